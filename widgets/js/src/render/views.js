/** One figure's view: a snapshot, an eye, hands, and a canvas that shows the picture. */
import { Emitter } from "../core/emitters.js";
import { Gestures } from "./gestures.js";
import { LabelLayer } from "./labels.js";
import { Navigator } from "./navigators.js";
import { Pace } from "./paces.js";
import { Picture } from "./pictures.js";
import { Sheet } from "./sheets.js";
import { THEMES } from "./themes.js";

/** @typedef {import("three").WebGLRenderer} WebGLRenderer */
/** @typedef {import("../core/types.js").Manifest} Manifest */
/** @typedef {import("../core/types.js").Snapshot} Snapshot */
/** @typedef {import("./orbits.js").Eye} Eye */
/** @typedef {import("./contents.js").Hit} Hit */
/** @typedef {import("./pictures.js").PictureLooks} PictureLooks */
/** @typedef {import("./stages.js").Stage} Stage */
/** @typedef {"auto"|"light"|"dark"} Surroundings */
/** @typedef {PictureLooks & {theme: Surroundings, hover: boolean}} ViewOptions `hover`: mark what is pointed at */

/** Drawn pixels per pixel of the screen, along an edge, when nothing moves: on a common screen, and on a dense one. */
const FINE = 2;
const FINE_DENSE = 1.5;
const MOST_PIXELS = 6e6;
/** Milliseconds after which one looks again what moves under a pointer that rests. */
const GLANCE = 120;

/** A figure's view. */
export class View {
  pace = new Pace();
  #stage;
  /** @type {Emitter<Record<string, any>>} */
  #events = new Emitter();
  #picture;
  #labels;
  #gestures;
  #navigator;
  /** @type {ViewOptions} */
  #options;
  /** @type {Snapshot|null} */
  #snapshot = null;
  #stale = true;
  #turned = true;
  /** whether the canvas's size is known until somebody tells of another; to ask for it lays out the page */
  #isMeasured = false;
  #sheet;
  #observer;
  #dark = matchMedia("(prefers-color-scheme: dark)");
  #still = matchMedia("(prefers-reduced-motion: reduce)");
  /** @type {string|null} */
  #highlight = null;
  /** @type {Hit|null} */
  #hit = null;
  /** @type {{x: number, y: number}|null} where to look for what is pointed at, with the next frame */
  #pointer = null;
  #glanced = 0;
  #end = new AbortController();

  /**
   * @param {Stage} stage the page's
   * @param {HTMLCanvasElement} canvas where the picture goes; its size on the page is a matter of style
   * @param {Manifest} manifest
   */
  constructor(stage, canvas, manifest) {
    const { shading, edges, ground, axes, grid, shadows, theme } = manifest.options;
    this.#stage = stage;
    this.canvas = canvas;
    this.#sheet = new Sheet(canvas);
    this.#options = { shading, edges, ground, axes, grid, shadows, theme, hover: true };
    this.#labels = new LabelLayer(canvas);
    this.#picture = new Picture(stage.materials, this.#labels, manifest.bounds, this.#theme);
    this.#navigator = new Navigator(manifest.view, this.#picture.home);
    this.#gestures = this.#hands();
    stage.add(this);
    this.#restyle();
    this.#dark.addEventListener("change", () => this.#restyle(), { signal: this.#end.signal });
    this.#observer = typeof ResizeObserver === "undefined" ? null : new ResizeObserver(() => this.resize());
    this.#observer?.observe(canvas);
  }

  /**
   * Listen to "camera" (the camera as it is now), "hover" (what is pointed at, or null), "lost", "restored".
   * @param {string} name
   * @param {(payload: any) => void} f
   * @returns {() => void} ends it
   */
  on(name, f) {
    return this.#events.on(name, f);
  }

  /** How the picture is drawn. @returns {ViewOptions} */
  get options() {
    return { ...this.#options };
  }

  /** @param {Partial<ViewOptions>} options all or some */
  set options(options) {
    this.#options = { ...this.#options, ...options };
    if (!this.#options.hover) this.#point(null);
    this.#restyle();
  }

  /** In which surroundings the picture is. @returns {"light"|"dark"} */
  get theme() {
    const { theme } = this.#options;
    return theme === "auto" ? (this.#dark.matches ? "dark" : "light") : theme;
  }

  /** How many draw batches the meshes make. */
  get batches() {
    return this.#ready().contents.batches;
  }

  /** How many triangles the meshes have. */
  get triangles() {
    return this.#ready().contents.triangles;
  }

  /** The eye in use, and whether it is the reader's own. @returns {Eye & {own: boolean}} */
  get camera() {
    this.#ready();
    const { position, target, up, fov } = this.#navigator.eye(performance.now());
    return { position: [...position], target: [...target], up: [...up], fov, own: this.#navigator.own !== null };
  }

  /** @param {Partial<Eye>|"scene"|null} eye the reader's; "scene" or null: follow the scene's camera */
  set camera(eye) {
    this.#ready();
    this.#navigator.own = eye === "scene" ? null : eye;
    this.#looked();
  }

  /** The reader's own eye, or null if they follow the scene. */
  get own() {
    return this.#navigator.own;
  }

  /**
   * Show a snapshot. Costs what changed since the last, and nothing while the figure is out of view.
   * @param {Snapshot} snapshot
   */
  show(snapshot) {
    if (snapshot === this.#snapshot) return;
    this.#snapshot = snapshot;
    this.#stale = true;
    this.#stage.invalidate(this);
  }

  /**
   * Draw now; answers whether there was a context to draw with.
   * @param {boolean} [sharp] finely, as what stands still; else as what moves
   */
  render(sharp = true) {
    return this.#stage.draw(this, sharp);
  }

  /** Look at the canvas's size anew. */
  resize() {
    this.#isMeasured = false;
    this.#stage.invalidate(this, true);
  }

  /**
   * Follow the scene's camera again, smoothly unless the reader wants no motion; or keep the eye where it is.
   * @param {boolean} on
   */
  follow(on) {
    this.#ready();
    const now = performance.now();
    if (on) this.#navigator.back(now, !this.#still.matches);
    else this.#navigator.take(now);
    this.#looked();
  }

  /**
   * What is at a place of the picture.
   * @param {number} x CSS pixels from the upper left corner
   * @param {number} y
   * @returns {Hit|null}
   */
  pick(x, y) {
    return this.#aimed().pick(this.#navigator.eye(performance.now()), x, y);
  }

  /** Mark a node, or all members of a group; null: none. @param {string|null} name */
  highlight(name) {
    this.#highlight = name;
    this.#mark();
  }

  /**
   * Where a place of the world is seen.
   * @param {readonly number[]} p
   */
  project(p) {
    return this.#aimed().project(p);
  }

  /**
   * The line of sight through a place of the picture.
   * @param {number} x CSS pixels
   * @param {number} y
   */
  ray(x, y) {
    return this.#aimed().ray(this.#navigator.eye(performance.now()), x, y);
  }

  /** The picture with its labels on the theme's paper, as PNG. @returns {Promise<Blob>} */
  async toBlob() {
    this.render();
    const { width, height } = this.canvas;
    const copy = document.createElement("canvas");
    copy.width = width;
    copy.height = height;
    const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext("2d"));
    context.fillStyle = this.#theme.paper;
    context.fillRect(0, 0, width, height);
    context.drawImage(this.canvas, 0, 0);
    this.#labels.draw(context, (at) => this.#picture.project(at), width / this.#picture.size.width);
    return new Promise((resolve, reject) => {
      copy.toBlob((blob) => (blob === null ? reject(new Error("the picture has no size")) : resolve(blob)));
    });
  }

  /** Free everything. */
  dispose() {
    this.#end.abort();
    this.#stage.remove(this);
    this.#observer?.disconnect();
    this.#gestures.dispose();
    this.#picture.dispose();
    this.#labels.dispose();
    this.#events.clear();
  }

  /** The stage's: there is nothing to draw with any more. */
  contextLost() {
    this.#picture.forget();
    this.#events.emit("lost", null);
  }

  /** The stage's: there is again. */
  contextRestored() {
    this.#events.emit("restored", null);
  }

  /**
   * The stage's: draw into its renderer, and copy it here.
   * @param {WebGLRenderer} renderer
   * @param {import("./floors.js").Blur} blur
   * @param {boolean} sharp
   */
  paint(renderer, blur, sharp) {
    const ratio = Math.min(4, devicePixelRatio || 1);
    const picture = this.#aimed();
    const eye = this.#navigator.eye(performance.now());
    const wide = Math.max(1, Math.round(picture.size.width * ratio));
    const high = Math.max(1, Math.round(picture.size.height * ratio));
    const fine = Math.min(ratio >= 2 ? FINE_DENSE : FINE, Math.sqrt(MOST_PIXELS / (wide * high)));
    const { step, rest } = this.pace;
    const scaling = Math.min(fine, sharp ? rest : step.scale);
    const width = Math.max(1, Math.round(wide * scaling));
    const height = Math.max(1, Math.round(high * scaling));
    const density = width / picture.size.width;
    const care = sharp ? { shadows: true, skips: 0 } : step;
    picture.draw(renderer, blur, { width, height, density, ...care });
    this.#sheet.show(renderer.domElement, wide, high);
    picture.letter(eye, sharp);
    if (sharp || performance.now() - this.#glanced > GLANCE) this.#look();
    if (this.#navigator.gliding) this.#looked();
  }

  get #theme() {
    return THEMES[this.theme];
  }

  #restyle() {
    this.#turned = true;
    this.#picture.restyle(this.#options, this.#theme);
    this.#stage.invalidate(this, true);
  }

  /** The picture of what is to be shown. */
  #ready() {
    if (this.#stale && this.#snapshot !== null) {
      this.#stale = false;
      this.#picture.contents.show(this.#snapshot);
      this.#navigator.follow(this.#snapshot);
      this.#turned = true;
    }
    return this.#picture;
  }

  /** The same, looked at as it is to be looked at now. */
  #aimed() {
    const picture = this.#ready();
    if (!this.#isMeasured) this.#measure(picture);
    if (!this.#turned && !this.#navigator.gliding) return picture;
    this.#turned = false;
    picture.aim(this.#navigator.eye(performance.now()), this.#navigator);
    return picture;
  }

  /** @param {Picture} picture */
  #measure({ size }) {
    const width = Math.max(1, this.canvas.clientWidth);
    const height = Math.max(1, this.canvas.clientHeight);
    this.#isMeasured = this.#observer !== null && width > 1;
    if (width === size.width && height === size.height) return;
    size.width = width;
    size.height = height;
    this.#turned = true;
  }

  #looked() {
    this.#turned = true;
    this.#stage.invalidate(this);
    this.#events.emit("camera", this.camera);
  }

  #mark() {
    if (this.#ready().contents.mark(this.#highlight, this.#hit?.name ?? null)) this.#stage.invalidate(this, true);
  }

  /** Look what is pointed at. */
  #look() {
    if (this.#pointer === null || this.#gestures.busy) return;
    this.#glanced = performance.now();
    const { x, y } = this.#pointer;
    const hit = this.pick(x, y);
    this.#point(hit === null ? null : { ...hit, x, y });
  }

  /** @param {(Hit & {x: number, y: number})|null} hit */
  #point(hit) {
    if (hit === null) this.#pointer = null;
    if (hit === null && this.#hit === null) return;
    this.#hit = hit;
    this.#mark();
    this.#events.emit("hover", hit);
  }

  #hands() {
    const now = () => performance.now();
    /** @type {(act: () => void) => void} */
    const move = (act) => {
      this.#ready();
      act();
      this.#looked();
    };
    const { size } = this.#picture;
    return new Gestures(this.canvas, {
      orbit: (right, down) =>
        move(() => this.#navigator.orbit(now(), (-right / size.height) * 3.6, (down / size.height) * 3.6)),
      pan: (right, down) => move(() => this.#navigator.pan(now(), -right / size.height, down / size.height)),
      dolly: (factor, x, y) => move(() => this.#navigator.dolly(now(), factor, this.ray(x, y).direction)),
      turn: (right, up) => move(() => this.#navigator.orbit(now(), right, up)),
      shift: (right, up) => move(() => this.#navigator.pan(now(), right, up)),
      zoom: (factor) => move(() => this.#navigator.dolly(now(), factor, null)),
      home: () => this.follow(true),
      hover: (x, y) => {
        if (!this.#options.hover) return;
        const waiting = this.#pointer !== null;
        this.#pointer = { x, y };
        if (!waiting) requestAnimationFrame(() => this.#look());
      },
      leave: () => this.#point(null),
      rest: () => this.#stage.invalidate(this),
    });
  }
}
