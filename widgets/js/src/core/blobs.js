/** The arrays that came over the wire, as many as the memory allows; what was not used for longest goes first. */

/** @typedef {import("./types.js").Blob} Blob */

export class BlobStore {
  #bytes = 0;
  /** In the order of their last use. @type {Map<string, Blob>} */
  #blobs = new Map();

  /** @param {{budget?: number}} [options] budget: bytes */
  constructor({ budget = 768 * 2 ** 20 } = {}) {
    this.budget = budget;
  }

  get bytes() {
    return this.#bytes;
  }

  get size() {
    return this.#blobs.size;
  }

  /** @param {string} ref */
  has(ref) {
    return this.#blobs.has(ref);
  }

  /** The array; using it keeps it. @param {string} ref @returns {Blob|undefined} */
  get(ref) {
    const blob = this.#blobs.get(ref);
    if (blob !== undefined) {
      this.#blobs.delete(ref);
      this.#blobs.set(ref, blob);
    }
    return blob;
  }

  /** Take arrays in; the array of a known reference stays the same object.
   * @param {Iterable<Blob>} blobs */
  put(blobs) {
    for (const blob of blobs) {
      if (this.get(blob.ref) !== undefined) continue;
      this.#blobs.set(blob.ref, blob);
      this.#bytes += blob.array.byteLength;
    }
  }

  /** Keep to the budget, as far as what is in use allows.
   * @param {() => ReadonlySet<string>} [inUse] what must not go now @returns {string[]} what went */
  evict(inUse = () => new Set()) {
    /** @type {string[]} */
    const gone = [];
    if (this.#bytes <= this.budget) return gone;
    const kept = inUse();
    for (const [ref, blob] of this.#blobs) {
      if (this.#bytes <= this.budget) break;
      if (kept.has(ref)) continue;
      this.#blobs.delete(ref);
      this.#bytes -= blob.array.byteLength;
      gone.push(ref);
    }
    return gone;
  }
}
