/** The picture of a figure: the canvas, its poster, what is written over it, and what pointer and keys do to it. */

import { button, make, setAll, setText } from "./elements.js";
import { positionText } from "./formats.js";
import { icon } from "./icons.js";

/**
 * @typedef {{ name: string, position: number[], x?: number, y?: number }} Hit
 * @typedef {import("../core/types.js").Problem} Problem
 *
 * @typedef {object} PictureActions
 * @property {() => void} toggle play or pause
 * @property {(direction: 1 | -1) => void} step
 * @property {(x: number, y: number) => Hit | null} pick
 * @property {(hit: Hit | null) => void} select
 * @property {() => void} camera back to the scene's
 */

export const KEYS = "Arrow keys turn the view, plus and minus zoom, Space plays, comma and full stop go from mark"
  + " to mark.";

/** Errors, as sentences: where and why. @param {readonly Problem[]} problems */
export function problemTexts(problems) {
  return problems.map(({ channel, text }) => {
    if (channel === "") return text;
    const at = channel.lastIndexOf("#");
    const [node, what] = at < 0 ? ["", channel] : [channel.slice(0, at), channel.slice(at + 1)];
    const subject = node ? `${node} is not shown: its ${what}` : `${what.replace(/^values\./, "")} is not known: it`;
    return `${subject} cannot be computed here. ${text}`;
  });
}

export class Picture {
  /** @type {ReturnType<typeof setTimeout> | undefined} */ #busy;

  /** @param {PictureActions} actions */
  constructor(actions) {
    this.canvas = make("canvas", { role: "img", tabindex: 0, "aria-keyshortcuts": "Space , ." });
    this.label = make("div", { class: "hover", hidden: true, "aria-hidden": "true" });
    this.back = button("Back to the scene\u2019s camera", icon("camera"), actions.camera, { hidden: true });
    this.back.className = "icon-button back";
    this.problems = make("ul", { class: "problems", hidden: true });
    this.note = make("p", { class: "message", hidden: true });
    this.waiting = make("p", { class: "waiting", hidden: true }, ["computing …"]);
    this.over = make("div", { class: "over" });
    this.still = make("img", { class: "still", alt: "" });
    this.element = make("div", { class: "picture" }, [
      make("slot"), this.still, this.canvas, this.over, this.label,
      make("div", { class: "notes" }, [this.problems, this.note, this.waiting]), this.back,
    ]);
    this.#listen(actions);
  }

  /** @param {PictureActions} actions */
  #listen(actions) {
    const { canvas } = this;
    let from = [NaN, NaN];
    canvas.addEventListener("pointerdown", (event) => { from = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", (event) => {
      if (event.button !== 0 || !(Math.hypot(event.clientX - from[0], event.clientY - from[1]) < 5)) return;
      const box = canvas.getBoundingClientRect();
      const hit = actions.pick(event.clientX - box.left, event.clientY - box.top);
      actions.select(hit && { ...hit, x: event.clientX - box.left, y: event.clientY - box.top });
    });
    canvas.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.key === " ") actions.toggle();
      else if (event.key === ",") actions.step(-1);
      else if (event.key === ".") actions.step(1);
      else if (event.key === "Escape") actions.select(null);
      else return;
      event.preventDefault();
    });
  }

  /** The poster is hidden while the picture lives. @param {boolean} live @param {string} [message] */
  live(live, message = "") {
    this.element.toggleAttribute("data-live", live);
    setText(this.note, message);
    this.note.hidden = message === "";
  }

  /** @param {string} text */
  describe(text) {
    setAll(this.canvas, { "aria-label": text });
  }

  /** Name and position of what the pointer is over, or what was chosen. @param {Hit | null} hit */
  hover(hit) {
    this.label.hidden = hit === null;
    if (!hit) return;
    this.label.replaceChildren(make("b", {}, [hit.name]), ` ${positionText(hit.position)}`);
    const { clientWidth, clientHeight } = this.element;
    const x = Math.min(Math.max(hit.x ?? 0, 8), clientWidth - 8);
    const y = Math.min(Math.max(hit.y ?? 0, 8), clientHeight - 8);
    this.label.style.translate = `${x.toFixed(0)}px ${y.toFixed(0)}px`;
    this.label.toggleAttribute("data-left", x > clientWidth / 2);
    this.label.toggleAttribute("data-below", y < 48);
  }

  /** @param {readonly Problem[]} problems */
  fail(problems) {
    const texts = problemTexts(problems);
    this.problems.hidden = texts.length === 0;
    if (texts.join() === [...this.problems.children].map((li) => li.textContent).join()) return;
    this.problems.replaceChildren(...texts.map((text) => make("li", {}, [text])));
  }

  /** Short waits are not worth a word. @param {boolean} waiting */
  wait(waiting) {
    clearTimeout(this.#busy);
    setAll(this.element, { "aria-busy": waiting ? "true" : null });
    if (waiting) this.#busy = setTimeout(() => { this.waiting.hidden = false; }, 300);
    else this.waiting.hidden = true;
  }

  /** Before printing: the picture as it is now, as an image. @param {string | null} source */
  print(source) {
    if (source) this.still.src = source;
    else this.still.removeAttribute("src");
    this.element.toggleAttribute("data-still", source !== null);
  }

  dispose() {
    clearTimeout(this.#busy);
  }
}
