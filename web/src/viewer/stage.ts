// The picture: meshes in a frame of physical units, turned with the mouse, a finger or keys. Drawn when something has changed.
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Mesh } from "./wire";

export class Stage {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: three.WebGLRenderer;
  private readonly scene = new three.Scene();
  private readonly camera = new three.PerspectiveCamera(30, 1, 0.1, 1000);
  private readonly controls: OrbitControls;
  private readonly meshes = new Map<number, three.Mesh<three.BufferGeometry, three.MeshStandardMaterial>>();
  private asked = false;

  /** moved: the camera has come to rest somewhere else */
  constructor(moved: () => void) {
    this.renderer = new three.WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.canvas = this.renderer.domElement;
    this.camera.up.set(0, 0, 1);
    this.scene.add(new three.HemisphereLight(0xffffff, 0x667788, 1.6), this.camera);
    const lamp = new three.DirectionalLight(0xffffff, 1.8);
    lamp.position.set(-0.4, 0.6, 1);
    this.camera.add(lamp);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.controls.addEventListener("end", moved);
    new ResizeObserver(() => this.resize()).observe(this.canvas);
  }

  /** Replaces what stands under this key. */
  put(key: number, mesh: Mesh, colour: string, opacity: number): void {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(mesh.positions, 3));
    geometry.setAttribute("normal", new three.BufferAttribute(mesh.normals, 3, true));
    geometry.setIndex(new three.BufferAttribute(mesh.corners, 1));
    this.remove(key);
    const body = new three.Mesh(geometry, new three.MeshStandardMaterial({ color: colour, roughness: 0.55, side: three.DoubleSide }));
    body.position.set(...mesh.origin);
    body.scale.setScalar(mesh.step);
    this.meshes.set(key, body);
    this.scene.add(body);
    this.fade(key, opacity);
  }

  fade(key: number, opacity: number): void {
    const material = this.meshes.get(key)?.material;
    if (!material) return;
    material.opacity = opacity;
    material.transparent = opacity < 1;
    material.depthWrite = opacity === 1;
    this.draw();
  }

  remove(key: number): void {
    const body = this.meshes.get(key);
    if (!body) return;
    this.scene.remove(body);
    body.geometry.dispose();
    body.material.dispose();
    this.meshes.delete(key);
    this.draw();
  }

  /** What stands under this key at a place of the picture, in pixels from its left and its top; null: nothing. */
  pick(left: number, top: number): number | null {
    const { clientWidth, clientHeight } = this.canvas;
    const ray = new three.Raycaster();
    ray.setFromCamera(new three.Vector2((2 * left) / clientWidth - 1, 1 - (2 * top) / clientHeight), this.camera);
    const hit = ray.intersectObjects([...this.meshes.values()], false)[0];
    for (const [key, body] of this.meshes) if (body === hit?.object) return key;
    return null;
  }

  /** The picture as it is, as a PNG. */
  picture(): Promise<Blob | null> {
    this.renderer.render(this.scene, this.camera);
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  /** All there is in the middle of the picture. */
  fit(): void {
    const box = new three.Box3();
    for (const body of this.meshes.values()) {
      body.updateMatrixWorld();
      box.expandByObject(body);
    }
    if (box.isEmpty()) return;
    const ball = box.getBoundingSphere(new three.Sphere());
    const away = (1.1 * ball.radius) / Math.sin((this.camera.fov * Math.PI) / 360);
    const towards = this.camera.position.clone().sub(this.controls.target);
    if (towards.lengthSq() === 0) towards.set(-0.5, -1, 0.5);
    this.controls.target.copy(ball.center);
    this.camera.position.copy(ball.center).addScaledVector(towards.normalize(), away);
    this.camera.near = away / 100;
    this.camera.far = away * 10;
    this.camera.updateProjectionMatrix();
    this.controls.update();
    this.draw();
  }

  /** Turns by angles in radians, around the vertical and towards it. */
  turn(around: number, up: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const ball = new three.Spherical().setFromVector3(new three.Vector3(offset.x, offset.z, -offset.y));
    ball.theta += around;
    ball.phi = Math.min(Math.max(ball.phi - up, 0.01), Math.PI - 0.01);
    const turned = new three.Vector3().setFromSpherical(ball);
    this.camera.position.copy(this.controls.target).add(new three.Vector3(turned.x, -turned.z, turned.y));
    this.controls.update();
    this.draw();
  }

  /** Where the camera stands and what it looks at. */
  get view(): number[] {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()];
  }

  set view(numbers: number[]) {
    this.camera.position.fromArray(numbers, 0);
    this.controls.target.fromArray(numbers, 3);
    this.controls.update();
    this.draw();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
