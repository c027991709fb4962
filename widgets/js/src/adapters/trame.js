/**
 * Figures that ask a server: those of a page that `serve` made, and those in somebody's own trame application.
 *
 * Nothing of a reader enters the state that all clients of trame share: each figure has a socket of its own.
 */

import { socket } from "../transports/socket.js";
import { ScriptElement } from "../ui/script-element.js";
import { Addresses } from "./addresses.js";
import { editable } from "./copies.js";
import { define } from "./page.js";

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
    const point = figure.write();
    if (point) figure.setAttribute("point", point);
    figure.transport = socket(address, { onReopen });
  };
  figure.transport = socket(address, { onReopen });
}

/**
 * Bring all figures of a page to life that a server answers.
 * @param {Document} page
 * @returns {FigureElement[]} in the order of the page
 */
export function serve(page) {
  define();
  const figures = () => /** @type {FigureElement[]} */ ([...page.querySelectorAll("r4d-figure")]);
  const addresses = new Addresses(page.defaultView ?? window, figures);
  for (const figure of figures()) {
    figure.addresses = addresses;
    figure.addEventListener("r4d-live", () => addresses.open(figure), { once: true });
    connect(figure, lineOf(page.baseURI, figure.name));
  }
  if (!customElements.get("r4d-script")) customElements.define("r4d-script", ScriptElement);
  for (const element of /** @type {NodeListOf<ScriptElement>} */ (page.querySelectorAll("r4d-script"))) {
    const figure = figures().find(({ name }) => name === element.getAttribute("figure"));
    if (figure === undefined) continue;
    const share = () => connect(figure, lineOf(page.baseURI, figure.name));
    editable(figure, element, { copy: lineOf(page.baseURI, figure.name, "copy"), share });
  }
  return figures();
}
