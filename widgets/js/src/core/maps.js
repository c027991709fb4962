/** A map that never changes, over names that are always the same: the next one costs one short array. */

/** @template V @implements {ReadonlyMap<string, V>} */
export class NamedMap {
  #index;
  #values;

  /** @param {ReadonlyMap<string, number>} index name → place; shared, and not changed any more
   * @param {readonly V[]} values by place */
  constructor(index, values) {
    this.#index = index;
    this.#values = values;
  }

  /** @param {readonly string[]} names */
  static index(names) {
    return new Map(names.map((name, i) => [name, i]));
  }

  get size() {
    return this.#index.size;
  }

  /** @param {string} name */
  has(name) {
    return this.#index.has(name);
  }

  /** @param {string} name @returns {V|undefined} */
  get(name) {
    const i = this.#index.get(name);
    return i === undefined ? undefined : this.#values[i];
  }

  keys() {
    return this.#index.keys();
  }

  values() {
    return this.#values.values();
  }

  /** @returns {MapIterator<[string, V]>} */
  entries() {
    return /** @type {any} */ (this.#pairs());
  }

  [Symbol.iterator]() {
    return this.entries();
  }

  /** @param {(value: V, name: string, map: ReadonlyMap<string, V>) => void} callback */
  forEach(callback) {
    for (const [name, value] of this) callback(value, name, this);
  }

  *#pairs() {
    for (const [name, i] of this.#index) yield [name, this.#values[i]];
  }
}
