/**
 * A figure in somebody's own trame application: a component for Vue, which trame's pages are made of.
 *
 * It asks over a socket of its own, and its reader's point is theirs alone. Only what the application binds, a time or
 * parameters, goes through trame's state, which all its clients share.
 */

import { define } from "./figures.js";
import { connect, lineOf } from "./trame.js";

/** @typedef {import("../ui/figure-element.js").FigureElement} FigureElement */

const PAUSE = 50; // ms between two words of where the reader is: each goes to the server and to all clients

/**
 * What a figure and the application that it stands in tell each other.
 * @param {FigureElement} figure
 * @param {{ time: () => unknown, parameters: () => Record<string, unknown> }} given what is bound, as it is now
 * @param {(name: "update:time" | "update:parameters", value: any) => void} tell
 * @param {(act: () => void, ms: number) => any} [later]
 */
export function bound(figure, given, tell, later = (act, ms) => setTimeout(act, ms)) {
  let waits = false;
  /** What of the reader's point is not as the application has it. */
  const others = () => {
    const point = figure.reader?.point;
    if (point === undefined) return null;
    const time = given.time();
    const entries = Object.entries(given.parameters()).filter(([name]) => name in point.parameters);
    return {
      point,
      time: time !== undefined && time !== point.time,
      names: entries.filter(([name, value]) => !isEqual(value, point.parameters[name])).map(([name]) => name),
    };
  };
  const say = () => {
    waits = false;
    const found = others();
    if (found?.time) tell("update:time", found.point.time);
    if (found?.names.length) {
      const { parameters } = found.point;
      tell("update:parameters", Object.fromEntries(found.names.map((name) => [name, parameters[name]])));
    }
  };
  return {
    /** The reader moved. */
    moved: () => {
      if (waits) return;
      waits = true;
      later(say, PAUSE);
    },
    /** The application says where to be; what it does not know yet it is told. */
    take: () => {
      const found = others();
      if (found === null || waits) return;
      const parameters = given.parameters();
      const wished = found.names.filter((name) => parameters[name] !== null && parameters[name] !== undefined);
      /** @type {{ time?: number, parameters?: Record<string, any> }} */
      const patch = {};
      const time = given.time();
      if (found.time && typeof time === "number") patch.time = time;
      if (wished.length) patch.parameters = Object.fromEntries(wished.map((name) => [name, parameters[name]]));
      if (patch.time !== undefined || patch.parameters) figure.reader?.change(patch, { gesture: "application" });
      say();
    },
  };
}

/** @param {unknown} a @param {unknown} b */
function isEqual(a, b) {
  return JSON.stringify(a) === JSON.stringify(b);
}

const component = {
  props: {
    figure: String, base: String, time: { default: undefined }, parameters: { type: Object, default: () => ({}) },
  },
  emits: ["update:time", "update:parameters"],
  /** @this {any} */
  mounted() {
    define();
    const figure = /** @type {FigureElement} */ (document.createElement("r4d-figure"));
    figure.setAttribute("name", this.figure);
    const given = { time: () => this.time, parameters: () => this.parameters ?? {} };
    const tie = bound(figure, given, (name, value) => this.$emit(name, value));
    this.tie = tie;
    figure.addEventListener("r4d-live", () => {
      tie.take();
      figure.reader?.on("point", tie.moved);
    });
    this.$el.append(figure);
    connect(figure, lineOf(new URL(this.base, document.baseURI).href, this.figure));
  },
  /** @this {any} */
  beforeUnmount() {
    const figure = /** @type {FigureElement | null} */ (this.$el.querySelector("r4d-figure"));
    const transport = figure?.transport;
    figure?.remove();
    transport?.close();
  },
  watch: {
    /** @this {any} */
    time() { this.tie?.take(); },
    /** @this {any} */
    parameters: { handler() { /** @type {any} */ (this).tie?.take(); }, deep: true },
  },
  render: () => /** @type {any} */ (globalThis).Vue.h("div", { class: "r4d-view" }),
};

/** What trame is told to use. */
export const vue = {
  /** @param {any} app */
  install(app) {
    app.component("r4d-view", component);
  },
};
