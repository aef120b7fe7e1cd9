// Draws measures: lines, end points and labels of constant size on the screen, without depth test.
import * as three from "three";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import type { Triple } from "../state/grid";
import { arcOf, type Measure } from "../state/measures";
import type { Viewport } from "./viewport";

const COLOUR = 0xd81b60;
const LABEL_PIXELS = 24;
const FONT = "600 30px system-ui, sans-serif";

function line(places: readonly Triple[], width: number): Line2 {
  const drawn = new Line2(
    new LineGeometry().setPositions(places.flat()),
    new LineMaterial({ color: COLOUR, linewidth: width, depthTest: false, transparent: true }),
  );
  drawn.renderOrder = 1001;
  return drawn;
}

function ends(viewport: Viewport, places: readonly Triple[]): three.Points {
  const geometry = new three.BufferGeometry().setFromPoints(places.map((place) => new three.Vector3(...place)));
  const size = 8 * viewport.renderer.getPixelRatio();
  const drawn = new three.Points(
    geometry,
    new three.PointsMaterial({ color: COLOUR, size, sizeAttenuation: false, depthTest: false, transparent: true }),
  );
  drawn.renderOrder = 1002;
  return drawn;
}

function label(text: string, place: Triple): three.Sprite {
  const canvas = document.createElement("canvas");
  const pen = canvas.getContext("2d") as CanvasRenderingContext2D;
  pen.font = FONT;
  [canvas.width, canvas.height] = [Math.ceil(pen.measureText(text).width) + 24, 48];
  pen.font = FONT;
  pen.fillStyle = "#ffffff";
  pen.roundRect(1, 1, canvas.width - 2, 46, 10);
  pen.fill();
  [pen.lineWidth, pen.strokeStyle, pen.fillStyle, pen.textBaseline] = [2, "#d81b60", "#7a0f36", "middle"];
  pen.stroke();
  pen.fillText(text, 12, 26);
  const map = new three.CanvasTexture(canvas);
  map.colorSpace = three.SRGBColorSpace;
  const sprite = new three.Sprite(new three.SpriteMaterial({ map, sizeAttenuation: false, depthTest: false }));
  sprite.position.set(...place);
  sprite.center.set(0.5, -0.3);
  sprite.userData.wide = canvas.width / canvas.height;
  sprite.renderOrder = 1003;
  return sprite;
}

export class MeasureDrawing {
  private group: three.Group | null = null;

  constructor(private readonly viewport: Viewport) {
    viewport.onBeforeRender(() => this.size());
  }

  /** pending: positions of an unfinished measure. */
  show(measures: readonly Measure[], texts: readonly string[], pending: readonly Triple[]): void {
    if (this.group) this.viewport.drop(this.group);
    this.group = null;
    if (measures.length === 0 && pending.length === 0) return;
    const group = (this.group = new three.Group());
    measures.forEach((measure, i) => {
      group.add(line(measure, 2.5), ends(this.viewport, measure), label(texts[i] ?? "", placeOfLabel(measure)));
      const arc = measure.length === 3 ? arcOf(measure) : [];
      if (arc.length > 0) group.add(line(arc, 1.5));
    });
    if (pending.length > 0) group.add(ends(this.viewport, pending));
    if (pending.length > 1) group.add(line(pending, 1.5));
    this.viewport.add(group);
  }

  /** Keeps the size of labels on the screen. */
  private size(): void {
    const { rig, canvas } = this.viewport;
    const high = (LABEL_PIXELS / Math.max(canvas.clientHeight, 1)) * rig.labelUnit;
    this.group?.children.forEach((child) => child instanceof three.Sprite && child.scale.set(high * Number(child.userData.wide), high, 1));
  }
}

function placeOfLabel(measure: Measure): Triple {
  if (measure.length === 3) return measure[1] as Triple;
  return measure[0]!.map((n, axis) => (n + measure[1]![axis]!) / 2) as Triple;
}
