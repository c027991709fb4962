/** What a custom element is made of; where there is no document (Node), the module can still be imported. */
export const ElementBase = /** @type {typeof HTMLElement} */ (globalThis.HTMLElement ?? class {});
