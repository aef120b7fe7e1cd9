// What is where in the menus: sections with headings, their actions in order with icons. Keys and what they do are in the actions.
import { svg } from "../shared/dom";
import type { Group } from "./context/actions";

/** begins: of the name of an action; of several that match, all */
type Item = [begins: string, icon: keyof typeof ICONS];

export interface Section {
  title: string;
  items: Item[];
}

/** Lines in a square of 24 by 24. */
const ICONS = {
  cards: "M4 4h7v7H4zM13 4h7v7h-7zM4 13h7v7H4zM13 13h7v7h-7z",
  list: "M4 6h2M4 12h2M4 18h2M9 6h11M9 12h11M9 18h11",
  tree: "M12 3v6M6 21v-6h12v6M12 9v6",
  filter: "M3 5h18l-7 8v6l-4 2v-8z",
  find: "M10 4a6 6 0 1 0 0 12a6 6 0 1 0 0-12M15 15l6 6",
  next: "M5 12h14M13 6l6 6l-6 6",
  previous: "M19 12H5M11 6l-6 6l6 6",
  pen: "M4 20l1-5L16 4l4 4L9 19z",
  up: "M12 20V5M6 11l6-6l6 6",
  down: "M12 4v15M6 13l6 6l6-6",
  play: "M7 4l12 8l-12 8z",
  level: "M3 12h18M7 8v8M12 8v8M17 8v8",
  undo: "M8 5L4 9l4 4M4 9h10a5 5 0 0 1 0 10h-4",
  redo: "M16 5l4 4l-4 4M20 9H10a5 5 0 0 0 0 10h4",
  eye: "M2 12c3-5 6-7 10-7s7 2 10 7c-3 5-6 7-10 7s-7-2-10-7zM12 9a3 3 0 1 0 0 6a3 3 0 1 0 0-6",
  one: "M12 8a4 4 0 1 0 0 8a4 4 0 1 0 0-8M3 8V3h5M16 3h5v5M21 16v5h-5M8 21H3v-5",
  points: "M6 7h.1M12 5h.1M18 8h.1M8 13h.1M14 12h.1M19 15h.1M6 19h.1M12 18h.1",
  ghost: "M5 21V11a7 7 0 0 1 14 0v10l-3.5-3L12 21l-3.5-3zM9 11h.1M15 11h.1",
  cavity: "M12 3a9 9 0 1 0 0 18a9 9 0 1 0 0-18M12 9a3 3 0 1 0 0 6a3 3 0 1 0 0-6",
  remove: "M5 7h14M9 7V4h6v3M7 7l1 13h8l1-13",
  fit: "M3 8V3h5M16 3h5v5M21 16v5h-5M8 21H3v-5M8 8h8v8H8z",
  axis: "M8 16V3M8 16h13M8 16l-5 5",
  box: "M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5l8-4.5M12 12v9",
  turn: "M20 12a8 8 0 1 1-3-6.2M17 2v4h-4",
  clip: "M4 20L20 4M8 4H4v4M20 16v4h-4",
  curve: "M3 20h18M3 17l6-2l5-9l7-2",
  fog: "M4 8h11M8 12h12M4 16h10",
  theme: "M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18",
  ruler: "M3 15L15 3l6 6L9 21zM7 11l2 2M11 7l2 2",
  angle: "M20 19H4L15 5M11 19a7 7 0 0 0-2.7-5.5",
  slices: "M3 9l9-5l9 5l-9 5zM3 14l9 5l9-5",
  cross: "M12 3v18M3 12h18",
  save: "M12 3v12M7 10l5 5l5-5M4 20h16",
  link: "M10 14l4-4M9 9l-3 3a4 4 0 0 0 6 6l3-3M15 15l3-3a4 4 0 0 0-6-6L9 9",
  image: "M3 5h18v14H3zM3 16l5-5l5 5l3-3l5 5",
  table: "M3 5h18v14H3zM3 10h18M9 5v14",
  code: "M5 7l5 5l-5 5M12 17h7",
  help: "M9 9a3 3 0 1 1 3 4v2M12 18.5v.1",
  other: "M12 11.9v.2",
};

export const MENU: Record<Group, Section[]> = {
  Objects: [
    { title: "Show as", items: [["Cards", "cards"], ["List", "list"], ["Tree", "tree"]] },
    { title: "Find", items: [["Find", "find"], ["Filter", "filter"]] },
    { title: "Go to", items: [["Isolate next", "next"], ["Isolate previous", "previous"]] },
    { title: "Name", items: [["Rename", "pen"]] },
  ],
  Isovalue: [
    { title: "Step", items: [["Up by", "up"], ["Down by", "down"]] },
    { title: "Events", items: [["Up to the next", "up"], ["Down to the next", "down"]] },
    { title: "Play", items: [["Play", "play"]] },
    { title: "All objects", items: [["Set all", "level"]] },
  ],
  Scene: [
    { title: "History", items: [["Undo", "undo"], ["Redo", "redo"]] },
    { title: "Selection", items: [["Select next", "next"], ["Select previous", "previous"]] },
    { title: "Selected object", items: [["Show or hide", "eye"], ["Isolate", "one"], ["Cavities", "cavity"], ["Remove", "remove"]] },
    { title: "Other objects", items: [["Ghost", "ghost"]] },
    { title: "Drawn", items: [["Surfaces as points", "points"]] },
  ],
  View: [
    { title: "Camera", items: [["Fit", "fit"], ["Orthographic", "box"], ["Rotate", "turn"]] },
    { title: "Standard views", items: [["View", "axis"]] },
    { title: "Up direction", items: [["Up direction", "up"], ["Roll left 90", "undo"], ["Roll right 90", "redo"]] },
    { title: "Clipping", items: [["Clip", "clip"], ["Flip", "turn"]] },
    { title: "Volume", items: [["Volume rendering", "fog"], ["Opacity curve", "curve"]] },
    { title: "Display", items: [["Bounding box", "box"], ["Unit", "ruler"], ["Theme", "theme"]] },
  ],
  Tools: [
    { title: "Slices", items: [["Slices", "slices"], ["Window presets", "theme"], ["Pick", "cross"]] },
    {
      title: "Measure",
      items: [["Measure distance", "ruler"], ["Measure angle", "angle"], ["Add crosshair", "cross"], ["Remove", "remove"]],
    },
  ],
  Export: [
    { title: "All formats", items: [["Export", "save"]] },
    { title: "Surfaces", items: [["Surface", "save"], ["Everything shown", "box"]] },
    { title: "Images, tables, scenes", items: [["Image", "image"], ["Table", "table"], ["Scene", "box"]] },
    { title: "Copy", items: [["Copy link", "link"], ["Copy command", "code"]] },
  ],
  Help: [{ title: "Learn", items: [["Introduction", "play"], ["Keyboard", "help"]] }],
};

/** Only by key; the list of keys names them. */
const BY_KEY_ONLY = /^(Orbit|Roll .* 5°|Flip the up|Crosshair|Window (narrower|wider|level)|Stop measuring)/;

export interface Placed<A> {
  title: string;
  actions: [A, keyof typeof ICONS][];
}

/** The actions of a menu in their sections; at the end what no section names. */
export function placed<A extends { name: string }>(group: Group, actions: A[]): Placed<A>[] {
  const left = new Set(actions.filter(({ name }) => !BY_KEY_ONLY.test(name)));
  const take = ([begins, icon]: Item): [A, keyof typeof ICONS][] => {
    const own = [...left].filter(({ name }) => name.startsWith(begins));
    own.forEach((action) => left.delete(action));
    return own.map((action) => [action, icon]);
  };
  const sections = MENU[group].map(({ title, items }): Placed<A> => ({ title, actions: items.flatMap(take) }));
  sections.push({ title: "Other", actions: [...left].map((action) => [action, "other"]) });
  return sections.filter((section) => section.actions.length > 0);
}

export function icon(name: keyof typeof ICONS): SVGSVGElement {
  return svg("svg", { class: "icon", viewBox: "0 0 24 24", "aria-hidden": "true" }, svg("path", { d: ICONS[name] }));
}
