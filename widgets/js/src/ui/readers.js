/** One reader of one figure: where they are, what they do, what undoes it, what plays. No screen. */

import { Emitter } from "../core/emitters.js";
import { Gestures, History } from "./histories.js";
import { allowed, fitted } from "./limits.js";

/**
 * @typedef {import("../core/types.js").Manifest} Manifest
 * @typedef {import("../core/types.js").Point} Point
 * @typedef {import("../core/types.js").Eye} Eye
 * @typedef {import("../core/types.js").Value} Value
 * @typedef {import("../core/types.js").Snapshot} Snapshot
 * @typedef {{ time?: number, parameters?: Record<string, Value>, camera?: Eye | null }} Patch
 *
 * @typedef {object} SessionLike what a reader needs of a Session
 * @property {Point} point
 * @property {import("../core/aheads.js").Hand | null} hand
 * @property {(patch: { time?: number, parameters?: Record<string, Value> },
 *   hand?: import("../core/aheads.js").Hand | null) => void} set
 * @property {(name: any, listener: (payload: any) => void) => () => void} on
 *
 * @typedef {object} ClockLike what a reader needs of a Clock
 * @property {number} value
 * @property {number} start
 * @property {number} stop
 * @property {number} speed
 * @property {boolean} loop
 * @property {boolean} paused
 * @property {string} playing
 * @property {number} pace
 * @property {(seconds: number) => number | null} after
 * @property {(settings: any) => void} configure
 * @property {() => void} play
 * @property {() => void} pause
 * @property {(value: number) => void} seek
 * @property {() => void} dispose
 * @property {(name: any, listener: (payload: any) => void) => () => void} on
 *
 * @typedef {object} CameraLike what a reader needs of a View
 * @property {() => Eye | null} own the reader's camera; null: the scene's
 * @property {(eye: Eye | null) => void} look
 */

const SWEEP = 6; // seconds in which a parameter that plays goes through its bounds

/**
 * @typedef {object} ReaderEvents
 * @property {void} point somebody moved
 * @property {string} acted the reader did, in a word: "moved", "undone", "jumped"
 * @property {void} playing what plays, or that nothing does
 * @property {void} camera
 * @property {void} history
 */

/** @extends {Emitter<ReaderEvents>} */
export class Reader extends Emitter {
  /** @type {History<Point>} */ #history = new History();
  #ticking = false;
  #moving = false;
  /** @type {Eye | null} */ #eye = null;
  /** @type {(() => void)[]} */ #off = [];
  /** @type {CameraLike | null} */ #camera = null;
  /** @type {Reader | null} */ #leader = null;
  gestures = new Gestures();

  /**
   * @param {Manifest} manifest
   * @param {SessionLike} session
   * @param {ClockLike} clock
   */
  constructor(manifest, session, clock) {
    super();
    this.manifest = manifest;
    this.session = session;
    this.clock = clock;
    this.#off.push(
      clock.on("tick", (value) => this.#tick(value)),
      clock.on("state", () => this.emit("playing", undefined)),
      session.on("point", () => this.#moved()),
    );
    /** Where it opened: what a reset returns to. @type {Point} */
    this.opened = { time: session.point.time, parameters: { ...session.point.parameters },
      camera: manifest.point.camera ?? null };
    this.#arm(manifest.options.playing || "time");
    clock.loop = manifest.options.loop;
  }

  /** Where the reader is. @returns {Point} */
  get point() {
    const { time, parameters } = this.session.point;
    return { time, parameters: { ...parameters }, camera: this.#camera?.own() ?? null };
  }

  /** What a parameter may be now. @param {import("../core/types.js").Parameter} parameter */
  allowed(parameter) {
    return allowed(parameter, this.session.point.parameters);
  }

  /** @param {string} name */
  parameter(name) {
    return this.manifest.parameters.find((p) => p.name === name) ?? null;
  }

  /** @param {CameraLike} camera */
  watch(camera) {
    this.#camera = camera;
    this.#eye = camera.own();
  }

  /** The reader moved the camera by hand: a step of undo too. */
  looked() {
    const eye = this.#camera?.own() ?? null;
    if (this.#moving || same(eye, this.#eye)) return;
    this.#history.act({ ...this.point, camera: this.#eye }, this.gestures.again("camera"));
    this.#eye = eye;
    this.emit("camera", undefined);
    this.emit("history", undefined);
  }

  /**
   * The reader acts. What is not allowed is brought to the nearest that is.
   * @param {Patch} patch
   * @param {{ gesture?: string | null, word?: string }} [options] acts of one gesture are one step of undo
   */
  change(patch, { gesture = null, word = "moved" } = {}) {
    this.#history.act(this.point, gesture);
    this.#go(patch);
    this.emit("history", undefined);
    this.emit("acted", word);
  }

  /** Where the page opened. */
  reset() {
    this.pause();
    this.change(this.opened, { word: "reset" });
  }

  undo() {
    this.#return(this.#history.undo(this.point), "undone");
  }

  redo() {
    this.#return(this.#history.redo(this.point), "redone");
  }

  get canUndo() {
    return this.#history.canUndo;
  }

  get canRedo() {
    return this.#history.canRedo;
  }

  /** @param {Point | null} point @param {string} word */
  #return(point, word) {
    if (!point) return;
    this.pause();
    this.#go(point);
    this.emit("history", undefined);
    this.emit("acted", word);
  }

  /** To a point, without a step of undo (an address, the page's own back button). @param {Patch} patch */
  jump(patch) {
    this.#go(patch);
    this.emit("acted", "jumped");
  }

  /** @param {Patch} patch */
  #go(patch) {
    this.#moving = true;
    /** @type {{ time?: number, parameters?: Record<string, Value> }} */
    const wish = {};
    if (patch.time !== undefined) wish.time = patch.time;
    if (patch.parameters) wish.parameters = this.#fitted(patch.parameters);
    if (wish.time !== undefined || wish.parameters) this.session.set(wish);
    if (patch.camera !== undefined) {
      this.#camera?.look(patch.camera);
      this.#eye = this.#camera?.own() ?? null;
      this.emit("camera", undefined);
    }
    this.#moving = false;
  }

  /** @param {Record<string, Value>} wishes */
  #fitted(wishes) {
    const place = { ...this.session.point.parameters, ...wishes };
    /** @type {Record<string, Value>} */
    const found = {};
    for (const [name, wish] of Object.entries(wishes)) {
      const parameter = this.parameter(name);
      if (parameter) found[name] = fitted(parameter, wish, allowed(parameter, place));
    }
    return found;
  }

  #moved() {
    if (!this.#ticking) this.clock.seek(this.#position());
    this.emit("point", undefined);
  }

  /** Where the clock's hand stands: the time, or the parameter that plays. */
  #position() {
    const { playing } = this.clock;
    const value = playing === "time" ? this.session.point.time : this.session.point.parameters[playing];
    return typeof value === "number" ? value : this.clock.value;
  }

  /** @param {number} value */
  #tick(value) {
    const { playing } = this.clock;
    this.#ticking = true;
    if (playing === "time") this.session.set({ time: value }, this.clock);
    else this.session.set({ parameters: this.#fitted({ [playing]: value }) });
    this.#ticking = false;
  }

  /** Whether this axis ("time", or a parameter) is playing. @param {string} [name] @returns {boolean} */
  isPlaying(name) {
    if (this.#leader) return this.#leader.isPlaying(name);
    return !this.clock.paused && (name === undefined || this.clock.playing === name);
  }

  /** Play or pause an axis; another one that plays stops. @param {string} [name] */
  toggle(name = "time") {
    if (this.#leader && (name === "time" || this.#leader.parameter(name))) this.#leader.toggle(name);
    else if (this.isPlaying(name)) this.pause();
    else this.play(name);
  }

  /** Pause whatever plays; if nothing does, play an axis. @param {string} [name] */
  turn(name = "time") {
    if (!this.isPlaying()) this.toggle(name);
    else if (this.#leader) this.#leader.turn(name);
    else this.pause();
  }

  /** @param {string} [name] */
  play(name = "time") {
    if (this.clock.playing !== name) this.#arm(name);
    const at = this.#position();
    const size = 1e-9 * Math.max(1, Math.abs(this.clock.stop));
    this.clock.seek(at >= this.clock.stop - size ? this.clock.start : at);
    this.clock.play();
    this.emit("playing", undefined);
  }

  pause() {
    this.clock.pause();
    this.emit("playing", undefined);
  }

  /** @param {string} name what plays from now on */
  #arm(name) {
    this.clock.pause();
    const parameter = this.parameter(name);
    const { times } = this.manifest;
    const limits = parameter && this.allowed(parameter);
    if (limits && limits.from !== null && limits.to !== null) {
      const [start, stop] = [limits.from, limits.to];
      this.clock.configure({
        playing: name, start, stop, marks: limits.stops ?? [], value: start, rate: (stop - start) / SWEEP,
      });
    } else {
      const { start, stop, marks } = times;
      this.clock.configure({ playing: "time", start, stop, marks, value: start, rate: 1 });
    }
    this.clock.seek(this.#position());
  }

  /**
   * Share the point with another reader from now on: theirs wins first, then each follows the other.
   * @param {Reader} leader
   */
  follow(leader) {
    this.#leader = leader;
    let busy = false;
    const pass = (/** @type {Reader} */ from, /** @type {Reader} */ to) => {
      if (busy) return;
      busy = true;
      const { time, parameters } = from.session.point;
      const shared = Object.entries(parameters).filter(([name]) => to.parameter(name));
      to.session.set({ time, parameters: Object.fromEntries(shared) }, from.session.hand);
      busy = false;
    };
    pass(leader, this);
    this.#off.push(
      leader.session.on("point", () => pass(leader, this)),
      this.session.on("point", () => pass(this, leader)),
      leader.on("playing", () => this.emit("playing", undefined)),
    );
  }

  /** The reader whose point this one shares, if any. */
  get leader() {
    return this.#leader;
  }

  dispose() {
    this.clock.pause();
    this.clock.dispose();
    for (const off of this.#off) off();
    this.clear();
  }
}

/** @param {Eye | null} a @param {Eye | null} b */
function same(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}
