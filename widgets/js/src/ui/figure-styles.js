/** A figure: the picture first, then one quiet bar, then the parameters in lines. */

import { cellStyles } from "./cell-styles.js";
import { controlStyles } from "./control-styles.js";
import { DARK, LIGHT } from "./palettes.js";

export const figureStyles = `
:host { display: block; position: relative; min-width: 0; }
:host([hidden]), [hidden] { display: none !important; }
* { box-sizing: border-box; }
.figure, .picture[data-theme="light"] { ${LIGHT} }
.figure[data-theme="dark"], .picture[data-theme="dark"] { ${DARK} }
.figure {
  --target: 28px; --thumb: 16px; container-type: inline-size; color: var(--ink);
  font: 13px/1.35 system-ui, -apple-system, "Segoe UI", "Noto Sans", "Helvetica Neue", "DejaVu Sans", sans-serif;
  font-variant-numeric: lining-nums tabular-nums;
}
@media (pointer: coarse) {
  .figure { --target: 44px; --thumb: 26px; font-size: 15px; }
  .typed, select, .link { font-size: 16px; }
  .typed { min-height: 40px; }
  .icon { scale: 1.25; }
}
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; border-radius: 3px; }
.spoken {
  position: absolute; width: 1px; height: 1px; overflow: hidden; clip-path: inset(50%); white-space: nowrap;
}

/* The picture */
.picture {
  position: relative; overflow: hidden; border-radius: 4px; border: 1px solid var(--line);
  background: var(--plate); color: var(--ink);
  height: var(--r4d-height, auto); aspect-ratio: 8 / 5; max-height: min(80vh, 46rem); width: 100%;
}
.picture > canvas { position: absolute; inset: 0; width: 100%; height: 100%; display: block; touch-action: pan-y; }
.picture:not([data-live]) > canvas { opacity: 0; } /* what was not drawn yet can be reached by keys */
.picture > canvas:focus-visible { outline-offset: -3px; }
.picture > slot { display: block; height: 100%; }
::slotted(.r4d-poster) {
  display: block; width: 100% !important; height: 100% !important; object-fit: contain; margin: 0 !important;
}
.picture[data-live] ::slotted(.r4d-poster), .picture[data-live] > slot { display: none; }
.picture > .remote { position: absolute; inset: 0; width: 100%; height: 100%; pointer-events: none; }
.picture:not([data-live]) > .remote { display: none; }
.picture > .still { display: none; position: absolute; inset: 0; width: 100%; height: 100%; }
.over, .handles { position: absolute; inset: 0; pointer-events: none; }
.picture:not([data-live]) > :is(.over, .hover, .r4d-labels) { display: none; }

.handle {
  position: absolute; left: calc(var(--target) / -2); top: calc(var(--target) / -2); width: var(--target);
  height: var(--target); pointer-events: auto; cursor: grab; touch-action: none; display: grid; place-items: center;
  border-radius: 50%;
}
.handle::before {
  content: ""; width: 14px; height: 14px; border-radius: 50%; border: 2.5px solid var(--grip);
  background: color-mix(in srgb, var(--raised) 72%, transparent); box-shadow: 0 0 0 1.5px var(--raised);
}
.handle[data-kind="plane"]::before { border-radius: 3px; }
.handle:hover::before, .handle[data-held]::before { background: var(--grip); }
.handle[data-held] { cursor: grabbing; }
.handle[aria-disabled] { cursor: not-allowed; opacity: 0.55; }
.handle[aria-disabled]::before { border-style: dotted; }

.hover {
  position: absolute; left: 0; top: 0; pointer-events: none; max-width: 60%;
  background: var(--raised); color: var(--ink); border: 1px solid var(--line); border-radius: 4px; padding: 2px 7px;
  font-size: 12px; white-space: nowrap; overflow: hidden; text-overflow: ellipsis; box-shadow: 0 1px 6px var(--shade);
  margin: -36px 0 0 10px;
}
.hover[data-left] { transform: translateX(-100%); margin-left: -10px; }
.hover[data-below] { margin-top: 18px; }
.hover b { font-weight: 600; }
.notes { position: absolute; left: 8px; right: 8px; bottom: 8px; display: grid; gap: 6px; pointer-events: none; }
.notes > * {
  margin: 0; justify-self: start; max-width: 100%; background: var(--raised); border: 1px solid var(--line);
  border-radius: 4px; padding: 5px 9px; pointer-events: auto; overflow-wrap: anywhere;
}
.problems {
  list-style: none; white-space: pre-line; border-left: 4px solid var(--alarm); max-height: 9em; overflow: auto; }
.problems li::before { content: "\\26A0\\FE0E\\00A0"; color: var(--alarm); }
.waiting { color: var(--soft); }
.back { position: absolute; right: 8px; top: 8px; background: var(--raised); border-color: var(--line); }
.failure {
  margin: 0.6rem 0 0; padding: 0.5rem 0.8rem; border-left: 4px solid var(--alarm); background: var(--wash);
  font-size: 14px; overflow-wrap: anywhere;
}

.mark {
  display: flex; align-items: center; gap: 4px 12px; flex-wrap: wrap; margin: 0 0 6px; padding-left: 9px;
  border-left: 4px solid var(--grip); font-weight: 600;
}
.mark button { font-weight: 400; }

/* Buttons and fields */
button, select, input { font: inherit; color: inherit; }
button {
  border: 1px solid var(--line); border-radius: 4px; background: none; padding: 4px 10px; min-height: var(--target);
  cursor: pointer;
}
button:hover:not(:disabled) { background: var(--wash); border-color: var(--soft); }
button:disabled { color: var(--soft); cursor: default; opacity: 0.6; }
.icon-button {
  display: inline-grid; place-items: center; padding: 0; width: var(--target); height: var(--target); flex: none;
  border-color: transparent; border-radius: 50%; color: var(--soft);
}
.icon-button:hover:not(:disabled) { color: var(--ink); }
.icon { width: 14px; height: 14px; fill: currentColor; display: block; }
.icon-button.small .icon { width: 10px; height: 10px; }
.icon-button[aria-pressed="true"], .icon-button[aria-expanded="true"] {
  color: var(--accent); border-color: var(--accent);
}
select {
  min-height: var(--target); border: 1px solid var(--line); border-radius: 4px; background: var(--raised);
  padding: 0 6px; max-width: 100%;
}
.amount { display: inline-flex; align-items: baseline; gap: 3px; white-space: nowrap; color: var(--soft); }
.typed {
  width: calc(var(--digits, 4) * 1ch + 12px); text-align: right; color: var(--ink); background: none; min-width: 0;
  border: 1px solid transparent; border-bottom-color: var(--line); border-radius: 3px; padding: 2px 4px;
  min-height: 24px;
}
.typed:hover:not(:disabled) { border-color: var(--line); }
.typed:focus { background: var(--raised); }
.typed:disabled { color: var(--soft); border-bottom-style: dotted; }

/* The player */
.bar { position: relative; }
.player {
  display: grid; grid-template-columns: auto minmax(0, 1fr) auto auto; align-items: center; gap: 2px 10px;
  padding: 6px 0 2px;
}
.transport, .extras { display: flex; align-items: center; gap: 2px; }
.play { color: var(--accent); border-color: var(--line); width: calc(var(--target) + 4px);
  height: calc(var(--target) + 4px); }
.play .icon { width: 16px; height: 16px; }
.unit.tight { margin-left: -6px; }
.speed {
  appearance: none; -webkit-appearance: none; border-color: transparent; background: none; color: var(--soft);
  padding: 0 4px; text-align: center; min-width: var(--target); field-sizing: content; cursor: pointer;
}
.speed:hover { border-color: var(--line); color: var(--ink); }
.scrub { position: relative; min-width: 0; }
.strip { position: relative; height: 5px; margin: -5px calc(var(--thumb) / 2) 0; }
.strip i {
  position: absolute; top: 0; bottom: 0; left: calc(var(--from) * 100%); width: calc((var(--to) - var(--from)) * 100%);
  border-block: 1px solid transparent; color: var(--soft); min-width: 2px;
}
.strip i[data-state="remembered"] { background: color-mix(in srgb, currentColor 45%, transparent);
  background-clip: padding-box; }
.strip i[data-state="stale"] {
  background: repeating-linear-gradient(115deg, var(--grip) 0 2px, transparent 2px 5px);
}
.strip i[data-state="computing"] {
  background: repeating-linear-gradient(90deg, var(--accent) 0 3px, transparent 3px 7px);
    animation: drift 0.6s linear infinite;
}
.strip i[data-state="missing"] { border-bottom-color: var(--line); }
@keyframes drift { to { background-position-x: 7px; } }
@container (max-width: 34rem) {
  .picture { aspect-ratio: 4 / 3; }
  .player { grid-template-columns: auto minmax(0, 1fr) auto; }
  .scrub { grid-row: 1; grid-column: 1 / -1; }
  .player > .amount { justify-self: center; }
}
@container (max-width: 22rem) {
  .player { grid-template-columns: auto minmax(0, 1fr) auto; }
  .player > .transport { grid-row: 2; grid-column: 1 / 3; }
  .player > .extras { grid-row: 2; grid-column: 2 / -1; justify-self: end; }
  .player > .scrub { grid-column: 1 / 3; }
  .player > .amount { grid-row: 1; grid-column: 3; }
}
[data-follows] :is(.transport, .scrub, .speed, .extras > [aria-pressed]),
  [data-follows] .player > .amount { display: none; }
[data-follows] .player { grid-template-columns: 1fr auto; }
[data-follows] .player .extras { grid-column: 2; }

/* The menu */
.menu {
  position: absolute; right: 0; top: calc(100% + 4px); z-index: 5; width: min(100%, 25rem); padding: 12px 14px;
  display: grid; grid-template-columns: repeat(auto-fit, minmax(7rem, 1fr)); gap: 10px 14px; background: var(--raised);
  border: 1px solid var(--line); border-radius: 6px; box-shadow: 0 4px 20px var(--shade);
}
.menu fieldset { border: 0; margin: 0; padding: 0; min-width: 0; }
.menu legend { padding: 0; color: var(--soft); margin-bottom: 2px; }
.menu label { display: flex; align-items: center; gap: 7px; min-height: max(24px, calc(var(--target) - 8px));
  cursor: pointer; }
.menu label input { margin: 0; width: 15px; height: 15px; accent-color: var(--accent); }
.menu .wide, .menu .actions, .menu .note, .menu .link { grid-column: 1 / -1; }
.menu .wide select { width: 100%; }
.menu .actions { display: flex; flex-wrap: wrap; gap: 6px; }
.menu .note { margin: 0; min-height: 1.35em; color: var(--soft); }
.menu .note:empty { display: none; }
.menu .link { width: 100%; padding: 4px 6px; border: 1px solid var(--line); border-radius: 4px;
  background: var(--wash); }

${controlStyles}

/* Full screen, paper, and colours that the reader forces */
.life:fullscreen { display: flex; flex-direction: column; background: var(--paper); padding: 0 16px 10px; }
.life:fullscreen .picture { flex: 1; height: auto; max-height: none; aspect-ratio: auto; border-radius: 0;
  margin: 0 -16px;
  width: auto; min-height: 0; }
.life:fullscreen .menu { top: auto; bottom: calc(100% + 4px); }
.life:fullscreen .controls { max-height: 30vh; overflow: auto; }
${cellStyles}
@media (prefers-reduced-motion: reduce) { *, *::before { animation: none !important; transition: none !important; } }
@media (forced-colors: active) {
  .icon { fill: ButtonText; }
  .handle::before { border-color: Highlight; background: Canvas; forced-color-adjust: none; }
  .strip i, .ticks i, .between::before, .between::after, .switch::before { forced-color-adjust: none; }
  .strip i { color: CanvasText; }
  .ticks i, .between::before, .switch::before { background: CanvasText; }
  .between::after { background: Highlight; }
  .slider input { forced-color-adjust: none; --accent: Highlight; --line: GrayText; --raised: Canvas; }
  .switch:checked { forced-color-adjust: none; background: Highlight; border-color: Highlight; }
  .switch:checked::before { background: HighlightText; }
  :focus-visible { outline-color: Highlight; }
}
@media print {
  .figure, .figure[data-theme], .picture[data-theme] { ${LIGHT} }
  .bar, .controls, .over, .hover, .back, .waiting { display: none !important; }
  .picture { background: none; max-height: 12cm; }
  .picture[data-still] > canvas { display: none; }
  .picture[data-still] > .still { display: block; object-fit: contain; }
}
`;
