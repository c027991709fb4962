/** One node as it is watched from frame to frame: what is missing of it, and its state when nothing is. */
import { Body } from "./bodies.js";
import { Cell, isSame, isUnmoved } from "./cells.js";
import { READERS, WANTED } from "./channels.js";
import { WireError } from "./errors.js";
import { identity } from "./matrices.js";

/**
 * @typedef {import("./types.js").NodeState} NodeState
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Problem} Problem
 * @typedef {import("./types.js").Points} Points
 * @typedef {import("./types.js").Settings} Settings
 * @typedef {import("./store.js").ChannelStore} ChannelStore
 *
 * @typedef {object} Scope where a node is looked at
 * @property {ChannelStore} store
 * @property {import("./blobs.js").BlobStore} blobs
 * @property {import("./mixing.js").Mixer} mixer
 * @property {(channel: string) => boolean} isRefused whether it was asked for here, and there was no answer
 * @property {(ref: string) => boolean} isLost whether the array was asked for, and did not come
 * @property {string[]} missing channels
 * @property {Set<string>} wanted references
 */

const IDENTITY = identity();
const WHITE = Object.freeze([1, 1, 1, 1]);
/** @type {Settings} */
const NO_SETTINGS = Object.freeze({
  text: null, height: null, light_type: null, intensity: null, angle: null, reach: null, shadows: null,
  fov: null, near: null, far: null, target: null,
});
const SETTING = Object.keys(NO_SETTINGS);

export class NodeWatch {
  /** @type {Map<string, Cell<any>>} */
  #cells = new Map();
  /** Those that are wanted now. @type {Cell<any>[]} */
  #used = [];
  /** @type {NodeState|null} */
  #state = null;
  /** @type {Problem|null} */
  problem = null;
  /** Whether it was looked at since the state was made. */
  #isNew = true;
  #version = -1;
  #time = NaN;
  #since = Infinity;
  #until = -Infinity;
  /** @type {readonly string[]} */
  #reads = [];
  /** @type {Parameters|null} */
  #parameters = null;
  #body = new Body();

  /** @param {string} name @param {string} kind */
  constructor(name, kind) {
    this.name = name;
    this.kind = kind;
  }

  /** The channels that are wanted at the point that was looked at last. */
  get channels() {
    return this.#used.map(({ channel }) => channel);
  }

  /** The arrays that it stands on. */
  get refs() {
    return this.#body.refs;
  }

  /** Look at a point; what is not there is noted in the scope.
   * @param {Scope} scope @param {number} t @param {Parameters} parameters @returns {boolean} whether it is complete */
  update(scope, t, parameters) {
    const { store } = scope;
    if (
      this.#version === store.version && this.#parameters !== null
      && (t === this.#time || (t >= this.#since && t < this.#until))
      && isUnmoved(this.#reads, this.#parameters, parameters)
    ) {
      return true;
    }
    this.#version = -1;
    if (!this.#gather(scope, t, parameters)) return false;
    this.#version = store.version;
    this.#time = t;
    this.#parameters = parameters;
    this.#since = -Infinity;
    this.#until = Infinity;
    for (const cell of this.#used) {
      if (cell.since > this.#since) this.#since = cell.since;
      if (cell.until < this.#until) this.#until = cell.until;
    }
    this.#reads = this.#used.every(({ reads }) => reads.length === 0)
      ? this.#used[0].reads
      : [...new Set(this.#used.flatMap(({ reads }) => reads))];
    return true;
  }

  /** The state at the point that was looked at, which has to be complete; the last one if it is the same. */
  state() {
    if (this.#state !== null && !this.#isNew) return this.#state;
    this.#isNew = false;
    const next = this.#build();
    if (this.#state === null || !isAlike(this.#state, next)) this.#state = Object.freeze(next);
    return this.#state;
  }

  /** @param {Scope} scope @param {number} t @param {Parameters} parameters */
  #gather(scope, t, parameters) {
    this.#used = [];
    this.problem = null;
    this.#isNew = true;
    const before = scope.missing.length;
    const visible = this.#cell("visible", scope, t, parameters);
    if (visible.state === "missing" && !scope.isRefused(visible.channel)) this.#cell("drawn", scope, t, parameters);
    if (scope.missing.length > before) return false;
    if (this.#fails(visible) || !visible.value) return true;
    const drawn = this.#cell("drawn", scope, t, parameters);
    if (scope.missing.length > before) return false;
    if (this.#fails(drawn)) return true;
    for (const channel of WANTED[/** @type {NodeState["drawn"]} */ (drawn.value)]) {
      this.#cell(channel, scope, t, parameters);
    }
    if (scope.missing.length > before) return false;
    if (this.#used.some((cell) => this.#fails(cell))) return true;
    try {
      return this.#resolve(scope);
    } catch (error) {
      if (!(error instanceof WireError)) throw error;
      this.problem = Object.freeze({ channel: `${this.name}#${error.path}`, text: error.message });
      return true;
    }
  }

  /** @param {string} channel @param {Scope} scope @param {number} t @param {Parameters} parameters */
  #cell(channel, scope, t, parameters) {
    let cell = this.#cells.get(channel);
    if (cell === undefined) {
      cell = new Cell(`${this.name}#${channel}`, READERS[channel]);
      this.#cells.set(channel, cell);
    }
    cell.update(scope.store, t, parameters);
    this.#used.push(cell);
    if (cell.state === "missing" && !scope.isRefused(cell.channel)) scope.missing.push(cell.channel);
    return cell;
  }

  /** @param {Cell<any>} cell */
  #fails(cell) {
    if (cell.state === "value") return false;
    const text = cell.state === "error" ? cell.text : "There is no answer here.";
    this.problem = Object.freeze({ channel: cell.channel, text });
    return true;
  }

  /** The arrays behind the references. @param {Scope} scope @returns {boolean} whether they are all there */
  #resolve(scope) {
    const points = this.#value("points");
    if (points === undefined) return true;
    const isMesh = this.#value("drawn") === "mesh";
    return this.#body.update(scope, isMesh, points, this.#value("topology") ?? null, this.#value("paints") ?? null);
  }

  /** The value of a channel, if it is wanted now. @param {string} channel */
  #value(channel) {
    const cell = this.#cells.get(channel);
    return cell !== undefined && this.#used.includes(cell) ? cell.value : undefined;
  }

  /** @returns {NodeState} */
  #build() {
    const { name, kind } = this;
    const value = (/** @type {string} */ channel) => this.#value(channel);
    const isThere = this.problem === null && value("visible") === true;
    const drawn = isThere ? value("drawn") : "none";
    const has = (/** @type {string} */ channel) => WANTED[/** @type {NodeState["drawn"]} */ (drawn)].includes(channel);
    return {
      name,
      kind,
      drawn,
      visible: isThere,
      color: has("color") ? value("color") : WHITE,
      matrix: has("matrix") ? value("matrix") : IDENTITY,
      points: has("points") ? this.#body.points : null,
      topology: has("topology") ? this.#body.topology : null,
      paints: has("paints") ? this.#body.paints : null,
      settings: drawn === "label" || drawn === "light" || drawn === "camera" ? settings(value) : NO_SETTINGS,
    };
  }
}

/** @param {(channel: string) => any} value @returns {Settings} */
function settings(value) {
  return Object.freeze(/** @type {any} */ (Object.fromEntries(SETTING.map((one) => [one, value(one) ?? null]))));
}

/** @param {NodeState} a @param {NodeState} b */
function isAlike(a, b) {
  return a.drawn === b.drawn && a.visible === b.visible && isSame(a.color, b.color) && isSame(a.matrix, b.matrix)
    && a.topology === b.topology && a.paints === b.paints && isAlikePoints(a.points, b.points)
    && (a.settings === b.settings || isSame(a.settings, b.settings));
}

/** @param {Points|null} a @param {Points|null} b */
function isAlikePoints(a, b) {
  return a === b || (a !== null && b !== null && a.a === b.a && a.b === b.b && a.mix === b.mix);
}
