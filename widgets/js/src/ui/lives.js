/** A figure that lives: session, clock, picture, player, controls and handles, wired together. */

import { carried, extentsOf, ORIGIN } from "./anchors.js";
import { Cells } from "./cells.js";
import { Controls } from "./controls.js";
import { make, reducedMotion, setAll, setText } from "./elements.js";
import { timeText } from "./formats.js";
import { Handles } from "./handles.js";
import { Menu } from "./menu.js";
import { KEYS, Picture } from "./picture.js";
import { Player } from "./player.js";
import { Reader } from "./readers.js";
import { Remote } from "./remotes.js";
import { Announcer, parameterTexts, pictureText } from "./speech.js";

/**
 * @typedef {import("../core/types.js").Manifest} Manifest
 * @typedef {import("../core/types.js").Eye} Eye
 * @typedef {import("../core/types.js").Options} Options
 * @typedef {import("../core/types.js").Parameters} Parameters
 * @typedef {import("../core/types.js").Snapshot} Snapshot
 * @typedef {import("./picture.js").Hit} Hit
 *
 * @typedef {object} Parts what a life is made of, ready made
 * @property {import("../core/session.js").Session} session open
 * @property {import("../core/clock.js").Clock} clock
 * @property {(canvas: HTMLCanvasElement, manifest: Manifest) => import("../render/views.js").View | null} view
 * @property {((wish: import("../core/types.js").Wish) => Promise<Uint8Array>) | null} [draw] who draws, if not we
 * @property {() => Promise<string | null>} copy a link to where the reader is
 * @property {(name: string) => void} tell the page of an event
 */

const UNSEEN = ["camera", "light", "group"];
const STILL = "This browser draws no pictures in three dimensions here (WebGL\u00a02 is needed); this one is a still.";
const LOST = "The picture was taken away by the browser; it comes back as soon as it can.";

export class Life {
  /** @type {Snapshot | null} */ snapshot = null;
  /** @type {(() => void)[]} */ #off = [];
  /** @type {Map<string, string>} */ #marks = new Map();
  /** @type {Hit | null} */ #selected = null;
  /** @type {Parameters | null} */ #parameters = null;
  #stripped = 0;
  /** @type {ReturnType<typeof setTimeout> | null} */ #stripper = null;
  #described = 0;
  #drawn = false;
  /** @type {Remote | null} */ #remote = null;
  #parts;

  /** @param {Parts} parts @param {HTMLElement} spoken the live region */
  constructor(parts, spoken) {
    this.#parts = parts;
    const { session, clock } = parts;
    this.manifest = session.manifest;
    this.reader = new Reader(this.manifest, session, clock);
    this.announcer = new Announcer((text) => setText(spoken, text));
    this.picture = new Picture({
      toggle: () => this.player.turn(),
      step: (direction) => this.player.step(direction),
      pick: (x, y) => this.view?.pick(x, y) ?? null,
      select: (hit) => this.select(hit),
      camera: () => this.reader.change({ camera: null }),
    });
    this.view = parts.view(this.picture.canvas, this.manifest);
    this.menu = this.#menu();
    this.player = new Player(this.reader, this.menu.toggle);
    this.controls = new Controls(this.reader);
    this.handles = new Handles(this.reader, {
      matrix: (node, parameters) => this.#matrix(node, parameters),
      extents: (node) => this.#extents(node),
      project: (p) => this.view?.project(p) ?? { x: 0, y: 0, depth: NaN },
      learn: (node, others) => this.#learn(node, others),
    });
    this.picture.over.append(this.handles.element);
    this.cells = this.manifest.cells && new Cells(this.manifest, this.manifest.cells);
    this.element = make("div", { class: "life", "data-cells": this.cells !== null }, [
      this.picture.element,
      make("div", { class: "bar" }, [this.player.element, this.menu.panel]),
      this.controls.element,
      this.cells && this.cells.element,
    ]);
    this.#listen();
  }

  #menu() {
    const objects = this.manifest.nodes.filter(({ kind }) => !UNSEEN.includes(kind.toLowerCase()));
    return new Menu(this.manifest.options, objects.map(({ name }) => name), {
      draw: (options) => this.draw(options),
      camera: () => this.reader.change({ camera: null }),
      undo: () => this.reader.undo(),
      redo: () => this.reader.redo(),
      reset: () => this.reader.reset(),
      copy: this.#parts.copy,
      full: () => { this.full(); },
      find: (name) => this.find(name),
    });
  }

  #listen() {
    const { reader, view } = this;
    const { session } = this.#parts;
    this.#off.push(
      session.on("commit", (snapshot) => this.#show(snapshot)),
      session.on("wait", (waiting) => { this.picture.wait(waiting); this.#strip(false); }),
      session.on("stale", () => this.#strip(true)),
      session.on("problem", (problem) => this.picture.fail([problem])),
      reader.on("point", () => this.#moved()),
      reader.on("playing", () => this.#plays()),
      reader.on("history", () => this.#menuNow()),
      reader.on("camera", () => { this.#menuNow(); this.handles.place(); this.#parts.tell("r4d-point"); }),
      reader.on("acted", () => this.announcer.say(() => this.#said())),
    );
    if (view) {
      reader.watch({
        own: () => /** @type {Eye | null} */ (view.own),
        look: (eye) => { if (eye) view.camera = eye; else view.follow(true); },
      });
      this.#off.push(
        view.on("camera", () => {
          reader.looked();
          this.handles.place();
          this.#menuNow();
          this.#label();
          this.#remote?.want();
        }),
        view.on("hover", (hit) => { if (!this.#selected) this.picture.hover(hit); }),
        view.on("lost", () => {
          if (!this.#elsewhere()) this.picture.live(false, this.#drawn ? LOST : STILL);
        }),
        view.on("restored", () => {
          if (this.manifest.pictures !== "always") this.#here();
          if (this.snapshot) this.#draw();
        }),
      );
    } else this.picture.live(false, STILL);
    const sizes = new ResizeObserver(() => {
      this.handles.place();
      this.#label();
      this.#remote?.want(true);
    });
    sizes.observe(this.picture.element);
    this.#off.push(() => sizes.disconnect());
  }

  /** @param {Snapshot} snapshot */
  #show(snapshot) {
    const first = this.snapshot === null;
    this.snapshot = snapshot;
    this.view?.show(snapshot);
    this.#remote?.want(!this.reader.isPlaying());
    if (first) this.#unveil();
    this.picture.fail(snapshot.problems);
    this.cells?.show(snapshot);
    this.handles.place();
    this.#label();
    this.#strip(false);
    this.#describe(first);
    this.#parts.tell("r4d-commit");
  }

  /** The poster stays until the picture comes into view and is drawn for the first time. */
  #unveil() {
    const seen = new IntersectionObserver((entries) => {
      if (!entries.some((entry) => entry.isIntersecting) || !this.view) return;
      seen.disconnect();
      this.#draw();
    }, { rootMargin: "80px" });
    seen.observe(this.picture.element);
    this.#off.push(() => seen.disconnect());
  }

  /** Now, and finely. @returns {boolean} whether there is something to draw with */
  #draw() {
    if (this.#remote || (this.manifest.pictures === "always" && this.#elsewhere())) return true;
    if (!this.view?.render()) return this.#elsewhere();
    this.#drawn = true;
    this.picture.live(true);
    return true;
  }

  /** Let the server draw, if it does. @returns {boolean} whether it does */
  #elsewhere() {
    const { draw, session } = this.#parts;
    if (this.manifest.pictures === "never" || !draw || !this.view) return false;
    if (this.#remote) return true;
    const point = () => ({ time: session.point.time, parameters: { ...session.point.parameters } });
    const tell = (/** @type {boolean} */ drawn, /** @type {string} */ problem) => this.picture.live(drawn, problem);
    this.#remote = new Remote({ draw, view: this.view, point, tell });
    this.picture.canvas.after(this.#remote.element);
    this.#remote.want(true);
    return true;
  }

  /** Draw here again. */
  #here() {
    this.#remote?.dispose();
    this.#remote = null;
  }

  /** How many pictures were drawn elsewhere. */
  get remote() {
    return this.#remote?.count ?? 0;
  }

  #moved() {
    this.player.show();
    const { parameters } = this.#parts.session.point;
    if (parameters !== this.#parameters) this.controls.show(); // the same object while only time moves
    this.#parameters = parameters;
    this.handles.place();
    this.#parts.tell("r4d-point");
  }

  #plays() {
    this.player.plays();
    this.controls.plays();
    this.#describe(true);
  }

  #menuNow() {
    const own = Boolean(this.view?.own);
    this.menu.show({ canUndo: this.reader.canUndo, canRedo: this.reader.canRedo, own });
    this.picture.back.hidden = !own;
  }

  /** The text of the picture, at most once a second while it plays. @param {boolean} now */
  #describe(now) {
    const at = performance.now();
    if (!this.snapshot || (!now && this.reader.isPlaying() && at - this.#described < 1000)) return;
    this.#described = at;
    this.picture.describe(pictureText(this.manifest, this.snapshot));
  }

  /** What is said after the reader acted. */
  #said() {
    const { time, parameters } = this.reader.point;
    if (this.snapshot) this.#describe(true);
    return [timeText(time), ...parameterTexts(this.manifest, parameters)].join(", ");
  }

  /** At once, or at most four times a second: who drags shall not wait for it. @param {boolean} now */
  #strip(now) {
    const at = performance.now();
    if (!now && at - this.#stripped < 250) {
      this.#stripper ??= setTimeout(() => this.#strip(true), 250);
      return;
    }
    if (this.#stripper !== null) clearTimeout(this.#stripper);
    this.#stripper = null;
    this.#stripped = at;
    const { start, stop } = this.manifest.times;
    this.player.strip(this.#parts.session.spans(start, stop));
  }

  /**
   * How a node stands in the world: at the reader's point as it is shown if nothing better is known, elsewhere as the
   * session knows it; null if it is not shown, or not known.
   * @param {string} node
   * @param {Parameters} parameters
   * @returns {ArrayLike<number> | null}
   */
  #matrix(node, parameters) {
    const { session } = this.#parts;
    const shown = this.snapshot?.nodes.get(node);
    if (shown && !shown.visible) return null;
    const value = session.evaluate(`${node}#matrix`, session.point.time, parameters);
    if (value) return /** @type {ArrayLike<number>} */ (value);
    return parameters === session.point.parameters ? shown?.matrix ?? null : null;
  }

  /** @param {string} node */
  #extents(node) {
    const points = this.snapshot?.nodes.get(node)?.points;
    return points ? extentsOf(points.a.array) : null;
  }

  /** Where a node's origin is in the world. @param {string} node */
  #where(node) {
    const matrix = this.#matrix(node, this.reader.session.point.parameters);
    return matrix && carried(matrix, ORIGIN);
  }

  /** Ask where a node stands for other parameters. @param {string} node @param {Parameters[]} others */
  #learn(node, others) {
    this.#parts.session.learn([`${node}#matrix`], others.map((parameters) => ({ parameters })));
  }

  /** @param {Hit | null} hit */
  select(hit) {
    this.#selected = hit;
    this.menu.find.value = hit?.name ?? "";
    this.mark("selection", hit?.name ?? null);
    this.picture.hover(hit);
    if (hit) this.announcer.say(() => hit.name);
  }

  /** An object by its name. @param {string | null} name */
  find(name) {
    const at = name === null ? null : this.#where(name);
    this.select(name === null || !at ? null : { name, position: at, ...this.view?.project(at) });
    if (name !== null && !at) this.mark("selection", name);
  }

  /** The label of what is chosen goes with it. */
  #label() {
    if (!this.#selected) return;
    const { name } = this.#selected;
    const at = this.#where(name);
    const spot = at && this.view?.project(at);
    if (at && spot && spot.depth <= 1) this.picture.hover({ name, position: at, x: spot.x, y: spot.y });
    else this.picture.hover(null);
  }

  /** Who marks which object; the last one who does is seen. @param {string} who @param {string | null} name */
  mark(who, name) {
    this.#marks.delete(who);
    if (name !== null) this.#marks.set(who, name);
    this.view?.highlight([...this.#marks.values()].at(-1) ?? null);
  }

  /** @param {Partial<Options>} options */
  draw(options) {
    if (options.theme) this.#parts.tell(`theme ${options.theme}`);
    const { theme: _theme, ...rest } = options;
    if (this.view) this.view.options = rest;
    this.#remote?.want(true);
  }

  /** @param {"light" | "dark"} theme */
  paint(theme) {
    this.picture.element.dataset.theme = theme;
    if (this.view) this.view.options = { theme };
    this.#remote?.want(true);
  }

  async full() {
    if (document.fullscreenElement) await document.exitFullscreen();
    else await this.element.requestFullscreen?.();
  }

  /** The page opens playing, if it is told to and the reader does not mind motion. */
  open() {
    this.#menuNow();
    const { player, reader } = this;
    if (this.manifest.options.autoplay && !player.idle && !reducedMotion()) reader.play(player.main);
    setAll(this.picture.canvas, { "aria-description": KEYS });
  }

  /** Share the point of another figure: its player moves both. @param {Life} leader */
  follow(leader) {
    this.reader.follow(leader.reader);
    const own = new Controls(this.reader, (name) => leader.reader.parameter(name) !== null);
    this.controls.element.replaceWith(own.element);
    this.controls = own;
    this.#parameters = null;
    this.element.toggleAttribute("data-follows", true);
    this.#moved();
  }

  /** @param {boolean} printing */
  print(printing) {
    if (!printing) this.picture.print(null);
    else if (this.#remote) this.picture.print(this.#remote.element.src);
    else if (this.snapshot && this.#draw()) this.picture.print(this.picture.canvas.toDataURL("image/png"));
  }

  dispose() {
    this.#here();
    for (const off of this.#off) off();
    this.announcer.dispose();
    this.cells?.dispose();
    this.picture.dispose();
    this.menu.dispose();
    this.reader.dispose();
    this.view?.dispose();
    this.#parts.session.close();
  }
}
