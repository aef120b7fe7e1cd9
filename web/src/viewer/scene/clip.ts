// Clips surfaces with a plane, and closes them with caps.
//
// Caps by stencil: where the back faces of a closed surface in the kept half-space outnumber its front faces, the plane
// is inside of it.
import * as three from "three";

const FACE = new three.PlaneGeometry(1, 1);

/**
 * Objects that close the cut of a body. plane: the positive side stays. order: 1, 2, ...: of coincident caps the one with
 * the higher order is visible.
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

/** Frees GPU resources of an object. all: geometries and textures too, not only materials. */
export function dispose(object: three.Object3D, all: boolean): void {
  object.traverse((child) => {
    const { geometry, material } = child as Partial<three.Mesh>;
    if (all) geometry?.dispose();
    for (const one of material === undefined ? [] : [material].flat()) {
      if (all && "map" in one) (one.map as three.Texture | null)?.dispose();
      one.dispose();
    }
  });
}
