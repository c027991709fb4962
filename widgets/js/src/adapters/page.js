/** A page that needs no server: reads the data it carries, and brings its figures to life. */

import { baked } from "../transports/baked.js";
import { FigureElement } from "../ui/figure-element.js";
import { CheckElement } from "../inline/check.js";
import { EitherElement } from "../inline/either.js";
import { LinkElement } from "../inline/link.js";
import { NumberElement } from "../inline/number.js";
import { WordElement } from "../inline/word.js";
import { Addresses } from "./addresses.js";

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

/**
 * Bring all figures of a document to life. A figure that cannot be shown says so in its place; the rest goes on.
 * @param {Document} page
 * @returns {FigureElement[]} in the order of the page
 */
export function start(page) {
  define();
  const figures = () => /** @type {FigureElement[]} */ ([...page.querySelectorAll("r4d-figure")]);
  const addresses = new Addresses(page.defaultView ?? window, figures);
  for (const figure of figures()) {
    figure.addresses = addresses;
    figure.addEventListener("r4d-live", () => addresses.open(figure));
    try {
      figure.transport = baked(dataOf(page, figure));
    } catch (error) {
      figure.fail(`This figure cannot be shown. ${error instanceof Error ? error.message : error}`);
    }
  }
  return figures();
}

/**
 * What the page carries of a figure, from the script `r4d-data-NAME`; a second figure names the first as its `source`.
 * @param {Document} page
 * @param {FigureElement} figure
 * @returns {import("../core/types.js").PageData}
 */
function dataOf(page, figure) {
  const name = figure.getAttribute("source") || figure.getAttribute("name") || "";
  const script = page.getElementById(`r4d-data-${name}`);
  if (!script) throw new Error(`The page holds no data named \u201c${name}\u201d.`);
  try {
    return JSON.parse(script.textContent ?? "");
  } catch {
    throw new Error(`The page's data named \u201c${name}\u201d are damaged.`);
  }
}
