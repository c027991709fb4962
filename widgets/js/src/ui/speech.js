/** What a figure says: the text of its picture, and after the reader acted, what became of it. */

import { described } from "./descriptions.js";
import { format, stepped, timeText, withUnit } from "./formats.js";
import { digitsOf, stepOf } from "./stepping.js";

/**
 * @typedef {import("../core/types.js").Manifest} Manifest
 * @typedef {import("../core/types.js").Value} Value
 * @typedef {import("../core/types.js").Snapshot} Snapshot
 * @typedef {{ time: number, parameters: import("../core/types.js").Parameters }} Moment
 */

/**
 * The text of the picture: "At 1.27 s: A crimson sphere (bob) at (0.34, 0.00, −0.94)." It is made of what
 * is shown, so that it holds at every time and for every value, baked or not.
 * @param {Manifest} manifest
 * @param {Moment & Partial<Pick<Snapshot, "nodes" | "values">>} moment
 */
export function pictureText(manifest, { time, parameters, nodes, values }) {
  const when = `At ${timeText(time)}`;
  if (nodes && values) return `${when}: ${described(manifest, { nodes, values })}`;
  const settings = parameterTexts(manifest, parameters).join(", ");
  return `${when}: ${[manifest.title || manifest.name, settings].filter(Boolean).join(", ")}.`;
}

/**
 * "length 1.50 m", for each parameter in view.
 * @param {Manifest} manifest
 * @param {import("../core/types.js").Parameters} parameters
 */
export function parameterTexts(manifest, parameters) {
  return manifest.parameters.filter((p) => !p.hidden && p.name in parameters)
    .map((p) => `${p.label} ${valueText(p, parameters[p.name])}`);
}

/**
 * A parameter's value as one reads it, with its unit; a spec is Python's, as in format().
 * @param {import("../core/types.js").Parameter} parameter
 * @param {Value} value
 * @param {string | null} [spec]
 */
export function valueText(parameter, value, spec = null) {
  if (parameter.kind === "select") {
    const key = JSON.stringify(value);
    const at = parameter.options?.findIndex((option) => JSON.stringify(option) === key) ?? -1;
    return parameter.labels?.[at] ?? format(value);
  }
  if (parameter.kind === "boolean") return value ? "on" : "off";
  if (parameter.kind === "color" && !Array.isArray(value)) return String(value);
  const step = stepOf(parameter);
  const digits = digitsOf(parameter, step);
  const plain = (/** @type {unknown} */ x) => typeof x === "number" && spec === null;
  const one = (/** @type {any} */ x) => (plain(x) ? stepped(x, { step, digits }) : format(x, spec ?? ""));
  const text = Array.isArray(value) ? value.map(one).join(parameter.kind === "range" ? " – " : ", ") : one(value);
  return withUnit(text, parameter.unit);
}

/**
 * A polite live region, which speaks at most every so many milliseconds, and then only the latest.
 */
export class Announcer {
  #last = -Infinity;
  /** @type {ReturnType<typeof setTimeout> | null} */ #timer = null;
  #write;

  /**
   * @param {(text: string) => void} write
   * @param {{ every?: number, now?: () => number }} [options] milliseconds
   */
  constructor(write, { every = 1200, now = () => performance.now() } = {}) {
    this.#write = write;
    this.every = every;
    this.now = now;
  }

  /** @param {() => string} text asked when it is spoken */
  say(text) {
    if (this.#timer !== null) clearTimeout(this.#timer);
    // A little silence first: whoever drags or holds a key is told where they arrived, not each step.
    const wait = Math.max(350, this.#last + this.every - this.now());
    this.#timer = setTimeout(() => {
      this.#timer = null;
      this.#last = this.now();
      this.#write(text());
    }, wait);
  }

  dispose() {
    if (this.#timer !== null) clearTimeout(this.#timer);
  }
}
