// Volume rendering together with surfaces: a depth pass of the surfaces, rays that end there, and a composite.
// Coarse during interaction, fine when idle.
import * as three from "three";
import { AXES, type Grid } from "../state/grid";
import { FRAGMENT, OVERLAY, VERTEX } from "./volume_shader";
import type { Viewport } from "./viewport";
import { PLACES } from "../api/transfer_function";
import type { CoarseVolume } from "../api/wire_samples";

/** milliseconds without a change until a fine frame */
const FINE_DELAY = 180;
/** step of rays, relative to the smallest edge of a cube of samples */
const FINE_STEP = 0.5;
const COARSE_STEP = 1.5;
/** resolution, as a fraction of the sides of the viewport */
const COARSE_SIDE = 0.4;
/** time limit of a fine frame, in milliseconds */
const MAX_FINE_TIME = 900;

export class VolumeRenderer {
  private readonly target = new three.WebGLRenderTarget(1, 1, { depthBuffer: false, type: three.HalfFloatType });
  private readonly opaque = new three.WebGLRenderTarget(1, 1, { stencilBuffer: true });
  private readonly values: three.Data3DTexture;
  private readonly rays: three.ShaderMaterial;
  private readonly rayScene = new three.Scene();
  private readonly overlay: three.Mesh<three.BufferGeometry, three.ShaderMaterial>;
  private readonly camera = new three.Camera();
  private readonly finest: number;
  private transfer: three.DataTexture | null = null;
  private table: Float32Array | null = null;
  private timer = 0;
  private isFine = false;
  /** milliseconds of a coarse frame */
  private took = 0;
  private lastViewKey = "";

  constructor(
    private readonly viewport: Viewport,
    grid: Grid,
    volume: CoarseVolume,
  ) {
    this.opaque.depthTexture = new three.DepthTexture(1, 1, three.UnsignedInt248Type);
    this.opaque.depthTexture.format = three.DepthStencilFormat;
    this.values = new three.Data3DTexture(volume.bytes, ...volume.size);
    Object.assign(this.values, {
      format: three.RedFormat,
      minFilter: three.LinearFilter,
      magFilter: three.LinearFilter,
      unpackAlignment: 1,
      needsUpdate: true,
    });
    this.finest = volume.step * Math.min(...grid.rulers.map(({ finest }) => finest));
    const uniforms = {
      ...placedIn(grid, volume),
      values: this.values,
      transfer: null,
      depths: this.opaque.depthTexture,
      toWorld: new three.Matrix4(),
      cut: new three.Vector4(),
      step_: 1,
      density: 1,
      lightDirection: new three.Vector3(),
      seed: 0,
    };
    this.rays = shader(FRAGMENT, uniforms);
    const triangle = new three.BufferGeometry().setAttribute(
      "position",
      new three.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3),
    );
    const everywhere = (material: three.ShaderMaterial): three.Mesh<three.BufferGeometry, three.ShaderMaterial> => {
      const mesh = new three.Mesh(triangle, material);
      mesh.frustumCulled = false;
      return mesh;
    };
    this.rayScene.add(everywhere(this.rays));
    this.overlay = everywhere(shader(OVERLAY, { image: this.target.texture }));
    Object.assign(this.overlay.material, {
      transparent: true,
      blending: three.CustomBlending,
      blendSrc: three.OneFactor,
      blendDst: three.OneMinusSrcAlphaFactor,
    });
    this.overlay.renderOrder = -1; // transparent surfaces are drawn over it
    this.overlay.visible = false;
    viewport.onBeforeRender((scene, isStill) => this.draw(scene, isStill));
    viewport.add(this.overlay);
  }

  /** table: of api/transfer_function.ts, between the values of bytes 0 and 255; density: factor. null: hidden. */
  show(table: Float32Array<ArrayBuffer> | null, density = 1): void {
    this.overlay.visible = table !== null;
    if (table && this.table !== table) {
      this.table = table;
      this.transfer?.dispose();
      this.transfer = new three.DataTexture(table, PLACES + 1, 1, three.RGBAFormat, three.FloatType);
      this.transfer.needsUpdate = true;
      this.rays.uniforms.transfer!.value = this.transfer;
    }
    this.rays.uniforms.density!.value = density;
    this.lastViewKey = "";
    this.viewport.draw();
  }

  private draw(scene: three.Scene, isStill: boolean): void {
    if (!this.overlay.visible) return;
    if (isStill) return this.march(scene, true, 1);
    const now = this.viewKey;
    if (now !== this.lastViewKey) {
      this.lastViewKey = now;
      this.isFine = false;
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => {
        this.isFine = true;
        this.viewport.draw();
      }, FINE_DELAY);
    }
    this.march(scene, this.isFine, this.isFine ? this.fineSide : COARSE_SIDE);
  }

  /** Everything that the image depends on, except surfaces. */
  private get viewKey(): string {
    const { camera } = this.viewport.rig;
    return [
      ...camera.matrixWorld.elements,
      ...camera.projectionMatrix.elements,
      this.viewport.cutPlane?.constant,
      this.rays.uniforms.density!.value,
      ...this.viewport.renderer.getDrawingBufferSize(new three.Vector2()).toArray(),
    ].join();
  }

  /** side: resolution as a fraction, 0 to 1. */
  private march(scene: three.Scene, fine: boolean, side: number): void {
    const { renderer, rig, cutPlane } = this.viewport;
    const { camera } = rig;
    const size = renderer.getDrawingBufferSize(new three.Vector2()).multiplyScalar(side).ceil();
    for (const target of [this.target, this.opaque])
      if (target.width !== size.x || target.height !== size.y) target.setSize(size.x, size.y);
    camera.updateMatrixWorld();
    const { uniforms } = this.rays;
    (uniforms.toWorld!.value as three.Matrix4).multiplyMatrices(camera.matrixWorld, camera.projectionMatrixInverse);
    (uniforms.cut!.value as three.Vector4).set(...(cutPlane?.normal.toArray() ?? [0, 0, 0]), cutPlane?.constant ?? 1);
    (uniforms.lightDirection!.value as three.Vector3).set(-0.4, 0.6, 1).normalize().applyQuaternion(camera.quaternion);
    uniforms.step_!.value = this.finest * (fine ? FINE_STEP : COARSE_STEP);
    const began = performance.now();
    this.overlay.visible = false;
    renderer.setRenderTarget(this.opaque);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(this.rayScene, this.camera);
    renderer.setRenderTarget(null);
    this.overlay.visible = true;
    if (fine) return;
    renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, new Uint16Array(4)); // blocks until the frame is finished
    this.took = performance.now() - began;
  }

  /** Highest resolution within the time limit: the cost is proportional to the number of rays and steps. */
  private get fineSide(): number {
    const whole = (this.took / COARSE_SIDE ** 2) * (COARSE_STEP / FINE_STEP);
    return Math.min(1, Math.max(COARSE_SIDE, Math.sqrt(MAX_FINE_TIME / Math.max(whole, 1))));
  }
}

function shader(fragmentShader: string, values: Record<string, unknown>): three.ShaderMaterial {
  const uniforms = Object.fromEntries(Object.entries(values).map(([name, value]) => [name, { value }]));
  return new three.ShaderMaterial({
    glslVersion: three.GLSL3,
    vertexShader: VERTEX,
    fragmentShader,
    uniforms,
    depthTest: false,
    depthWrite: false,
  });
}

/** One texel per cube of samples; the box ends at the outermost samples. */
function placedIn(grid: Grid, { size, step }: CoarseVolume): { toTexture: three.Matrix4; low: three.Vector3; high: three.Vector3 } {
  const texture = (sample: number, axis: number): number => ((sample - (step - 1) / 2) / step + 0.5) / size[axis]!;
  const rows = grid.fromSteps([0, 0, 0], 1).map((row, axis) => {
    const scale = 1 / (step * size[axis]! * grid.rulers[axis]!.finest);
    return [row[0]! * scale, row[1]! * scale, row[2]! * scale, texture(row[3]! / grid.rulers[axis]!.finest, axis)];
  });
  const toTexture = new three.Matrix4().set(
    ...(rows.flat() as [number, number, number, number, number, number, number, number, number, number, number, number]),
    0,
    0,
    0,
    1,
  );
  const ends = (end: 0 | 1): three.Vector3 =>
    new three.Vector3(...(AXES.map((axis) => texture(end * (grid.size[axis] - 1), axis)) as [number, number, number]));
  return { toTexture, low: ends(0), high: ends(1) };
}
