/**
 * One graphics context for all figures of a page. A figure is drawn here and copied into its own canvas, only when
 * something about it changed and it can be seen; coarser while it moves, finely when it has come to rest.
 */
import { WebGLRenderer } from "three";
import { Blur } from "./floors.js";
import { Materials } from "./materials.js";

/** @typedef {import("./views.js").View} View */
/**
 * @typedef {object} Entry a figure, and how it stands with its picture
 * @property {View} view
 * @property {boolean} seen whether it is in sight
 * @property {boolean} dirty whether it is to be drawn
 * @property {boolean} sharp whether finely
 * @property {number} last when it was drawn, milliseconds
 * @property {ReturnType<typeof setTimeout>|null} timer until it is drawn finely
 */

const REST = 200;
const BUDGET = 24;

/** Where figures are drawn. */
export class Stage {
  materials = new Materials();
  /** @type {WebGLRenderer|null} */
  #renderer = null;
  /** @type {WebGLRenderer["info"]|null} */
  #info = null;
  /** @type {Blur|null} */
  #blur = null;
  #failed = false;
  #lost = false;
  /** @type {Map<View, Entry>} */
  #entries = new Map();
  /** @type {number|null} */
  #frame = null;
  /** @type {IntersectionObserver|null} */
  #watch = null;
  /** @type {HTMLCanvasElement|OffscreenCanvas|null} */
  #canvas;

  /** @param {{canvas?: HTMLCanvasElement|OffscreenCanvas}} [options] `canvas`: one to draw on, else one is made */
  constructor({ canvas } = {}) {
    this.#canvas = canvas ?? null;
    if (typeof IntersectionObserver !== "undefined") {
      this.#watch = new IntersectionObserver((changes) => this.#look(changes), { rootMargin: "80px" });
    }
  }

  /** Counts of what is on the graphics card; null before the first picture. */
  get info() {
    return this.#renderer?.info ?? this.#info;
  }

  /** Whether there is a context to draw with. */
  get lost() {
    return this.#lost || this.#failed;
  }

  /** @param {View} view */
  add(view) {
    const seen = this.#watch === null;
    this.#entries.set(view, { view, sharp: false, last: -Infinity, timer: null, seen, dirty: true });
    this.#watch?.observe(view.canvas);
  }

  /** @param {View} view */
  remove(view) {
    const entry = this.#entries.get(view);
    if (entry === undefined) return;
    if (entry.timer !== null) clearTimeout(entry.timer);
    this.#watch?.unobserve(view.canvas);
    this.#entries.delete(view);
    if (this.#entries.size === 0) this.#blur?.dispose(); // it comes back with the next figure
  }

  /**
   * Something about a figure changed.
   * @param {View} view
   * @param {boolean} [sharp] it changed once and does not move: draw it finely at once
   */
  invalidate(view, sharp = false) {
    const entry = this.#entries.get(view);
    if (entry === undefined) return;
    entry.sharp = sharp && (entry.sharp || !entry.dirty) && entry.timer === null;
    entry.dirty = true;
    this.#schedule();
  }

  /**
   * Draw a figure now.
   * @param {View} view
   * @param {boolean} [sharp] finely
   * @returns {boolean} whether there was something to draw with
   */
  draw(view, sharp = true) {
    const entry = this.#entries.get(view);
    return entry !== undefined && this.#paint(entry, sharp);
  }

  /** Lose the context, as a browser might (for tests). */
  lose() {
    this.#renderer?.forceContextLoss();
  }

  /** Get it back (for tests). */
  restore() {
    this.#renderer?.forceContextRestore();
  }

  /** Free everything. The views are to be disposed of before. */
  dispose() {
    for (const view of [...this.#entries.keys()]) this.remove(view);
    if (this.#frame !== null) cancelAnimationFrame(this.#frame);
    this.#watch?.disconnect();
    this.materials.dispose();
    this.#blur?.dispose();
    this.#info = this.info;
    this.#renderer?.dispose();
    this.#renderer?.forceContextLoss();
    this.#renderer = null;
    this.#failed = true;
  }

  #schedule() {
    this.#frame ??= requestAnimationFrame((now) => this.#tick(now));
  }

  /** @param {number} start */
  #tick(start) {
    this.#frame = null;
    if (this.lost) return;
    const waiting = [...this.#entries.values()].filter((entry) => entry.dirty && entry.seen);
    waiting.sort((a, b) => a.last - b.last);
    for (const entry of waiting) {
      if (performance.now() - start > BUDGET && entry !== waiting[0]) {
        this.#schedule();
        break;
      }
      const sharp = entry.sharp;
      this.#paint(entry, sharp);
      if (!sharp && !this.lost) this.#settle(entry);
    }
  }

  /** @param {Entry} entry drawn coarsely: draw it finely when it rests */
  #settle(entry) {
    if (entry.timer !== null) clearTimeout(entry.timer);
    entry.timer = setTimeout(() => {
      entry.timer = null;
      if (entry.dirty) return;
      entry.dirty = true;
      entry.sharp = true;
      this.#schedule();
    }, REST);
  }

  /**
   * @param {Entry} entry
   * @param {boolean} sharp
   */
  #paint(entry, sharp) {
    const renderer = this.#open();
    if (renderer === null || this.#lost || this.#blur === null) return false;
    const start = performance.now();
    entry.dirty = false;
    entry.sharp = false;
    entry.view.paint(renderer, this.#blur, sharp);
    const end = performance.now();
    if (sharp) entry.view.pace.rested(end - start);
    else entry.view.pace.learn(end - start, start - entry.last < 100 ? start - entry.last : 0);
    entry.last = start;
    return true;
  }

  #open() {
    if (this.#renderer !== null || this.#failed) return this.#renderer;
    this.#canvas ??= newCanvas();
    try {
      this.#renderer = new WebGLRenderer({
        canvas: /** @type {HTMLCanvasElement} */ (this.#canvas),
        alpha: true,
        antialias: false,
        powerPreference: "high-performance",
      });
    } catch {
      this.#failed = true;
      for (const view of this.#entries.keys()) view.contextLost();
      return null;
    }
    this.#renderer.shadowMap.enabled = true;
    this.#renderer.setClearColor(0x000000, 0);
    this.#blur = new Blur();
    this.#canvas.addEventListener("webglcontextlost", () => this.#setLost(true));
    this.#canvas.addEventListener("webglcontextrestored", () => this.#setLost(false));
    return this.#renderer;
  }

  /** @param {boolean} lost */
  #setLost(lost) {
    this.#lost = lost;
    if (lost) {
      this.materials.forget();
      this.#blur?.dispose();
    }
    for (const entry of this.#entries.values()) {
      entry.dirty = true;
      if (lost) entry.view.contextLost();
      else entry.view.contextRestored();
    }
    if (!lost) this.#schedule();
  }

  /** @param {IntersectionObserverEntry[]} changes */
  #look(changes) {
    for (const { target, isIntersecting } of changes) {
      for (const entry of this.#entries.values()) if (entry.view.canvas === target) entry.seen = isIntersecting;
    }
    this.#schedule();
  }
}

/** A canvas that is on no page. */
function newCanvas() {
  return typeof OffscreenCanvas === "undefined" ? document.createElement("canvas") : new OffscreenCanvas(4, 4);
}
