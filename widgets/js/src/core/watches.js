/** All of a figure that is watched: its nodes, and its named values. */
import { Cell, isSame } from "./cells.js";
import { READERS, readValue } from "./channels.js";
import { NamedMap } from "./maps.js";
import { Mixer } from "./mixing.js";
import { NodeWatch } from "./nodes.js";

/**
 * @typedef {import("./types.js").NodeState} NodeState
 * @typedef {import("./types.js").Parameters} Parameters
 * @typedef {import("./types.js").Problem} Problem
 * @typedef {import("./types.js").Snapshot} Snapshot
 * @typedef {import("./types.js").Value} Value
 * @typedef {Omit<import("./nodes.js").Scope, "store"|"blobs"|"mixer">} Lack
 */

/** @type {readonly Problem[]} */
const NONE = Object.freeze([]);

export class Watch {
  #mixer = new Mixer();
  /** @type {Cell<any>[]} */
  #values;
  /** What was done for the picture. @type {Cell<string>[]} */
  #cells;
  /** @type {string[]} */
  #names;
  #index;
  /** @type {ReadonlyMap<string, NodeState>} */
  #nodes = new Map();
  /** @type {NodeState[]} */
  #states = [];
  /** @type {ReadonlyMap<string, Value>} */
  #said = new Map();
  #problems = NONE;

  /** @param {import("./types.js").Manifest} manifest @param {import("./store.js").ChannelStore} store
   * @param {import("./blobs.js").BlobStore} blobs */
  constructor(manifest, store, blobs) {
    this.store = store;
    this.blobs = blobs;
    this.watches = manifest.nodes.map(({ name, kind }) => new NodeWatch(name, kind));
    this.#index = NamedMap.index(manifest.nodes.map(({ name }) => name));
    this.#names = manifest.values.map(({ name }) => name);
    this.#values = this.#names.map((name) => new Cell(`#values.${name}`, readValue));
    const moves = manifest.cells?.moves ?? [];
    const channels = manifest.cells ? ["#cells", ...moves.map((_names, k) => `#cells.${k}`)] : [];
    this.#cells = channels.map((channel) => new Cell(channel, READERS.text));
  }

  /** The channels in view, as far as they are known. */
  get channels() {
    return [...this.watches.flatMap(({ channels }) => channels), ...this.#values.map(({ channel }) => channel)];
  }

  /** The channels that are the scene's and no node's. */
  get scene() {
    return [...this.#cells, ...this.#values].map(({ channel }) => channel);
  }

  /** The arrays in view. */
  get refs() {
    return new Set(this.watches.flatMap(({ refs }) => refs));
  }

  /** Look at a point. @param {Lack} lack what is missing is noted here @param {number} t
   * @param {Parameters} parameters @returns {boolean} whether nothing is missing */
  update(lack, t, parameters) {
    const scope = { ...lack, store: this.store, blobs: this.blobs, mixer: this.#mixer };
    let isComplete = true;
    for (const watch of this.watches) if (!watch.update(scope, t, parameters)) isComplete = false;
    for (const cell of [...this.#cells, ...this.#values]) {
      cell.update(this.store, t, parameters);
      if (cell.state !== "missing" || scope.isRefused(cell.channel)) continue;
      scope.missing.push(cell.channel);
      isComplete = false;
    }
    return isComplete;
  }

  /** What was looked at last, when nothing was missing. @param {number} revision @param {number} time
   * @param {Parameters} parameters @returns {Snapshot} */
  snapshot(revision, time, parameters) {
    const [nodes, values, problems] = [this.#gatherNodes(), this.#gatherValues(), this.#gatherProblems()];
    const cells = this.#cells.map(({ state, value }) => (state === "value" ? value : null));
    return Object.freeze({ revision, time, parameters, nodes, values, problems, cells });
  }

  /** The same map as long as no node has changed. */
  #gatherNodes() {
    let isSameAsBefore = this.#states.length === this.watches.length;
    for (let i = 0; i < this.watches.length; i++) {
      const state = this.watches[i].state();
      if (state !== this.#states[i]) {
        isSameAsBefore = false;
        this.#states[i] = state;
      }
    }
    if (!isSameAsBefore) this.#nodes = new NamedMap(this.#index, this.#states.slice());
    return this.#nodes;
  }

  #gatherValues() {
    const next = this.#values.map((cell) => (cell.state === "value" ? cell.value : null));
    if (!isSame(next, [...this.#said.values()]) || this.#said.size !== next.length) {
      this.#said = new Map(this.#names.map((name, i) => [name, next[i]]));
    }
    return this.#said;
  }

  #gatherProblems() {
    /** @type {Problem[]} */
    const problems = [];
    for (const { problem } of this.watches) if (problem !== null) problems.push(problem);
    for (const { channel, state, text: said } of this.#values) {
      if (state !== "value") problems.push({ channel, text: state === "error" ? said : "There is no answer here." });
    }
    if (problems.length === 0) this.#problems = NONE;
    else if (!isSame(problems, this.#problems)) this.#problems = Object.freeze(problems);
    return this.#problems;
  }
}
