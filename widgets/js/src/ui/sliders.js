/** A slider: a native range, its ticks, and keys that know stops. */

import { make, setAll } from "./elements.js";
import { keyed } from "./stepping.js";
import { ticks } from "./ticks.js";

/**
 * @typedef {import("./stepping.js").Limits} Limits
 * @typedef {object} SliderOptions
 * @property {string} label
 * @property {(value: number) => string} say the value in words
 * @property {(wish: number) => number} fit the allowed value nearest to where the pointer is
 * @property {(value: number, act: "drag" | "key") => void} moved
 * @property {(act: "begin" | "end") => void} [drag] a drag begins, ends
 * @property {(key: string, shift: boolean, value: number) => number | null} [key] other meanings of keys
 */

export class Slider {
  /** @type {Limits} */ #limits = { lo: 0, hi: 1, step: 0.01, stops: null };
  #value = 0;
  #marked = "";
  #options;

  /** @param {SliderOptions} options */
  constructor(options) {
    this.#options = options;
    this.input = make("input", { type: "range", step: "any", "aria-label": options.label }, [], {
      input: () => this.#dragged(),
      keydown: (event) => this.#pressed(event),
      pointerdown: () => options.drag?.("begin"),
      pointerup: () => options.drag?.("end"),
      pointercancel: () => options.drag?.("end"),
    });
    this.ticks = make("div", { class: "ticks", "aria-hidden": "true" });
    this.element = make("div", { class: "slider" }, [this.ticks, this.input]);
  }

  /** @param {number} value @param {Limits} limits @param {readonly number[]} [marks] */
  show(value, limits, marks = []) {
    this.#value = value;
    this.#limits = limits;
    const [lo, hi] = [limits.lo ?? 0, limits.hi ?? 1];
    setAll(this.input, { min: lo, max: hi, "aria-valuetext": this.#options.say(value) });
    if (this.input.valueAsNumber !== value) this.input.value = String(value);
    const share = hi > lo ? Math.min(1, Math.max(0, (value - lo) / (hi - lo))) : 0;
    this.element.style.setProperty("--share", share.toFixed(5));
    this.#mark(marks, lo, hi);
  }

  /** @param {readonly number[]} marks @param {number} lo @param {number} hi */
  #mark(marks, lo, hi) {
    const key = `${lo} ${hi} ${marks.length} ${marks[0]} ${marks.at(-1)}`;
    if (key === this.#marked) return;
    this.#marked = key;
    this.ticks.replaceChildren(...ticks(marks, lo, hi).map(({ at }) => {
      const tick = make("i");
      tick.style.setProperty("--at", at.toFixed(5));
      return tick;
    }));
  }

  #dragged() {
    const value = this.#options.fit(this.input.valueAsNumber);
    if (value !== this.#value) this.#options.moved(value, "drag");
    this.show(value, this.#limits); // a snapped value takes the thumb with it
  }

  /** @param {KeyboardEvent} event */
  #pressed(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const value = this.#options.key?.(event.key, event.shiftKey, this.#value)
      ?? keyed(event.key, event.shiftKey, this.#value, this.#limits);
    if (value === null) return;
    event.preventDefault();
    event.stopPropagation();
    if (value !== this.#value) this.#options.moved(value, "key");
  }
}
