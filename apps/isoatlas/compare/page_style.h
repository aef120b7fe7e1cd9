// The style of the page of `compare`: colours and fonts are those of web/src/page/page.css.
#pragma once

#include <string_view>

namespace isoatlas::cli {

inline constexpr std::string_view kPageStyle = R"css(
:root {
  color-scheme: light dark;
  --ground: #f6f5f2; --panel: #ffffff; --ink: #1d2126; --soft: #5c6470; --line: #d9d6cf; --accent: #0b63b5;
  --defect: #c1121f; --misplaced: #0b63b5;
  --c0: #0072b2; --c1: #b14a00; --c2: #00785a; --c3: #9b3d78; --c4: #7a6400; --c5: #2d7fb0; --c6: #3c424a;
  font: 16px/1.45 system-ui, "Segoe UI", "Noto Sans", sans-serif;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ground: #14171b; --panel: #1d2127; --ink: #e9ebee; --soft: #a2aab5; --line: #343a43; --accent: #7db8f0;
    --defect: #ff7b7b; --misplaced: #7db8f0;
    --c0: #5aa9e6; --c1: #f08a4b; --c2: #35c49a; --c3: #e08fbf; --c4: #e2cc45; --c5: #8fd3ff; --c6: #c9ced6;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink); }
main { max-width: 90rem; margin: 0 auto; padding: 1.5rem 1rem 3rem; }
h1 { font-size: 1.7rem; margin: 0 0 0.25rem; overflow-wrap: anywhere; }
h2 { font-size: 1.15rem; margin: 0 0 0.75rem; }
h3 { font-size: 1rem; margin: 1rem 0 0.25rem; }
p { margin: 0.25rem 0; max-width: 60rem; }
a { color: var(--accent); }
header p, .note { color: var(--soft); }
.note { font-size: 0.85rem; margin-top: 0.6rem; }
code { overflow-wrap: anywhere; }
.panel { background: var(--panel); border: 1px solid var(--line); border-radius: 10px; padding: 1rem; margin: 1.25rem 0; }
.pictures { list-style: none; margin: 0; padding: 0; display: grid; gap: 1rem; grid-template-columns: repeat(auto-fill, minmax(15rem, 1fr)); }
.pictures figure { margin: 0; }
.pictures img { display: block; width: 100%; height: auto; border-radius: 6px; background: color-mix(in srgb, var(--ground) 60%, var(--panel)); }
.pictures figcaption { margin-top: 0.35rem; font-size: 0.9rem; }
.pictures figcaption span { display: block; color: var(--soft); }
.pictures figcaption .bad { color: var(--defect); }
.key span { display: inline-flex; align-items: center; margin-right: 1.25rem; }
.key span::before { content: ""; width: 1rem; height: 1rem; margin-right: 0.4rem; border-radius: 3px; background: var(--key); }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.8rem; width: 100%; font-variant-numeric: tabular-nums; }
caption { text-align: left; color: var(--soft); padding-bottom: 0.4rem; }
th, td { text-align: right; padding: 0.25rem 0.45rem 0.25rem 0; white-space: nowrap; }
th[scope="row"], th.words, td.words { text-align: left; font-weight: 400; }
thead th { color: var(--soft); border-bottom: 1px solid var(--line); vertical-align: bottom; white-space: normal; }
tbody tr + tr > * { border-top: 1px solid color-mix(in srgb, var(--line) 50%, transparent); }
td.bad { color: var(--defect); font-weight: 600; }
.plots { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 30rem), 1fr)); }
.plots figure { margin: 0; min-width: 0; }
.plots figcaption { font-weight: 600; }
svg { display: block; width: 100%; height: auto; }
svg text { font-size: 13px; fill: var(--soft); }
svg text.strong { fill: var(--ink); }
line.grid { stroke: var(--line); }
rect.frame { fill: none; stroke: var(--line); }
.line path { fill: none; stroke: var(--key); stroke-width: 2; stroke-linejoin: round; }
.line .marker { stroke-dasharray: none; stroke-width: 1.6; fill: var(--panel); }
.c0 { --key: var(--c0); } .c1 { --key: var(--c1); } .c2 { --key: var(--c2); } .c3 { --key: var(--c3); } .c4 { --key: var(--c4); } .c5 { --key: var(--c5); } .c6 { --key: var(--c6); }
.d1 path { stroke-dasharray: 7 4; } .d2 path { stroke-dasharray: 2 3; }
.lines { list-style: none; margin: 0.25rem 0 0; padding: 0; display: flex; flex-wrap: wrap; gap: 0.1rem 1rem; font-size: 0.82rem; }
.lines li { display: inline-flex; align-items: center; gap: 0.35rem; }
.lines svg { width: 2.5rem; height: 1rem; flex: none; }
.lines small { color: var(--soft); }
summary { cursor: pointer; min-height: 2rem; color: var(--soft); }
:focus-visible { outline: 3px solid var(--accent); outline-offset: 2px; border-radius: 4px; }
footer { color: var(--soft); font-size: 0.85rem; }
@media (max-width: 40rem) {
  main { padding: 1rem 0.75rem 2rem; }
  .pictures { grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 0.6rem; }
  .panel { padding: 0.75rem; }
}
@media print {
  :root { color-scheme: light; --ground: #ffffff; --panel: #ffffff; --ink: #000000; --soft: #4a4a4a; --line: #bbbbbb; --accent: #000000; }
  .panel, figure { break-inside: avoid; }
  .pictures { grid-template-columns: repeat(4, 1fr); }
  .scroll { overflow: visible; }
  table { font-size: 0.6rem; }
}
)css";

}  // namespace isoatlas::cli
