/** The page around the figures: prose as in a book, wide enough for about 65 letters. */

import { DARK, LIGHT } from "./palettes.js";

export const pageStyles = `
:root { ${LIGHT} }
@media screen and (prefers-color-scheme: dark) { :root:not([data-theme="light"]) { ${DARK} } }
@media screen { :root[data-theme="dark"] { ${DARK} } }

html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; scroll-padding-top: 1rem; }
body {
  margin: 0; background: var(--paper); color: var(--ink);
  font: 1.0625rem/1.6 "Iowan Old Style", "Palatino Linotype", Palatino, "URW Palladio L", P052, "Book Antiqua", Georgia,
    "Noto Serif", "DejaVu Serif", serif;
  font-kerning: normal; font-variant-ligatures: common-ligatures; text-rendering: optimizeLegibility;
}
.r4d-page {
  max-width: 34em; margin-inline: auto; padding: clamp(1.5rem, 6vw, 4.5rem) clamp(1rem, 5vw, 2rem) 5rem;
}
.r4d-page > * { margin: 0; min-width: 0; }
.r4d-page p, .r4d-page li { hyphens: auto; overflow-wrap: break-word; hanging-punctuation: first; }
.r4d-page > p + p { margin-top: 0.75em; }
.r4d-page h1, .r4d-page h2, .r4d-page h3, .r4d-page h4 { font-weight: 500; line-height: 1.2; text-wrap: balance; }
.r4d-page h1 { font-size: clamp(1.75rem, 1.3rem + 2vw, 2.4rem); letter-spacing: -0.01em; margin-bottom: 1.4rem; }
.r4d-page h2 { font-size: 1.4rem; margin: 2.6rem 0 0.8rem; }
.r4d-page h3 { font-size: 1.15rem; font-style: italic; margin: 2rem 0 0.5rem; }
.r4d-page h4 { font-size: 1rem; font-style: italic; margin: 1.6rem 0 0.4rem; }
.r4d-page ul, .r4d-page ol { padding-left: 1.4em; margin: 0.8em 0; }
.r4d-page li + li { margin-top: 0.3em; }
.r4d-page blockquote { margin: 1.2em 0; padding-left: 1.2em; border-left: 2px solid var(--line); color: var(--soft); }
.r4d-page hr { border: 0; margin: 2.4em auto; width: 4em; border-top: 1px solid var(--line); }
.r4d-page a { color: var(--accent); text-decoration-thickness: 1px; text-underline-offset: 0.18em; }
.r4d-page code { font: 0.85em/1.5 ui-monospace, "SF Mono", "DejaVu Sans Mono", Menlo, Consolas, monospace; }
.r4d-page pre { background: var(--wash); padding: 0.9rem 1.1rem; margin: 1.2em 0; overflow-x: auto;
  border-radius: 4px; }
.r4d-page table { border-collapse: collapse; margin: 1.4em 0; font-size: 0.93em; font-variant-numeric: tabular-nums; }
.r4d-page th, .r4d-page td { text-align: left; padding: 0.3em 1em 0.3em 0; border-bottom: 1px solid var(--line); }
.r4d-page th { font-weight: 500; font-style: italic; border-bottom-color: var(--soft); }
.r4d-page math { font-family: "STIX Two Math", "Libertinus Math", "Cambria Math", "Latin Modern Math",
  "DejaVu Math TeX Gyre", math; }
.r4d-formula { display: block; margin: 1em 0; padding-block: 0.2em; overflow-x: auto; overflow-y: hidden; }
.r4d-formula math { font-size: 1.08em; }
.r4d-page img { max-width: 100%; height: auto; }
.r4d-page :focus-visible { outline: 2px solid var(--accent); outline-offset: 3px; border-radius: 2px; }
.r4d-page sup, .r4d-page sub { line-height: 0; }

figure.r4d, .r4d-page > r4d-figure { margin: 2rem 0; }
.r4d-page > :first-child:is(figure.r4d, r4d-figure) { margin-top: 0; }
figure.r4d figcaption {
  margin-top: 0.7rem; color: var(--soft); font-size: 0.9rem; line-height: 1.5; text-wrap: pretty;
  font-variant-numeric: lining-nums tabular-nums;
}
r4d-figure { display: block; }
.r4d-poster { display: block; width: 100%; height: auto; border-radius: 4px; }
r4d-figure:not(:defined) .r4d-poster {
  box-sizing: border-box; aspect-ratio: 8 / 5; object-fit: contain; max-height: min(80vh, 46rem);
  background: var(--plate); border: 1px solid var(--line);
}
@media (min-width: 60rem) {
  figure.r4d, .r4d-page > r4d-figure { margin-inline: -5rem; }
  figure.r4d figcaption { max-width: calc(34em / 0.9 * 1.0625); margin-inline: 5rem; }
}
@media print {
  :root { --paper: #fff; }
  body { font-size: 10.5pt; line-height: 1.45; background: none; }
  .r4d-page { padding: 0; max-width: 36em; }
  .r4d-page a { color: inherit; }
  .r4d-page h1, .r4d-page h2, .r4d-page h3 { break-after: avoid; }
  figure.r4d, .r4d-page > r4d-figure { break-inside: avoid; margin-inline: 0; }
  p { orphans: 3; widows: 3; }
  figure.r4d figcaption { margin-inline: 0; max-width: none; font-size: 9.5pt; }
  @page { margin: 22mm 20mm; }
}
`;
