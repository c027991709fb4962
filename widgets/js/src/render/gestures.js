/**
 * What hands do on a picture: turning, shifting, coming nearer; with mouse, pen, fingers and keys.
 *
 * A page must stay scrollable: the wheel and a vertical stroke of one finger belong to the page until the figure has
 * the focus (a click or a tap gives it). A horizontal stroke, two fingers, and the wheel with Ctrl always belong to
 * the figure.
 */

/**
 * @typedef {object} Actions lengths are CSS pixels
 * @property {(right: number, down: number) => void} orbit
 * @property {(right: number, down: number) => void} pan
 * @property {(factor: number, x: number, y: number) => void} dolly around a place in the picture
 * @property {(rightward: number, upward: number) => void} turn by a key, radians
 * @property {(rightward: number, upward: number) => void} shift by a key, in fractions of the picture's height
 * @property {(factor: number) => void} zoom by a key
 * @property {() => void} home
 * @property {(x: number, y: number) => void} hover
 * @property {() => void} leave
 * @property {() => void} rest the hand is off
 */

/** CSS pixels that a click or a tap may tremble. */
const TREMBLE = { touch: 9, mouse: 3 };
const TURN = (5 * Math.PI) / 180;
const SHIFT = 0.05;
const ZOOM = 1.12;

/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** The hands on one canvas. */
export class Gestures {
  #canvas;
  #actions;
  /** @type {Map<number, {x: number, y: number}>} */
  #fingers = new Map();
  #panning = false;
  /** @type {{x: number, y: number}|null} where the hand came down, until it has moved */
  #start = null;
  #end = new AbortController();

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Actions} actions
   */
  constructor(canvas, actions) {
    this.#canvas = canvas;
    this.#actions = actions;
    canvas.style.touchAction = "pan-y";
    canvas.style.cursor = "grab";
    /** @type {(name: keyof HTMLElementEventMap, f: (event: any) => void, options?: object) => void} */
    const listen = (name, f, options = {}) =>
      canvas.addEventListener(name, f, { signal: this.#end.signal, ...options });
    listen("pointerdown", (event) => this.#down(event));
    listen("pointermove", (event) => this.#move(event));
    listen("pointerup", (event) => this.#up(event));
    listen("pointercancel", (event) => this.#up(event));
    listen("pointerleave", () => this.#actions.leave());
    listen("wheel", (event) => this.#wheel(event), { passive: false });
    listen("keydown", (event) => this.#key(event));
    listen("contextmenu", (event) => event.preventDefault());
    listen("focus", () => (canvas.style.touchAction = "none"));
    listen("blur", () => (canvas.style.touchAction = "pan-y"));
  }

  /** Whether a hand is on the picture. */
  get busy() {
    return this.#fingers.size > 0;
  }

  /** Take the hands off. */
  dispose() {
    this.#end.abort();
  }

  get #focused() {
    const root = /** @type {Document|ShadowRoot} */ (this.#canvas.getRootNode());
    return root.activeElement === this.#canvas;
  }

  /** @param {PointerEvent} event */
  #down(event) {
    if (event.defaultPrevented) return;
    this.#panning = event.button === 1 || event.button === 2 || event.shiftKey || event.metaKey;
    this.#fingers.set(event.pointerId, place(event));
    this.#start = this.#fingers.size === 1 ? place(event) : null;
    this.#canvas.setPointerCapture(event.pointerId);
    this.#canvas.style.cursor = "grabbing";
    if (event.pointerType !== "touch") this.#canvas.focus({ preventScroll: true });
    if (event.button === 1) event.preventDefault();
    this.#actions.leave();
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const before = this.#fingers.get(event.pointerId);
    const now = place(event);
    if (before === undefined) {
      if (event.pointerType !== "touch") this.#actions.hover(now.x, now.y);
      return;
    }
    const others = [...this.#fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
    this.#fingers.set(event.pointerId, now);
    if (others.length === 0 && !this.#begun(event, now)) return;
    if (others.length === 0) {
      if (this.#panning) this.#actions.pan(now.x - before.x, now.y - before.y);
      else this.#actions.orbit(now.x - before.x, now.y - before.y);
      return;
    }
    const other = others[0];
    const wide = Math.hypot(now.x - other.x, now.y - other.y);
    const was = Math.hypot(before.x - other.x, before.y - other.y);
    this.#actions.pan((now.x - before.x) / 2, (now.y - before.y) / 2);
    if (wide > 0 && was > 0) this.#actions.dolly(was / wide, (now.x + other.x) / 2, (now.y + other.y) / 2);
  }

  /**
   * Whether a stroke of one finger has begun, and is the figure's.
   * @param {PointerEvent} event
   * @param {{x: number, y: number}} now
   */
  #begun({ pointerType }, now) {
    if (this.#start === null) return true;
    const right = Math.abs(now.x - this.#start.x);
    const down = Math.abs(now.y - this.#start.y);
    const touches = pointerType === "touch";
    if (Math.hypot(right, down) < (touches ? TREMBLE.touch : TREMBLE.mouse)) return false;
    if (touches && !this.#focused && down > right) return false;
    this.#start = null;
    return false;
  }

  /** @param {PointerEvent} event */
  #up(event) {
    if (!this.#fingers.delete(event.pointerId)) return;
    if (this.#fingers.size > 0) return;
    this.#canvas.style.cursor = "grab";
    this.#actions.rest();
  }

  /** @param {WheelEvent} event */
  #wheel(event) {
    if (!event.ctrlKey && !this.#focused) return;
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 30 : event.deltaMode === 2 ? 300 : 1;
    const far = Math.min(300, Math.max(-300, event.deltaY * unit * (event.ctrlKey ? 5 : 1)));
    const { x, y } = place(event);
    this.#actions.dolly(Math.exp(far * 0.0012), x, y);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.defaultPrevented || event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = ARROWS[event.key];
    if (arrow !== undefined) {
      const [x, y] = arrow;
      if (event.shiftKey) this.#actions.shift(x * SHIFT, y * SHIFT);
      else this.#actions.turn(x * TURN, y * TURN);
    } else if (event.key === "+" || event.key === "=") this.#actions.zoom(1 / ZOOM);
    else if (event.key === "-" || event.key === "_") this.#actions.zoom(ZOOM);
    else if (event.key === "0") this.#actions.home();
    else return;
    event.preventDefault();
  }
}

/** @type {(event: MouseEvent) => {x: number, y: number}} from the canvas's upper left corner */
function place(event) {
  return { x: event.offsetX, y: event.offsetY };
}
