/** `<r4d-check name="solved"></r4d-check>`: says whether a value holds: an exercise is done, or not yet. */

import { make, setText } from "../ui/elements.js";
import { InlineElement } from "./finding.js";

const OPEN = "Not yet.";
const DONE = "That is it.";

export class CheckElement extends InlineElement {
  /** @type {HTMLElement | null} */ #text = null;
  /** @type {HTMLElement | null} */ #face = null;

  /** @override */
  build() {
    const name = this.getAttribute("name") ?? "";
    if (!this.reader?.manifest.values.some((value) => value.name === name)) return null;
    const mark = make("span", { class: "mark", "aria-hidden": "true" });
    this.#text = make("span", { role: "status" });
    this.#face = make("span", { class: "check" }, [mark, this.#text]);
    return this.#face;
  }

  /** @override */
  update() {
    const value = this.figure?.snapshot?.values.get(this.getAttribute("name") ?? "");
    const done = value === true || value === 1;
    if (!this.#face || !this.#text) return;
    this.#face.toggleAttribute("data-done", done);
    setText(this.#text, done ? DONE : OPEN);
  }
}
