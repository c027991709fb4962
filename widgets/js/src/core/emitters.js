/** Who wants to be told of what. */

/** @template {Record<string, any>} Events by name, what a listener is given */
export class Emitter {
  /** @type {Map<keyof Events, Set<(payload: any) => void>>} */
  #listeners = new Map();

  /** @template {keyof Events} N @param {N} name @param {(payload: Events[N]) => void} listener
   * @returns {() => void} takes the listener away */
  on(name, listener) {
    let listeners = this.#listeners.get(name);
    if (listeners === undefined) this.#listeners.set(name, (listeners = new Set()));
    listeners.add(listener);
    return () => {
      listeners.delete(listener);
    };
  }

  /** @template {keyof Events} N @param {N} name @param {Events[N]} payload */
  emit(name, payload) {
    for (const listener of [...(this.#listeners.get(name) ?? [])]) listener(payload);
  }

  clear() {
    this.#listeners.clear();
  }
}
