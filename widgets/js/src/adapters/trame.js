/**
 * Figures that ask a server: those of a page that `serve` made, and those in somebody's own trame application.
 *
 * Nothing of a reader enters the state that all clients of trame share: each figure has a socket of its own.
 */

import { socket } from "../transports/socket.js";
import { edited, figuresOf } from "./figures.js";

/** @typedef {import("../ui/figure-element.js").FigureElement} FigureElement */

/**
 * Where a figure asks, from where its page is.
 * @param {string} base
 * @param {string} name
 * @param {"live" | "copy"} [way] the model that all share, or a private copy
 */
export function lineOf(base, name, way = "live") {
  const address = new URL(`${way}/${encodeURIComponent(name)}`, base);
  address.protocol = address.protocol.replace("http", "ws");
  address.hash = "";
  return address.href;
}

/**
 * Bring a figure to life. If the model gets other objects or parameters, it opens again at its point.
 * @param {FigureElement} figure
 * @param {string} address of its socket
 */
export function connect(figure, address) {
  const onReopen = () => {
    figure.stay();
    connect(figure, address);
  };
  figure.transport = socket(address, { onReopen });
}

/**
 * Bring all figures of a page to life that a server answers.
 * @param {Document} page
 * @returns {FigureElement[]} in the order of the page
 */
export function serve(page) {
  const figures = figuresOf(page);
  for (const figure of figures) {
    const share = () => connect(figure, lineOf(page.baseURI, figure.name));
    share();
    edited(page, figure, { share, copy: lineOf(page.baseURI, figure.name, "copy") });
  }
  return figures;
}
