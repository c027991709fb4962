/** A shelf: the tables of a channel for one set of parameter names, one table for each combination of their values. */
import { NOTHING } from "./playables.js";

/** @typedef {import("./segments.js").Segment} Segment */

export class Shelf {
  /** What of the names may be blended. @type {readonly string[]} */
  blend = NOTHING;
  /** Of a shelf without names, there are thousands of them: no map for one table. @type {Segment[]|undefined} */
  #only = undefined;
  /** @type {Map<string, Segment[]>|undefined} */
  #tables = undefined;

  /** @param {readonly string[]} names sorted */
  constructor(names) {
    this.names = names;
  }

  /** @param {string} key of the values @returns {Segment[]|undefined} */
  get(key) {
    return this.names.length === 0 ? this.#only : this.#tables?.get(key);
  }

  /** The table of these values, made if there is none. @param {string} key @returns {Segment[]} */
  at(key) {
    if (this.names.length === 0) return (this.#only ??= []);
    this.#tables ??= new Map();
    let table = this.#tables.get(key);
    if (table === undefined) this.#tables.set(key, (table = []));
    return table;
  }

  /** @returns {Iterable<Segment[]>} */
  get tables() {
    if (this.names.length === 0) return this.#only === undefined ? [] : [this.#only];
    return this.#tables?.values() ?? [];
  }

  /** Leave out some of the segments, and tables that are empty then. @param {ReadonlySet<Segment>} gone */
  drop(gone) {
    if (this.#only !== undefined) this.#only = this.#only.filter((segment) => !gone.has(segment));
    for (const [key, table] of this.#tables ?? []) {
      const left = table.filter((segment) => !gone.has(segment));
      if (left.length === 0) this.#tables?.delete(key);
      else this.#tables?.set(key, left);
    }
  }

  /** Whether these are its names. @param {readonly string[]} names */
  isOf(names) {
    const mine = this.names;
    return mine === names || (mine.length === names.length && mine.every((one, i) => one === names[i]));
  }
}
