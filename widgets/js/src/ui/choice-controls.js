/** Controls of choices: a switch, a list, a colour. */

import { fromHex, toHex } from "./colours.js";
import { make, setText, unique } from "./elements.js";
import { format } from "./formats.js";
import { row } from "./rows.js";

/**
 * @typedef {import("../core/types.js").Parameter} Parameter
 * @typedef {import("../core/types.js").Value} Value
 * @typedef {import("./readers.js").Reader} Reader
 * @typedef {import("./rows.js").Control} Control
 */

/** @param {Parameter} parameter @param {Reader} reader @returns {Control} */
export function switchControl(parameter, reader) {
  const settings = { type: "checkbox", role: "switch", class: "switch", "aria-label": parameter.label };
  const input = make("input", settings, [], {
    change: () => reader.change({ parameters: { [parameter.name]: input.checked } }),
  });
  const state = make("span", { class: "state", "aria-hidden": "true" });
  const line = row(parameter, [make("span", { class: "field" }, [input, state])], [input]);
  return {
    element: line.element,
    show(value, limits) {
      line.close(limits);
      input.checked = value === true;
      setText(state, input.checked ? "on" : "off");
    },
  };
}

/**
 * A list of the options; of those that are baked if only they can be shown.
 * @param {Parameter} parameter
 * @param {Reader} reader
 * @returns {Control}
 */
export function selectControl(parameter, reader) {
  const given = parameter.options ?? parameter.stops ?? [];
  const all = parameter.optional && !given.includes(null) ? [...given, null] : given;
  const labels = all.map((value, i) => parameter.labels?.[i] ?? (value === null ? "none" : format(value)));
  const known = new Set(parameter.stops?.map((stop) => JSON.stringify(stop)));
  const shown = parameter.grade === "stops" && known.size ? all.filter((v) => known.has(JSON.stringify(v))) : all;
  const options = shown.map((value) => make("option", {}, [labels[all.indexOf(value)]]));
  const select = make("select", { "aria-label": parameter.label }, options, {
    change: () => reader.change({ parameters: { [parameter.name]: shown[select.selectedIndex] } }),
  });
  const line = row(parameter, [make("span", { class: "field" }, [select])], [select]);
  return {
    element: line.element,
    show(value, limits) {
      line.close(limits);
      const key = JSON.stringify(value);
      select.selectedIndex = shown.findIndex((option) => JSON.stringify(option) === key);
    },
  };
}

/** @param {Parameter} parameter @param {Reader} reader @returns {Control} */
export function colorControl(parameter, reader) {
  return parameter.grade === "stops" && parameter.stops?.length
    ? swatchControl(parameter, reader, parameter.stops)
    : pickerControl(parameter, reader);
}

/** @param {Parameter} parameter @param {Reader} reader @returns {Control} */
function pickerControl(parameter, reader) {
  const { name, label } = parameter;
  /** @type {Value} */
  let now = parameter.default;
  const set = (/** @type {number | undefined} */ opacity) => {
    const value = fromHex(picker.value, now, opacity);
    reader.change({ parameters: { [name]: value } }, { gesture: reader.gestures.again(name) });
  };
  const picker = make("input", { type: "color", "aria-label": label }, [], { input: () => set(undefined) });
  const alpha = make("input", { type: "range", min: 0, max: 1, step: 0.01, "aria-label": `${label}, opacity` }, [], {
    input: () => set(alpha.valueAsNumber),
  });
  const line = row(parameter, [make("span", { class: "field" }, [picker, alpha])], [picker, alpha]);
  return {
    element: line.element,
    show(value, limits) {
      line.close(limits);
      now = value;
      const { hex, opacity } = toHex(value);
      if (picker.value !== hex) picker.value = hex;
      alpha.hidden = opacity === null;
      if (opacity !== null && alpha.valueAsNumber !== opacity) alpha.value = String(opacity);
    },
  };
}

/**
 * The baked colours, as one group of radio buttons.
 * @param {Parameter} parameter
 * @param {Reader} reader
 * @param {readonly Value[]} stops
 * @returns {Control}
 */
function swatchControl(parameter, reader, stops) {
  const group = unique("swatches");
  const inputs = stops.map((stop) => {
    const input = make("input", { type: "radio", name: group, "aria-label": format(stop) }, [], {
      change: () => reader.change({ parameters: { [parameter.name]: stop } }),
    });
    input.style.setProperty("--swatch", toHex(stop).hex);
    return input;
  });
  const line = row(parameter, [make("span", { class: "field swatches" }, inputs)], inputs, { group: true });
  return {
    element: line.element,
    show(value, limits) {
      line.close(limits);
      const key = JSON.stringify(value);
      stops.forEach((stop, i) => { inputs[i].checked = JSON.stringify(stop) === key; });
    },
  };
}
