/** `<r4d-figure name="pendulum" follow="other">`: a picture that a reader drives. Its child is the poster. */

import { Clock } from "../core/clock.js";
import { decode, encode } from "../core/point.js";
import { Session } from "../core/session.js";
import { Stage } from "../render/stages.js";
import { View } from "../render/views.js";
import { ElementBase } from "./bases.js";
import { make, prefers, setAll } from "./elements.js";
import { bareFor } from "./hashes.js";
import { Life } from "./lives.js";
import { figureStyles } from "./figure-styles.js";

/**
 * @typedef {import("../core/types.js").Transport} Transport
 * @typedef {import("../core/types.js").Snapshot} Snapshot
 *
 * @typedef {object} Addresses what a page does with its address; a figure outside of a page has none
 * @property {(figure: FigureElement, text: string) => void} visit
 * @property {(figure: FigureElement) => string} link
 */

/** @type {Stage | null} */
let shared = null;

/** One drawing context for all figures that are given no other. */
function sharedStage() {
  shared ??= new Stage();
  return shared;
}

/**
 * Events, none of which leaves the figure's root: "r4d-live" (it can be asked), "r4d-point" (the reader moved),
 * "r4d-commit" (what is shown changed), "r4d-failed".
 */
export class FigureElement extends ElementBase {
  /** @type {Life | null} */ #life = null;
  /** @type {Transport | null} */ #transport = null;
  #theme = "auto";
  #title = "";
  #turn = 0;
  /** @type {AbortController | null} */ #attached = null;
  #frame = make("div", { class: "figure" });
  #mark = make("p", { class: "mark", id: "mark", hidden: true });
  #spoken = make("div", { class: "spoken", role: "status", "aria-live": "polite" });
  /** @type {Addresses | null} */ addresses = null;
  /** @type {Stage | null} */ stage = null;

  constructor() {
    super();
    const root = this.attachShadow({ mode: "open" });
    this.#fill(make("slot"));
    root.append(make("style", {}, [figureStyles]), this.#frame, this.#spoken);
  }

  /** Who answers. Setting it brings the figure to life, as soon as it is in a document. */
  get transport() {
    return this.#transport;
  }

  set transport(transport) {
    this.#end();
    this.#transport = transport;
    if (this.isConnected) this.#begin();
  }

  /** The parts of a figure that lives; null before, and after a failure. */
  get life() {
    return this.#life;
  }

  get reader() {
    return this.#life?.reader ?? null;
  }

  /** @returns {Snapshot | null} what is shown */
  get snapshot() {
    return this.#life?.snapshot ?? null;
  }

  get name() {
    return this.getAttribute("name") ?? this.#life?.manifest.name ?? "";
  }

  connectedCallback() {
    this.#title = this.getAttribute("title") ?? this.#title;
    this.removeAttribute("title"); // it names the figure; as a tip it would cover the picture
    this.#attached = new AbortController();
    const { signal } = this.#attached;
    this.addEventListener("keydown", (event) => this.#pressed(event), { signal });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#paint(), { signal });
    matchMedia("(prefers-reduced-motion: reduce)").addEventListener("change", (event) => {
      if (event.matches) this.reader?.pause();
    }, { signal });
    addEventListener("beforeprint", () => this.#print(true), { signal });
    addEventListener("afterprint", () => this.#print(false), { signal });
    if (this.#transport && !this.#life) this.#begin();
  }

  disconnectedCallback() {
    this.#attached?.abort();
    queueMicrotask(() => { if (!this.isConnected) this.#end(); }); // a figure that is only moved lives on
  }

  async #begin() {
    const turn = ++this.#turn;
    const transport = /** @type {Transport} */ (this.#transport);
    /** @type {Session | null} */
    let session = null;
    try {
      session = new Session(transport);
      await session.open();
      if (turn !== this.#turn) {
        session.close();
        return;
      }
      this.#live(session);
    } catch (error) {
      if (turn !== this.#turn) return;
      session?.close();
      this.refuse(error);
    }
  }

  /** @param {Session} session */
  #live(session) {
    const { time, parameters } = decode(this.getAttribute("point") ?? "", session.manifest);
    session.set({ time, parameters });
    const clock = new Clock({
      now: () => performance.now() / 1000,
      request: (/** @type {FrameRequestCallback} */ f) => requestAnimationFrame(f),
      cancel: (/** @type {number} */ id) => cancelAnimationFrame(id),
    });
    const stage = this.stage ?? sharedStage();
    this.stage = stage;
    const life = new Life({
      session,
      clock,
      view: (canvas, manifest) => new View(stage, canvas, manifest),
      draw: this.#transport?.picture?.bind(this.#transport) ?? null,
      copy: () => this.#copy(),
      tell: (name) => this.#tell(name),
    }, this.#spoken);
    this.#life = life;
    this.#fill(life.element);
    this.#frame.setAttribute("role", "group");
    this.#frame.setAttribute("aria-label", this.#title || life.manifest.title || this.name);
    const { height, theme } = life.manifest.options;
    if (height) this.style.setProperty("--r4d-height", `${height}px`);
    this.#theme = theme;
    this.#paint();
    life.open();
    this.#follow();
    this.#tell("r4d-live");
  }

  /** @param {string} name */
  #tell(name) {
    if (name.startsWith("theme ")) {
      this.#theme = name.slice(6);
      this.#paint();
    } else this.dispatchEvent(new CustomEvent(name, { bubbles: true }));
  }

  /** Light or dark as the page is, else as the reader's system; the picture as the figure is told, if it is. */
  #paint() {
    const told = this.ownerDocument.documentElement.dataset.theme;
    const dark = told === "dark" || (told !== "light" && prefers("(prefers-color-scheme: dark)"));
    const page = dark ? "dark" : "light";
    this.#frame.dataset.theme = page;
    this.#life?.paint(this.#theme === "dark" || this.#theme === "light" ? this.#theme : page);
  }

  /** Share the point of the figure that `follow` names, once both live. */
  #follow() {
    const name = this.getAttribute("follow");
    const root = /** @type {Document | ShadowRoot} */ (this.getRootNode());
    const life = this.#life;
    if (!name || !life) return;
    const attempt = () => {
      const other = [...root.querySelectorAll("r4d-figure")].find((f) => f.getAttribute("name") === name);
      if (!(other instanceof FigureElement) || other === this || !other.life || life !== this.#life) return false;
      if (!leads(other.life.reader, life.reader)) life.follow(other.life);
      return true;
    };
    if (!attempt()) {
      const waiting = () => { if (attempt()) root.removeEventListener("r4d-live", waiting); };
      root.addEventListener("r4d-live", waiting, { signal: this.#attached?.signal });
    }
  }

  /** @param {boolean} printing */
  #print(printing) {
    if (printing) this.#life?.paint("light");
    this.#life?.print(printing);
    if (!printing) this.#paint();
  }

  /** @param {KeyboardEvent} event */
  #pressed(event) {
    const key = event.key.toLowerCase();
    if (!this.#life || !(event.ctrlKey || event.metaKey) || event.altKey || (key !== "z" && key !== "y")) return;
    event.preventDefault();
    if (key === "y" || event.shiftKey) this.#life.reader.redo();
    else this.#life.reader.undo();
  }

  /** To a point written as in an address, "t=1.2&length=1.5": a step of undo. @param {string} text */
  visit(text) {
    if (!this.#life) return;
    if (this.addresses) this.addresses.visit(this, text);
    else this.reader?.change(this.read(text), { word: "jumped" });
  }

  /** What such a text says, as far as this figure knows it. @param {string} text */
  read(text) {
    const { manifest } = /** @type {Life} */ (this.#life);
    return decode(bareFor(text, this.name, true), manifest);
  }

  /** Where the reader is, as such a text. @param {string} [prefix] */
  write(prefix = "") {
    return this.#life ? encode(this.#life.reader.point, this.#life.manifest, prefix) : "";
  }

  /** Where it opens the next time: where the reader is. */
  stay() {
    const point = this.write();
    if (point) this.setAttribute("point", point);
  }

  /** @returns {Promise<string | null>} null: the link is in the clipboard */
  async #copy() {
    const link = this.addresses?.link(this) ?? `${location.href.split("#")[0]}#${this.write(this.name)}`;
    try {
      await navigator.clipboard.writeText(link);
      return null;
    } catch {
      return link; // without leave to use the clipboard, the reader copies it
    }
  }

  /**
   * Say above the picture that it is another one than that of all others.
   * @param {string} words nothing is said if there are none
   * @param {{ name: string, act: () => void }} [way] a button
   */
  mark(words, way) {
    this.#mark.replaceChildren(make("span", {}, [words]));
    if (way) this.#mark.append(make("button", { type: "button" }, [way.name], { click: way.act }));
    this.#mark.hidden = words === "";
    setAll(this.#frame, { "aria-describedby": words ? "mark" : null });
  }

  /** Put something into the frame, below what is said above it. @param {Node[]} nodes */
  #fill(...nodes) {
    this.#frame.replaceChildren(this.#mark, ...nodes);
  }

  /** @param {unknown} error why it cannot be shown */
  refuse(error) {
    this.fail(`This figure cannot be shown. ${error instanceof Error ? error.message : error}`);
  }

  /** A sentence in place of what does not work; the poster stays. @param {string} sentence */
  fail(sentence) {
    this.#end();
    const text = make("p", { class: "failure", role: "alert" }, [sentence]);
    this.#fill(make("div", { class: "picture" }, [make("slot")]), text);
    this.#tell("r4d-failed");
  }

  #end() {
    this.#turn++;
    this.#life?.dispose();
    this.#life = null;
    this.#fill(make("slot"));
  }
}

/** Whether `reader` follows `other`, directly or through others. */
function leads(/** @type {import("./readers.js").Reader} */ reader, /** @type {unknown} */ other) {
  for (let r = /** @type {typeof reader | null} */ (reader); r; r = r.leader) if (r === other) return true;
  return false;
}
