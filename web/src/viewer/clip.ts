// A plane that cuts everything open, and the cut faces: what is solid behind the plane shows as solid.
//
// Closed surfaces: where the back sides of a surface in front of the far half outnumber its front sides, the plane is inside it. The stencil counts.
import * as three from "three";

export class Clip {
  /** what lies on its positive side stays */
  readonly plane = new three.Plane(new three.Vector3(0, 0, -1), 0);
  on = false;
  private readonly face = new three.PlaneGeometry(1, 1);

  /** The cut through a ball: share 0 keeps nothing of it, 1 everything. away: the direction that is cut off first. */
  set(ball: three.Sphere, away: three.Vector3, share: number): void {
    const normal = away.clone().normalize().negate();
    const point = ball.center.clone().addScaledVector(normal, ball.radius * (1 - 2 * share));
    this.plane.setFromNormalAndCoplanarPoint(normal, point);
  }

  get planes(): three.Plane[] {
    return this.on ? [this.plane] : [];
  }

  /** What must be drawn besides a body so that its cut is closed. order: 1, 2, ...: where cuts lie in one place, the later one is seen. */
  cap(body: three.Mesh<three.BufferGeometry, three.MeshStandardMaterial>, order: number): three.Group {
    const group = new three.Group();
    const count = (side: three.Side, operation: three.StencilOp): three.Mesh => {
      const material = new three.MeshBasicMaterial({
        depthWrite: false,
        depthTest: false,
        colorWrite: false,
        stencilWrite: true,
        stencilFunc: three.AlwaysStencilFunc,
        side,
        clippingPlanes: [this.plane],
        stencilFail: operation,
        stencilZFail: operation,
        stencilZPass: operation,
      });
      const counted = new three.Mesh(body.geometry, material);
      counted.position.copy(body.position);
      counted.scale.copy(body.scale);
      counted.renderOrder = order;
      return counted;
    };
    const face = new three.Mesh(
      this.face,
      new three.MeshStandardMaterial({
        color: body.material.color,
        roughness: 0.9,
        side: three.DoubleSide,
        opacity: body.material.opacity,
        transparent: body.material.transparent,
        stencilWrite: true,
        stencilRef: 0,
        stencilFunc: three.NotEqualStencilFunc,
        stencilFail: three.ZeroStencilOp,
        stencilZFail: three.ZeroStencilOp,
        stencilZPass: three.ZeroStencilOp,
        polygonOffset: true,
        polygonOffsetFactor: -order,
        polygonOffsetUnits: -4 * order,
      }),
    );
    face.renderOrder = order + 0.5;
    const ball = new three.Box3().setFromObject(body).getBoundingSphere(new three.Sphere());
    this.plane.projectPoint(ball.center, face.position);
    face.lookAt(face.position.clone().add(this.plane.normal));
    face.scale.setScalar(4 * ball.radius);
    group.add(count(three.BackSide, three.IncrementWrapStencilOp), count(three.FrontSide, three.DecrementWrapStencilOp), face);
    return group;
  }
}

export function dispose(group: three.Object3D): void {
  group.traverse((child) => {
    if (child instanceof three.Mesh && child.material instanceof three.Material) child.material.dispose();
  });
}
