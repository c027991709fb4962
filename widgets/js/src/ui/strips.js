/** The strip under the scrub slider: where answers are remembered, stale, being computed, or not asked for yet. */

import { make, setAll } from "./elements.js";
import { stepped } from "./formats.js";

/** @typedef {import("../core/types.js").Span} Span */

const WORDS = {
  remembered: "remembered",
  stale: "out of date",
  computing: "being computed",
  missing: "not asked for yet",
};

/**
 * Spans as shares of the whole, neighbours of one state joined, those outside cut away.
 * @param {readonly Span[]} spans
 * @param {number} start
 * @param {number} stop
 */
export function blocks(spans, start, stop) {
  /** @type {(Span & { from: number, to: number })[]} */
  const found = [];
  const length = stop - start;
  if (!(length > 0)) return found;
  for (const span of spans) {
    const [a, b] = [Math.max(span.start, start), Math.min(span.stop, stop)];
    if (!(b > a)) continue;
    const before = found.at(-1);
    if (before && before.state === span.state && a - before.stop < 1e-9 * length) {
      before.stop = b;
      before.to = (b - start) / length;
    } else found.push({ start: a, stop: b, state: span.state, from: (a - start) / length, to: (b - start) / length });
  }
  return found;
}

/**
 * The strip in words: "remembered 0.00 to 3.00 s; being computed 3.00 to 4.00 s".
 * @param {readonly Span[]} spans
 * @param {number} step of the times shown
 */
export function told(spans, step) {
  if (!spans.length) return "nothing remembered yet";
  const at = (/** @type {number} */ t) => stepped(t, { step });
  return spans.map((s) => `${WORDS[s.state]} ${at(s.start)} to ${at(s.stop)}\u202fs`).join("; ");
}

export class Strip {
  #shown = "";
  element = make("div", { class: "strip", role: "img" });

  /** @param {readonly Span[]} spans @param {number} start @param {number} stop @param {number} step */
  show(spans, start, stop, step) {
    const found = blocks(spans, start, stop);
    const key = found.map((b) => `${b.state} ${b.start} ${b.stop}`).join();
    if (key === this.#shown) return;
    this.#shown = key;
    setAll(this.element, { "aria-label": `Answers: ${told(found, step)}` });
    this.element.replaceChildren(...found.map((block) => {
      const piece = make("i", { "data-state": block.state, title: told([block], step) });
      piece.style.setProperty("--from", block.from.toFixed(5));
      piece.style.setProperty("--to", block.to.toFixed(5));
      return piece;
    }));
  }
}
