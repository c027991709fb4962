/** Handles on the picture: grips that one drags, with the pointer or by keys, to set parameters. */

import { anchorOf, carried, ORIGIN } from "./anchors.js";
import { axesOf, limitsOf, surroundings, valueOf, withValues } from "./axes.js";
import { make, setAll } from "./elements.js";
import { solve } from "./solving.js";
import { fit, keyed } from "./stepping.js";
import { valueText } from "./speech.js";

/**
 * @typedef {import("../core/types.js").Handle} Handle
 * @typedef {import("../core/types.js").Parameters} Parameters
 * @typedef {import("./readers.js").Reader} Reader
 * @typedef {import("./axes.js").Axis} Axis
 *
 * @typedef {{ handle: Handle, axes: Axis[], grip: HTMLElement, anchor: import("./anchors.js").Vec3 | null }} Held
 *
 * @typedef {object} Scenery where things are
 * @property {(node: string, parameters: Parameters) => ArrayLike<number> | null} matrix 16 numbers, row-major
 * @property {(node: string) => import("./anchors.js").Vec3 | null} extents half sizes, along the node's own axes
 * @property {(p: [number, number, number]) => { x: number, y: number, depth: number }} project CSS pixels
 * @property {(node: string, parameters: Parameters[]) => void} learn ask where a node would stand
 */

export class Handles {
  #reader;
  #scenery;
  /** @type {Held[]} */ #grips;

  /** @param {Reader} reader @param {Scenery} scenery */
  constructor(reader, scenery) {
    this.#reader = reader;
    this.#scenery = scenery;
    this.#grips = reader.manifest.handles.map((handle) => {
      const axes = axesOf(reader, handle);
      const label = handle.label || handle.node;
      const grip = make("div", { class: "handle", role: "slider", "aria-label": label, title: label });
      grip.dataset.kind = handle.kind;
      if (axes.length > 1) setAll(grip, { "aria-roledescription": "two-way handle" });
      const held = /** @type {Held} */ ({ handle, axes, grip, anchor: null });
      listen(grip, held, this.#drag.bind(this));
      grip.addEventListener("focus", () => this.#learn(held));
      grip.addEventListener("keydown", (event) => this.#pressed(event, held));
      return held;
    }).filter(({ axes }) => axes.length > 0);
    this.element = make("div", { class: "handles" }, this.#grips.map(({ grip }) => grip));
  }

  /** Put every grip where its node is now. */
  place() {
    const { parameters } = this.#reader.session.point;
    for (const held of this.#grips) {
      const { axes, grip } = held;
      const at = this.#where(held, parameters);
      const spot = at && this.#scenery.project(at);
      const seen = spot !== null && spot.depth >= -1 && spot.depth <= 1;
      grip.hidden = !seen;
      if (seen) grip.style.translate = `${spot.x.toFixed(1)}px ${spot.y.toFixed(1)}px`;
      this.#describe(grip, axes, parameters);
    }
  }

  /** @param {Held} held @param {Parameters} parameters @returns {[number, number, number] | null} */
  #where(held, parameters) {
    const matrix = this.#scenery.matrix(held.handle.node, parameters);
    return matrix && carried(matrix, this.#anchor(held, matrix));
  }

  /** Where on its node a handle is taken; settled as soon as it is known how the node moves. @param {Held} held
   * @param {ArrayLike<number>} here the node's matrix */
  #anchor(held, here) {
    if (held.anchor || held.handle.kind !== "circle") return held.anchor ?? ORIGIN;
    const { parameters } = this.#reader.session.point;
    const [axis] = held.axes;
    const { lo, hi, step, stops } = limitsOf(this.#reader, axis);
    const value = valueOf(parameters, axis);
    const others = stops ?? [value + step, value - step].filter((x) => x >= (lo ?? x) && x <= (hi ?? x));
    const extents = this.#scenery.extents(held.handle.node);
    for (const other of others) {
      if (other === value || !extents) continue;
      const numbers = withValues(parameters, [axis], [other]);
      const there = this.#scenery.matrix(held.handle.node, { ...parameters, ...numbers });
      if (there) held.anchor = anchorOf(here, there, extents);
      if (there) break;
    }
    return held.anchor ?? ORIGIN;
  }

  /** @param {HTMLElement} grip @param {Axis[]} axes @param {Parameters} parameters */
  #describe(grip, axes, parameters) {
    const first = limitsOf(this.#reader, axes[0]);
    const closed = axes.some(({ parameter }) => this.#reader.allowed(parameter).closed);
    const named = [...new Set(axes.map(({ parameter }) => parameter))];
    setAll(grip, {
      "aria-valuenow": valueOf(parameters, axes[0]), "aria-valuemin": first.lo, "aria-valuemax": first.hi,
      "aria-valuetext": named.map((p) => `${p.label} ${valueText(p, parameters[p.name])}`).join(", "),
      "aria-disabled": closed || null, tabindex: closed ? null : 0,
    });
  }

  /**
   * @param {Held} held
   * @param {[number, number]} target CSS pixels in the picture
   * @param {string} gesture
   */
  #drag(held, target, gesture) {
    const { axes } = held;
    const { parameters } = this.#reader.session.point;
    const limits = axes.map((axis) => limitsOf(this.#reader, axis));
    const freedoms = axes.map((axis, i) => ({ value: valueOf(parameters, axis), ...limits[i] }));
    const found = solve(freedoms, (numbers) => {
      const at = this.#where(held, { ...parameters, ...withValues(parameters, axes, numbers) });
      const spot = at && this.#scenery.project(at);
      return spot && spot.depth >= -1 && spot.depth <= 1 ? [spot.x, spot.y] : null;
    }, target);
    if (!found) return;
    const numbers = found.map((x, i) => fit(x, { ...limits[i], step: limits[i].step / 10 }, { coarse: true }));
    this.#reader.change({ parameters: withValues(parameters, axes, numbers) }, { gesture });
  }

  /**
   * Where the node stands at other stops is asked for as soon as a handle is taken.
   * @param {Held} held
   */
  #learn({ handle, axes }) {
    const { parameters } = this.#reader.session.point;
    const others = surroundings(axes.map((axis) => ({
      value: valueOf(parameters, axis), stops: limitsOf(this.#reader, axis).stops,
    }))).map((numbers) => ({ ...parameters, ...withValues(parameters, axes, numbers) }));
    const unknown = others.filter((there) => this.#scenery.matrix(handle.node, there) === null);
    if (unknown.length) this.#scenery.learn(handle.node, unknown);
  }

  /** @param {KeyboardEvent} event @param {Held} held */
  #pressed(event, { axes, grip }) {
    if (event.ctrlKey || event.metaKey || event.altKey || grip.hasAttribute("aria-disabled")) return;
    const upward = ["ArrowUp", "ArrowDown", "PageUp", "PageDown"].includes(event.key);
    const axis = axes[upward && axes.length > 1 ? 1 : 0];
    const { parameters } = this.#reader.session.point;
    const x = keyed(event.key, event.shiftKey, valueOf(parameters, axis), limitsOf(this.#reader, axis));
    if (x === null) return;
    event.preventDefault();
    event.stopPropagation();
    const gesture = this.#reader.gestures.again(axis.parameter.name);
    this.#reader.change({ parameters: withValues(parameters, [axis], [x]) }, { gesture });
  }
}

/**
 * A grip follows the pointer that took it, keeping the distance at which it was taken.
 * @template H
 * @param {HTMLElement} grip
 * @param {H} held
 * @param {(held: H, target: [number, number], gesture: string) => void} drag
 */
function listen(grip, held, drag) {
  let offset = [0, 0];
  let gesture = "";
  let drags = 0;
  const place = (/** @type {PointerEvent} */ event) => {
    const box = /** @type {HTMLElement} */ (grip.parentElement).getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  grip.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || grip.hasAttribute("aria-disabled")) return;
    event.preventDefault();
    event.stopPropagation();
    grip.focus({ preventScroll: true });
    grip.setPointerCapture(event.pointerId);
    const [x, y] = place(event);
    const [left, top] = grip.style.translate.split(" ").map(parseFloat);
    offset = [left - x, (top || 0) - y];
    gesture = `handle ${++drags} ${event.timeStamp}`;
    grip.toggleAttribute("data-held", true);
  });
  grip.addEventListener("pointermove", (event) => {
    if (!grip.hasPointerCapture(event.pointerId)) return;
    const [x, y] = place(event);
    drag(held, [x + offset[0], y + offset[1]], gesture);
  });
  grip.addEventListener("lostpointercapture", () => grip.toggleAttribute("data-held", false));
}
