/** `<r4d-number name="length" format=".2f">1.00</r4d-number>`: a parameter to be dragged, or a value to be read. */

import { make, setAll, setText } from "../ui/elements.js";
import { format, parse, withUnit } from "../ui/formats.js";
import { isNumeric } from "../ui/limits.js";
import { valueText } from "../ui/speech.js";
import { fit, keyed, perPixel } from "../ui/stepping.js";
import { InlineElement } from "./finding.js";

/** @typedef {import("../core/types.js").Parameter} Parameter */

const UNTIL_A_DRAG = 3; // pixels

export class NumberElement extends InlineElement {
  /** @type {HTMLElement | null} */ #face = null;
  /** @type {Parameter | null} */ #parameter = null;
  #typing = false;
  /** @type {unknown} */ #seen = null;

  get name() {
    return this.getAttribute("name") ?? "";
  }

  /** @override */
  build() {
    this.#parameter = this.reader?.parameter(this.name) ?? null;
    this.#typing = false;
    this.#seen = null;
    const known = this.#parameter ?? this.reader?.manifest.values.find((value) => value.name === this.name);
    if (!known) return null;
    this.#face = !this.#parameter ? make("span", { class: "value" })
      : isNumeric(this.#parameter) ? this.#spinner()
      : this.#parameter.kind === "boolean" ? this.#toggle(this.#parameter)
      : this.#parameter.kind === "select" ? this.#list(this.#parameter)
      : make("span", { class: "value" });
    return this.#face;
  }

  /** @override */
  update() {
    const { reader } = this;
    if (!reader || !this.#face || this.#typing) return;
    const seen = this.#parameter ? reader.session.point.parameters : this.figure?.snapshot?.values;
    if (seen === this.#seen) return; // the same object as long as nothing in it changes
    this.#seen = seen;
    if (!this.#parameter) {
      const value = reader.manifest.values.find(({ name }) => name === this.name);
      const spec = this.getAttribute("format") || value?.format || "";
      setText(this.#face, withUnit(format(this.figure?.snapshot?.values.get(this.name), spec), value?.unit));
      return;
    }
    const value = reader.session.point.parameters[this.name];
    const limits = reader.allowed(this.#parameter);
    const spec = this.getAttribute("format") || null;
    const text = value === null ? "none" : valueText(this.#parameter, value, spec);
    if (this.#face instanceof HTMLSelectElement) {
      const key = JSON.stringify(value);
      this.#face.selectedIndex = (this.#parameter.options ?? []).findIndex((option) => JSON.stringify(option) === key);
      this.#face.disabled = limits.closed;
      return;
    }
    setText(this.#face, text);
    if (!this.#face.hasAttribute("role")) return;
    setAll(this.#face, { "aria-disabled": limits.closed || null, title: limits.why || this.#parameter.doc || null });
    if (isNumeric(this.#parameter)) {
      setAll(this.#face, {
        "aria-valuenow": Number(value), "aria-valuemin": limits.lo, "aria-valuemax": limits.hi, "aria-valuetext": text,
      });
    } else setAll(this.#face, { "aria-checked": String(value === true) });
  }

  /** A number that one drags to the left and right, types, or steps with keys. */
  #spinner() {
    const label = this.#parameter?.label;
    const face = make("span", { class: "number", role: "spinbutton", tabindex: 0, "aria-label": label });
    let from = { x: NaN, value: 0 };
    let gesture = "";
    let wasFocused = false;
    face.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || this.#closed()) return;
      wasFocused = face.matches(":focus");
      face.setPointerCapture(event.pointerId);
      from = { x: event.clientX, value: this.#value() };
      gesture = "";
    });
    face.addEventListener("pointermove", (event) => {
      if (!face.hasPointerCapture(event.pointerId)) return;
      const moved = event.clientX - from.x;
      if (!gesture && Math.abs(moved) < UNTIL_A_DRAG) return;
      gesture ||= this.reader?.gestures.begin(this.name) ?? "drag";
      face.toggleAttribute("data-held", true);
      this.#set(from.value + moved * perPixel(this.#limits()), gesture, true);
    });
    face.addEventListener("pointerup", () => { if (!gesture && wasFocused) this.#type(); });
    face.addEventListener("lostpointercapture", () => face.toggleAttribute("data-held", false));
    face.addEventListener("dblclick", () => this.#type());
    face.addEventListener("keydown", (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || this.#closed()) return;
      if (event.key === "Enter" || event.key === "F2") {
        event.preventDefault();
        this.#type();
        return;
      }
      const value = keyed(event.key, event.shiftKey, this.#value(), this.#limits());
      if (value === null) return;
      event.preventDefault();
      this.#set(value, this.reader?.gestures.again(this.name) ?? null);
    });
    return face;
  }

  /** A field in place of the number, until Enter, Escape or elsewhere. */
  #type() {
    if (this.#typing || this.#closed() || !this.#face) return;
    this.#typing = true;
    const face = this.#face;
    const text = format(this.#value());
    const field = make("input", {
      class: "typing", type: "text", inputmode: "decimal", value: text, "aria-label": this.#parameter?.label,
      autocomplete: "off", spellcheck: "false", enterkeyhint: "done",
    });
    field.style.setProperty("--digits", String(Math.max(text.length, 3)));
    const end = (/** @type {boolean} */ keep, /** @type {boolean} */ back) => {
      if (!this.#typing) return;
      this.#typing = false;
      const value = keep ? parse(field.value) : null;
      this.show(face);
      if (back) face.focus();
      if (value !== null) this.#set(value, null);
      this.#seen = null;
      this.update();
    };
    field.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Enter") end(true, true);
      else if (event.key === "Escape") end(false, true);
    });
    field.addEventListener("blur", () => end(true, false));
    this.show(field);
    field.focus();
    field.select();
  }

  /** @param {Parameter} parameter */
  #toggle(parameter) {
    const face = make("span", { class: "number", role: "switch", tabindex: 0, "aria-label": parameter.label });
    const flip = () => {
      if (!this.#closed()) this.#set(this.reader?.session.point.parameters[this.name] !== true, null);
    };
    face.addEventListener("click", flip);
    face.addEventListener("keydown", (event) => {
      if (event.key !== " " && event.key !== "Enter") return;
      event.preventDefault();
      flip();
    });
    return face;
  }

  /** @param {Parameter} parameter */
  #list(parameter) {
    const options = parameter.options ?? [];
    const names = options.map((value) => make("option", {}, [valueText(parameter, value)]));
    const list = make("select", { class: "choice", "aria-label": parameter.label }, names, {
      change: () => this.#set(options[list.selectedIndex], null),
    });
    return list;
  }

  #limits() {
    return /** @type {import("../ui/readers.js").Reader} */ (this.reader).allowed(
      /** @type {Parameter} */ (this.#parameter),
    );
  }

  #closed() {
    return !this.reader || !this.#parameter || this.#limits().closed;
  }

  #value() {
    return Number(this.reader?.session.point.parameters[this.name] ?? 0);
  }

  /** @param {import("../core/types.js").Value} wish @param {string | null} gesture @param {boolean} [coarse] */
  #set(wish, gesture, coarse = false) {
    const value = typeof wish === "number" ? fit(wish, this.#limits(), { coarse }) : wish;
    this.reader?.change({ parameters: { [this.name]: value } }, { gesture });
  }
}
