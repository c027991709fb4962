/** The script of a figure, as its reader edits it: below the picture, and as quiet. */

import { DARK, LIGHT } from "./palettes.js";

export const scriptStyles = `
:host { display: block; min-width: 0; }
* { box-sizing: border-box; }
.script { ${LIGHT} }
.script[data-theme="dark"] { ${DARK} }
.script {
  --target: 28px; margin: -1rem 0 2rem; color: var(--ink);
  font: 13px/1.4 system-ui, -apple-system, "Segoe UI", "Noto Sans", "Helvetica Neue", "DejaVu Sans", sans-serif;
}
@media (min-width: 60rem) { .script { margin-inline: -5rem; } }
@media (pointer: coarse) { .script { --target: 44px; font-size: 15px; } }
:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; border-radius: 3px; }
summary { cursor: pointer; color: var(--soft); padding: 4px 0; min-height: var(--target); align-content: center; }
summary:hover { color: var(--ink); }
p { margin: 6px 0; }
.about, .keys { color: var(--soft); }
.field {
  display: grid; grid-template-columns: auto minmax(0, 1fr); border: 1px solid var(--line); border-radius: 4px;
  background: var(--raised); overflow: hidden;
}
.field:focus-within { border-color: var(--accent); box-shadow: 0 0 0 1px var(--accent); }
textarea:focus-visible { outline: 0; }
.lines, textarea {
  font: 13px/1.5 ui-monospace, "SF Mono", "DejaVu Sans Mono", Menlo, Consolas, monospace; padding: 8px 0; margin: 0;
  tab-size: 4;
}
@media (pointer: coarse) {
  .lines, textarea { font-size: 16px; }
  .keys { display: none; }
}
.lines {
  height: 0; min-height: 100%; list-style: none; overflow: hidden; text-align: right; color: var(--soft);
  background: var(--wash);
  user-select: none; -webkit-user-select: none; font-variant-numeric: tabular-nums;
}
.lines li { padding: 0 8px 0 10px; }
.lines li[data-wrong] { color: var(--paper); background: var(--alarm); font-weight: 600; }
textarea {
  width: 100%; border: 0; padding-inline: 10px; resize: vertical; color: inherit; background: none;
  white-space: pre; overflow: auto; display: block; min-height: 6rem;
}
.actions { display: flex; flex-wrap: wrap; align-items: center; gap: 8px; margin: 8px 0; }
button {
  font: inherit; color: inherit; border: 1px solid var(--line); border-radius: 4px; background: none; padding: 4px 10px;
  min-height: var(--target); cursor: pointer;
}
button:hover:not(:disabled) { background: var(--wash); border-color: var(--soft); }
button:disabled { color: var(--soft); cursor: default; opacity: 0.6; }
.run { border-color: var(--accent); color: var(--accent); }
.status { min-height: 1.4em; }
.status[data-own]::before { content: "\\25CF\\00A0"; color: var(--grip); }
.wrong { list-style: none; margin: 6px 0; padding: 0; display: grid; gap: 6px; }
.wrong li { border-left: 4px solid var(--alarm); padding-left: 9px; white-space: pre-wrap; overflow-wrap: anywhere; }
.wrong button { border: 0; padding: 0 2px; min-height: 24px; color: var(--accent); text-decoration: underline; }
@media (forced-colors: active) {
  .lines li[data-wrong] { forced-color-adjust: none; background: Mark; color: MarkText; }
}
@media print { .script { display: none; } }
`;
