/** Cells at work: boxes and arrows beside the picture, and what was done with each for the picture on show. */

import { make, setAll, setText } from "./elements.js";

/**
 * @typedef {import("../core/types.js").Cells} Chart
 * @typedef {import("../core/types.js").Manifest} Manifest
 * @typedef {import("../core/types.js").Snapshot} Snapshot
 * @typedef {Pick<Snapshot, "time" | "parameters" | "cells">} Moment
 */

/** By the letter: the colour it has, the word on the box, and what that means.
 * @type {Readonly<Record<string, readonly [string, string, string]>>} */
export const WORDS = Object.freeze({
  e: ["fresh", "evaluated", "its rule ran"],
  r: ["known", "reused", "answered from memory"],
  "-": ["idle", "not asked", "nobody needed it"],
  x: ["edited", "edited", "set to something else"],
  m: ["fresh", "evaluated anew", "marked by the edit; its rule ran"],
  c: ["same", "cut off", "marked; its rule ran, and said the same: who asks it need not run"],
  k: ["known", "still right", "marked, looked at, and not run: what it asks says what it said"],
  q: ["marked", "marked", "by the edit; nobody has asked since"],
});
const USUAL = "er-";
const CALM = 600; // ms
const RECORDED = "Recorded when this page was made, as";

const [HIGH, ROW, GAP, EDGE] = [36, 66, 12, 3];
const SVG = "http://www.w3.org/2000/svg";

/**
 * Which of the records is of what the reader did: the one in which the same parameters were moved, else the least that
 * moved them all; that of time if none was moved, or nothing was recorded of it.
 * @param {Chart} chart @param {Moment} now @param {Moment | null} before
 */
export function recordOf({ moves }, now, before) {
  if (moves === null || before === null) return 0;
  const moved = Object.keys(now.parameters).filter((name) => (
    JSON.stringify(now.parameters[name]) !== JSON.stringify(before.parameters[name])
  ));
  if (moved.length === 0) return 0;
  const fit = moves.filter((names) => moved.every((name) => names.includes(name)))
    .sort((a, b) => a.length - b.length);
  return moves.indexOf(fit[0]) + 1;
}

/** What was done, as a sentence for each word. @param {Chart} chart @param {string} letters */
export function told({ boxes }, letters) {
  return Object.entries(WORDS).flatMap(([letter, [, word]]) => {
    const names = boxes.filter((_box, i) => letters[i] === letter).map(({ name }) => name);
    return names.length ? [`${word[0].toUpperCase()}${word.slice(1)}: ${names.join(", ")}.`] : [];
  }).join(" ");
}

export class Cells {
  /** @type {Moment | null} */ #before = null;
  /** @type {ReturnType<typeof setTimeout> | undefined} */ #calmer;
  #shown = "";
  #record = 0;
  /** @type {{ box: SVGElement, word: SVGElement }[]} */ #boxes;
  #seen = new Set(USUAL);

  /** @param {Manifest} manifest @param {Chart} chart */
  constructor(manifest, chart) {
    this.manifest = manifest;
    this.chart = chart;
    const wide = Math.max(86, ...chart.boxes.map(({ name }) => 16 + 7 * name.length));
    const unit = wide + GAP;
    const [columns, rows] = [0, 1].map((axis) => Math.max(0, ...chart.boxes.map(({ at }) => at[axis])));
    const ends = chart.arrows.flatMap(({ via }) => via.map(([x]) => x + 0.1));
    const size = [Math.max(columns + 0.5, ...ends) * unit - GAP + 2 * EDGE, rows * ROW + HIGH + 2 * EDGE];
    const place = (/** @type {readonly number[]} */ [x, y]) => [x * unit - GAP / 2 + EDGE, y * ROW + EDGE];
    this.#boxes = chart.boxes.map(({ name, at }) => {
      const [x, y] = place(at);
      const word = svg("text", { x, y: y + 29, class: "word" });
      const label = svg("text", { x, y: y + 15 }, name);
      const plate = svg("rect", { x: x - wide / 2, y, width: wide, height: HIGH, rx: 5 });
      return { box: svg("g", { class: "box" }, plate, label, word), word };
    });
    this.drawing = svg("svg", {
      viewBox: `0 0 ${size.map((n) => n.toFixed(1)).join(" ")}`, role: "img", "aria-description": asked(chart),
    }, ...arrows(chart, place), ...this.#boxes.map(({ box }) => box));
    this.drawing.style.maxWidth = `${(size[0] * 1.15).toFixed(0)}px`;
    this.legend = make("dl", { class: "legend" });
    this.told = make("p", { class: "told" });
    this.element = make("div", { class: "cells", role: "group", "aria-label": "Who asks whom" }, [
      make("p", { class: "head" }, ["Who asks whom"]),
      this.told, this.drawing, this.legend,
    ]);
    this.#explain();
  }

  /** @param {Moment} snapshot */
  show(snapshot) {
    const { parameters, time, cells } = snapshot;
    if (!this.#before || parameters !== this.#before.parameters || time !== this.#before.time) {
      this.#record = recordOf(this.chart, snapshot, this.#before);
    }
    this.#before = snapshot;
    const letters = cells[this.#record] ?? "";
    if (letters !== this.#shown) this.#change(letters);
    this.#boxes.forEach(({ box }, i) => setAll(box, { "data-lit": !"-q".includes(letters[i] ?? "-") }));
    setText(this.told, this.#source());
    clearTimeout(this.#calmer);
    this.#calmer = setTimeout(() => this.#calm(), CALM);
  }

  /** @param {string} letters */
  #change(letters) {
    const known = this.#seen.size;
    this.#shown = letters;
    this.#boxes.forEach(({ box, word }, i) => {
      const [look, text] = WORDS[letters[i]] ?? ["idle", ""];
      setAll(box, { "data-look": look });
      setText(word, text);
      if (text) this.#seen.add(letters[i]);
    });
    if (this.#seen.size > known) this.#explain();
    if (!this.drawing.hasAttribute("aria-label")) this.#calm();
  }

  /** The boxes glow no more; now there is time to say what was done. */
  #calm() {
    for (const { box } of this.#boxes) setAll(box, { "data-lit": false });
    setAll(this.drawing, { "aria-label": told(this.chart, this.#shown) || "Nothing is known of it." });
  }

  /** Where it is known from. */
  #source() {
    const { moves } = this.chart;
    if (moves === null) return "Live: what was done for this picture just now, for you.";
    const names = moves[this.#record - 1];
    if (!names) return `${RECORDED} time goes on.`;
    const labels = this.manifest.parameters.filter(({ name }) => names.includes(name)).map(({ label }) => label);
    return `${RECORDED} ${labels.join(" and ")} move${labels.length > 1 ? "" : "s"}.`;
  }

  #explain() {
    this.legend.replaceChildren(...[...this.#seen].flatMap((letter) => {
      const [look, word, meaning] = WORDS[letter];
      return [make("dt", { "data-look": look }, [word]), make("dd", {}, [meaning])];
    }));
  }

  dispose() {
    clearTimeout(this.#calmer);
  }
}

/** Who asks whom, for those who do not see it. @param {Chart} chart */
function asked({ boxes, arrows: all }) {
  return boxes.flatMap(({ name }, i) => {
    const names = all.filter(({ to }) => to === i).map(({ from }) => boxes[from].name);
    return names.length ? [`${name} asks ${names.join(", ")}.`] : [];
  }).join(" ");
}

/** The arrows, each from the foot of a box to the head of one that asks it; what comes to one box is spread out there.
 * @param {Chart} chart @param {(at: readonly number[]) => number[]} place */
function arrows({ boxes, arrows: all }, place) {
  return all.map(({ from, to, via }) => {
    const rivals = all.filter((other) => other.to === to)
      .sort((a, b) => (a.via.at(-1) ?? boxes[a.from].at)[0] - (b.via.at(-1) ?? boxes[b.from].at)[0]);
    const aside = rivals.findIndex((other) => other.from === from) - (rivals.length - 1) / 2;
    let [x, y] = place(boxes[from].at);
    y += HIGH;
    let path = `M${x} ${y}`;
    const bend = (/** @type {number} */ toX, /** @type {number} */ toY) => {
      const half = (toY - y) / 2;
      path += `C${x} ${y + half} ${toX} ${toY - half} ${toX} ${toY}`;
      [x, y] = [toX, toY];
    };
    for (const gap of via) {
      const [toX, toY] = place(gap);
      bend(toX, toY);
      y += HIGH;
      path += `V${y}`;
    }
    const [endX, endY] = place(boxes[to].at);
    bend(endX + aside * Math.min(14, 60 / rivals.length), endY - 5);
    return svg("g", { class: "arrow" }, svg("path", { d: path }),
      svg("path", { d: `M${x - 3.5} ${endY - 7}h7l-3.5 7z`, class: "point" }));
  });
}

/** @param {string} tag @param {Record<string, string | number>} attributes @param {(Node | string)[]} children */
function svg(tag, attributes, ...children) {
  const node = document.createElementNS(SVG, tag);
  setAll(node, attributes);
  node.append(...children);
  return /** @type {SVGElement} */ (node);
}
