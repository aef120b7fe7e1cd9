// Perspective and orthographic camera, with orbit controls around a target.
import * as three from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { turnedUp } from "../state/up_direction";

/** View directions by key. */
export const VIEWS: Record<string, [number, number, number]> = {
  x: [1, 0, 0],
  X: [-1, 0, 0],
  y: [0, 1, 0],
  Y: [0, -1, 0],
  z: [0, 0, -1],
  Z: [0, 0, 1],
};

const HALF_ANGLE = (15 * Math.PI) / 180;

export class CameraRig {
  private readonly near = new three.PerspectiveCamera((360 * HALF_ANGLE) / Math.PI);
  private readonly far = new three.OrthographicCamera();
  private controls: OrbitControls;
  /** towards the camera, where no view says where it is */
  firstOffset: readonly number[] = [-0.5, -1, 0.5];
  private aspect = 1;
  /** orthographic: lengths compare at any depth */
  private flat = false;

  /** onChange: the view must be drawn again; onDragEnd: the pointer was released. */
  constructor(
    private readonly element: HTMLElement,
    private readonly onChange: () => void,
    private readonly onDragEnd: () => void,
  ) {
    for (const camera of [this.near, this.far]) camera.up.set(0, 0, 1);
    this.controls = this.madeControls();
  }

  private madeControls(): OrbitControls {
    const controls = new OrbitControls(this.camera, this.element);
    controls.addEventListener("change", this.onChange);
    controls.addEventListener("end", this.onDragEnd);
    return controls;
  }

  /** The axis of orbits, upwards in the picture: a unit vector. Position and target stay. */
  get up(): [number, number, number] {
    return this.near.up.toArray();
  }
  set up(up: readonly number[]) {
    if (this.near.up.toArray().every((n, i) => n === up[i])) return;
    const [offset, target] = [this.offset(), this.controls.target.clone()];
    for (const camera of [this.near, this.far]) camera.up.set(up[0]!, up[1]!, up[2]!);
    this.controls.dispose(); // controls read the axis only once
    this.controls = this.madeControls();
    this.place(target, offset);
  }

  /** From the camera to its target: a unit vector. */
  get forward(): [number, number, number] {
    return this.offset().normalize().negate().toArray();
  }

  get camera(): three.PerspectiveCamera | three.OrthographicCamera {
    return this.flat ? this.far : this.near;
  }

  resize(aspect: number): void {
    this.aspect = aspect;
    this.frame();
  }

  /** Fits a sphere to the view, keeping the direction. */
  fit(ball: three.Sphere): void {
    const towards = this.offset();
    if (towards.lengthSq() === 0) towards.set(...turnedUp(this.up, this.firstOffset));
    const min = Math.min(1, this.aspect);
    this.place(ball.center, towards.normalize().multiplyScalar((1.05 * ball.radius) / (min * Math.sin(HALF_ANGLE))));
  }

  /** Views the target along a direction. */
  along(direction: readonly [number, number, number]): void {
    const towards = new three.Vector3(...direction).multiplyScalar(-this.offset().length());
    const isAlongUp = Math.abs(towards.dot(this.near.up)) > (1 - 1e-6) * towards.length();
    const front = new three.Vector3(...turnedUp(this.up, [0, -1, 0]));
    if (isAlongUp) towards.addScaledVector(front, 1e-4 * towards.length()); // away from the poles of orbits
    this.place(this.controls.target.clone(), towards);
  }

  /** Orbits by angles in radians: azimuth and elevation. */
  turn(around: number, up: number): void {
    const upright = new three.Quaternion().setFromUnitVectors(this.near.up, new three.Vector3(0, 1, 0));
    const ball = new three.Spherical().setFromVector3(this.offset().applyQuaternion(upright));
    ball.theta += around;
    ball.phi = Math.min(Math.max(ball.phi - up, 0.01), Math.PI - 0.01);
    const turned = new three.Vector3().setFromSpherical(ball).applyQuaternion(upright.invert());
    this.place(this.controls.target.clone(), turned);
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

  /** Physical height of the view at the depth of the target. */
  get height(): number {
    return 2 * this.offset().length() * Math.tan(HALF_ANGLE) / this.camera.zoom;
  }

  /** World size of the view's height for labels of constant size on the screen; of perspective, at distance 1. */
  get labelUnit(): number {
    return this.flat ? this.height : 2 * Math.tan(HALF_ANGLE);
  }

  /** Position and target of the camera, rounded to the digits of an address. */
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
    this.onChange();
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
