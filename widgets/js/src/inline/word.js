/** `<r4d-word node="bob">the bob</r4d-word>`: marks an object while it is pointed at, has the focus, or was tapped. */

import { make, setAll } from "../ui/elements.js";
import { InlineElement } from "./finding.js";

let count = 0;

export class WordElement extends InlineElement {
  #who = `word ${++count}`;
  #kept = false;

  /** @override */
  build() {
    this.#kept = false;
    const word = make("span", { class: "word", role: "button", tabindex: 0, "aria-pressed": "false" }, [make("slot")], {
      pointerenter: (event) => { if (event.pointerType !== "touch") this.#mark(true); },
      pointerleave: (event) => { if (event.pointerType !== "touch") this.#mark(this.#kept); },
      focus: () => { if (word.matches(":focus-visible")) this.#mark(true); },
      blur: () => this.#mark(this.#kept),
      click: () => this.#keep(word, !this.#kept),
      keydown: (event) => {
        if (event.key === "Escape") this.#keep(word, false);
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        this.#keep(word, !this.#kept);
      },
    });
    return word;
  }

  /** @override */
  disconnectedCallback() {
    this.#mark(false);
    super.disconnectedCallback();
  }

  /** @param {HTMLElement} word @param {boolean} kept */
  #keep(word, kept) {
    this.#kept = kept;
    setAll(word, { "aria-pressed": String(kept) });
    this.#mark(kept);
  }

  /** @param {boolean} on */
  #mark(on) {
    this.figure?.life?.mark(this.#who, on ? this.getAttribute("node") : null);
  }
}
