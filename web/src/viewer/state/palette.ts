// Colours that are distinct for all kinds of colour vision, as in the pictures of `isoatlas` (after Okabe and Ito, 2008).
export const PALETTE: readonly (readonly [name: string, colour: string])[] = [
  ["bone", "#e6d8ba"],
  ["sky blue", "#56b4e9"],
  ["vermilion", "#d55e00"],
  ["green", "#009e73"],
  ["pink", "#cc79a7"],
  ["orange", "#e69f00"],
  ["blue", "#0072b2"],
];
