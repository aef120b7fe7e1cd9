// The picture: meshes in a frame of physical units. Drawn when something has changed.
import * as three from "three";
import { Clip, dispose } from "./clip";
import { Eye } from "./eye";
import type { Mesh } from "./wire";

type Body = three.Mesh<three.BufferGeometry, three.MeshStandardMaterial>;

/** How a body is drawn. solid: a click hits it. */
export interface Dress {
  colour: string;
  opacity: number;
  visible: boolean;
  solid: boolean;
}

export class Stage {
  readonly canvas: HTMLCanvasElement;
  readonly eye: Eye;
  private readonly renderer: three.WebGLRenderer;
  private readonly scene = new three.Scene();
  private readonly bodies = new Map<number, Body>();
  /** over the left shoulder */
  private readonly lamp = new three.DirectionalLight(0xffffff, 1.8);
  private readonly clip = new Clip();
  /** in which direction it is cut */
  private readonly towards = new three.Vector3(0, 1, 0);
  private caps: three.Group[] = [];
  private box: three.LineSegments | null = null;
  private asked = false;
  private readonly listeners: (() => void)[] = [];

  /** rested: the hand has let go after turning. */
  constructor(rested: () => void) {
    this.renderer = new three.WebGLRenderer({ antialias: true, alpha: true, stencil: true, preserveDrawingBuffer: true });
    this.renderer.localClippingEnabled = true;
    this.canvas = this.renderer.domElement;
    this.eye = new Eye(this.canvas, () => this.draw(), rested);
    this.scene.add(new three.HemisphereLight(0xffffff, 0x667788, 1.6), this.lamp);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  /** Calls after every picture, with the length of its height in physical units. */
  onDraw(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Replaces what stands under this key. tau: on a cut, what has the higher isovalue is seen. */
  put(key: number, mesh: Mesh, dress: Dress, tau: number): void {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(mesh.positions, 3));
    geometry.setAttribute("normal", new three.BufferAttribute(mesh.normals, 3, true));
    geometry.setIndex(new three.BufferAttribute(mesh.corners, 1));
    this.take(key);
    const body: Body = new three.Mesh(geometry, new three.MeshStandardMaterial({ roughness: 0.55, side: three.DoubleSide }));
    body.position.set(...mesh.origin);
    body.scale.setScalar(mesh.step);
    body.updateMatrixWorld();
    body.userData = { tau };
    this.bodies.set(key, body);
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
    this.cut();
  }

  remove(key: number): void {
    this.take(key);
    this.cut();
  }

  /** All there is in the middle of the picture. */
  fit(): void {
    const ball = this.ball();
    if (ball) this.eye.fit(ball);
  }

  /** Cuts everything open, from where one looks now, or closes it. */
  open(on: boolean): void {
    this.clip.on = on;
    this.eye.camera.getWorldDirection(this.towards);
    this.slide(0.5);
  }
  /** Moves the cut. share: of what stays, 0 to 1. */
  slide(share: number): void {
    const ball = this.ball();
    if (ball) this.clip.set(ball, this.towards.clone().negate(), share);
    this.cut();
  }
  get isOpen(): boolean {
    return this.clip.on;
  }

  /** The edges of the volume, or not. corners: of the box, physical. */
  frame(corners: [number, number, number][] | null): void {
    if (this.box) {
      this.scene.remove(this.box);
      this.box.geometry.dispose();
      this.box = null;
    }
    if (corners) {
      const edges = [0, 1, 2].flatMap((axis) => [0, 1, 2, 3, 4, 5, 6, 7].filter((i) => !(i & (1 << axis))).map((i) => [i, i | (1 << axis)])).flat();
      const geometry = new three.BufferGeometry().setFromPoints(edges.map((i) => new three.Vector3(...(corners[i] as [number, number, number]))));
      this.box = new three.LineSegments(geometry, new three.LineBasicMaterial({ color: 0x888888 }));
      this.scene.add(this.box);
    }
    this.draw();
  }

  /** What stands under this key at a place of the picture, in pixels from its left and its top; null: nothing. */
  pick(left: number, top: number): number | null {
    const { clientWidth, clientHeight } = this.canvas;
    const ray = new three.Raycaster();
    ray.setFromCamera(new three.Vector2((2 * left) / clientWidth - 1, 1 - (2 * top) / clientHeight), this.eye.camera);
    const hits = ray.intersectObjects([...this.bodies.values()].filter(({ visible, userData }) => visible && userData.solid === true), false);
    const hit = hits.find(({ point }) => !this.clip.on || this.clip.plane.distanceToPoint(point) >= 0);
    for (const [key, body] of this.bodies) if (body === hit?.object) return key;
    return null;
  }

  /** Draws once in another size, in pixels; `use` gets the canvas, which must be read at once. */
  shoot(width: number, height: number, use: (canvas: HTMLCanvasElement) => void): void {
    this.renderer.setPixelRatio(1);
    this.renderer.setSize(width, height, false);
    this.eye.resize(width / height);
    this.render();
    use(this.canvas);
    this.resize();
    this.render();
  }

  /** What is cut away: points p with normal . p > offset; null: nothing. */
  get removed(): { normal: number[]; offset: number } | null {
    const { on, plane } = this.clip;
    return on ? { normal: plane.normal.toArray().map((n) => -n), offset: plane.constant } : null;
  }

  private take(key: number): void {
    const body = this.bodies.get(key);
    if (!body) return;
    this.scene.remove(body);
    body.geometry.dispose();
    body.material.dispose();
    this.bodies.delete(key);
  }

  private ball(): three.Sphere | null {
    const box = new three.Box3();
    for (const body of this.bodies.values()) if (body.visible) box.expandByObject(body);
    return box.isEmpty() ? null : box.getBoundingSphere(new three.Sphere());
  }

  /** Makes planes and cut faces what they must be. */
  private cut(): void {
    for (const cap of this.caps) {
      this.scene.remove(cap);
      dispose(cap);
    }
    this.caps = [];
    let order = 1;
    for (const body of [...this.bodies.values()].sort((a, b) => Number(a.userData.tau) - Number(b.userData.tau))) {
      body.material.clippingPlanes = this.clip.planes;
      body.renderOrder = this.clip.on ? 100 : 0;
      if (this.clip.on && body.visible) this.caps.push(this.clip.cap(body, order++));
    }
    for (const cap of this.caps) this.scene.add(cap);
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

  private render(): void {
    this.lamp.position.set(-0.4, 0.6, 1).applyQuaternion(this.eye.camera.quaternion);
    this.renderer.render(this.scene, this.eye.camera);
  }

  private draw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.render();
      for (const listener of this.listeners) listener();
    });
  }
}
