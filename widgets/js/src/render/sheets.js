/**
 * Where a figure's picture is seen: drawn on the canvas that all figures share, it is handed over to the figure's own.
 * What was drawn as large as it is seen is handed over as it is, and nothing is copied; what was drawn more finely is
 * scaled down. Where a browser cannot hand over pictures they are copied.
 */

/** @typedef {HTMLCanvasElement|OffscreenCanvas} Source */

/** Where pictures are scaled down: one for all figures. @type {OffscreenCanvasRenderingContext2D|null} */
let table = null;

/** One figure's own canvas. */
export class Sheet {
  /** @type {ImageBitmapRenderingContext|null} */
  #receiver = null;
  /** @type {CanvasRenderingContext2D|null} */
  #brush = null;

  /** @param {HTMLCanvasElement} canvas nothing else draws on it */
  constructor(canvas) {
    this.canvas = canvas;
  }

  /**
   * Show a picture.
   * @param {Source} source just drawn; afterwards it is empty, or as it was
   * @param {number} width of what is seen, pixels of the screen
   * @param {number} height
   */
  show(source, width, height) {
    const { canvas } = this;
    const isResized = canvas.width !== width || canvas.height !== height;
    if (isResized) {
      canvas.width = width;
      canvas.height = height;
    }
    const receiver = this.#brush === null && "transferToImageBitmap" in source ? this.#receive() : null;
    if (receiver !== null) {
      const image = /** @type {OffscreenCanvas} */ (source).transferToImageBitmap();
      receiver.transferFromImageBitmap(image.width > width || image.height > height ? shrunk(image, canvas) : image);
      return;
    }
    this.#brush ??= canvas.getContext("2d");
    if (!isResized) this.#brush?.clearRect(0, 0, width, height);
    this.#brush?.drawImage(source, 0, 0, width, height);
  }

  #receive() {
    this.#receiver ??= canvasReceiver(this.canvas);
    return this.#receiver;
  }
}

/** @param {HTMLCanvasElement} canvas */
function canvasReceiver(canvas) {
  return typeof OffscreenCanvas === "undefined" ? null : canvas.getContext("bitmaprenderer");
}

/** @param {ImageBitmap} image which is closed @param {{width: number, height: number}} size */
function shrunk(image, { width, height }) {
  table ??= new OffscreenCanvas(width, height).getContext("2d");
  if (table === null) return image;
  const { canvas } = table;
  if (canvas.width !== width || canvas.height !== height) {
    canvas.width = width;
    canvas.height = height;
  }
  table.drawImage(image, 0, 0, width, height);
  image.close();
  return canvas.transferToImageBitmap();
}
