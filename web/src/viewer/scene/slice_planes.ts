// Slices in 3D: textured planes with the grey values of the slice views.
import * as three from "three";
import { acrossAndDown, type AxisNumber, type Grid } from "../state/grid";
import type { Picture } from "./slice_view";
import type { Viewport } from "./viewport";

export class SlicePlanes {
  private readonly planes = new Map<AxisNumber, three.Mesh<three.BufferGeometry, three.MeshBasicMaterial>>();

  constructor(
    private readonly viewport: Viewport,
    private readonly grid: Grid,
  ) {}

  /** fresh: the image has changed. */
  show(axis: AxisNumber, { canvas, across: columns, down: rows }: Picture, index: number, changed: boolean): void {
    const plane = this.planes.get(axis) ?? this.made(axis, canvas);
    const { map } = plane.material;
    if (changed && map) map.needsUpdate = true;
    const [across, down] = acrossAndDown(axis);
    const position = plane.geometry.getAttribute("position") as three.BufferAttribute;
    for (let corner = 0; corner < 4; ++corner) {
      const sample = [index, index, index];
      sample[across] = this.grid.rulers[across].sample(corner & 1 ? columns.high : columns.low);
      sample[down] = this.grid.rulers[down].sample(corner & 2 ? rows.high : rows.low);
      position.setXYZ(corner, ...this.grid.place(sample));
    }
    position.needsUpdate = true;
    plane.geometry.computeBoundingSphere();
    this.viewport.draw();
  }

  hide(): void {
    for (const plane of this.planes.values()) this.viewport.drop(plane);
    this.planes.clear();
  }

  private made(axis: AxisNumber, picture: HTMLCanvasElement): three.Mesh<three.BufferGeometry, three.MeshBasicMaterial> {
    const map = new three.CanvasTexture(picture);
    map.colorSpace = three.SRGBColorSpace;
    map.flipY = false;
    map.generateMipmaps = false;
    map.minFilter = three.LinearFilter;
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(new Float32Array(12), 3));
    geometry.setAttribute("uv", new three.BufferAttribute(new Float32Array([0, 0, 1, 0, 0, 1, 1, 1]), 2));
    geometry.setIndex([0, 1, 2, 2, 1, 3]);
    const plane = new three.Mesh(geometry, new three.MeshBasicMaterial({ map, side: three.DoubleSide }));
    plane.userData.touchable = true;
    this.planes.set(axis, plane);
    this.viewport.add(plane);
    return plane;
  }
}
