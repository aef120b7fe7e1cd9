// The crosshair in 3D: lines through the volume that meet in a point, drawn without depth test.
import * as three from "three";
import { AXES, type Grid, type Triple } from "../state/grid";
import type { Viewport } from "./viewport";

const COLOUR = 0xffb000;

export class CrosshairLines {
  private readonly lines: three.LineSegments;
  private readonly point: three.Points;
  private readonly group = new three.Group();
  private shown = "";

  constructor(
    private readonly viewport: Viewport,
    private readonly grid: Grid,
  ) {
    const buffer = (count: number): three.BufferGeometry =>
      new three.BufferGeometry().setAttribute("position", new three.BufferAttribute(new Float32Array(3 * count), 3));
    this.lines = new three.LineSegments(
      buffer(6),
      new three.LineBasicMaterial({ color: COLOUR, transparent: true, opacity: 0.55, depthTest: false }),
    );
    const size = 9 * viewport.renderer.getPixelRatio();
    this.point = new three.Points(
      buffer(1),
      new three.PointsMaterial({ color: COLOUR, size, sizeAttenuation: false, depthTest: false, transparent: true }),
    );
    this.lines.renderOrder = this.point.renderOrder = 1000;
    for (const object of [this.lines, this.point]) object.frustumCulled = false;
    this.group.add(this.lines, this.point);
    this.group.userData.isTool = true;
  }

  /** null: hidden. */
  show(voxel: Triple | null): void {
    if (String(voxel) === this.shown) return;
    this.shown = String(voxel);
    if (!voxel) {
      this.group.removeFromParent();
      return this.viewport.draw();
    }
    const ends = AXES.flatMap((axis) =>
      [0, this.grid.size[axis] - 1].map((end) => this.grid.place(voxel.map((n, other) => (other === axis ? end : n)))),
    );
    fill(this.lines, ends);
    fill(this.point, [this.grid.place(voxel)]);
    this.viewport.add(this.group);
  }
}

function fill(object: three.LineSegments | three.Points, places: Triple[]): void {
  const position = object.geometry.getAttribute("position") as three.BufferAttribute;
  places.forEach((place, i) => position.setXYZ(i, ...place));
  position.needsUpdate = true;
}
