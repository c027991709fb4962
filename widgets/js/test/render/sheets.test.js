import assert from "node:assert/strict";
import { afterEach, test } from "node:test";
import { Sheet } from "../../src/render/sheets.js";

/** A picture that can be handed over. */
class Image {
  isClosed = false;

  constructor(/** @type {number} */ width, /** @type {number} */ height, /** @type {string} */ from) {
    Object.assign(this, { width, height, from });
  }

  close() {
    this.isClosed = true;
  }
}

/** @type {any[]} */
const log = [];

/** A canvas; `gives`: the contexts that it has. */
class Canvas {
  /** @param {number} width @param {number} height @param {string[]} gives @param {string} [name] */
  constructor(width, height, gives, name = "own") {
    Object.assign(this, { width, height, gives, name });
  }

  /** @param {string} kind */
  getContext(kind) {
    const { gives, name } = /** @type {any} */ (this);
    if (!gives.includes(kind)) return null;
    return {
      canvas: this,
      clearRect: () => log.push([name, "clearRect"]),
      drawImage: (/** @type {any} */ image, /** @type {number[]} */ ...rest) => {
        log.push([name, "drawImage", image.from ?? image.name, ...rest]);
      },
      transferFromImageBitmap: (/** @type {any} */ image) => log.push([name, "receives", image.from, image.width]),
    };
  }
}

/** A canvas beside the page, whose picture can be handed over. */
class Offscreen extends Canvas {
  constructor(/** @type {number} */ width, /** @type {number} */ height) {
    super(width, height, ["2d", "webgl2"], "table");
  }

  transferToImageBitmap() {
    const { width, height, name } = /** @type {any} */ (this);
    return new Image(width, height, name);
  }
}

const receiving = () => /** @type {any} */ (new Canvas(0, 0, ["bitmaprenderer", "2d"]));

/** @param {number} width @param {number} height @returns {any} the canvas that all figures share */
const drawnOn = (width, height) => Object.assign(new Offscreen(width, height), { name: "stage" });

const globals = /** @type {any} */ (globalThis);
globals.OffscreenCanvas = Offscreen;
afterEach(() => {
  log.length = 0;
  globals.OffscreenCanvas = Offscreen;
});

test("a picture as large as it is seen is handed over, and nothing is copied", () => {
  const canvas = receiving();
  const sheet = new Sheet(canvas);
  sheet.show(drawnOn(40, 30), 40, 30);
  sheet.show(drawnOn(30, 22), 40, 30); // one drawn coarsely is stretched by the screen
  assert.deepEqual(log, [["own", "receives", "stage", 40], ["own", "receives", "stage", 30]]);
  assert.deepEqual([canvas.width, canvas.height], [40, 30]);
});

test("a picture that was drawn more finely is scaled down before, so that it takes no more memory", () => {
  new Sheet(receiving()).show(drawnOn(80, 60), 40, 30);
  assert.deepEqual(log, [["table", "drawImage", "stage", 0, 0, 40, 30], ["own", "receives", "table", 40]]);
});

test("where pictures cannot be handed over they are copied, and the last one does not shine through", () => {
  for (const make of [() => new Canvas(40, 30, ["webgl2"], "stage"), () => drawnOn(40, 30)]) {
    const canvas = make() instanceof Offscreen ? new Canvas(0, 0, ["2d"]) : receiving();
    const sheet = new Sheet(/** @type {any} */ (canvas));
    sheet.show(/** @type {any} */ (make()), 40, 30);
    sheet.show(/** @type {any} */ (make()), 40, 30);
    const drawn = ["own", "drawImage", "stage", 0, 0, 40, 30];
    assert.deepEqual(log, [drawn, ["own", "clearRect"], drawn]);
    log.length = 0;
  }
});
