// A plane that cuts everything open, and the cut faces: what is solid behind the plane shows as solid.
//
// Closed surfaces: where the back sides of a surface in front of the far half outnumber its front sides, the plane is inside it. The
// stencil counts.
import * as three from "three";

const FACE = new three.PlaneGeometry(1, 1);

/**
 * What must be drawn besides a body so that its cut is closed. plane: what lies on its positive side stays. order: 1, 2, ...: where cuts
 * lie in one place, the later one is seen.
 */
export function cap(body: three.Mesh<three.BufferGeometry, three.MeshStandardMaterial>, plane: three.Plane, order: number): three.Group {
  const group = new three.Group();
  const count = (side: three.Side, operation: three.StencilOp): three.Mesh => {
    const material = new three.MeshBasicMaterial({
      depthWrite: false,
      depthTest: false,
      colorWrite: false,
      stencilWrite: true,
      stencilFunc: three.AlwaysStencilFunc,
      side,
      clippingPlanes: [plane],
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
    FACE,
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
  plane.projectPoint(ball.center, face.position);
  face.lookAt(face.position.clone().add(plane.normal));
  face.scale.setScalar(4 * ball.radius);
  group.add(count(three.BackSide, three.IncrementWrapStencilOp), count(three.FrontSide, three.DecrementWrapStencilOp), face);
  return group;
}

/** Frees what something on the stage holds. all: its geometries and textures too, not only its materials. */
export function dispose(thing: three.Object3D, all: boolean): void {
  thing.traverse((child) => {
    const { geometry, material } = child as Partial<three.Mesh>;
    if (all) geometry?.dispose();
    for (const one of material === undefined ? [] : [material].flat()) {
      if (all && "map" in one) (one.map as three.Texture | null)?.dispose();
      one.dispose();
    }
  });
}
