/** Undo and redo of points: each step remembers where the reader was before they acted. */

/**
 * What came before is kept, not what was done: so a point that drifted by itself (a playing clock) is still met.
 * @template P
 */
export class History {
  /** @type {P[]} */ #past = [];
  /** @type {P[]} */ #future = [];
  /** @type {string | null} */ #gesture = null;
  #limit;

  /** @param {{ limit?: number }} [options] */
  constructor({ limit = 200 } = {}) {
    this.#limit = limit;
  }

  /**
   * The reader is about to act. Acts of one gesture (a drag, a held key) are one step.
   * @param {P} before
   * @param {string | null} [gesture]
   */
  act(before, gesture = null) {
    this.#future = [];
    if (gesture !== null && gesture === this.#gesture) return;
    this.#gesture = gesture;
    this.#past.push(before);
    if (this.#past.length > this.#limit) this.#past.shift();
  }

  /** @param {P} now @returns {P | null} where to go back to */
  undo(now) {
    const before = this.#past.pop();
    if (before === undefined) return null;
    this.#gesture = null;
    this.#future.push(now);
    return before;
  }

  /** @param {P} now @returns {P | null} */
  redo(now) {
    const after = this.#future.pop();
    if (after === undefined) return null;
    this.#gesture = null;
    this.#past.push(now);
    return after;
  }

  get canUndo() {
    return this.#past.length > 0;
  }

  get canRedo() {
    return this.#future.length > 0;
  }
}

/** Names for gestures: a drag has one of its own, keys that follow each other within a second share one. */
export class Gestures {
  #count = 0;
  #name = "";
  #last = -Infinity;
  #now;

  /** @param {() => number} [now] milliseconds */
  constructor(now = () => performance.now()) {
    this.#now = now;
  }

  /** @param {string} name */
  begin(name) {
    this.#name = "";
    return `${name} ${++this.#count}`;
  }

  /** @param {string} name */
  again(name) {
    const now = this.#now();
    if (name !== this.#name || now - this.#last > 1000) this.#count++;
    this.#name = name;
    this.#last = now;
    return `${name} ${this.#count}`;
  }
}
