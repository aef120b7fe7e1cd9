// A coarse surface of the page, turned with the pointer or the arrow keys, and saved as STL. Where the browser has no WebGL, or the data do
// not decode, the picture stays.
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DirectionalLight,
  DoubleSide,
  HemisphereLight,
  Mesh as Solid,
  MeshStandardMaterial,
  PerspectiveCamera,
  Scene,
  Spherical,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { bytesOf } from "../shared/base64";
import { html } from "../shared/dom";
import { count } from "../shared/format";
import type { PageMesh } from "../shared/page";
import { stlOf } from "../shared/stl";
import { decodeMesh, type Mesh } from "../shared/wire";

export interface Turnable {
  element: HTMLElement;
  dispose(): void;
}

const FIELD = 30; // degrees of the camera
const TURN = Math.PI / 12; // of an arrow key
const ZOOM = 1.15; // of + and -

function geometryOf(mesh: Mesh): BufferGeometry {
  const places = Float32Array.from(mesh.positions, (steps) => steps * mesh.step); // without origin: float32 is exact enough
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(places, 3));
  geometry.setAttribute("normal", new BufferAttribute(mesh.normals, 3, true));
  geometry.setIndex(new BufferAttribute(mesh.corners, 1));
  geometry.center();
  geometry.computeBoundingSphere();
  return geometry;
}

/** A canvas that shows a mesh, z up, seen from the front at first. Throws where there is no WebGL. */
class View {
  readonly canvas: HTMLCanvasElement;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(FIELD);
  private readonly controls: OrbitControls;
  private readonly geometry: BufferGeometry;
  private readonly size: ResizeObserver;

  constructor(mesh: Mesh, label: string, colour: string) {
    this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true }); // kept: pages are printed
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${label}. Arrow keys turn it, + and - change its size.`);
    this.geometry = geometryOf(mesh);
    const material = new MeshStandardMaterial({ color: new Color(colour), side: DoubleSide, roughness: 0.7 });
    const lamp = new DirectionalLight(0xffffff, 2);
    lamp.position.set(1, 1, 1);
    this.camera.add(lamp);
    this.camera.up.set(0, 0, 1);
    this.scene.add(new Solid(this.geometry, material), new HemisphereLight(0xffffff, 0x666666, 1.2), this.camera);
    const radius = this.geometry.boundingSphere?.radius || 1;
    const distance = (1.05 * radius) / Math.sin((FIELD / 2) * (Math.PI / 180));
    this.camera.near = distance / 100;
    this.camera.far = distance * 20;
    this.camera.position.set(0.45, -1, 0.3).setLength(distance);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.minDistance = 1.05 * radius;
    this.controls.maxDistance = 10 * distance;
    this.controls.addEventListener("change", () => this.draw());
    this.controls.update();
    this.canvas.addEventListener("keydown", (event) => this.onKey(event));
    this.size = new ResizeObserver(() => this.resize());
    this.size.observe(this.canvas);
  }

  dispose(): void {
    this.size.disconnect();
    this.controls.dispose();
    this.geometry.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(devicePixelRatio);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  private draw(): void {
    this.renderer.render(this.scene, this.camera);
    const { x, y, z } = this.camera.position.clone().normalize();
    this.canvas.dataset.view = [x, y, z].map((part) => part.toFixed(3)).join(" ");
  }

  private onKey(event: KeyboardEvent): void {
    const turns: Record<string, [number, number, number]> = {
      ArrowLeft: [-TURN, 0, 1],
      ArrowRight: [TURN, 0, 1],
      ArrowUp: [0, -TURN, 1],
      ArrowDown: [0, TURN, 1],
      "+": [0, 0, 1 / ZOOM],
      "=": [0, 0, 1 / ZOOM],
      "-": [0, 0, ZOOM],
    };
    const turn = turns[event.key];
    if (!turn || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    const { x, y, z } = this.camera.position;
    const at = new Spherical().setFromVector3(new Vector3(x, z, -y)); // three's spheres have y up
    at.theta += turn[0];
    at.phi = Math.min(Math.max(at.phi + turn[1], 0.01), Math.PI - 0.01);
    at.radius = Math.min(Math.max(at.radius * turn[2], this.controls.minDistance), this.controls.maxDistance);
    const moved = new Vector3().setFromSpherical(at);
    this.camera.position.set(moved.x, -moved.z, moved.y);
    this.controls.update();
    this.draw();
  }
}

/** What the surface is, exactly. */
function words(mesh: PageMesh): string {
  if (mesh.triangles === mesh.of) return `The exact surface, ${count(mesh.of)} triangles.`;
  const kept = mesh.keepsTopology ? "with the same components and tunnels" : "without its smallest parts and tunnels";
  return `A coarse surface: ${count(mesh.triangles)} of ${count(mesh.of)} triangles, ${kept}.`;
}

function saveButton(mesh: Mesh, name: string): HTMLElement {
  const save = html("button", { type: "button", class: "save-stl" }, "Save this surface as STL");
  save.addEventListener("click", () => {
    const address = URL.createObjectURL(new Blob([stlOf(mesh)], { type: "model/stl" }));
    html("a", { href: address, download: `${name}.stl` }).click();
    setTimeout(() => URL.revokeObjectURL(address), 60_000);
  });
  return save;
}

/** In place of a picture, which is there until the surface is decoded. */
export function turnable(still: HTMLElement, mesh: PageMesh, label: string, colour: string, name: string): Turnable {
  const element = html("div", { class: "solid" }, still);
  let view: View | null = null;
  let isGone = false;
  const show = async (): Promise<void> => {
    const decoded = await decodeMesh(bytesOf(mesh.data));
    const below = html("p", { class: "note" }, `${words(mesh)} `, saveButton(decoded, name));
    if (isGone) return;
    element.append(below);
    view = new View(decoded, label, colour);
    still.replaceWith(view.canvas);
  };
  show().catch(() => element.classList.add("picture-only"));
  return {
    element,
    dispose: () => {
      isGone = true;
      view?.dispose();
      view = null;
    },
  };
}

/** Puts a surface that turns in place of a picture, and back: browsers have few of them at a time. */
export function turnButton(picture: HTMLElement, mesh: PageMesh, title: string, colour: string): HTMLElement {
  const button = html("button", { type: "button", class: "turn", "aria-pressed": "false" }, "Turn in 3D");
  let solid: Turnable | null = null;
  button.addEventListener("click", () => {
    if (solid) {
      solid.dispose();
      solid.element.replaceWith(picture);
      solid = null;
    } else {
      const place = document.createComment("");
      picture.replaceWith(place);
      solid = turnable(picture, mesh, `Picture of ${title}`, colour, title.replaceAll(/[^\p{L}\p{N}]+/gu, "-"));
      place.replaceWith(solid.element);
    }
    button.setAttribute("aria-pressed", String(solid !== null));
  });
  return button;
}
