// Chooses the unit of lengths: of the scale bar, sizes, measurements and tables. A part of the link.
import { html } from "../../shared/dom";
import { canChoose, chooseUnit, hasNoUnit, UNITS } from "../../shared/units";
import { observePart } from "../context/observe";
import type { ViewerContext } from "../context/viewer_context";
import { UNIT } from "../state/unit";

/** changed: text with lengths is to be made anew. */
export function addUnitTool(context: UnitContext, changed: () => void): void {
  const { page, history, overlay, actions } = context;
  const { unit } = page.volume;
  if (!canChoose(unit)) return;
  const own = hasNoUnit(unit) ? "unit: none in the file" : `unit of the file: ${unit}`;
  const options = UNITS.map((name) => html("option", { value: name }, hasNoUnit(unit) ? `lengths are in ${name}` : `in ${name}`));
  const select = html("select", { class: "unit", "aria-label": "unit of lengths" }, html("option", { value: "" }, own), ...options);
  select.addEventListener("input", () => history.go(UNIT.with(history.now, select.value === "" ? null : select.value)));
  overlay.append(select);
  let isFirst = true;
  observePart(history, UNIT, (chosen) => {
    chooseUnit(chosen);
    select.value = chosen ?? "";
    if (!isFirst) changed();
    isFirst = false;
  });
  actions.add({
    group: "View",
    name: "Unit of lengths",
    keys: ["U"],
    run: () => {
      select.focus();
      context.notify("choose the unit of lengths with the arrow keys");
    },
  });
}

type UnitContext = Pick<ViewerContext, "page" | "history" | "overlay" | "actions" | "notify">;
