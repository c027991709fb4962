/**
 * A site of many pages, opened from the disk or from a server: the data of a figure are classic scripts beside it,
 * which hand them over as a property of their own element. Where a server says that models live behind it, figures ask
 * them, and fall back to their data.
 */

import { baked } from "../transports/baked.js";
import { socket } from "../transports/socket.js";
import { edited, figuresOf } from "./figures.js";
import { lineOf } from "./trame.js";

/**
 * @typedef {import("../ui/figure-element.js").FigureElement} FigureElement
 * @typedef {import("../core/types.js").PageData} PageData
 * @typedef {import("../core/types.js").Transport} Transport
 */

/**
 * Bring the figures of a page to life, those that are seen first before the others. One that cannot be shown says so.
 * @param {Document} page
 * @returns {Promise<void>} when all have been given who answers
 */
export async function site(page) {
  const server = page.querySelector('meta[name="r4d-live"]')?.getAttribute("content");
  const load = loader(page);
  for (const figure of nearest(figuresOf(page))) {
    try {
      const source = new URL(figure.dataset.source ?? "", page.baseURI).href;
      const held = () => dataOf(load, source);
      if (server && figure.dataset.line) {
        const base = new URL(server, page.baseURI).href;
        const share = () => live(figure, lineOf(base, figure.dataset.line ?? ""), held);
        share();
        edited(page, figure, { share, copy: lineOf(base, figure.dataset.line, "copy") });
      } else figure.transport = baked(await held());
    } catch (error) {
      figure.refuse(error);
    }
  }
}

/**
 * Ask a server; if it does not open, the figure has what its page carries.
 * @param {FigureElement} figure
 * @param {string} address
 * @param {() => Promise<PageData>} held
 */
function live(figure, address, held) {
  const onReopen = () => {
    figure.stay();
    live(figure, address, held);
  };
  figure.transport = either(socket(address, { onReopen }), async () => {
    figure.dataset.state = "baked";
    return baked(await held());
  });
  figure.dataset.state = "live";
}

/**
 * The first of two that opens.
 * @param {Transport} first
 * @param {() => Promise<Transport>} second
 * @returns {Transport}
 */
export function either(first, second) {
  let used = first;
  /** @type {(stale: import("../core/types.js").Stale) => void} */
  let listener = () => undefined;
  first.onStale((stale) => listener(stale));
  return {
    open: async () => {
      try {
        return await first.open();
      } catch {
        first.close();
        used = await second();
        used.onStale((stale) => listener(stale));
        return used.open();
      }
    },
    ask: (ask) => used.ask(ask),
    onStale: (told) => { listener = told; },
    dropped: (refs) => used.dropped(refs),
    need: (refs) => used.need(refs),
    close: () => used.close(),
  };
}

/** Those that can be seen first. @param {FigureElement[]} figures */
function nearest(figures) {
  const away = new Map(figures.map((figure) => {
    const { top, bottom } = figure.getBoundingClientRect();
    return [figure, bottom < 0 ? -bottom : Math.max(top - innerHeight, 0)];
  }));
  return figures.sort((a, b) => (away.get(a) ?? 0) - (away.get(b) ?? 0));
}

/**
 * The data of a figure, with its large arrays, which stand in scripts of their own.
 * @param {(address: string) => Promise<any>} load
 * @param {string} source
 * @returns {Promise<PageData>}
 */
async function dataOf(load, source) {
  const data = await load(source);
  const chunks = await Promise.all((data?.chunks ?? []).map((/** @type {any} */ chunk) => (
    typeof chunk?.file === "string" ? load(new URL(chunk.file, source).href) : chunk
  )));
  return { ...data, chunks };
}

/** Loads scripts, each once. @param {Document} page @returns {(address: string) => Promise<any>} */
function loader(page) {
  /** @type {Map<string, Promise<any>>} */
  const loading = new Map();
  return (address) => {
    const known = loading.get(address);
    if (known) return known;
    const script = /** @type {HTMLScriptElement & { data?: any }} */ (page.createElement("script"));
    const loaded = new Promise((resolve, reject) => {
      script.onload = () => {
        script.remove();
        if (script.data) resolve(script.data);
        else reject(new Error("Its data are damaged."));
      };
      script.onerror = () => reject(new Error("Its data are missing."));
    });
    loading.set(address, loaded);
    script.src = address;
    page.head.append(script);
    return loaded;
  };
}
