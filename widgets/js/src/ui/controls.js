/** The controls of a figure: one line for each parameter that its reader may see. */

import { make } from "./elements.js";
import { colorControl, selectControl, switchControl } from "./choice-controls.js";
import { numberControl } from "./numeric-controls.js";
import { padControl, rangeControl } from "./pair-controls.js";

/**
 * @typedef {import("../core/types.js").Parameter} Parameter
 * @typedef {import("./readers.js").Reader} Reader
 * @typedef {import("./rows.js").Control} Control
 */

const KINDS = {
  number: numberControl,
  integer: numberControl,
  boolean: switchControl,
  select: selectControl,
  color: colorControl,
  range: rangeControl,
  xy: padControl,
};

/**
 * A parameter that may also be nothing has a box for that; a list has it among its choices.
 * @param {Parameter} parameter
 * @param {Reader} reader
 * @returns {Control}
 */
function controlOf(parameter, reader) {
  const control = KINDS[parameter.kind](parameter, reader);
  if (!parameter.optional || parameter.kind === "select") return control;
  let last = parameter.default ?? parameter.stops?.find((stop) => stop !== null) ?? parameter.bounds?.[0] ?? 0;
  const box = make("input", { type: "checkbox", "aria-label": `${parameter.label}, none` }, [], {
    change: () => reader.change({ parameters: { [parameter.name]: box.checked ? null : last } }),
  });
  control.element.append(make("label", { class: "none" }, [box, "none"]));
  return {
    ...control,
    show(value, limits) {
      box.checked = value === null;
      box.disabled = limits.closed;
      if (value !== null) last = value;
      control.show(value ?? last, { ...limits, closed: limits.closed || value === null });
    },
  };
}

export class Controls {
  #reader;
  /** @type {[Parameter, Control][]} */ #lines;

  /**
   * @param {Reader} reader
   * @param {(name: string) => boolean} [left] which parameters are shown elsewhere
   */
  constructor(reader, left = () => false) {
    this.#reader = reader;
    const seen = reader.manifest.parameters.filter((p) => !p.hidden && p.kind in KINDS && !left(p.name));
    this.#lines = seen.map((parameter) => [parameter, controlOf(parameter, reader)]);
    this.element = make("div", { class: "controls", role: "group", "aria-label": "Parameters" },
      this.#lines.map(([, control]) => control.element));
    this.element.hidden = this.#lines.length === 0;
    this.show();
    this.plays();
  }

  /** The reader is somewhere else. */
  show() {
    const { parameters } = this.#reader.session.point;
    for (const [parameter, control] of this.#lines) {
      control.show(parameters[parameter.name], this.#reader.allowed(parameter));
    }
  }

  /** Something else plays, or nothing. */
  plays() {
    const playing = this.#lines.find(([parameter]) => this.#reader.isPlaying(parameter.name));
    for (const [, control] of this.#lines) control.plays?.(playing?.[0].name ?? null);
  }
}
