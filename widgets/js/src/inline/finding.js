/** Which figure an element in the prose belongs to. */

import { FigureElement } from "../ui/figure-element.js";
import { ElementBase } from "../ui/bases.js";
import { make } from "../ui/elements.js";
import { inlineStyles } from "../ui/inline-styles.js";

/**
 * The figure of that name; without a name the nearest before the element, else the first of the same root.
 * @param {Element} element
 * @param {string} name "" is none
 * @returns {FigureElement | null}
 */
export function findFigure(element, name) {
  const root = /** @type {Document | ShadowRoot} */ (element.getRootNode());
  if (!("querySelectorAll" in root)) return null;
  const figures = [...root.querySelectorAll("r4d-figure")].filter((figure) => figure instanceof FigureElement);
  if (name) return figures.find((figure) => figure.name === name) ?? null;
  const before = figures.filter((f) => f.compareDocumentPosition(element) & Node.DOCUMENT_POSITION_FOLLOWING);
  return before.at(-1) ?? figures[0] ?? null;
}

/**
 * An element in the prose: as long as its figure is not found or does not live, it shows the text that it came with.
 */
export class InlineElement extends ElementBase {
  /** @type {FigureElement | null} */ figure = null;
  /** @type {AbortController | null} */ #attached = null;
  /** @type {AbortController | null} */ #listening = null;
  #root;

  constructor() {
    super();
    this.#root = this.attachShadow({ mode: "open" });
    this.#root.append(make("style", {}, [inlineStyles]), make("slot"));
  }

  connectedCallback() {
    this.#attached = new AbortController();
    const { signal } = this.#attached;
    const root = this.getRootNode();
    for (const name of ["r4d-live", "r4d-failed"]) root.addEventListener(name, () => this.#find(), { signal });
    this.#find();
  }

  disconnectedCallback() {
    this.#attached?.abort();
    this.#listening?.abort();
    this.figure = null;
  }

  #find() {
    const found = findFigure(this, this.getAttribute("figure") ?? "");
    const figure = found?.reader ? found : null;
    if (figure === this.figure && (figure === null || figure.reader === this.reader)) return;
    this.#listening?.abort();
    this.figure = figure;
    this.reader = figure?.reader ?? null;
    const body = figure ? this.build() : null;
    this.show(body ?? make("slot"));
    if (!figure || !body) return;
    this.#listening = new AbortController();
    const { signal } = this.#listening;
    figure.addEventListener("r4d-point", () => this.update(), { signal });
    figure.addEventListener("r4d-commit", () => this.update(), { signal });
    this.update();
  }

  /** @type {import("../ui/readers.js").Reader | null} */ reader = null;

  /** Put something in place of the text that it came with. @param {Node} body */
  show(body) {
    this.#root.replaceChildren(this.#root.children[0], body);
  }

  /** What is shown once the figure lives; null: the text that it came with. @returns {Node | null} */
  build() {
    return null;
  }

  /** The figure shows something else. */
  update() {
    // an element that only acts has nothing to renew
  }
}
