/** Cells at work, beside the picture where there is room. */

export const cellStyles = `
/* Cells */
.cells { margin-top: 10px; --fresh: #0b7a4b; --same: #7d3fae; }
@media screen { [data-theme="dark"] .cells { --fresh: #4fd39a; --same: #c9a0f2; } }
.cells p { margin: 0; }
.cells .head { font-weight: 600; }
.cells .told { color: var(--soft); margin-bottom: 8px; min-height: 2.7em; }
.cells svg { display: block; width: 100%; height: auto; margin: 0 auto; overflow: visible; }
.cells text { font-size: 13px; text-anchor: middle; fill: var(--ink); }
.cells .word { font-size: 11px; font-style: italic; }
.cells [data-look="fresh"] { --look: var(--fresh); }
.cells [data-look="known"] { --look: var(--accent); }
.cells [data-look="same"] { --look: var(--same); }
.cells [data-look="marked"] { --look: var(--grip); }
.cells [data-look="edited"] { --look: var(--alarm); }
.box rect {
  fill: color-mix(in srgb, var(--look, transparent) 9%, var(--plate)); transition: fill 0.7s;
  stroke: var(--look, var(--soft)); stroke-width: 1.2;
}
.box[data-look="fresh"] rect { stroke-width: 2.4; }
.box[data-look="idle"] rect { stroke-dasharray: 3 3; }
.box[data-look="marked"] rect { stroke-dasharray: 7 3; }
.box[data-lit] rect { fill: color-mix(in srgb, var(--look) 40%, var(--plate)); transition: none; }
.arrow { fill: none; stroke: var(--soft); stroke-width: 1.1; }
.arrow .point { fill: var(--soft); stroke: none; }
.legend { display: grid; grid-template-columns: max-content 1fr; gap: 2px 8px; margin: 10px 0 0; color: var(--soft); }
.legend dt { color: var(--ink); font-style: italic; }
.legend dt::before {
  content: ""; display: inline-block; width: 14px; height: 9px; margin-right: 6px; border-radius: 2px;
  border: 1.5px solid var(--look, var(--soft));
  background: color-mix(in srgb, var(--look, transparent) 30%, transparent);
}
.legend dt[data-look="idle"]::before { border-style: dashed; }
.legend dd { margin: 0; }
@container (min-width: 44rem) {
  .life[data-cells] {
    display: grid; grid-template: auto auto 1fr / minmax(0, 11fr) minmax(0, 9fr); column-gap: 20px;
  }
  .life[data-cells] > .cells { grid-area: 1 / 2 / span 3; margin: 0; }
}
.life:fullscreen > .cells { max-height: 45vh; overflow: auto; }
@media (min-width: 50rem) {
  .life[data-cells]:fullscreen { display: grid; grid-template: 1fr auto auto / minmax(0, 1fr) minmax(0, 26rem); }
  .life:fullscreen > .cells { max-height: 100vh; margin-top: 10px; }
}
`;
