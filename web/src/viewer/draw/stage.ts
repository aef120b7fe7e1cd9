// The picture: meshes in a frame of physical units, and what other parts put beside them. Drawn when something has changed.
import * as three from "three";
import { cap, dispose } from "./clip";
import { Eye } from "./eye";
import { clipped, firstHit, type Ray } from "./ray";
import type { Mesh } from "../ask/wire";

type Body = three.Mesh<three.BufferGeometry, three.MeshStandardMaterial>;

/** How a body is drawn. solid: a click hits it. */
export interface Dress {
  colour: string;
  opacity: number;
  visible: boolean;
  solid: boolean;
}

/** A surface on the stage. */
export interface Standing {
  key: number;
  mesh: Mesh;
  colour: string;
  tau: number;
}

export interface Hit {
  key: number;
  point: three.Vector3;
}

export class Stage {
  readonly canvas: HTMLCanvasElement;
  readonly eye: Eye;
  readonly renderer: three.WebGLRenderer;
  private readonly scene = new three.Scene();
  private readonly bodies = new Map<number, Body>();
  private readonly meshes = new Map<number, Mesh>();
  /** of bodies that were taken away, for those that come: with its last material a shader goes, and is compiled anew at every step */
  private readonly spare: three.MeshStandardMaterial[] = [];
  /** over the left shoulder */
  private readonly lamp = new three.DirectionalLight(0xffffff, 1.8);
  /** what lies on its positive side stays; null: nothing is cut away */
  private plane: three.Plane | null = null;
  private caps: three.Group[] = [];
  private asked = false;
  private readonly drawn: (() => void)[] = [];
  private readonly changed: (() => void)[] = [];
  private readonly passes: ((scene: three.Scene, isStill: boolean) => void)[] = [];

  /** rested: the hand has let go after turning. */
  constructor(rested: () => void) {
    this.renderer = new three.WebGLRenderer({ antialias: true, alpha: true, stencil: true, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.canvas = this.renderer.domElement;
    this.eye = new Eye(this.canvas, () => this.draw(), rested);
    this.scene.add(new three.HemisphereLight(0xffffff, 0x667788, 1.6), this.lamp);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  /** Calls after every picture. */
  onDraw(listener: () => void): void {
    this.drawn.push(listener);
  }
  /** Calls when other surfaces stand on the stage, or in other colours. */
  onChange(listener: () => void): void {
    this.changed.push(listener);
  }
  /** Calls before every picture, for what is drawn aside first. isStill: it will be kept. */
  onPass(listener: (scene: three.Scene, isStill: boolean) => void): void {
    this.passes.push(listener);
  }

  /** Puts something beside the surfaces. With userData.isTool it is for the hand: pictures that are kept are without it. */
  add(thing: three.Object3D): void {
    this.scene.add(thing);
    this.draw();
  }
  /** Takes it away for good. */
  drop(thing: three.Object3D): void {
    this.scene.remove(thing);
    dispose(thing, true);
    this.draw();
  }

  /** Replaces what stands under this key. tau: on a cut, what has the higher isovalue is seen. */
  put(key: number, mesh: Mesh, dress: Dress, tau: number): void {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(mesh.positions, 3));
    geometry.setAttribute("normal", new three.BufferAttribute(mesh.normals, 3, true));
    geometry.setIndex(new three.BufferAttribute(mesh.corners, 1));
    this.take(key);
    const material = this.spare.pop() ?? new three.MeshStandardMaterial({ roughness: 0.55, side: three.DoubleSide });
    const body: Body = new three.Mesh(geometry, material);
    body.position.set(...mesh.origin);
    body.scale.setScalar(mesh.step);
    body.updateMatrixWorld();
    body.userData = { tau };
    this.bodies.set(key, body);
    this.meshes.set(key, mesh);
    this.scene.add(body);
    this.dress(key, dress);
  }

  dress(key: number, { colour, opacity, visible, solid }: Dress): void {
    const body = this.bodies.get(key);
    if (!body) return;
    const { material } = body;
    material.color.set(colour);
    material.opacity = opacity;
    material.needsUpdate = material.transparent !== opacity < 1;
    material.transparent = opacity < 1;
    material.depthWrite = opacity === 1;
    body.visible = visible;
    body.userData.solid = solid;
    this.arrange();
  }

  remove(key: number): void {
    this.take(key);
    this.arrange();
  }

  /** The surfaces that are seen. */
  get standing(): Standing[] {
    const seen = [...this.bodies].filter(([, body]) => body.visible);
    return seen.map(([key, body]) => ({
      key,
      mesh: this.meshes.get(key) as Mesh,
      colour: `#${body.material.color.getHexString()}`,
      tau: Number(body.userData.tau),
    }));
  }

  /** All there is in the middle of the picture. */
  fit(): void {
    const box = new three.Box3();
    for (const body of this.bodies.values()) if (body.visible) box.expandByObject(body);
    if (!box.isEmpty()) this.eye.fit(box.getBoundingSphere(new three.Sphere()));
  }

  /** Cuts away what lies on the negative side of a plane; null: nothing. */
  cut(plane: three.Plane | null): void {
    this.plane = plane;
    this.arrange();
  }
  get cutPlane(): three.Plane | null {
    return this.plane;
  }

  /** The nearest surface at a place of the picture, in pixels from its left and its top; null: none. */
  hit(left: number, top: number): Hit | null {
    const { origin, direction } = this.casterAt(left, top).ray;
    let ray: Ray = { origin: origin.toArray(), direction: direction.toArray(), begin: 0, end: Infinity };
    if (this.plane) ray = clipped(ray, this.plane.normal.toArray(), this.plane.constant);
    let key: number | null = null;
    for (const [other, body] of this.bodies) {
      if (!body.visible || body.userData.solid !== true) continue;
      const t = firstHit(this.meshes.get(other) as Mesh, ray);
      if (t === null) continue;
      ray = { ...ray, end: t };
      key = other;
    }
    return key === null ? null : { key, point: origin.clone().addScaledVector(direction, ray.end) };
  }

  /** The nearest place there: of a surface, or of something beside them that can be touched (its userData says so). */
  touch(left: number, top: number): three.Vector3 | null {
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

  /** What stands under this key at a place of the picture; null: nothing. */
  pick(left: number, top: number): number | null {
    return this.hit(left, top)?.key ?? null;
  }

  /** Draws once in another size, in pixels; `use` gets the canvas, which must be read at once. */
  shoot(width: number, height: number, use: (canvas: HTMLCanvasElement) => void): void {
    const tools = this.scene.children.filter(({ visible, userData }) => visible && userData.isTool === true);
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    this.eye.resize(width / height);
    for (const tool of tools) tool.visible = false;
    this.render(true);
    use(this.canvas);
    for (const tool of tools) tool.visible = true;
    this.resize();
    this.render();
  }

  /** What is cut away: points p with normal . p > offset; null: nothing. */
  get removed(): { normal: number[]; offset: number } | null {
    return this.plane && { normal: this.plane.normal.toArray().map((n) => -n), offset: this.plane.constant };
  }

  /** Soon. */
  draw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.render();
      for (const listener of this.drawn) listener();
    });
  }

  private casterAt(left: number, top: number): three.Raycaster {
    const { clientWidth, clientHeight } = this.canvas;
    const caster = new three.Raycaster();
    caster.setFromCamera(new three.Vector2((2 * left) / clientWidth - 1, 1 - (2 * top) / clientHeight), this.eye.camera);
    return caster;
  }

  private take(key: number): void {
    const body = this.bodies.get(key);
    if (!body) return;
    this.scene.remove(body);
    body.geometry.dispose();
    this.spare.push(body.material);
    this.bodies.delete(key);
    this.meshes.delete(key);
  }

  /** Makes planes and cut faces what they must be. */
  private arrange(): void {
    for (const group of this.caps) {
      this.scene.remove(group);
      dispose(group, false);
    }
    this.caps = [];
    let order = 1;
    for (const body of [...this.bodies.values()].sort((a, b) => Number(a.userData.tau) - Number(b.userData.tau))) {
      body.material.clippingPlanes = this.plane ? [this.plane] : [];
      body.renderOrder = this.plane ? 100 : 0;
      if (this.plane && body.visible) this.caps.push(cap(body, this.plane, order++));
    }
    for (const group of this.caps) this.scene.add(group);
    for (const listener of this.changed) listener();
    this.draw();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.eye.resize(clientWidth / clientHeight);
    this.draw();
  }

  private render(isStill = false): void {
    this.lamp.position.set(-0.4, 0.6, 1).applyQuaternion(this.eye.camera.quaternion);
    for (const pass of this.passes) pass(this.scene, isStill);
    this.renderer.render(this.scene, this.eye.camera);
    const { geometries, textures } = this.renderer.info.memory;
    this.canvas.dataset.held = `${geometries} ${textures}`; // for tests, and for those who wonder about memory
  }
}
