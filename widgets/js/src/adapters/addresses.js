/** The page's address: opens figures at its point, and takes part in going back and forward. */

import { bareFor, joined, piecesFor } from "../ui/hashes.js";

/**
 * @typedef {import("../ui/figure-element.js").FigureElement} FigureElement
 * @typedef {Record<string, string>} Places by figure: where its reader is, as the text of an address
 */

export class Addresses {
  #window;
  #figures;
  #returned = "";

  /**
   * @param {Window} view
   * @param {() => FigureElement[]} figures of the page, in its order
   */
  constructor(view, figures) {
    this.#window = view;
    this.#figures = figures;
    view.addEventListener("popstate", (event) => {
      const places = event.state?.r4d;
      if (!places || typeof places !== "object") return;
      this.#returned = view.location.href;
      for (const figure of this.#living()) {
        if (typeof places[figure.name] === "string") this.#jump(figure, places[figure.name]);
      }
    });
    view.addEventListener("hashchange", () => {
      const returned = this.#returned === view.location.href;
      this.#returned = "";
      if (!returned) for (const figure of this.#living()) this.open(figure);
    });
  }

  /** The point that the address names, if it names one of this figure. @param {FigureElement} figure */
  open(figure) {
    const { hash } = this.#window.location;
    const bare = this.#figures()[0] === figure;
    if (piecesFor(hash, figure.name, bare).length) this.#jump(figure, bareFor(hash, figure.name, bare));
  }

  /**
   * Go to a point by a step that the browser's back button undoes.
   * @param {FigureElement} figure
   * @param {string} text
   */
  visit(figure, text) {
    const { history, location } = this.#window;
    this.#remember(() => history.replaceState(this.#state(), "", location.href));
    figure.reader?.change(figure.read(text), { word: "jumped" });
    this.#remember(() => history.pushState(this.#state(), "", `#${figure.write(figure.name)}`));
  }

  /** A link to where the reader is in this figure, and in those that they moved. @param {FigureElement} figure */
  link(figure) {
    const moved = this.#living().filter((f) => f === figure || f.reader?.canUndo);
    return this.#window.location.href.split("#")[0] + joined(moved.map((f) => f.write(f.name)));
  }

  #living() {
    return this.#figures().filter((figure) => figure.reader !== null);
  }

  /** @returns {{ r4d: Places }} */
  #state() {
    return { r4d: Object.fromEntries(this.#living().map((figure) => [figure.name, figure.write()])) };
  }

  /** An address says what differs from where the figure opened. @param {FigureElement} figure @param {string} text */
  #jump(figure, text) {
    const { reader } = figure;
    if (!reader) return;
    const { opened } = reader;
    const { time = opened.time, parameters, camera = opened.camera } = figure.read(text);
    reader.jump({ time, parameters: { ...opened.parameters, ...parameters }, camera });
  }

  /** Documents without an address of their own (frames, mails) may have no history: then there is none to keep. */
  #remember(/** @type {() => void} */ act) {
    try {
      act();
    } catch (error) {
      if (!(error instanceof DOMException)) throw error;
    }
  }
}
