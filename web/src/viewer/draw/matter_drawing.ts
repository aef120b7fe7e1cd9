// Draws the volume as matter together with the surfaces: their depths first, then rays that end at them, then all of it over the picture.
// Coarse while something moves, fine when it rests.
import * as three from "three";
import { AXES, type Grid } from "../state/grid";
import { FRAGMENT, OVERLAY, VERTEX } from "./matter_shader";
import type { Stage } from "./stage";
import { PLACES } from "../ask/transfer";
import type { CoarseVolume } from "../ask/wire_samples";

/** milliseconds without a change */
const RESTED = 180;
/** of the smallest edge of a cube of samples */
const FINE_STEP = 0.5;
const COARSE_STEP = 1.5;
/** of the pixels of a side */
const COARSE_SIDE = 0.4;
/** milliseconds that a fine picture may take */
const PATIENCE = 900;

export class MatterDrawing {
  private readonly target = new three.WebGLRenderTarget(1, 1, { depthBuffer: false, type: three.HalfFloatType });
  private readonly opaque = new three.WebGLRenderTarget(1, 1, { stencilBuffer: true });
  private readonly values: three.Data3DTexture;
  private readonly rays: three.ShaderMaterial;
  private readonly alone = new three.Scene();
  private readonly overlay: three.Mesh<three.BufferGeometry, three.ShaderMaterial>;
  private readonly camera = new three.Camera();
  private readonly finest: number;
  private transfer: three.DataTexture | null = null;
  private table: Float32Array | null = null;
  private timer = 0;
  private resting = false;
  /** milliseconds of a coarse picture */
  private took = 0;
  private seen = "";

  constructor(
    private readonly stage: Stage,
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
      lamp: new three.Vector3(),
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
    this.alone.add(everywhere(this.rays));
    this.overlay = everywhere(shader(OVERLAY, { matter: this.target.texture }));
    Object.assign(this.overlay.material, {
      transparent: true,
      blending: three.CustomBlending,
      blendSrc: three.OneFactor,
      blendDst: three.OneMinusSrcAlphaFactor,
    });
    this.overlay.renderOrder = -1; // what is transparent comes over it
    this.overlay.visible = false;
    stage.onPass((scene, isStill) => this.draw(scene, isStill));
    stage.add(this.overlay);
  }

  /** table: of transfer.ts, between the values of bytes 0 and 255; density: factor. null: nothing is seen. */
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
    this.seen = "";
    this.stage.draw();
  }

  private draw(scene: three.Scene, isStill: boolean): void {
    if (!this.overlay.visible) return;
    if (isStill) return this.march(scene, true, 1);
    const now = this.look;
    if (now !== this.seen) {
      this.seen = now;
      this.resting = false;
      clearTimeout(this.timer);
      this.timer = window.setTimeout(() => {
        this.resting = true;
        this.stage.draw();
      }, RESTED);
    }
    this.march(scene, this.resting, this.resting ? this.fineSide : COARSE_SIDE);
  }

  /** All that the picture depends on, but for surfaces. */
  private get look(): string {
    const { camera } = this.stage.eye;
    return [
      ...camera.matrixWorld.elements,
      ...camera.projectionMatrix.elements,
      this.stage.cutPlane?.constant,
      this.rays.uniforms.density!.value,
      ...this.stage.renderer.getDrawingBufferSize(new three.Vector2()).toArray(),
    ].join();
  }

  /** side: of the pixels of a side, 0 to 1. */
  private march(scene: three.Scene, fine: boolean, side: number): void {
    const { renderer, eye, cutPlane } = this.stage;
    const { camera } = eye;
    const size = renderer.getDrawingBufferSize(new three.Vector2()).multiplyScalar(side).ceil();
    for (const target of [this.target, this.opaque])
      if (target.width !== size.x || target.height !== size.y) target.setSize(size.x, size.y);
    camera.updateMatrixWorld();
    const { uniforms } = this.rays;
    (uniforms.toWorld!.value as three.Matrix4).multiplyMatrices(camera.matrixWorld, camera.projectionMatrixInverse);
    (uniforms.cut!.value as three.Vector4).set(...(cutPlane?.normal.toArray() ?? [0, 0, 0]), cutPlane?.constant ?? 1);
    (uniforms.lamp!.value as three.Vector3).set(-0.4, 0.6, 1).normalize().applyQuaternion(camera.quaternion);
    uniforms.step_!.value = this.finest * (fine ? FINE_STEP : COARSE_STEP);
    const began = performance.now();
    this.overlay.visible = false;
    renderer.setRenderTarget(this.opaque);
    renderer.clear();
    renderer.render(scene, camera);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(this.alone, this.camera);
    renderer.setRenderTarget(null);
    this.overlay.visible = true;
    if (fine) return;
    renderer.readRenderTargetPixels(this.target, 0, 0, 1, 1, new Uint16Array(4)); // waits until it is drawn
    this.took = performance.now() - began;
  }

  /** As fine as patience allows: rays cost what their number and their steps say. */
  private get fineSide(): number {
    const whole = (this.took / COARSE_SIDE ** 2) * (COARSE_STEP / FINE_STEP);
    return Math.min(1, Math.max(COARSE_SIDE, Math.sqrt(PATIENCE / Math.max(whole, 1))));
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

/** The texture has a texel for every cube of samples; the box ends at the outermost samples. */
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
