/**
 * Pictures that a server draws, where the browser cannot, or the scene is too large to be sent. The reader's hands, the
 * clock and the controls are those of every figure; for where they are now one picture at a time is asked for, coarsely
 * while something moves and finely when it has come to rest, so a drag ends on its last value.
 */

import { make } from "./elements.js";

/**
 * @typedef {import("../core/types.js").Wish} Wish
 * @typedef {import("../render/views.js").View} View
 *
 * @typedef {object} Sources
 * @property {(wish: Wish) => Promise<Uint8Array>} draw who draws, as JPEG
 * @property {View} view whose camera it is, and whose canvas is covered
 * @property {() => {time: number, parameters: Record<string, any>}} point where the reader is
 * @property {(drawn: boolean, problem: string) => void} tell whether there is a picture, and what is wrong
 */

const REST = 220; // ms after the last motion until a fine picture is asked for
const PACE = 40; // ms between two pictures
const COARSE = 0.5;
const MOST_RATIO = 2;

/** One figure's pictures from elsewhere. */
export class Remote {
  element = make("img", { class: "remote", alt: "", "aria-hidden": "true", draggable: "false" });
  #sources;
  #isBusy = false;
  #isWanted = false;
  #isSharp = true;
  #isClosed = false;
  /** @type {ReturnType<typeof setTimeout> | undefined} */ #timer;
  #url = "";
  /** How many pictures were shown. */
  count = 0;

  /** @param {Sources} sources */
  constructor(sources) {
    this.#sources = sources;
  }

  /**
   * Something is to be seen otherwise.
   * @param {boolean} [sharp] it changed once, and does not move
   */
  want(sharp = false) {
    this.#isWanted = true;
    this.#isSharp = sharp;
    if (!this.#isBusy) this.#go();
  }

  dispose() {
    this.#isClosed = true;
    clearTimeout(this.#timer);
    if (this.#url) URL.revokeObjectURL(this.#url);
    this.element.remove();
  }

  async #go() {
    clearTimeout(this.#timer);
    const sharp = this.#isSharp;
    this.#isWanted = false;
    this.#isBusy = true;
    try {
      await this.#show(await this.#sources.draw(this.#wish(sharp)));
      if (!this.#isClosed) this.#sources.tell(true, "");
    } catch (error) {
      if (!this.#isClosed) this.#sources.tell(this.count > 0, error instanceof Error ? error.message : String(error));
    }
    if (this.#isClosed) return;
    this.#timer = setTimeout(() => {
      this.#isBusy = false;
      if (this.#isWanted) this.#go();
      else if (!sharp) this.#timer = setTimeout(() => this.want(true), REST - PACE);
    }, PACE);
  }

  /** @param {boolean} sharp @returns {Wish} */
  #wish(sharp) {
    const { view, point } = this.#sources;
    const { position, target, up, fov } = view.camera;
    const { edges, shadows } = view.options;
    const ratio = Math.min(MOST_RATIO, devicePixelRatio || 1) * (sharp ? 1 : COARSE);
    const { clientWidth, clientHeight } = view.canvas;
    const size = [clientWidth, clientHeight].map((side) => Math.max(1, Math.round(side * ratio)));
    return { ...point(), camera: { position, target, up, fov }, size, theme: view.theme, edges, shadows, sharp };
  }

  /** @param {Uint8Array} data */
  async #show(data) {
    if (this.#isClosed) return;
    const url = URL.createObjectURL(new Blob([/** @type {any} */ (data)], { type: "image/jpeg" }));
    const before = this.#url;
    this.element.src = url;
    this.#url = url;
    try {
      await this.element.decode();
    } finally {
      if (before) URL.revokeObjectURL(before);
    }
    this.count += 1;
  }
}
