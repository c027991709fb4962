/** The figures of a page: what all adapters do with them, whoever answers. */

import { CheckElement } from "../inline/check.js";
import { EitherElement } from "../inline/either.js";
import { LinkElement } from "../inline/link.js";
import { NumberElement } from "../inline/number.js";
import { WordElement } from "../inline/word.js";
import { FigureElement } from "../ui/figure-element.js";
import { ScriptElement } from "../ui/script-element.js";
import { Addresses } from "./addresses.js";
import { editable } from "./copies.js";

const ELEMENTS = /** @type {const} */ ([
  ["r4d-figure", FigureElement],
  ["r4d-check", CheckElement],
  ["r4d-either", EitherElement],
  ["r4d-number", NumberElement],
  ["r4d-link", LinkElement],
  ["r4d-word", WordElement],
]);

/** Make the elements known to the browser; those that are known already stay. */
export function define() {
  for (const [name, element] of ELEMENTS) if (!customElements.get(name)) customElements.define(name, element);
}

/** The figures of a page, in its order; each opens at the point that the address names. @param {Document} page */
export function figuresOf(page) {
  define();
  const figures = () => /** @type {FigureElement[]} */ ([...page.querySelectorAll("r4d-figure")]);
  const addresses = new Addresses(page.defaultView ?? window, figures);
  for (const figure of figures()) {
    figure.addresses = addresses;
    figure.addEventListener("r4d-live", () => addresses.open(figure), { once: true });
  }
  return figures();
}

/**
 * Let a reader edit the script of a figure, if the page has one for it.
 * @param {Document} page
 * @param {FigureElement} figure
 * @param {import("./copies.js").Places} places
 */
export function edited(page, figure, places) {
  const scripts = /** @type {ScriptElement[]} */ ([...page.querySelectorAll("r4d-script")]);
  const element = scripts.find((one) => one.getAttribute("figure") === figure.name);
  if (!element) return;
  if (!customElements.get("r4d-script")) customElements.define("r4d-script", ScriptElement);
  editable(figure, element, places);
}
