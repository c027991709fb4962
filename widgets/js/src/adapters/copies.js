/**
 * Private copies: a reader edits the script of a figure and sees what becomes of it; all others see what they saw.
 *
 * The text goes to a worker of the server, over a connection of its own; as long as it answers, the figure asks it
 * instead of the shared model. Whenever it ends, the figure asks the shared model again, at the reader's point.
 */

import { socket } from "../transports/socket.js";

/**
 * @typedef {import("../ui/figure-element.js").FigureElement} FigureElement
 * @typedef {import("../ui/script-element.js").ScriptElement} ScriptElement
 * @typedef {import("../core/types.js").Transport} Transport
 * @typedef {import("../transports/socket.js").Line} Line
 *
 * @typedef {object} Places
 * @property {string} copy the address of the socket of copies
 * @property {() => void} share makes the figure ask the shared model
 * @property {(address: string, options: import("../transports/socket.js").Options) => Line} [connect]
 */

const BUSY = "Your copy is being made.";
const STILL = "The figure still shows what it showed.";
const KEPT = "The figure shows what all see; your text is still here.";

/**
 * Let a reader edit a figure.
 * @param {FigureElement} figure
 * @param {ScriptElement} element
 * @param {Places} places
 */
export function editable(figure, element, places) {
  const copies = new Copies(figure, element, places);
  element.addEventListener("r4d-run", (event) => { void copies.run(/** @type {CustomEvent} */ (event).detail); });
  element.addEventListener("r4d-reset", () => copies.reset());
  return copies;
}

class Copies {
  #figure;
  #element;
  #places;
  /** @type {Line | null} */ #line = null;
  /** What the figure asks just now, if it is a copy. @type {Transport | null} */ #held = null;
  #turn = 0;

  /** @param {FigureElement} figure @param {ScriptElement} element @param {Places} places */
  constructor(figure, element, places) {
    this.#figure = figure;
    this.#element = element;
    this.#places = places;
  }

  /** Show what a script says. @param {string} text */
  async run(text) {
    const turn = ++this.#turn;
    const had = this.#line;
    this.#element.show({ own: had !== null, busy: true, note: BUSY });
    const line = had ?? this.#dial();
    try {
      const problems = await line.edit(text);
      if (turn !== this.#turn) {
        if (line !== this.#line) line.close();
        return;
      }
      if (problems.length) {
        if (had === null) line.close();
        this.#element.show({ own: had !== null, note: STILL, problems });
        return;
      }
      this.#line = line;
      this.#take(line);
      this.#element.show({ own: true });
    } catch (error) {
      if (turn !== this.#turn) return; // it was told by then
      if (line !== this.#line) line.close();
      this.#element.show({ own: this.#line !== null, note: `${message(error)}. ${this.#line ? STILL : KEPT}` });
    }
  }

  /** Back to what all see. */
  reset() {
    this.#turn++;
    this.#leave();
    this.#element.show({ own: false });
  }

  #dial() {
    /** @type {Line} */
    const line = (this.#places.connect ?? socket)(this.#places.copy, {
      onEnded: (reason) => {
        if (line !== this.#line) return; // whoever waits for it is told
        this.#turn++;
        this.#leave();
        this.#element.show({ own: false, note: `Your copy has ended: ${reason}. ${KEPT}` });
      },
    });
    return line;
  }

  /** The figure asks the copy from now on, where its reader is. @param {Line} line */
  #take(line) {
    /** @type {Transport} */
    const transport = {
      open: () => line.open(),
      ask: (ask) => line.ask(ask),
      onStale: (listener) => line.onStale(listener),
      dropped: (refs) => line.dropped(refs),
      need: (refs) => line.need(refs),
      close: () => { if (this.#held === transport) line.close(); },
    };
    this.#held = transport;
    this.#figure.stay();
    this.#figure.transport = transport;
    this.#figure.mark("Your copy", { name: "Back to what all see", act: () => this.#element.reset() });
  }

  /** The figure asks the shared model again. */
  #leave() {
    const line = this.#line;
    this.#line = this.#held = null;
    if (line === null) return;
    this.#figure.stay();
    this.#figure.mark("");
    this.#places.share();
    line.close();
  }
}

/** @param {unknown} error */
function message(error) {
  return (error instanceof Error ? error.message : String(error)).replace(/\.$/, "");
}
