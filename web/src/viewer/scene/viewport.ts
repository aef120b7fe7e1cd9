// The 3D viewport: surfaces in physical units, and objects of tools. Drawn on demand.
import * as three from "three";
import { cap, dispose } from "./clip";
import { CameraRig } from "./camera_rig";
import { clipped, firstHit, type Ray } from "./ray";
import { SplatMaterial, splats } from "./splats";
import type { Mesh } from "../../shared/wire";
import type { Eye } from "../api/api";

/** heights of the view, from where rays are as good as parallel */
const FAR = 1e4;
const ROUGH = { roughness: 0.55 };

type Solid = three.Mesh<three.BufferGeometry, three.MeshStandardMaterial>;
type Body = Solid | three.Points<three.BufferGeometry, SplatMaterial>;

/** Appearance of a surface. pickable: clicks hit it. */
export interface Appearance {
  colour: string;
  opacity: number;
  visible: boolean;
  pickable: boolean;
}

/** A visible surface. */
export interface VisibleSurface {
  key: number;
  mesh: Mesh;
  colour: string;
  tau: number;
}

export interface Hit {
  key: number;
  point: three.Vector3;
}

export class Viewport {
  readonly canvas: HTMLCanvasElement;
  readonly rig: CameraRig;
  readonly renderer: three.WebGLRenderer;
  private readonly scene = new three.Scene();
  private readonly bodies = new Map<number, Body>();
  private readonly meshes = new Map<number, Mesh>();
  /** materials of removed bodies, reused: a shader is deleted with its last material, and would be compiled again */
  private readonly materialPool: three.MeshStandardMaterial[] = [];
  private readonly splatPool: SplatMaterial[] = [];
  /** headlight, from above the left */
  private readonly light = new three.DirectionalLight(0xffffff, 1.8);
  /** its positive side stays; null: no clipping */
  private plane: three.Plane | null = null;
  private caps: three.Group[] = [];
  private isFrameRequested = false;
  /** milliseconds from the last frame that was drawn until another one could be */
  frameTime = 0;
  private readonly drawListeners: (() => void)[] = [];
  private readonly changeListeners: (() => void)[] = [];
  private readonly passes: ((scene: three.Scene, isStill: boolean) => void)[] = [];

  /** onDragEnd: the pointer was released after an orbit. */
  constructor(onDragEnd: () => void) {
    this.renderer = new three.WebGLRenderer({ antialias: true, alpha: true, stencil: true, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.canvas = this.renderer.domElement;
    this.rig = new CameraRig(this.canvas, () => this.draw(), onDragEnd);
    this.scene.add(new three.HemisphereLight(0xffffff, 0x667788, 1.6), this.light);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  /** Calls after every frame. */
  onDraw(listener: () => void): void {
    this.drawListeners.push(listener);
  }
  /** Calls when visible surfaces or their colours change. */
  onChange(listener: () => void): void {
    this.changeListeners.push(listener);
  }
  /** Calls before every frame, for offscreen passes. isStill: for an exported image. */
  onBeforeRender(listener: (scene: three.Scene, isStill: boolean) => void): void {
    this.passes.push(listener);
  }

  /** Adds an object beside the surfaces. Objects with userData.isTool are left out of exported images. */
  add(object: three.Object3D): void {
    this.scene.add(object);
    this.draw();
  }
  /** Removes an object and frees its resources. */
  drop(object: three.Object3D): void {
    this.scene.remove(object);
    dispose(object, true);
    this.draw();
  }

  /** Sets the surface of a key. tau: of coincident caps the one with the higher isovalue is visible. */
  put(key: number, mesh: Mesh, appearance: Appearance, tau: number): void {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(mesh.positions, 3));
    geometry.setAttribute("normal", new three.BufferAttribute(mesh.normals, 3, true));
    this.release(key);
    const body = mesh.spacing === undefined ? this.solid(geometry, mesh) : this.splats(geometry, mesh);
    body.position.set(...mesh.origin);
    body.scale.setScalar(mesh.step);
    body.updateMatrixWorld();
    body.userData = { tau, isOpen: mesh.isOpen };
    this.bodies.set(key, body);
    this.meshes.set(key, mesh);
    this.scene.add(body);
    this.applyAppearance(key, appearance);
  }

  applyAppearance(key: number, { colour, opacity, visible, pickable }: Appearance): void {
    const body = this.bodies.get(key);
    if (!body) return;
    const { material } = body;
    material.color.set(colour);
    material.opacity = opacity;
    material.needsUpdate = material.transparent !== opacity < 1;
    material.transparent = opacity < 1;
    material.depthWrite = opacity === 1;
    body.visible = visible;
    body.userData.pickable = pickable;
    this.updateClipping();
  }

  remove(key: number): void {
    this.release(key);
    this.updateClipping();
  }

  /** The surfaces that are seen. */
  get visibleSurfaces(): VisibleSurface[] {
    const visible = [...this.bodies].filter(([, body]) => body.visible);
    return visible.map(([key, body]) => ({
      key,
      mesh: this.meshes.get(key) as Mesh,
      colour: `#${body.material.color.getHexString()}`,
      tau: Number(body.userData.tau),
    }));
  }

  /** From where the scene is seen; of parallel rays from far away. */
  get eye(): Eye {
    const { view, height, forward, isFlat, labelUnit, camera } = this.rig;
    const [rows, aspect] = [Math.max(1, this.canvas.height), this.canvas.width / Math.max(1, this.canvas.height)];
    const away = isFlat ? FAR * height : 1;
    const high = isFlat ? height : labelUnit / camera.zoom; // of the picture, that far away
    const at = isFlat ? view.slice(3).map((x, i) => x - away * forward[i]!) : view.slice(0, 3);
    const angle = (360 / Math.PI) * Math.atan((high / 2) * Math.hypot(1, aspect) / away); // of its corners
    return { at, pixel: high / rows / away, towards: forward, angle: Math.min(angle, 179) };
  }

  /** Fits all visible surfaces to the view. */
  fit(): void {
    const box = new three.Box3();
    for (const body of this.bodies.values()) if (body.visible) box.expandByObject(body);
    if (!box.isEmpty()) this.rig.fit(box.getBoundingSphere(new three.Sphere()));
  }

  /** Clips with a plane: its negative side is removed; null: no clipping. */
  setClipPlane(plane: three.Plane | null): void {
    this.plane = plane;
    this.updateClipping();
  }
  get cutPlane(): three.Plane | null {
    return this.plane;
  }

  /** The nearest surface at a pixel, from the left and the top; null: none. */
  hit(left: number, top: number): Hit | null {
    const { origin, direction } = this.casterAt(left, top).ray;
    let ray: Ray = { origin: origin.toArray(), direction: direction.toArray(), begin: 0, end: Infinity };
    if (this.plane) ray = clipped(ray, this.plane.normal.toArray(), this.plane.constant);
    let key: number | null = null;
    for (const [other, body] of this.bodies) {
      if (!body.visible || body.userData.pickable !== true) continue;
      const t = firstHit(this.meshes.get(other) as Mesh, ray);
      if (t === null) continue;
      ray = { ...ray, end: t };
      key = other;
    }
    return key === null ? null : { key, point: origin.clone().addScaledVector(direction, ray.end) };
  }

  /** The nearest point there: of a surface, or of an object with userData.touchable. */
  pointAt(left: number, top: number): three.Vector3 | null {
    const caster = this.casterAt(left, top);
    const places = caster
      .intersectObjects(
        this.scene.children.filter(({ userData }) => userData.touchable === true),
        false,
      )
      .map(({ point }) => point);
    const hit = this.hit(left, top);
    if (hit) places.push(hit.point);
    const { origin } = caster.ray;
    return places.sort((a, b) => origin.distanceToSquared(a) - origin.distanceToSquared(b))[0] ?? null;
  }

  /** Key of the nearest surface at a pixel; null: none. */
  pick(left: number, top: number): number | null {
    return this.hit(left, top)?.key ?? null;
  }

  /** Renders once in another size, in pixels; `use` must read the canvas immediately. */
  renderToImage(width: number, height: number, use: (canvas: HTMLCanvasElement) => void): void {
    const tools = this.scene.children.filter(({ visible, userData }) => visible && userData.isTool === true);
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    this.rig.resize(width / height);
    for (const tool of tools) tool.visible = false;
    this.render(true);
    use(this.canvas);
    for (const tool of tools) tool.visible = true;
    this.resize();
    this.render();
  }

  /** Removed half-space: points p with normal . p > offset; null: none. */
  get clippedHalfSpace(): { normal: number[]; offset: number } | null {
    return this.plane && { normal: this.plane.normal.toArray().map((n) => -n), offset: this.plane.constant };
  }

  /** Requests a frame. */
  draw(): void {
    if (this.isFrameRequested) return;
    this.isFrameRequested = true;
    requestAnimationFrame((begun) => {
      this.isFrameRequested = false;
      this.render();
      for (const listener of this.drawListeners) listener();
      requestAnimationFrame((next) => (this.frameTime = next - begun));
    });
  }

  private casterAt(left: number, top: number): three.Raycaster {
    const { clientWidth, clientHeight } = this.canvas;
    const caster = new three.Raycaster();
    caster.setFromCamera(new three.Vector2((2 * left) / clientWidth - 1, 1 - (2 * top) / clientHeight), this.rig.camera);
    return caster;
  }

  private solid(geometry: three.BufferGeometry, { corners }: Mesh): Body {
    geometry.setIndex(new three.BufferAttribute(corners, 1));
    return new three.Mesh(geometry, this.materialPool.pop() ?? new three.MeshStandardMaterial({ ...ROUGH, side: three.DoubleSide }));
  }
  private splats(geometry: three.BufferGeometry, mesh: Mesh): Body {
    return splats(geometry, this.splatPool.pop() ?? new SplatMaterial(ROUGH), mesh);
  }

  private release(key: number): void {
    const body = this.bodies.get(key);
    if (!body) return;
    this.scene.remove(body);
    body.geometry.dispose();
    if (body instanceof three.Points) this.splatPool.push(body.material);
    else this.materialPool.push(body.material);
    this.bodies.delete(key);
    this.meshes.delete(key);
  }

  /** Updates clipping planes and caps. */
  private updateClipping(): void {
    for (const group of this.caps) {
      this.scene.remove(group);
      dispose(group, false);
    }
    this.caps = [];
    let order = 1;
    for (const body of [...this.bodies.values()].sort((a, b) => Number(a.userData.tau) - Number(b.userData.tau))) {
      body.material.clippingPlanes = this.plane ? [this.plane] : [];
      body.renderOrder = this.plane ? 100 : 0;
      const isCapped = body.visible && body instanceof three.Mesh && body.userData.isOpen !== true;
      if (this.plane && isCapped) this.caps.push(cap(body, this.plane, order++));
    }
    for (const group of this.caps) this.scene.add(group);
    for (const listener of this.changeListeners) listener();
    this.draw();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.rig.resize(clientWidth / clientHeight);
    this.draw();
  }

  private render(isStill = false): void {
    this.light.position.set(-0.4, 0.6, 1).applyQuaternion(this.rig.camera.quaternion);
    for (const pass of this.passes) pass(this.scene, isStill);
    this.renderer.render(this.scene, this.rig.camera);
    const { geometries, textures } = this.renderer.info.memory;
    this.canvas.dataset.gpuMemory = `${geometries} ${textures}`; // for tests and debugging of GPU memory
  }
}
