/** Manifests, sessions and clocks as small as the tests need them. */

import { Emitter } from "../../src/core/emitters.js";

/**
 * @typedef {import("../../src/core/types.js").Manifest} Manifest
 * @typedef {import("../../src/core/types.js").Parameter} Parameter
 */

/** @param {string} name @param {Partial<Parameter>} [more] @returns {Parameter} */
export function parameter(name, more = {}) {
  return {
    name, kind: "number", label: name, doc: "", unit: "", default: 1, bounds: [0, 2], step: null, options: null,
    labels: null, stops: null, grade: "free", why: "", hidden: false, depends: null, optional: false,
    soft: null, ...more,
  };
}

/** @param {Parameter[]} parameters @param {Partial<Manifest>} [more] @returns {Manifest} */
export function manifest(parameters, more = {}) {
  return {
    format: "reactive4d/1", name: "pendulum", title: "A pendulum", doc: "", pictures: "never", cells: null,
    revision: 1,
    times: { start: 0, stop: 10, rate: 30, marks: [0, 2.5, 10], still: false }, parameters, handles: [],
    view: { position: [0, -5, 0], target: [0, 0, 0], up: [0, 0, 1], fov: 30, near: 0.1, far: 100 },
    bounds: [[-1, -1, -1], [1, 1, 1]], nodes: [{ name: "bob", kind: "Sphere" }], values: [],
    point: { time: 0, parameters: Object.fromEntries(parameters.map((p) => [p.name, p.default])), camera: null },
    options: {
      theme: "auto", height: null, loop: false, autoplay: false, edges: false, shading: "smooth", ground: false,
      axes: false, grid: false, shadows: false, playing: "time",
    },
    ...more,
  };
}

/**
 * A session that answers nothing and remembers what was set.
 * @extends {Emitter<Record<string, any>>}
 */
export class FakeSession extends Emitter {
  /** @type {any[]} */ sets = [];
  /** What moved it last. @type {any} */ hand = null;

  /** @param {Manifest} of */
  constructor(of) {
    super();
    this.point = { time: of.point.time, parameters: { ...of.point.parameters } };
  }

  /** @param {{ time?: number, parameters?: Record<string, any> }} patch @param {any} [hand] */
  set({ time = this.point.time, parameters = {} }, hand = null) {
    this.hand = hand;
    const next = { time, parameters: { ...this.point.parameters, ...parameters } };
    if (JSON.stringify(next) === JSON.stringify(this.point)) return;
    this.sets.push(next);
    this.point = next;
    this.emit("point", next);
  }
}

/** The display's frames, one by one. */
export function frames() {
  let now = 0;
  /** @type {(() => void) | null} */
  let waiting = null;
  return {
    host: {
      now: () => now,
      request: (/** @type {() => void} */ f) => { waiting = f; return 1; },
      cancel: () => { waiting = null; },
    },
    /** @param {number} seconds */
    pass(seconds) {
      now += seconds;
      const f = waiting;
      waiting = null;
      f?.();
    },
  };
}
