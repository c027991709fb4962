/** The menu of a figure: how it is drawn, and what one can do with it besides. */

import { button, make, reducedMotion, setAll, setText, unique } from "./elements.js";
import { icon } from "./icons.js";

/**
 * @typedef {object} MenuActions
 * @property {(options: Partial<import("../core/types.js").Options>) => void} draw
 * @property {() => void} camera back to the scene's
 * @property {() => void} undo
 * @property {() => void} redo
 * @property {() => void} reset
 * @property {() => Promise<string | null>} copy null: copied; else the link, to be copied by hand
 * @property {() => void} full
 * @property {(name: string | null) => void} find an object
 */

const SWITCHES = /** @type {const} */ ([
  ["edges", "Edges"], ["shadows", "Shadows"], ["ground", "Ground"], ["grid", "Grid"], ["axes", "Axes"],
]);
const SHADINGS = /** @type {const} */ ([["smooth", "Smooth"], ["flat", "Flat"], ["wire", "Wire"]]);
const THEMES = /** @type {const} */ ([["auto", "As the page"], ["light", "Light"], ["dark", "Dark"]]);

export class Menu {
  #closing = new AbortController();

  /**
   * @param {import("../core/types.js").Options} options as the figure opens
   * @param {readonly string[]} objects that one may look for
   * @param {MenuActions} actions
   */
  constructor(options, objects, actions) {
    const id = unique("menu");
    this.toggle = button("Settings", icon("menu"), () => this.open(this.panel.hidden === true), {
      class: "icon-button", "aria-expanded": "false", "aria-controls": id,
    });
    this.undo = plain("Undo", actions.undo);
    this.redo = plain("Redo", actions.redo);
    this.camera = plain("Scene\u2019s camera", () => { actions.camera(); this.camera.disabled = true; });
    const note = make("p", { class: "note", role: "status" });
    const link = make("input", { type: "text", readonly: true, class: "link", "aria-label": "Link to this point" });
    link.hidden = true;
    const copy = plain("Copy link", async () => {
      const text = await actions.copy();
      link.hidden = text === null;
      if (text !== null) {
        link.value = text;
        link.select();
      }
      setText(note, text === null ? "The link is copied." : "Copy this link:");
    });
    const find = make("select", { "aria-label": "Find an object" }, [
      make("option", { value: "" }, ["none"]), ...objects.map((name) => make("option", { value: name }, [name])),
    ], { change: () => actions.find(find.value || null) });
    this.find = find;
    this.panel = make("div", { class: "menu", id, role: "group", "aria-label": "Settings", hidden: true }, [
      choices("Shading", "shading", SHADINGS, options.shading, (shading) => actions.draw({ shading })),
      make("fieldset", {}, [make("legend", {}, ["Show"]), ...SWITCHES.map(([name, label]) => {
        const box = make("input", { type: "checkbox", checked: Boolean(options[name]) }, [], {
          change: () => actions.draw({ [name]: box.checked }),
        });
        return make("label", {}, [box, label]);
      })]),
      choices("Surroundings", "theme", THEMES, options.theme, (theme) => actions.draw({ theme })),
      objects.length ? make("fieldset", { class: "wide" }, [make("legend", {}, ["Find an object"]), find]) : null,
      make("div", { class: "actions" }, [
        this.undo, this.redo, plain("Reset", actions.reset), this.camera, copy,
        plain("Full screen", () => { this.open(false); actions.full(); }),
      ]),
      note, link,
    ], { keydown: (event) => this.#key(event) });
    this.toggle.addEventListener("keydown", (event) => this.#key(event));
  }

  /** @param {boolean} open */
  open(open) {
    this.panel.hidden = !open;
    setAll(this.toggle, { "aria-expanded": String(open) });
    this.#closing.abort();
    if (!open) return;
    this.panel.scrollIntoView({ block: "nearest", behavior: reducedMotion() ? "auto" : "smooth" });
    this.#closing = new AbortController();
    const outside = (/** @type {Event} */ event) => {
      const path = event.composedPath();
      if (!path.includes(this.panel) && !path.includes(this.toggle)) this.open(false);
    };
    document.addEventListener("pointerdown", outside, { signal: this.#closing.signal });
  }

  /** @param {{ canUndo: boolean, canRedo: boolean, own: boolean }} now */
  show({ canUndo, canRedo, own }) {
    this.undo.disabled = !canUndo;
    this.redo.disabled = !canRedo;
    this.camera.disabled = !own;
  }

  dispose() {
    this.#closing.abort();
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key !== "Escape" || this.panel.hidden) return;
    event.stopPropagation();
    this.open(false);
    this.toggle.focus();
  }
}

/** @param {string} label @param {() => void} action */
function plain(label, action) {
  return make("button", { type: "button" }, [label], { click: action });
}

/**
 * Radio buttons under one name.
 * @template {string} V
 * @param {string} title
 * @param {string} stem
 * @param {readonly (readonly [V, string])[]} values
 * @param {V} now
 * @param {(value: V) => void} chosen
 */
function choices(title, stem, values, now, chosen) {
  const name = unique(stem);
  return make("fieldset", {}, [make("legend", {}, [title]), ...values.map(([value, label]) => {
    const input = make("input", { type: "radio", name, checked: value === now }, [], { change: () => chosen(value) });
    return make("label", {}, [input, label]);
  })]);
}
