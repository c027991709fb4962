/**
 * How finely a moving picture is drawn: finer while there is time, coarser when frames come late. A picture that stands
 * still is always drawn finely, but not so finely that the next move would have to wait for it.
 */

/**
 * @typedef {object} Step
 * @property {number} scale drawn pixels per pixel of the screen, along an edge
 * @property {boolean} shadows whether things throw shadows on each other
 * @property {number} skips how many frames the shadow on the floor may lag behind
 */

/** @type {Step[]} */
const STEPS = [
  { scale: 0.75, shadows: false, skips: 8 },
  { scale: 1, shadows: false, skips: 2 },
  { scale: 1, shadows: true, skips: 0 },
  { scale: 1.5, shadows: true, skips: 0 },
  { scale: 2, shadows: true, skips: 0 },
];
const START = 1;
const CHEAP = 5;
const DEAR = 14;
const SLOW = 60;
const LATE = 30;
const PATIENCE = 12;
/** Milliseconds that a picture at rest may take. */
const PAUSE = 300;
const FINE = STEPS[STEPS.length - 1].scale;
const FAIR = 1.5;

/** The pace of one figure. */
export class Pace {
  #step = START;
  #ceiling = STEPS.length - 1;
  #good = 0;
  #bad = 0;
  #slow = 0;
  #rest = FINE;

  /** How the next moving frame is to be drawn. */
  get step() {
    return STEPS[this.#step];
  }

  /** The most drawn pixels per pixel of the screen for a picture at rest. */
  get rest() {
    return this.#rest;
  }

  /**
   * Learn from a picture at rest.
   * @param {number} cost milliseconds
   */
  rested(cost) {
    this.#slow = cost > PAUSE ? this.#slow + 1 : 0;
    if (this.#slow < 2) return; // the first may have waited for its programs
    this.#rest = this.#rest > FAIR ? FAIR : 1;
    this.#slow = 0;
  }

  /**
   * Learn from a frame that moved.
   * @param {number} cost milliseconds that drawing took
   * @param {number} interval milliseconds since the frame before, if it followed at once; else 0
   */
  learn(cost, interval) {
    this.#bad = cost > DEAR || interval > LATE ? this.#bad + 1 : 0;
    this.#good = cost < CHEAP && interval < LATE ? this.#good + 1 : 0;
    const least = cost > SLOW ? 0 : START;
    if (this.#bad >= 3 && this.#step > least) {
      this.#step -= 1;
      this.#ceiling = Math.max(START, this.#step);
      this.#bad = 0;
    }
    if (this.#good >= PATIENCE && this.#step < this.#ceiling) {
      this.#step += 1;
      this.#good = 0;
    }
  }
}
