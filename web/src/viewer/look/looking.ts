// Looking and measuring: all that shows the volume, and what stands on the stage, from another side.
import { html } from "../../dom";
import { cube } from "./cube";
import { cutting } from "./cutting";
import type { Desk } from "../desk/desk";
import { Grid } from "../state/grid";
import { look } from "./look";
import { MatterPanel } from "./matter";
import { Measuring } from "./measuring";
import { crosshairOf, Slices } from "./slices";
import "./looking.css";

export function looking(desk: Desk): void {
  const tools = html("div", { class: "hand-tools" });
  desk.overlay.append(tools);
  look(desk);
  cube(desk);
  cutting(desk, tools);
  const grid = new Grid(desk.page);
  const measuring = new Measuring(desk, tools, () => grid.place(crosshairOf(desk)));
  new Slices(desk, (place) => measuring.take(place));
  new MatterPanel(desk, tools);
}
