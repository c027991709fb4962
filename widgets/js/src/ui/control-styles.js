/** Sliders and the lines of parameters under a figure. */

export const controlStyles = `
/* A player without a time */
.player[data-timeless] :is(.scrub, .amount) { display: none; }
.player[data-idle] :is(.transport, .speed, .extras > [aria-pressed]) { display: none; }
.player[data-timeless] { grid-template-columns: auto 1fr; }
.player[data-timeless] > .extras { grid-row: 1; grid-column: 2; justify-self: end; }
.player[data-timeless] > .transport { grid-row: 1; grid-column: 1; }

/* A slider */
.slider { position: relative; height: var(--target); min-width: 0; display: grid; align-items: center; }
.slider input {
  appearance: none; -webkit-appearance: none; width: 100%; height: 100%; margin: 0; background: none; cursor: pointer;
  position: relative; touch-action: pan-y;
}
.slider input:focus-visible { outline: none; }
.slider input::-webkit-slider-runnable-track {
  height: 3px; border-radius: 2px;
  background: linear-gradient(var(--accent) 0 0) 0 / calc(var(--share) * 100%) 100% no-repeat, var(--line);
}
.slider input::-moz-range-track { height: 3px; border-radius: 2px; background: var(--line); }
.slider input::-moz-range-progress { height: 3px; border-radius: 2px; background: var(--accent); }
.slider input::-webkit-slider-thumb {
  -webkit-appearance: none; width: var(--thumb); height: var(--thumb); margin-top: calc((3px - var(--thumb)) / 2);
  border-radius: 50%; border: 2px solid var(--accent); background: var(--raised);
}
.slider input::-moz-range-thumb {
  width: var(--thumb); height: var(--thumb); border-radius: 50%; border: 2px solid var(--accent);
  background: var(--raised); box-sizing: border-box;
}
.slider input:hover::-webkit-slider-thumb, .slider input:active::-webkit-slider-thumb { background: var(--accent); }
.slider input:hover::-moz-range-thumb, .slider input:active::-moz-range-thumb { background: var(--accent); }
.slider input:focus-visible::-webkit-slider-thumb { outline: 2px solid var(--accent); outline-offset: 3px; }
.slider input:focus-visible::-moz-range-thumb { outline: 2px solid var(--accent); outline-offset: 3px; }
.slider input:disabled { cursor: not-allowed; }
.slider input:disabled::-webkit-slider-thumb { border-color: var(--soft); background: var(--wash);
  border-style: dotted; }
.slider input:disabled::-webkit-slider-runnable-track { background: var(--line); }
.slider input:disabled::-moz-range-thumb { border-color: var(--soft); background: var(--wash); border-style: dotted; }
.ticks { position: absolute; left: calc(var(--thumb) / 2); right: calc(var(--thumb) / 2); top: 50%; height: 0; }
.ticks i {
  position: absolute; left: calc(var(--at) * 100%); top: -5px; width: 1px; height: 10px; background: var(--soft);
  opacity: 0.55;
}

/* The lines */
.controls {
  columns: 17rem 2; column-gap: 32px;
  padding-top: 6px; margin-top: 4px; border-top: 1px solid var(--line);
}
.control {
  position: relative; display: grid; align-items: center; gap: 0 8px; min-width: 0; min-height: var(--target);
  break-inside: avoid; margin-bottom: 4px;
  grid-template-columns: 6rem minmax(0, 1fr) minmax(4.6rem, auto) var(--target);
}
.control .name { overflow-wrap: anywhere; cursor: default; }
.control > .field, .control > .pad { grid-column: 2 / -1; justify-self: start; display: flex; align-items: center;
  gap: 8px;
  max-width: 100%; }
.control > .amount { grid-column: 3; justify-self: end; }
.control:not(:has(> .slider:not([hidden]), > .between, > .pad)) > .amount { grid-column: 2; justify-self: start; }
.control > .icon-button { grid-column: 4; }
.control[data-kind="range"] > .amount { grid-column: 3 / -1; }
.control .why { grid-column: 2 / -1; margin: -2px 0 4px; color: var(--soft); font-style: italic; }
.control[data-closed] .name { color: var(--soft); }
.tip {
  /* Above its line: below the last one it would make the columns longer, and push what follows away. */
  position: absolute; left: 0; bottom: calc(100% - 2px); z-index: 4; max-width: min(100%, 22rem); padding: 5px 9px;
  background: var(--raised); border: 1px solid var(--line); border-radius: 4px; box-shadow: 0 1px 8px var(--shade);
  visibility: hidden; opacity: 0;
  transition: opacity 0.12s 0.35s, visibility 0s 0.5s;
}
.control .name:hover ~ .tip, .control .tip:hover, .control:has(:focus-visible) .tip {
  visibility: visible; opacity: 1; transition: opacity 0.12s 0.35s, visibility 0s 0.35s;
}
.control[data-quiet] .tip { visibility: hidden !important; }

.none { grid-column: 2 / -1; display: flex; align-items: center; gap: 6px; color: var(--soft); min-height: 24px; }
.none input { margin: 0; width: 15px; height: 15px; accent-color: var(--accent); }

/* A switch */
.switch {
  appearance: none; -webkit-appearance: none; width: 34px; height: 20px; margin: 0; border-radius: 10px; flex: none;
  border: 1.5px solid var(--soft); background: none; position: relative; cursor: pointer;
}
.switch::before {
  content: ""; position: absolute; left: 2px; top: 2px; width: 13px; height: 13px; border-radius: 50%;
  background: var(--soft); transition: translate 0.1s;
}
.switch::after { content: ""; position: absolute; inset: calc((18px - var(--target)) / 2) -6px; }
.switch:checked { background: var(--accent); border-color: var(--accent); }
.switch:checked::before { translate: 14px 0; background: var(--on-accent); }
.switch:disabled { opacity: 0.55; cursor: not-allowed; }
.state { color: var(--soft); }

/* Colours */
input[type="color"] {
  width: 44px; height: max(24px, calc(var(--target) - 4px)); padding: 2px; border: 1px solid var(--line);
    border-radius: 4px;
  background: var(--raised); cursor: pointer;
}
.swatches { flex-wrap: wrap; }
.swatches input {
  appearance: none; -webkit-appearance: none; width: 24px; height: 24px; margin: 0; border-radius: 50%; cursor: pointer;
  background: var(--swatch); border: 1px solid var(--soft); box-shadow: inset 0 0 0 2px var(--raised);
  forced-color-adjust: none;
}
.swatches input:checked { outline: 2px solid var(--ink); outline-offset: 1px; }

/* Two thumbs on one track */
.between { position: relative; height: var(--target); min-width: 0; grid-column: 2; }
.between .slider { position: absolute; inset: 0; pointer-events: none; }
.between .slider input { pointer-events: none; }
.between .slider input::-webkit-slider-thumb { pointer-events: auto; position: relative; z-index: 1; }
.between .slider input::-moz-range-thumb { pointer-events: auto; }
.between .slider input::-webkit-slider-runnable-track { background: none; }
.between .slider input::-moz-range-track, .between .slider input::-moz-range-progress { background: none; }
.between::before, .between::after {
  content: ""; position: absolute; top: calc(50% - 1.5px); height: 3px; border-radius: 2px; background: var(--line);
  left: calc(var(--thumb) / 2); right: calc(var(--thumb) / 2);
}
.between::after {
  background: var(--accent); right: auto; width: calc((100% - var(--thumb)) * (var(--to) - var(--from)));
  left: calc(var(--thumb) / 2 + (100% - var(--thumb)) * var(--from));
}
.between .slider { z-index: 1; }

/* A pad */
.pad {
  position: relative; width: 104px; height: 104px; border: 1px solid var(--line); border-radius: 4px; cursor: crosshair;
  touch-action: none; margin: 4px 0; background:
    linear-gradient(var(--line) 0 0) center / 100% 1px no-repeat,
      linear-gradient(var(--line) 0 0) center / 1px 100% no-repeat;
}
.pad .thumb {
  position: absolute; left: calc(var(--x) * 100% - var(--thumb) / 2); bottom: calc(var(--y) * 100% - var(--thumb) / 2);
  width: var(--thumb); height: var(--thumb); border-radius: 50%; border: 2px solid var(--accent);
    background: var(--raised);
}
.control[data-kind="xy"] { grid-template-columns: 6rem auto minmax(0, 1fr); }
.control[data-kind="xy"] > .pad { grid-column: 2; }
.control[data-kind="xy"] > .amount {
  grid-column: 3; justify-self: start; display: grid; gap: 2px; padding-left: 6px;
}
.pair { display: inline-flex; align-items: baseline; gap: 4px; }

/* Narrow: the name and the number above, the slider below over the whole width */
@container (max-width: 30rem) {
  .control { grid-template-columns: minmax(0, 1fr) auto var(--target); padding-block: 3px; }
  .control > .name { grid-row: 1; grid-column: 1; }
  .control > .slider, .control > .between { grid-row: 2; grid-column: 1 / -1; margin-top: -6px; }
  .control > .amount { grid-row: 1; grid-column: 2; }
  .control > .icon-button { grid-row: 1; grid-column: 3; }
  .control:has(> .field) { grid-template-columns: auto minmax(0, 1fr); }
  .control > .field { grid-row: 1; grid-column: 2; justify-self: end; }
  .control[data-kind="range"] > .amount { grid-column: 2 / -1; }
  .control[data-kind="xy"] { grid-template-columns: auto minmax(0, 1fr); }
  .control[data-kind="xy"] > .name { grid-column: 1 / -1; }
  .control[data-kind="xy"] > .pad { grid-column: 1; }
  .control[data-kind="xy"] > .amount { grid-row: 2; grid-column: 2; }
  .control .why, .none { grid-column: 1 / -1; }
}
`;
