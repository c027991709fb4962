/** One line of a figure's controls: a name, what one moves, and in words why it is closed. */

import { make, setAll, setText, unique } from "./elements.js";

/**
 * @typedef {import("../core/types.js").Parameter} Parameter
 * @typedef {import("../core/types.js").Value} Value
 * @typedef {import("./limits.js").Allowed} Allowed
 *
 * @typedef {object} Control
 * @property {HTMLElement} element
 * @property {(value: Value, limits: Allowed) => void} show
 * @property {(name: string | null) => void} [plays] which axis plays now
 */

/**
 * @typedef {object} Row
 * @property {HTMLElement} element
 * @property {(limits: Allowed) => void} close or open, by what is allowed
 */

/**
 * @param {Parameter} parameter
 * @param {(Node | null)[]} body
 * @param {HTMLElement[]} fields what is described and closed
 * @param {{ group?: boolean }} [options] group: several fields under one name
 * @returns {Row}
 */
export function row(parameter, body, fields, { group = false } = {}) {
  const names = { tip: unique("tip"), why: unique("why"), label: unique("label") };
  const doc = parameter.doc && parameter.doc !== parameter.label ? parameter.doc : "";
  const tip = doc ? make("span", { role: "tooltip", class: "tip", id: names.tip }, [doc]) : null;
  const why = make("p", { class: "why", id: names.why, hidden: true });
  const name = make("span", { class: "name", id: names.label }, [parameter.label]);
  const settings = group ? { role: "group", "aria-labelledby": names.label } : {};
  const attributes = { class: "control", "data-kind": parameter.kind, ...settings };
  const element = make("div", attributes, [name, ...body, tip, why], {
    keydown: (event) => { if (event.key === "Escape") element.dataset.quiet = ""; },
    focusout: () => { delete element.dataset.quiet; },
    pointerleave: () => { delete element.dataset.quiet; },
  });
  if (!group && fields[0]) {
    name.addEventListener("click", () => fields[0].focus());
  }
  return {
    element,
    close(limits) {
      const described = [doc ? names.tip : "", limits.why ? names.why : ""].filter(Boolean).join(" ");
      for (const field of fields) {
        setAll(field, { "aria-describedby": described || null });
        if ("disabled" in field) field.disabled = limits.closed;
        else setAll(field, { "aria-disabled": limits.closed || null, tabindex: limits.closed ? null : 0 });
      }
      setText(why, limits.why);
      why.hidden = limits.why === "";
      element.toggleAttribute("data-closed", limits.closed);
    },
  };
}
