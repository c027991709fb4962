/**
 * `<r4d-script figure="scene">`: the script of a figure, for its reader to edit. Its child holds the text as it is.
 *
 * It only shows and tells: "r4d-run" when the reader wants to see their text, "r4d-reset" when they want back what all
 * see. Who listens says with `show` what became of it.
 */

import { ElementBase } from "./bases.js";
import { make, prefers, setAll, setText } from "./elements.js";
import { scriptStyles } from "./script-styles.js";

/**
 * @typedef {{ line: number | null, column: number | null, text: string }} Problem
 *
 * @typedef {object} Standing
 * @property {boolean} own whether the reader sees a copy of their own
 * @property {boolean} [busy] whether an answer is awaited
 * @property {string} [note] a sentence
 * @property {Problem[]} [problems]
 */

const ABOUT = "What you change here changes a copy that only you see.";
const MOST_ROWS = 20;

export class ScriptElement extends ElementBase {
  #details = make("details");
  #lines = make("ol", { class: "lines", "aria-hidden": true });
  #text = /** @type {HTMLTextAreaElement} */ (make("textarea", {
    "aria-label": "Script", "aria-describedby": "status", spellcheck: "false", autocapitalize: "off",
    autocomplete: "off", autocorrect: "off", wrap: "off",
  }));
  #run = /** @type {HTMLButtonElement} */ (make("button", { class: "run", type: "button" }, ["Show my copy"]));
  #reset = /** @type {HTMLButtonElement} */ (make("button", { type: "button" }, ["Back to what all see"]));
  #status = make("p", { class: "status", id: "status", role: "status" });
  #wrong = make("ul", { class: "wrong" });
  #frame = make("div", { class: "script" });
  #original = "";
  #own = false;
  #busy = false;
  #again = false;
  /** What the reader wanted to see last. */
  #asked = "";

  constructor() {
    super();
    this.#details.append(
      make("summary", {}, ["The script"]),
      make("p", { class: "about" }, [ABOUT]),
      make("div", { class: "field" }, [this.#lines, this.#text]),
      make("div", { class: "actions" }, [
        this.#run, this.#reset, make("span", { class: "keys" }, ["Ctrl + Enter shows it"]),
      ]),
      this.#status,
      this.#wrong,
    );
    this.#frame.append(this.#details);
    this.attachShadow({ mode: "open" }).append(make("style", {}, [scriptStyles]), this.#frame);
    this.#text.addEventListener("input", () => this.#edited());
    this.#text.addEventListener("scroll", () => { this.#lines.scrollTop = this.#text.scrollTop; });
    this.#text.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      this.#ask();
    });
    this.#run.addEventListener("click", () => this.#ask());
    this.#reset.addEventListener("click", () => this.reset());
  }

  connectedCallback() {
    if (this.#original !== "") return;
    this.#original = (this.querySelector("pre")?.textContent ?? "").replace(/\n$/, "");
    this.text = this.#original;
    this.show({ own: false });
    this.#paint();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.#paint());
  }

  get text() {
    return this.#text.value;
  }

  set text(text) {
    this.#text.value = text;
    this.#text.rows = Math.min(Math.max(4, text.split("\n").length), MOST_ROWS);
    this.#number([]);
  }

  /** What became of what the reader wanted. @param {Standing} standing */
  show({ own, busy = false, note = "", problems = [] }) {
    this.#own = own;
    this.#busy = busy;
    setText(this.#status, note || (own ? "This is your copy; nobody else sees it." : "This is what all see."));
    setAll(this.#status, { "data-own": own });
    setAll(this.#text, { "aria-invalid": problems.length > 0 });
    this.#number(problems);
    this.#wrong.replaceChildren(...problems.map((problem) => this.#told(problem)));
    this.#enable();
    if (problems.length && this.text === this.#asked) this.#go(problems[0]);
    if (!busy && this.#again) this.#ask();
  }

  /** Back to the text as it was, and to what all see. */
  reset() {
    this.#again = false;
    this.text = this.#original;
    this.dispatchEvent(new CustomEvent("r4d-reset"));
  }

  /** What is wanted while an answer is awaited is asked for afterwards. */
  #ask() {
    this.#again = this.#busy;
    if (this.#busy) return;
    this.#asked = this.text;
    this.dispatchEvent(new CustomEvent("r4d-run", { detail: this.text }));
  }

  #edited() {
    this.#number([]);
    this.#enable();
  }

  #enable() {
    this.#run.disabled = this.#busy;
    this.#reset.disabled = this.#busy || (!this.#own && this.text === this.#original);
  }

  /** Numbers beside the lines. @param {Problem[]} problems */
  #number(problems) {
    const wrong = new Set(problems.map(({ line }) => line));
    const count = this.text.split("\n").length;
    const items = Array.from({ length: count }, (_, k) =>
      make("li", { "data-wrong": wrong.has(k + 1) }, [String(k + 1)]));
    this.#lines.replaceChildren(...items);
    this.#lines.scrollTop = this.#text.scrollTop;
  }

  /** @param {Problem} problem */
  #told(problem) {
    const { line, column, text } = problem;
    if (line === null) return make("li", {}, [text]);
    const where = make("button", { type: "button" }, [`Line ${line}${column === null ? "" : `, column ${column}`}`]);
    where.addEventListener("click", () => this.#go(problem));
    return make("li", {}, [where, ` ${text}`]);
  }

  /** The caret to where something is wrong. @param {Problem} problem */
  #go({ line, column }) {
    if (line === null) return;
    const before = this.text.split("\n").slice(0, line - 1);
    const at = before.reduce((sum, one) => sum + one.length + 1, 0) + (column ?? 1) - 1;
    this.#text.focus();
    this.#text.setSelectionRange(at, Math.min(at + 1, this.text.length));
    const height = this.#text.scrollHeight / Math.max(1, this.text.split("\n").length);
    this.#text.scrollTop = Math.max(0, (line - 3) * height);
  }

  #paint() {
    const told = this.ownerDocument.documentElement.dataset.theme;
    const dark = told === "dark" || (told !== "light" && prefers("(prefers-color-scheme: dark)"));
    this.#frame.dataset.theme = dark ? "dark" : "light";
  }
}
