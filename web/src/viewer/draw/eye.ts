// Where one looks from: a camera with perspective or without, turned around a point.
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

/** Directions to look along, by the key that asks for them. */
export const VIEWS: Record<string, [number, number, number]> = {
  x: [1, 0, 0],
  X: [-1, 0, 0],
  y: [0, 1, 0],
  Y: [0, -1, 0],
  z: [0, 0, -1],
  Z: [0, 0, 1],
};

const HALF_ANGLE = (15 * Math.PI) / 180;

export class Eye {
  private readonly near = new three.PerspectiveCamera((360 * HALF_ANGLE) / Math.PI);
  private readonly far = new three.OrthographicCamera();
  private readonly controls: OrbitControls;
  private aspect = 1;
  /** without perspective: lengths compare at any depth */
  private flat = false;

  /** changed: what is seen is no longer what is drawn; rested: the hand has let go. */
  constructor(
    element: HTMLElement,
    private readonly changed: () => void,
    rested: () => void,
  ) {
    this.near.up.set(0, 0, 1);
    this.far.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.near, element);
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("end", rested);
  }

  get camera(): three.PerspectiveCamera | three.OrthographicCamera {
    return this.flat ? this.far : this.near;
  }

  resize(aspect: number): void {
    this.aspect = aspect;
    this.frame();
  }

  /** All of a ball in the middle, from the same side as before. */
  fit(ball: three.Sphere): void {
    const towards = this.offset();
    if (towards.lengthSq() === 0) towards.set(-0.5, -1, 0.5);
    const least = Math.min(1, this.aspect);
    this.place(ball.center, towards.normalize().multiplyScalar((1.05 * ball.radius) / (least * Math.sin(HALF_ANGLE))));
  }

  /** Looks along a direction at what is in the middle. */
  along(direction: readonly [number, number, number]): void {
    const towards = new three.Vector3(...direction).multiplyScalar(-this.offset().length());
    if (direction[2] !== 0) towards.y -= 1e-4 * towards.length(); // north up: straight down is no direction around the vertical
    this.place(this.controls.target.clone(), towards);
  }

  /** Turns by angles in radians, around the vertical and towards it. */
  turn(around: number, up: number): void {
    const offset = this.offset();
    const ball = new three.Spherical().setFromVector3(new three.Vector3(offset.x, offset.z, -offset.y));
    ball.theta += around;
    ball.phi = Math.min(Math.max(ball.phi - up, 0.01), Math.PI - 0.01);
    const turned = new three.Vector3().setFromSpherical(ball);
    this.place(this.controls.target.clone(), new three.Vector3(turned.x, -turned.z, turned.y));
  }

  get isFlat(): boolean {
    return this.flat;
  }
  set isFlat(flat: boolean) {
    if (flat === this.flat) return;
    const offset = this.offset();
    this.flat = flat;
    this.controls.object = this.camera;
    this.place(this.controls.target.clone(), offset);
  }

  /** Physical length of the height of the picture, at the depth of what is in the middle. */
  get height(): number {
    return 2 * this.offset().length() * Math.tan(HALF_ANGLE) / this.camera.zoom;
  }

  /** What is a scale of 1 for a label that keeps its size: the height of the picture, at a distance of 1 where there is perspective. */
  get labelUnit(): number {
    return this.flat ? this.height : 2 * Math.tan(HALF_ANGLE);
  }

  /** Where the camera stands and what it looks at, in digits that an address has room for; ours: what was got here before. */
  get view(): number[] {
    return [...this.camera.position.toArray(), ...this.controls.target.toArray()].map((n) => Number(n.toPrecision(7)));
  }
  set view(numbers: number[]) {
    const target = new three.Vector3().fromArray(numbers, 3);
    this.place(target, new three.Vector3().fromArray(numbers, 0).sub(target));
  }

  private offset(): three.Vector3 {
    return this.camera.position.clone().sub(this.controls.target);
  }

  private place(target: three.Vector3, offset: three.Vector3): void {
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(offset);
    this.frame();
    this.controls.update();
    this.changed();
  }

  private frame(): void {
    const away = Math.max(this.offset().length(), 1e-6);
    this.near.aspect = this.aspect;
    this.near.near = away / 100;
    this.near.far = away * 10;
    const half = away * Math.tan(HALF_ANGLE);
    this.far.top = half;
    this.far.bottom = -half;
    this.far.left = -half * this.aspect;
    this.far.right = half * this.aspect;
    this.far.near = -away * 10;
    this.far.far = away * 10;
    this.near.updateProjectionMatrix();
    this.far.updateProjectionMatrix();
  }
}
