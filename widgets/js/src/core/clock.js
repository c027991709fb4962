/** What makes time go on: a value that runs from start to stop, as the display asks for frames. */
import { Emitter } from "./emitters.js";

const LEAP = 0.25; // seconds: no frame counts for more, so that a page that was hidden goes on from where it was

/**
 * @typedef {object} Settings
 * @property {string} [playing] "time", or the parameter that plays
 * @property {number} [start]
 * @property {number} [stop]
 * @property {readonly number[]} [marks] ascending
 * @property {number} [value]
 * @property {number} [rate] units per second at speed 1
 */

/**
 * Events: "tick" with the new value, whenever it runs or steps; "state" when it starts, stops or is configured.
 * @extends {Emitter<{tick: number, state: undefined}>}
 */
export class Clock extends Emitter {
  playing = "time";
  start = 0;
  stop = 1;
  /** @type {readonly number[]} */
  marks = [];
  value = 0;
  rate = 1;
  speed = 1;
  loop = false;
  paused = true;
  #frame = 0;
  #last = 0;

  /**
   * @param {object} host
   * @param {() => number} host.now seconds
   * @param {(callback: () => void) => number} host.request calls back at the next frame
   * @param {(frame: number) => void} host.cancel
   */
  constructor({ now, request, cancel }) {
    super();
    this.now = now;
    this.request = request;
    this.cancel = cancel;
  }

  /** @param {Settings} settings what changes */
  configure({ playing, start, stop, marks, value, rate }) {
    this.playing = playing ?? this.playing;
    this.start = start ?? this.start;
    this.stop = Math.max(stop ?? this.stop, this.start);
    this.marks = marks ?? this.marks;
    this.rate = rate ?? this.rate;
    this.value = this.#inside(value ?? this.value);
    this.emit("state", undefined);
  }

  /** Run; from the other end, if it stands at the one it runs to. */
  play() {
    if (!this.paused) return;
    const forwards = this.speed >= 0;
    if (this.value === (forwards ? this.stop : this.start)) {
      this.#go(forwards ? this.start : this.stop);
    }
    this.paused = false;
    this.#last = this.now();
    this.#frame = this.request(this.#run);
    this.emit("state", undefined);
  }

  pause() {
    if (this.paused) return;
    this.paused = true;
    this.cancel(this.#frame);
    this.emit("state", undefined);
  }

  toggle() {
    if (this.paused) this.play();
    else this.pause();
  }

  /** Set the hand; nobody is told, for whoever sets it knows. @param {number} value */
  seek(value) {
    if (Number.isFinite(value)) this.value = this.#inside(value);
    this.#last = this.now();
  }

  /** By how much it runs in a second. */
  get pace() {
    return this.rate * this.speed;
  }

  /** Where it will stand, as far as one can tell; null if it does not run. @param {number} seconds from now */
  after(seconds) {
    return this.paused ? null : this.#moved(seconds * this.pace).value;
  }

  /** Stop, and step to the next mark, or to the end. */
  next() {
    this.pause();
    this.#go(this.marks.find((mark) => mark > this.value && mark <= this.stop) ?? this.stop);
  }

  /** Stop, and step to the mark before, or to the beginning. */
  previous() {
    this.pause();
    this.#go(this.marks.findLast((mark) => mark < this.value && mark >= this.start) ?? this.start);
  }

  dispose() {
    this.pause();
    this.clear();
  }

  #run = () => {
    if (this.paused) return;
    const now = this.now();
    const passed = now - this.#last;
    this.#last = now;
    const { value, isOver } = this.#moved(Math.min(Math.max(passed, 0), LEAP) * this.pace);
    // The frame is asked for first: a listener may pause.
    this.#frame = this.request(this.#run);
    if (isOver) this.pause();
    this.#go(value);
  };

  /** @param {number} step */
  #moved(step) {
    const value = this.value + step;
    const span = this.stop - this.start;
    if (step >= 0 ? value < this.stop : value > this.start) return { value, isOver: false };
    if (!this.loop || span <= 0) return { value: step >= 0 ? this.stop : this.start, isOver: true };
    const past = (value - this.start) % span;
    return { value: this.start + (past < 0 ? past + span : past), isOver: false };
  }

  /** @param {number} value */
  #go(value) {
    this.value = this.#inside(value);
    this.emit("tick", this.value);
  }

  /** @param {number} value */
  #inside(value) {
    return Math.min(Math.max(value, this.start), this.stop);
  }
}
