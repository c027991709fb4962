/** What is wrong with a message from outside, and where in it. */

/** Raised by everything that reads what came over a wire, and by nothing else. */
export class WireError extends Error {
  /**
   * @param {string} path where in the message: `segments[3].track.times`
   * @param {string} text what was expected, and what was there
   */
  constructor(path, text) {
    super(`${path}: ${text}`);
    this.name = "WireError";
    this.path = path;
  }
}
