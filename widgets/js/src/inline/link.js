/** `<r4d-link point="t=1.2&length=1.5">text</r4d-link>`: takes its figure to a point; the back button returns. */

import { make, reducedMotion } from "../ui/elements.js";
import { InlineElement } from "./finding.js";

export class LinkElement extends InlineElement {
  /** @override */
  build() {
    const figure = /** @type {import("../ui/figure-element.js").FigureElement} */ (this.figure);
    const point = (this.getAttribute("point") ?? "").replace(/^#/, "");
    const prefixed = point.split("&").filter(Boolean)
      .map((piece) => (piece.startsWith(`${figure.name}.`) ? piece : `${figure.name}.${piece}`));
    return make("a", { href: `#${prefixed.join("&")}` }, [make("slot")], {
      click: (event) => {
        if (event.button !== 0 || event.ctrlKey || event.metaKey || event.shiftKey || event.altKey) return;
        event.preventDefault();
        figure.visit(point);
        figure.scrollIntoView({ block: "nearest", behavior: reducedMotion() ? "auto" : "smooth" });
      },
    });
  }
}
