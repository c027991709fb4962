/** `<r4d-either live="this machine">the machine that made this page</r4d-either>`: words for each way to answer. */

import { make } from "../ui/elements.js";
import { InlineElement } from "./finding.js";

export class EitherElement extends InlineElement {
  /** @override */
  build() {
    return this.figure?.dataset.state === "live" ? make("span", {}, [this.getAttribute("live") ?? ""]) : null;
  }
}
