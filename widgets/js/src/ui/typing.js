/** A number that one types: at rest as short as its step, while typing with all its digits. */

import { make, setAll } from "./elements.js";
import { format, parse, stepped } from "./formats.js";
import { keyed } from "./stepping.js";

/** @typedef {import("./stepping.js").Limits} Limits */

export class TypedNumber {
  #value = 0;
  /** @type {Limits} */ #limits = { lo: null, hi: null, step: 0.01, stops: null };
  #typing = false;
  #typed;

  /**
   * @param {string} label
   * @param {(value: number, act: "typed" | "key") => void} typed
   */
  constructor(label, typed) {
    this.#typed = typed;
    this.element = make("input", {
      type: "text", inputmode: "decimal", class: "typed", "aria-label": label, role: "spinbutton",
      autocomplete: "off", spellcheck: "false", enterkeyhint: "done",
    }, [], {
      focus: () => this.#begin(),
      input: () => { this.#typing = true; },
      blur: () => this.#end(true),
      keydown: (event) => this.#pressed(event),
    });
  }

  /** @param {number} value @param {Limits} limits */
  show(value, limits) {
    this.#value = value;
    this.#limits = limits;
    const text = stepped(value, limits);
    setAll(this.element, { "aria-valuenow": value, "aria-valuemin": limits.lo, "aria-valuemax": limits.hi });
    setAll(this.element, { "aria-valuetext": text });
    if (!this.#typing && this.element.value !== text) this.element.value = text;
    const ends = [limits.lo, limits.hi, value].map((x) => (x === null ? 0 : stepped(x, limits).length));
    this.element.style.setProperty("--digits", String(Math.max(...ends)));
  }

  #begin() {
    this.element.value = format(this.#value);
    this.element.select();
  }

  /** @param {boolean} keep */
  #end(keep) {
    const value = keep && this.#typing ? parse(this.element.value) : null;
    this.#typing = false;
    if (value !== null && value !== this.#value) this.#typed(value, "typed");
    this.element.value = stepped(this.#value, this.#limits);
  }

  /** @param {KeyboardEvent} event */
  #pressed(event) {
    if (this.#typing && (event.ctrlKey || event.metaKey)) event.stopPropagation(); // the field's own undo
    if (event.key === "Enter") {
      this.#end(true);
      this.element.select();
    } else if (event.key === "Escape" && this.#typing) {
      this.#end(false);
      this.element.select();
      event.stopPropagation();
    } else if (["ArrowUp", "ArrowDown", "PageUp", "PageDown"].includes(event.key)) {
      event.preventDefault();
      const value = keyed(event.key, event.shiftKey, this.#value, this.#limits);
      if (value !== null && value !== this.#value) this.#typed(value, "key");
      this.#typing = false;
      this.element.value = stepped(this.#value, this.#limits);
    }
  }
}
