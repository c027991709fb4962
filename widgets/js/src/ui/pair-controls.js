/** Controls of two numbers: a range with two thumbs, a pad for a place in the plane. */

import { sideLimits } from "./axes.js";
import { make, setAll } from "./elements.js";
import { stepped, withUnit } from "./formats.js";
import { unitOf } from "./numeric-controls.js";
import { row } from "./rows.js";
import { fit, keyed } from "./stepping.js";
import { Slider } from "./sliders.js";
import { TypedNumber } from "./typing.js";

/**
 * @typedef {import("../core/types.js").Parameter} Parameter
 * @typedef {import("../core/types.js").Value} Value
 * @typedef {import("./readers.js").Reader} Reader
 * @typedef {import("./rows.js").Control} Control
 * @typedef {import("./stepping.js").Limits} Limits
 */

/** @param {Value} value @returns {[number, number]} */
function pairOf(value) {
  return Array.isArray(value) && value.length > 1 ? [value[0], value[1]] : [0, 0];
}

/** @param {Parameter} parameter @param {Reader} reader @returns {Control} */
export function rangeControl(parameter, reader) {
  const { name, label, unit } = parameter;
  let now = pairOf(parameter.default);
  let gesture = "";
  /** @type {Limits[]} */
  let sides = [0, 1].map((i) => sideLimits(parameter, reader.allowed(parameter), i));
  const set = (/** @type {number} */ i, /** @type {number} */ x, /** @type {string} */ act) => {
    const pair = i === 0 ? [Math.min(x, now[1]), now[1]] : [now[0], Math.max(x, now[0])];
    const mark = act === "drag" ? gesture : reader.gestures.again(name);
    reader.change({ parameters: { [name]: pair } }, { gesture: mark });
  };
  const ends = ["from", "to"].map((word, i) => ({
    slider: new Slider({
      label: `${label}, ${word}`,
      say: (value) => withUnit(stepped(value, sides[i]), unit),
      fit: (wish) => {
        const x = fit(wish, sides[i], { coarse: true });
        return i === 0 ? Math.min(x, now[1]) : Math.max(x, now[0]);
      },
      moved: (value, act) => set(i, value, act),
      drag: (act) => { gesture = act === "begin" ? reader.gestures.begin(name) : ""; },
    }),
    typed: new TypedNumber(`${label}, ${word}, as a number`, (value, act) => set(i, fit(value, sides[i]), act)),
  }));
  const track = make("div", { class: "between" }, ends.map((end) => end.slider.element));
  const amount = make("span", { class: "amount" }, [
    ends[0].typed.element, "–", ends[1].typed.element, unitOf(unit),
  ]);
  const fields = ends.flatMap((end) => [end.slider.input, end.typed.element]);
  const line = row(parameter, [track, amount], fields, { group: true });
  return {
    element: line.element,
    show(value, limits) {
      line.close(limits);
      now = pairOf(value);
      sides = [0, 1].map((i) => sideLimits(parameter, limits, i));
      ends.forEach(({ slider, typed }, i) => {
        slider.show(now[i], sides[i], i === 0 ? sides[i].stops ?? [] : []);
        typed.show(now[i], sides[i]);
      });
      const { lo, hi } = sides[0];
      const share = (/** @type {number} */ x) => ((x - (lo ?? 0)) / ((hi ?? 1) - (lo ?? 0) || 1)).toFixed(5);
      track.style.setProperty("--from", share(now[0]));
      track.style.setProperty("--to", share(now[1]));
    },
  };
}

/** @param {Parameter} parameter @param {Reader} reader @returns {Control} */
export function padControl(parameter, reader) {
  const { name, label, unit } = parameter;
  let now = pairOf(parameter.default);
  let gesture = "";
  /** @type {Limits[]} */
  let sides = [0, 1].map((i) => sideLimits(parameter, reader.allowed(parameter), i));
  const set = (/** @type {number[]} */ pair, /** @type {string} */ act) => {
    const mark = act === "drag" ? gesture : reader.gestures.again(name);
    reader.change({ parameters: { [name]: pair } }, { gesture: mark });
  };
  const thumb = make("div", {
    class: "thumb", role: "slider", "aria-label": label, "aria-roledescription": "two-way slider",
  });
  const pad = make("div", { class: "pad" }, [thumb], {
    pointerdown: (event) => {
      if (thumb.hasAttribute("aria-disabled") || event.button !== 0) return;
      event.preventDefault();
      thumb.focus();
      pad.setPointerCapture(event.pointerId);
      gesture = reader.gestures.begin(name);
      drag(event);
    },
    pointermove: (event) => { if (pad.hasPointerCapture(event.pointerId)) drag(event); },
    keydown: (event) => {
      const upward = event.key === "ArrowUp" || event.key === "ArrowDown" || event.key.startsWith("Page");
      const i = upward ? 1 : 0;
      const x = event.ctrlKey || event.metaKey ? null : keyed(event.key, event.shiftKey, now[i], sides[i]);
      if (x === null || thumb.hasAttribute("aria-disabled")) return;
      event.preventDefault();
      event.stopPropagation();
      set(i === 0 ? [x, now[1]] : [now[0], x], "key");
    },
  });
  /** @param {PointerEvent} event */
  function drag(event) {
    const box = pad.getBoundingClientRect();
    const shares = [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    set(shares.map((share, i) => {
      const [lo, hi] = [sides[i].lo ?? 0, sides[i].hi ?? 1];
      return fit(lo + share * (hi - lo), sides[i], { coarse: true });
    }), "drag");
  }
  const typed = ["x", "y"].map((axis, i) => new TypedNumber(`${label}, ${axis}`, (value, act) => {
    const x = fit(value, sides[i]);
    set(i === 0 ? [x, now[1]] : [now[0], x], act);
  }));
  const amount = make("span", { class: "amount" }, [
    make("span", { class: "pair" }, ["x", typed[0].element, unitOf(unit)]),
    make("span", { class: "pair" }, ["y", typed[1].element, unitOf(unit)]),
  ]);
  const line = row(parameter, [pad, amount], [thumb, ...typed.map((t) => t.element)], { group: true });
  return {
    element: line.element,
    show(value, limits) {
      line.close(limits);
      now = pairOf(value);
      sides = [0, 1].map((i) => sideLimits(parameter, limits, i));
      typed.forEach((field, i) => field.show(now[i], sides[i]));
      const texts = now.map((x, i) => withUnit(stepped(x, sides[i]), unit));
      setAll(thumb, {
        "aria-valuenow": now[0], "aria-valuemin": sides[0].lo, "aria-valuemax": sides[0].hi,
        "aria-valuetext": `x ${texts[0]}, y ${texts[1]}`,
      });
      now.forEach((x, i) => {
        const [lo, hi] = [sides[i].lo ?? 0, sides[i].hi ?? 1];
        pad.style.setProperty(i === 0 ? "--x" : "--y", ((x - lo) / (hi - lo || 1)).toFixed(5));
      });
    },
  };
}
