// The crosshair in the picture: lines through the volume that meet in a point, seen through everything.
import * as three from "three";
import { AXES, type Grid, type Triple } from "../state/grid";
import type { Stage } from "./stage";

const COLOUR = 0xffb000;

export class Mark {
  private readonly lines: three.LineSegments;
  private readonly point: three.Points;
  private readonly group = new three.Group();
  private shown = "";

  constructor(
    private readonly stage: Stage,
    private readonly grid: Grid,
  ) {
    const room = (count: number): three.BufferGeometry =>
      new three.BufferGeometry().setAttribute("position", new three.BufferAttribute(new Float32Array(3 * count), 3));
    this.lines = new three.LineSegments(
      room(6),
      new three.LineBasicMaterial({ color: COLOUR, transparent: true, opacity: 0.55, depthTest: false }),
    );
    const size = 9 * stage.renderer.getPixelRatio();
    this.point = new three.Points(
      room(1),
      new three.PointsMaterial({ color: COLOUR, size, sizeAttenuation: false, depthTest: false, transparent: true }),
    );
    this.lines.renderOrder = this.point.renderOrder = 1000;
    for (const thing of [this.lines, this.point]) thing.frustumCulled = false;
    this.group.add(this.lines, this.point);
    this.group.userData.isTool = true;
  }

  /** null: nowhere. */
  show(voxel: Triple | null): void {
    if (String(voxel) === this.shown) return;
    this.shown = String(voxel);
    if (!voxel) {
      this.group.removeFromParent();
      return this.stage.draw();
    }
    const ends = AXES.flatMap((axis) =>
      [0, this.grid.size[axis] - 1].map((end) => this.grid.place(voxel.map((n, other) => (other === axis ? end : n)))),
    );
    fill(this.lines, ends);
    fill(this.point, [this.grid.place(voxel)]);
    this.stage.add(this.group);
  }
}

function fill(thing: three.LineSegments | three.Points, places: Triple[]): void {
  const position = thing.geometry.getAttribute("position") as three.BufferAttribute;
  places.forEach((place, i) => position.setXYZ(i, ...place));
  position.needsUpdate = true;
}
