/** One node as it is watched from frame to frame: what is missing of it, and its state when nothing is. */
import { Body } from "./bodies.js";
import { Cell, isSame, isUnmoved } from "./cells.js";
import { READERS, wantedOf } from "./channels.js";
import { WireError } from "./errors.js";
import { identity } from "./matrices.js";

/**
 * @typedef {import("./types.js").Drawn} Drawn
 * @typedef {import("./types.js").NodeState} NodeState
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Problem} Problem
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
/** @type {readonly string[]} */
const NONE = Object.freeze([]);

export class NodeWatch {
  /** All that were ever wanted. @type {Map<string, Cell<any>>} */
  #cells = new Map();
  /** Those that are wanted now, by channel. @type {Map<string, Cell<any>>} */
  #used = new Map();
  /** The same as a list. @type {Cell<any>[]} */
  #list = [];
  /** Whether all of these had values: then only they need to be looked at. */
  #isWhole = false;
  #body = new Body();
  /** @type {NodeState|null} */
  #state = null;
  /** Whether it was looked at since the state was made. */
  #isNew = true;
  /** @type {Problem|null} */
  problem = null;
  #version = -1;
  #time = NaN;
  #since = Infinity;
  #until = -Infinity;
  /** @type {readonly string[]} */
  #reads = NONE;
  /** @type {Parameters|null} */
  #parameters = null;

  /** @param {string} name @param {string} kind */
  constructor(name, kind) {
    this.name = name;
    this.kind = kind;
  }

  /** The channels that are wanted at the point that was looked at last. */
  get channels() {
    return this.#list.map(({ channel }) => channel);
  }

  /** The arrays that it stands on. */
  get refs() {
    return this.#body.refs;
  }

  /** Look at a point; what is not there is noted in the scope.
   * @param {Scope} scope @param {number} t @param {Parameters} parameters @returns {boolean} whether it is complete */
  update(scope, t, parameters) {
    if (
      this.#version === scope.store.version && this.#parameters !== null
      && (t === this.#time || (t >= this.#since && t < this.#until))
      && isUnmoved(this.#reads, this.#parameters, parameters)
    ) {
      return true;
    }
    this.#version = -1;
    this.#isNew = true;
    if (!(this.#isWhole && this.#follow(scope, t, parameters)) && !this.#gather(scope, t, parameters)) return false;
    this.#version = scope.store.version;
    this.#time = t;
    this.#parameters = parameters;
    this.#since = -Infinity;
    this.#until = Infinity;
    let reads = NONE;
    for (const cell of this.#list) {
      if (cell.since > this.#since) this.#since = cell.since;
      if (cell.until < this.#until) this.#until = cell.until;
      if (cell.reads.length > 0 && cell.reads !== reads) {
        reads = reads.length === 0 ? cell.reads : [...new Set([...reads, ...cell.reads])];
      }
    }
    this.#reads = reads;
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

  /** Look at what was wanted last; answers whether the same is wanted now, and all of it there.
   * @param {Scope} scope @param {number} t @param {Parameters} parameters */
  #follow(scope, t, parameters) {
    const [visible, drawn] = this.#list;
    const kind = drawn?.value;
    for (const cell of this.#list) {
      cell.update(scope.store, t, parameters);
      if (cell.state !== "value") return false;
    }
    if (visible.value !== (drawn !== undefined) || kind !== drawn?.value) return false;
    return this.#resolves(scope);
  }

  /** Find out what is wanted, and look at it. @param {Scope} scope @param {number} t @param {Parameters} parameters */
  #gather(scope, t, parameters) {
    this.#used = new Map();
    this.#isWhole = false;
    this.problem = null;
    const isComplete = this.#look(scope, t, parameters);
    this.#list = [...this.#used.values()];
    this.#isWhole = isComplete && this.problem === null;
    return isComplete;
  }

  /** @param {Scope} scope @param {number} t @param {Parameters} parameters */
  #look(scope, t, parameters) {
    const before = scope.missing.length;
    const visible = this.#cell("visible", scope, t, parameters);
    if (scope.missing.length > before) this.#cell("drawn", scope, t, parameters); // likely to be wanted
    if (scope.missing.length > before) return false;
    if (this.#fails(visible) || !visible.value) return true;
    const drawn = this.#cell("drawn", scope, t, parameters);
    if (scope.missing.length > before) return false;
    if (this.#fails(drawn)) return true;
    const kind = /** @type {Drawn} */ (drawn.value);
    for (const channel of wantedOf(this.kind, kind)) this.#cell(channel, scope, t, parameters);
    if (scope.missing.length > before) return false;
    if (kind === "none") return true; // if where a group is, is an error, its members say so
    for (const cell of this.#used.values()) if (this.#fails(cell)) return true;
    return this.#resolves(scope);
  }

  /** @param {string} channel @param {Scope} scope @param {number} t @param {Parameters} parameters */
  #cell(channel, scope, t, parameters) {
    let cell = this.#cells.get(channel);
    if (cell === undefined) {
      cell = new Cell(`${this.name}#${channel}`, READERS[channel]);
      this.#cells.set(channel, cell);
    }
    cell.update(scope.store, t, parameters);
    this.#used.set(channel, cell);
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
  #resolves(scope) {
    const points = this.#used.get("points");
    if (points === undefined) return true;
    const isMesh = this.#used.get("drawn")?.value === "mesh";
    const topology = this.#used.get("topology")?.value ?? null;
    const paints = this.#used.get("paints")?.value ?? null;
    try {
      return this.#body.update(scope, isMesh, points.value, topology, paints);
    } catch (error) {
      if (!(error instanceof WireError)) throw error;
      this.problem = Object.freeze({ channel: `${this.name}#${error.path}`, text: error.message });
      this.#isWhole = false;
      return true;
    }
  }

  /** @returns {NodeState} */
  #build() {
    const { name, kind } = this;
    const used = this.#used;
    const visible = this.problem === null && used.get("visible")?.value === true;
    const drawn = /** @type {NodeState["drawn"]} */ (visible ? used.get("drawn")?.value : "none");
    const isThere = drawn !== "none";
    const has = (/** @type {string} */ channel) => isThere && used.has(channel);
    return {
      name,
      kind,
      drawn,
      visible,
      color: has("color") ? used.get("color")?.value : WHITE,
      matrix: visible && used.get("matrix")?.state === "value" ? used.get("matrix")?.value : IDENTITY,
      points: has("points") ? this.#body.points : null,
      topology: has("topology") ? this.#body.topology : null,
      paints: has("paints") ? this.#body.paints : null,
      settings: drawn === "label" || drawn === "light" || drawn === "camera" ? this.#settings() : NO_SETTINGS,
    };
  }

  /** @returns {Settings} the last ones if they are the same */
  #settings() {
    const next = /** @type {any} */ ({});
    for (const channel of SETTING) next[channel] = this.#used.get(channel)?.value ?? null;
    const last = this.#state?.settings;
    return last !== undefined && isSame(last, next) ? last : Object.freeze(next);
  }
}

/** Whether two states are the same: what is equal in them is the same object. @param {NodeState} a
 * @param {NodeState} b */
function isAlike(a, b) {
  return a.drawn === b.drawn && a.visible === b.visible && a.color === b.color && a.matrix === b.matrix
    && a.topology === b.topology && a.paints === b.paints && a.settings === b.settings
    && (a.points === b.points || isSame(a.points, b.points));
}
