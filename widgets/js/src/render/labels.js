/** Labels as live text: elements above the picture, put where their anchors are seen. */
import { linear } from "./fits.js";
import { contrast, luminance, THEMES } from "./themes.js";
import { thin } from "./thinning.js";

/** @typedef {import("./themes.js").Theme} Theme */
/** @typedef {{x: number, y: number, depth: number}} Place CSS pixels; the depth is from -1 to 1 in front of the eye */
/**
 * @typedef {object} Label
 * @property {string} name
 * @property {string} text
 * @property {number[]} at in the world
 * @property {number} height of a line, CSS pixels
 * @property {readonly number[]} color sRGB and alpha
 * @property {readonly number[]} turn how it is turned on the screen: xx, xy, yx, yy
 * @property {number} priority
 * @property {boolean} hidden behind something
 */

/** @typedef {{label: Label, element: HTMLElement, shown: boolean, css: string}} Look */
/** @typedef {Look & {width: number, height: number, measured: boolean}} Entry */

const READABLE = 3;
/** The width of a letter, of its height. */
const GUESS = 0.55;
const LAYER = "position:absolute;inset:0;overflow:hidden;pointer-events:none;contain:strict";
const TEXT =
  "position:absolute;left:0;top:0;white-space:nowrap;line-height:1.2;transform-origin:0 0;transition:opacity .12s;";

/** The labels of one figure. */
export class LabelLayer {
  /** @type {Map<string, Entry>} */
  #entries = new Map();
  #canvas;
  #theme = THEMES.light;

  /** @param {HTMLCanvasElement} canvas the layer lies right above it */
  constructor(canvas) {
    this.#canvas = canvas;
    this.element = canvas.ownerDocument.createElement("div");
    this.element.className = "r4d-labels";
    this.element.setAttribute("aria-hidden", "true");
    this.element.style.cssText = LAYER;
    canvas.after(this.element);
    const parent = canvas.parentElement;
    if (parent !== null && getComputedStyle(parent).position === "static") parent.style.position = "relative";
  }

  /** @returns {Iterable<Label>} */
  get labels() {
    return [...this.#entries.values()].map((entry) => entry.label);
  }

  /** @param {Theme} theme whose paper makes a halo round the letters */
  set theme(theme) {
    this.#theme = theme;
  }

  /** @param {Label} label a new one, or the new state of an old one */
  set(label) {
    const old = this.#entries.get(label.name);
    if (old !== undefined) {
      if (old.label.text !== label.text || old.label.height !== label.height) old.css = "";
      old.label = { ...label, hidden: old.label.hidden };
      return;
    }
    const element = this.#canvas.ownerDocument.createElement("div");
    element.className = "r4d-label";
    this.element.append(element);
    this.#entries.set(label.name, { label, element, width: 0, height: 0, measured: false, shown: false, css: "" });
  }

  /** @param {string} name */
  delete(name) {
    this.#entries.get(name)?.element.remove();
    this.#entries.delete(name);
  }

  /**
   * Put the labels where they are seen, and leave out what does not fit.
   * @param {(at: number[]) => Place} project
   * @param {{width: number, height: number}} size of the picture
   */
  place(project, { width, height }) {
    const { offsetLeft, offsetTop } = this.#canvas;
    this.element.style.inset = `${offsetTop}px auto auto ${offsetLeft}px`;
    this.element.style.width = `${width}px`;
    this.element.style.height = `${height}px`;
    const placed = [];
    for (const entry of this.#entries.values()) {
      this.#dress(entry);
      const { x, y, depth } = project(entry.label.at);
      const ahead = depth >= -1 && depth <= 1 && x >= 0 && x <= width && y >= 0 && y <= height;
      const { priority, hidden, text } = entry.label;
      if (ahead && !hidden && text !== "") {
        placed.push({ entry, x, y, width: entry.width, height: entry.height, priority, shown: entry.shown });
      } else show(entry, false);
    }
    const kept = new Set(thin(placed));
    for (const label of placed) {
      const { entry, x, y } = label;
      const [a, c, b, d] = entry.label.turn;
      const turned = `matrix(${a},${-b},${-c},${d},0,0)`;
      const place = `translate(${x.toFixed(2)}px,${y.toFixed(2)}px)`;
      entry.element.style.transform = `${place} ${turned} translate(-50%,-50%)`;
      show(entry, kept.has(label));
    }
  }

  /**
   * Write the labels that are shown into a picture.
   * @param {CanvasRenderingContext2D} context
   * @param {(at: number[]) => Place} project
   * @param {number} ratio pixels per CSS pixel
   */
  draw(context, project, ratio) {
    for (const { label, element, shown } of this.#entries.values()) {
      if (!shown) continue;
      const { x, y } = project(label.at);
      const style = getComputedStyle(element);
      context.save();
      context.scale(ratio, ratio);
      context.translate(x, y);
      const [a, c, b, d] = label.turn;
      context.transform(a, -b, -c, d, 0, 0);
      context.font = `${style.fontStyle} ${label.height}px ${style.fontFamily}`;
      context.textAlign = "center";
      context.textBaseline = "middle";
      context.lineWidth = 3;
      context.lineJoin = "round";
      context.strokeStyle = this.#theme.paper;
      context.strokeText(label.text, 0, 0);
      context.fillStyle = style.color;
      context.fillText(label.text, 0, 0);
      context.restore();
    }
  }

  /** Take the layer away. */
  dispose() {
    this.element.remove();
    this.#entries.clear();
  }

  /** @param {Entry} entry */
  #dress(entry) {
    const { element, label } = entry;
    const look = `color:${readable(label.color, this.#theme)};text-shadow:${halo(this.#theme.paper)};`;
    const css = `${TEXT}font-size:${label.height}px;${look}`;
    if (entry.css !== css) {
      entry.css = css;
      element.textContent = label.text;
      element.style.cssText = css;
      element.style.opacity = entry.shown ? "1" : "0";
      entry.measured = false;
    }
    if (entry.measured) return;
    // What is on no screen has no size; then a guess must do until it is.
    const width = element.offsetWidth;
    entry.measured = width > 0;
    entry.width = entry.measured ? width : GUESS * label.height * label.text.length;
    entry.height = entry.measured ? element.offsetHeight : label.height;
  }
}

/** @type {(entry: Entry, shown: boolean) => void} */
function show(entry, shown) {
  if (entry.shown === shown) return;
  entry.shown = shown;
  entry.element.style.opacity = shown ? "1" : "0";
}

/**
 * A label's colour, or the theme's if nobody could read it.
 * @param {readonly number[]} color
 * @param {Theme} theme
 */
function readable(color, theme) {
  const light = luminance(color.slice(0, 3).map(linear));
  if (contrast(light, theme.dark ? 0.01 : 1) < READABLE) return theme.text;
  return `rgb(${color.slice(0, 3).map((c) => Math.round(255 * c)).join(" ")} / ${color[3]})`;
}

/** @type {(paper: string) => string} */
function halo(paper) {
  return ["-1px -1px", "1px -1px", "-1px 1px", "1px 1px", "0 0"]
    .map((at, k) => `${at} ${k === 4 ? "4px" : "1px"} ${paper}`)
    .join(",");
}
