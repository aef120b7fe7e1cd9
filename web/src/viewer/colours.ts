// Colours that people with any kind of sight tell apart (Okabe and Ito), the first for what is largest.
const COLOURS = ["#e69f00", "#56b4e9", "#009e73", "#f0e442", "#0072b2", "#d55e00", "#cc79a7"];

/** Of an entry of the atlas; grey for what is none. */
export function colourOf(entry: number): string {
  return (entry >= 0 && COLOURS[entry % COLOURS.length]) || "#999999";
}
