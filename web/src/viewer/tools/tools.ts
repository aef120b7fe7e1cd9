// Tools: camera, clipping, measures, slices, volume rendering.
import { html } from "../../shared/dom";
import { addOrientationCube } from "./orientation_cube";
import { addClipTool } from "./clip_tool";
import type { ViewerContext } from "../context/viewer_context";
import { Grid } from "../state/grid";
import { addCameraTool } from "./camera_tool";
import { VolumeTool } from "./volume_tool";
import { MeasureTool } from "./measure_tool";
import { addUpTool } from "./up_tool";
import { crosshairOf, SliceTool } from "./slice_tool";
import "./tools.css";

export function addTools(context: ViewerContext): void {
  const tools = html("div", { class: "tool-bars" });
  context.overlay.append(tools);
  addUpTool(context); // before the first fit
  addCameraTool(context);
  addOrientationCube(context);
  addClipTool(context, tools);
  const grid = new Grid(context.page);
  const measuring = new MeasureTool(context, tools, () => grid.place(crosshairOf(context)));
  new SliceTool(context, (place) => measuring.addPosition(place));
  new VolumeTool(context, tools);
}
