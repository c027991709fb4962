/**
 * A make-believe graphics card and a make-believe page: enough of both for three.js and a view to go through their
 * motions in Node, and to count what they ask for. What it looks like is for a browser to show.
 */

/** @typedef {Record<string, number>} Counts calls of the card, by name */

/** @type {Record<string, any>} */
const ANSWERS = { VERSION: "WebGL 2.0", SCISSOR_BOX: [0, 0, 1, 1], VIEWPORT: [0, 0, 1, 1] };

/** @param {Counts} calls @returns {any} a context whose constants are their own names */
function fakeContext(calls) {
  /** @type {Record<string, (...rest: any[]) => any>} */
  const special = {
    getParameter: (name) => ANSWERS[name] ?? (String(name).startsWith("MAX") ? 64 : 0),
    getShaderPrecisionFormat: () => ({ precision: 23, rangeMin: 127, rangeMax: 127 }),
    getContextAttributes: () => ({ alpha: true, antialias: false }),
    getProgramParameter: (_, what) => what === "LINK_STATUS" || (what === "COMPLETION_STATUS_KHR" ? true : 0),
    getShaderParameter: () => true,
    getProgramInfoLog: () => "",
    getShaderInfoLog: () => "",
    getExtension: () => null,
    getUniformLocation: () => ({}),
    isContextLost: () => false,
  };
  return new Proxy({}, {
    get: (_, name) => {
      if (typeof name !== "string") return undefined;
      if (/^[A-Z0-9_]+$/.test(name)) return name;
      return (/** @type {any[]} */ ...rest) => {
        calls[name] = (calls[name] ?? 0) + 1;
        if (name in special) return special[name](...rest);
        return name.startsWith("create") ? {} : undefined;
      };
    },
  });
}

/** An element of the make-believe page. */
export class FakeElement extends EventTarget {
  style = /** @type {any} */ ({ setProperty() {} });
  className = "";
  textContent = "";
  /** @type {FakeElement[]} */
  children = [];
  /** @type {FakeElement|null} */
  parentElement = null;
  width = 0;
  height = 0;
  clientWidth = 400;
  clientHeight = 300;
  offsetLeft = 0;
  offsetTop = 0;
  /** @type {Counts} */
  drawn = {};

  get ownerDocument() {
    return document;
  }

  get offsetWidth() {
    return 8 * this.textContent.length;
  }

  get offsetHeight() {
    return 16;
  }

  /** @param {...FakeElement} elements */
  append(...elements) {
    for (const element of elements) element.parentElement = this;
    this.children.push(...elements);
  }

  /** @param {FakeElement} element */
  after(element) {
    this.parentElement?.append(element);
  }

  remove() {
    if (this.parentElement) this.parentElement.children = this.parentElement.children.filter((e) => e !== this);
    this.parentElement = null;
  }

  setAttribute() {}
  setPointerCapture() {}
  focus() {}

  getRootNode() {
    return document;
  }

  getContext() {
    const count = (/** @type {string} */ name) => () => void (this.drawn[name] = (this.drawn[name] ?? 0) + 1);
    return { drawImage: count("drawImage"), clearRect: count("clearRect") };
  }
}

/** A canvas with a card behind it. */
export class FakeCard extends FakeElement {
  /** @type {Counts} */
  calls = {};

  /** @override @returns {any} */
  getContext() {
    return fakeContext(this.calls);
  }

  /** What was asked of the card meanwhile. @param {() => void} act @returns {Counts} */
  during(act) {
    for (const name of Object.keys(this.calls)) delete this.calls[name];
    act();
    return { ...this.calls };
  }
}

/** Make the page's globals; answers a frame's beat: all that waits for one is called. */
export function page() {
  /** @type {(() => void)[]} */
  let waiting = [];
  const fakes = {
    document: { createElement: () => new FakeElement(), activeElement: null },
    matchMedia: () => Object.assign(new EventTarget(), { matches: false }),
    getComputedStyle: () => ({ position: "relative" }),
    requestAnimationFrame: (/** @type {() => void} */ f) => waiting.push(f),
    cancelAnimationFrame: () => void (waiting = []),
    devicePixelRatio: 1,
  };
  Object.assign(globalThis, fakes);
  return () => {
    const now = waiting;
    waiting = [];
    for (const f of now) f();
  };
}
