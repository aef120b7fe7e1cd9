// Looking and measuring: all that shows the volume, and what stands on the stage, from another side.
import { html } from "../dom";
import { cube } from "./cube";
import { cutting } from "./cutting";
import type { Desk } from "./desk";
import { look } from "./look";
import { Slices } from "./slices";
import "./looking.css";

export function looking(desk: Desk): void {
  const tools = html("div", { class: "tools" });
  desk.overlay.append(tools);
  look(desk);
  cube(desk);
  cutting(desk, tools);
  if (desk.page.volume.spacing) new Slices(desk);
}
