// @ts-check
// The controls above the chart: measure, axes, lines.

import { byId, element } from "../shared/dom.js";
import { isFiniteNumber, roundedNumber } from "../shared/format.js";
import { inSI, typedList, typedNumber } from "../shared/typed-number.js";
import { opened, parameterNamed, variableParameters } from "./opened.js";
import { state, valueIn, xParameter } from "./state.js";

/** @import { Parameter } from "../types.d.ts" */

export const axisEvents = {
  /** The rows to show have changed. */
  onChange: () => {},
  /** An axis has become linear or logarithmic. */
  onScale: () => {},
  /** The responses up and down are switched on or off. */
  onUpDown: () => {},
};

/** Lines of a new family. */
const LINES = 5;

const ENDS = /** @type {const} */ (["from", "to"]);
const SCALES = /** @type {const} */ (["x", "y"]);

/** Shows the state in the controls. */
export const showAxisControls = () => {
  const x = xParameter();
  const by = state.by && parameterNamed(state.by.name);
  byId("measure").value = state.measure;
  byId("x").value = x.name;
  byId("x-unit").textContent = x.unit;
  byId("x-problem").hidden = true;
  for (const end of ENDS) {
    byId(`x-${end}`).removeAttribute("aria-invalid");
    byId(`x-${end}`).value = roundedNumber(state.x[end] * x.factor, 6);
  }
  byId("by").value = by?.name ?? "";
  byId("by-unit").textContent = by?.unit ?? "";
  byId("by-values").disabled = !by;
  const values = (by && state.by?.values) ?? [];
  const texts = values.map((value) =>
    typeof value === "number" ? roundedNumber(value * (by?.factor ?? 1), 6) : value,
  );
  byId("by-values").value = texts.join(", ");
  for (const scale of SCALES) byId(`log-${scale}`).checked = state.log[scale];
  byId("hysteresis").setAttribute("aria-pressed", String(state.updown));
};

/** A range around the value of a parameter, within the limits of allowed values. */
const rangeAround = (/** @type {Parameter} */ { name, low, high, limits }) => {
  const value = valueIn(state.design, name);
  if (!isFiniteNumber(value) || value <= 0) return { from: low, to: high };
  const [least, most] = limits ?? [0, Number.POSITIVE_INFINITY];
  return { from: Math.max(0.6 * value, least), to: Math.min(1.4 * value, most) };
};

/** Shows everything, after a change of the rows. */
const changed = () => {
  state.view = { x: null, y: null };
  showAxisControls();
  axisEvents.onChange();
};

/** Takes over the text of an end of the axis, or shows its problem. */
const readEnd = (/** @type {"from" | "to"} */ end) => {
  const field = byId(`x-${end}`);
  const { unit, factor } = xParameter();
  if (field.value.trim() === "") return showAxisControls();
  const { number = Number.NaN, problem } = typedNumber(field.value, unit);
  const value = inSI(number, factor);
  const isSame = value === state.x[end === "from" ? "to" : "from"];
  if (problem !== undefined || isSame) {
    field.setAttribute("aria-invalid", "true");
    byId("x-problem").textContent = problem ?? "“from” and “to” must differ";
    byId("x-problem").hidden = false;
    return;
  }
  state.x[end] = value;
  changed();
};

const chooseLines = (/** @type {string} */ name) => {
  state.hidden = [];
  state.by = null;
  if (name && state.x.name !== name) {
    const parameter = parameterNamed(name);
    const { from, to } = rangeAround(parameter);
    const values = Array.from({ length: LINES }, (_, i) => from + (i * (to - from)) / (LINES - 1));
    const rounded = values.map((value) => (parameter.whole ? Math.round(value) : Number(value.toPrecision(4))));
    state.by = { name, values: [...new Set(rounded)] };
  }
  changed();
};

export const buildAxisControls = () => {
  const options = (/** @type {{ name: string, label: string }[]} */ list) =>
    list.map(({ name, label }) => element("option", { value: name }, label));
  byId("measure").append(...options(opened.measures));
  // Most values between two ends are not whole.
  byId("x").append(...options(variableParameters.filter(({ name, whole }) => !whole || name === opened.view.x.name)));
  byId("by").append(element("option", { value: "" }, "none"), ...options(variableParameters));
  byId("measure").onchange = () => {
    state.measure = byId("measure").value;
    changed();
  };
  byId("x").onchange = () => {
    const name = byId("x").value;
    if (state.by?.name === name) state.by = null;
    state.x = { name, ...rangeAround(parameterNamed(name)) };
    changed();
  };
  for (const end of ENDS) byId(`x-${end}`).onchange = () => readEnd(end);
  byId("by").onchange = () => chooseLines(byId("by").value);
  byId("by-values").onchange = () => {
    if (!state.by) return;
    state.by.values = typedList(byId("by-values").value, parameterNamed(state.by.name).factor);
    changed();
  };
  for (const scale of SCALES) {
    byId(`log-${scale}`).onchange = () => {
      state.log[scale] = byId(`log-${scale}`).checked;
      state.view = { x: null, y: null };
      axisEvents.onScale();
    };
  }
  byId("hysteresis").onclick = () => {
    state.updown = !state.updown;
    state.hidden = [];
    showAxisControls();
    axisEvents.onUpDown();
  };
};
