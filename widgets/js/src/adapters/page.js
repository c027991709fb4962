/** A page that needs no server: reads the data it carries, and brings its figures to life. */

import { baked } from "../transports/baked.js";
import { figuresOf } from "./figures.js";

/** @typedef {import("../ui/figure-element.js").FigureElement} FigureElement */

/**
 * Bring all figures of a document to life. A figure that cannot be shown says so in its place; the rest goes on.
 * @param {Document} page
 * @returns {FigureElement[]} in the order of the page
 */
export function start(page) {
  const figures = figuresOf(page);
  for (const figure of figures) {
    try {
      figure.transport = baked(dataOf(page, figure));
    } catch (error) {
      figure.refuse(error);
    }
  }
  return figures;
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
