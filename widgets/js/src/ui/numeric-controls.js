/** Controls of numbers: a slider, a number to type, and a button that plays it as time plays. */

import { button, make, rename } from "./elements.js";
import { stepped, withUnit } from "./formats.js";
import { icon, setIcon } from "./icons.js";
import { canPlay, spanned } from "./limits.js";
import { row } from "./rows.js";
import { Slider } from "./sliders.js";
import { fit } from "./stepping.js";
import { TypedNumber } from "./typing.js";

/**
 * @typedef {import("../core/types.js").Parameter} Parameter
 * @typedef {import("./readers.js").Reader} Reader
 * @typedef {import("./limits.js").Allowed} Allowed
 */

/** A unit behind a field; a degree sign stands close. @param {string} unit */
export function unitOf(unit) {
  const text = withUnit("", unit);
  if (!unit) return null;
  return make("span", { class: text.startsWith("\u202f") ? "unit" : "unit tight" }, [text.trim()]);
}

/** @param {Parameter} parameter @param {Reader} reader @returns {import("./rows.js").Control} */
export function numberControl(parameter, reader) {
  const { name, label, unit } = parameter;
  /** @type {Allowed} */
  let limits = reader.allowed(parameter);
  let gesture = "";
  const set = (/** @type {number} */ value, /** @type {string} */ act) => {
    const mark = act === "drag" ? gesture : reader.gestures.again(name);
    reader.change({ parameters: { [name]: value } }, { gesture: mark });
  };
  const slider = new Slider({
    label,
    say: (value) => withUnit(stepped(value, limits), unit),
    fit: (wish) => fit(wish, limits, { coarse: true }),
    moved: set,
    drag: (act) => { gesture = act === "begin" ? reader.gestures.begin(name) : ""; },
  });
  const typed = new TypedNumber(`${label}, as a number`, set);
  const play = button(`Play ${label}`, icon("play"), () => reader.toggle(name), { class: "icon-button small" });
  const unitText = unitOf(unit);
  const line = row(parameter, [
    slider.element, make("span", { class: "amount" }, [typed.element, unitText]), play,
  ], [slider.input, typed.element, play]);
  return {
    element: line.element,
    show(value, now) {
      limits = now;
      const x = typeof value === "number" ? value : 0;
      line.close(now);
      const open = now.from === null || now.to === null;
      slider.element.hidden = open;
      if (!open) slider.show(x, spanned(now, x), now.stops ?? []);
      typed.show(x, now);
      play.hidden = !canPlay(parameter, now);
    },
    plays(axis) {
      const on = axis === name;
      setIcon(play, on ? "pause" : "play");
      rename(play, on ? `Pause ${label}` : `Play ${label}`);
    },
  };
}
