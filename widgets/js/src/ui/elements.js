/** Elements made in one expression, and small things that many parts of a figure need. */

/**
 * @typedef {Record<string, string | number | boolean | null | undefined>} Attributes
 * @typedef {{ [K in keyof HTMLElementEventMap]?: (event: HTMLElementEventMap[K]) => void }} Listeners
 */

let count = 0;

/** A name for an id, used once. @param {string} stem */
export function unique(stem) {
  return `${stem}-${++count}`;
}

/**
 * An element with attributes (true is an empty one, false and null are none), children and listeners.
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Attributes} [attributes]
 * @param {(Node | string | null)[]} [children]
 * @param {Listeners} [listeners]
 * @returns {HTMLElementTagNameMap[K]}
 */
export function make(tag, attributes = {}, children = [], listeners = {}) {
  const node = document.createElement(tag);
  setAll(node, attributes);
  for (const child of children) if (child !== null) node.append(child);
  for (const [name, listener] of Object.entries(listeners)) {
    node.addEventListener(name, /** @type {EventListener} */ (listener));
  }
  return node;
}

/** @param {Element} node @param {Attributes} attributes */
export function setAll(node, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) node.removeAttribute(name);
    else if (node.getAttribute(name) !== written(name, value)) node.setAttribute(name, written(name, value));
  }
}

/** Aria wants a word where HTML wants nothing. @param {string} name @param {string | number | true} value */
function written(name, value) {
  return value === true && !name.startsWith("aria-") ? "" : String(value);
}

/** Text is only touched where it differs: so that selections and screen readers are left in peace. */
export function setText(/** @type {Node} */ node, /** @type {string} */ text) {
  if (node.textContent !== text) node.textContent = text;
}

/**
 * A button with a picture and a name.
 * @param {string} name spoken, and shown as a tip
 * @param {Node} picture
 * @param {(event: MouseEvent) => void} action
 * @param {Attributes} [attributes]
 */
export function button(name, picture, action, attributes = {}) {
  const settings = { type: "button", "aria-label": name, title: name, ...attributes };
  return make("button", settings, [picture], { click: action });
}

/** Name a button anew. @param {HTMLElement} node @param {string} name */
export function rename(node, name) {
  setAll(node, { "aria-label": name, title: name });
}

/** @param {string} query @returns {boolean} */
export function prefers(query) {
  return typeof matchMedia === "function" && matchMedia(query).matches;
}

export const reducedMotion = () => prefers("(prefers-reduced-motion: reduce)");
