/**
 * A figure in a cell of a notebook, as a view of a widget: its point is the widget's `time` and `params`, both ways.
 *
 * The view asks the kernel for itself; what the widget keeps is small JSON, which other widgets may be linked to.
 */

import { baked } from "../transports/baked.js";
import { comm } from "../transports/comm.js";
import { make } from "../ui/elements.js";
import { pageStyles } from "../ui/page-styles.js";
import { define } from "./figures.js";

/**
 * @typedef {import("../ui/figure-element.js").FigureElement} FigureElement
 *
 * @typedef {object} Model what a notebook gives to a view: as anywidget has it
 * @property {(name: string) => any} get
 * @property {(name: string, value: any) => void} set
 * @property {() => void} save_changes
 * @property {(event: string, listener: (...values: any[]) => void) => void} on
 * @property {(event: string, listener: (...values: any[]) => void) => void} off
 * @property {(message: any) => void} send
 */

/**
 * Show a widget. It is seen as soon as it has a picture; until then, and where there is no kernel, what the notebook
 * keeps of the figure is seen, if there is something.
 * @param {{model: Model, el: HTMLElement}} view
 * @returns {() => void} what ends it
 */
export function widget({ model, el }) {
  define();
  el.dataset.lmSuppressShortcuts = "true"; // keys belong to the figure while it has the focus
  const { shadow, figure } = framed();
  const hidden = make("style", {}, [`[data-r4d-poster="${model.get("_poster")}"] { display: none !important; }`]);
  const seen = (/** @type {boolean} */ isSeen) => shadow.style.setProperty("display", isSeen ? "" : "none");
  seen(false);
  el.append(shadow);
  const connect = () => comm(portOf(model), { onReopen: reopen });
  const reopen = () => {
    figure.stay();
    figure.transport = connect();
  };
  const { isSame, take } = synced(model, figure);
  const given = () => { if (figure.reader && !isSame()) take(); };
  figure.addEventListener("r4d-live", () => {
    if (!isSame()) take();
    figure.reader?.on("point", () => give(model, figure));
  });
  figure.addEventListener("r4d-commit", () => {
    if (hidden.isConnected) return;
    el.append(hidden);
    seen(true);
  });
  figure.addEventListener("r4d-failed", () => seen(hidden.isConnected || !isKept(el, model.get("_poster"))));
  model.on("change:time", given);
  model.on("change:params", given);
  figure.transport = connect();
  return () => {
    model.off("change:time", given);
    model.off("change:params", given);
    const transport = figure.transport;
    figure.remove();
    transport?.close();
    hidden.remove();
  };
}

/**
 * Bring to life what a notebook keeps of a figure: its picture stays until the first one is drawn.
 * @param {{place: HTMLElement, data: import("../core/types.js").PageData}} kept
 */
export function keepsake({ place, data }) {
  define();
  const { shadow, figure } = framed();
  const image = place.querySelector("img");
  place.insertBefore(shadow, image);
  if (image) figure.append(image);
  figure.transport = baked(data);
}

/** A figure, in a root of its own so that a notebook's styles stay outside. */
function framed() {
  const shadow = make("div", { class: "r4d-cell" });
  const figure = /** @type {FigureElement} */ (document.createElement("r4d-figure"));
  const root = shadow.attachShadow({ mode: "open" });
  root.append(make("style", {}, [pageStyles]), figure);
  return { shadow, figure };
}

/** @param {Model} model @returns {import("../transports/comm.js").Port} */
function portOf(model) {
  return {
    send: (message) => model.send(message),
    listen: (listener) => {
      const heard = (/** @type {any} */ message, /** @type {any[]} */ buffers) => listener(message, buffers ?? []);
      model.on("msg:custom", heard);
      return () => model.off("msg:custom", heard);
    },
  };
}

/** How a figure takes its point from a widget. @param {Model} model @param {FigureElement} figure */
function synced(model, figure) {
  const isSame = () => {
    const point = figure.reader?.point;
    return point === undefined || (point.time === model.get("time") && isEqual(point.parameters, model.get("params")));
  };
  const take = () => {
    const known = new Set(figure.reader?.manifest.parameters.map(({ name }) => name));
    const given = Object.entries(model.get("params") ?? {}).filter(([name]) => known.has(name));
    figure.reader?.change({ time: model.get("time"), parameters: Object.fromEntries(given) }, { gesture: "kernel" });
  };
  return { isSame, take };
}

/** Let a widget know where its reader is. @param {Model} model @param {FigureElement} figure */
function give(model, figure) {
  const point = figure.reader?.point;
  if (point === undefined) return;
  const isOther = point.time !== model.get("time") || !isEqual(point.parameters, model.get("params"));
  if (!isOther) return;
  model.set("time", point.time);
  model.set("params", { ...point.parameters });
  model.save_changes();
}

/** @param {any} a @param {any} b */
function isEqual(a, b) {
  return JSON.stringify(sorted(a)) === JSON.stringify(sorted(b));
}

/** @param {any} value */
function sorted(value) {
  return Object.entries(value ?? {}).sort(([a], [b]) => (a < b ? -1 : 1));
}

/** Whether a picture stands for the figure. @param {HTMLElement} el @param {string} name */
function isKept(el, name) {
  const places = /** @type {NodeListOf<HTMLElement>} */ (el.ownerDocument.querySelectorAll("[data-r4d-poster]"));
  return [...places].some((place) => place.dataset.r4dPoster === name && place.childElementCount > 0);
}
