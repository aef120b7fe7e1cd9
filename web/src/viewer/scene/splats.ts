// Points of a surface, drawn as discs about as wide as the points are apart: in place of a surface that has too many triangles to be drawn.
import * as three from "three";
import type { Mesh } from "../../shared/wire";

/** of discs, which are no lattice */
const OVERLAP = 1.6;

// Diffuse light alone, once a point: without a graphics card every pixel that a shader computes counts, and discs overlap.
const VERTEX = `
  #include <common>
  #include <lights_pars_begin>
  #include <clipping_planes_pars_vertex>
  uniform vec3 diffuse;
  uniform float splatWidth;
  uniform float viewHeight;
  varying vec3 vLit;
  void main() {
    #include <begin_vertex>
    #include <project_vertex>
    #include <clipping_planes_vertex>
    vec3 n = normalize(normalMatrix * normal);
    if (dot(n, mvPosition.xyz) > 0.0) n = -n; // both sides are lit
    vec3 light = max(dot(n, directionalLights[0].direction), 0.0) * directionalLights[0].color;
    light += mix(hemisphereLights[0].groundColor, hemisphereLights[0].skyColor, 0.5 * dot(n, hemisphereLights[0].direction) + 0.5);
    vLit = RECIPROCAL_PI * diffuse * light;
    gl_PointSize = 0.5 * splatWidth * viewHeight * projectionMatrix[1][1] / gl_Position.w;
  }`;
const FRAGMENT = `
  #include <common>
  #include <clipping_planes_pars_fragment>
  uniform float opacity;
  varying vec3 vLit;
  void main() {
    #include <clipping_planes_fragment>
    if (length(gl_PointCoord - 0.5) > 0.5) discard;
    gl_FragColor = vec4(vLit, opacity);
    #include <colorspace_fragment>
  }`;

/** Colour, opacity and clipping as of surfaces. */
export class SplatMaterial extends three.MeshStandardMaterial {
  /** of a disc, in the unit of positions */
  readonly width = { value: 1 };
  /** pixels */
  readonly viewHeight = { value: 1 };

  override onBeforeCompile(shader: three.WebGLProgramParametersWithUniforms): void {
    Object.assign(shader.uniforms, { splatWidth: this.width, viewHeight: this.viewHeight });
    Object.assign(shader, { vertexShader: VERTEX, fragmentShader: FRAGMENT });
  }
}

/** Of a mesh without triangles. */
export function splats(
  geometry: three.BufferGeometry,
  material: SplatMaterial,
  { spacing = 0 }: Mesh,
): three.Points<three.BufferGeometry, SplatMaterial> {
  const points = new three.Points(geometry, material);
  const size = new three.Vector2();
  material.width.value = OVERLAP * spacing;
  points.onBeforeRender = (renderer) => (material.viewHeight.value = renderer.getDrawingBufferSize(size).y);
  return points;
}
