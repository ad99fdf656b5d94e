// @ts-check
// The panel of parameters: sliders, fields, options, help.

import { byId, element } from "../shared/dom.js";
import { isFiniteNumber, roundedNumber } from "../shared/format.js";
import { inSI, splitNumber } from "../shared/typed-number.js";
import { setMessage } from "./banner.js";
import { opened, parameterNamed } from "./opened.js";
import { STEPS, sliderPlace, sliderStep, sliderValue } from "./slider.js";
import { setParameter, state, valueIn, valueText } from "./state.js";
import { symbolElement } from "./symbol.js";

/** @import { Parameter } from "../types.d.ts" */
/** @import { ServerError } from "./server.js" */

/** Groups that are open at first, unless they have at least `LARGE_GROUP` parameters. */
const OPEN_GROUPS = ["drive", "hinge", "wing", "transmission", "actuator"];
const LARGE_GROUP = 16;

/**
 * The elements of a parameter.
 *
 * @typedef {object} Row
 * @property {HTMLElement} row
 * @property {HTMLInputElement | null} slider
 * @property {HTMLInputElement | HTMLSelectElement} field
 * @property {HTMLElement} reset
 * @property {HTMLElement} problem
 */

/** @type {Map<string, Row>} */
const rows = new Map();
/** Problems of fields whose text is not a number, by parameter. @type {Map<string, string>} */
const fieldProblems = new Map();

export const panelEvents = {
  /** The time of the first movement of a slider since the last coarse family; undefined if there was none. */
  movedAt: /** @type {number | undefined} */ (undefined),
  /** After a change: `isDone` is false while a slider moves. */
  onChange: (/** @type {boolean} */ _isDone) => {},
  /** A slider has been released. */
  onRelease: () => {},
};

const rowOf = (/** @type {string} */ name) => /** @type {Row} */ (rows.get(name));

/** The placeholder of a parameter that is not set: the value that it takes. */
const unsetText = (/** @type {Parameter} */ { allowed }) => {
  const rule = allowed.split("if not set, ")[1] ?? "";
  return rule === "" || rule.startsWith("nothing") ? "not set" : rule;
};

/**
 * Sets a parameter and shows it.
 *
 * @param {string} name
 * @param {number | string | null} value
 * @param {boolean} isDone false while a slider moves
 */
const changeParameter = (name, value, isDone) => {
  setParameter(name, value);
  showParameter(name);
  panelEvents.onChange(isDone);
};

/** Applies the text of a field: a number, or text with a unit, which the server converts. */
const readField = (/** @type {string} */ name) => {
  const parameter = parameterNamed(name);
  const text = rowOf(name).field.value.trim();
  if (text === "") {
    // An empty field resets a parameter that the preset or [vehicle] sets.
    const canBeUnset = parameter.kind === "following" && parameter.published === null;
    return changeParameter(name, canBeUnset ? null : parameter.value, true);
  }
  const { number, rest, problem } = splitNumber(text);
  if (problem === undefined) {
    changeParameter(name, rest === "" ? inSI(number, parameter.factor) : `${number} ${rest}`, true);
  } else if (/^[-+−.\d]/.test(text)) {
    fieldProblems.set(name, problem);
    showProblems(null);
  } else changeParameter(name, text, true);
};

/** The inputs of a parameter: a menu, or a slider with a field. */
const inputsOf = (/** @type {Parameter} */ parameter) => {
  const { name, label, kind, unit } = parameter;
  const id = `p-${name}`;
  if (kind === "choice") {
    const options = (parameter.options ?? []).map((option) => element("option", { value: option }, option));
    const field = element("select", { id, style: "grid-column: 1 / 4" }, ...options);
    field.onchange = () => changeParameter(name, field.value, true);
    return { slider: null, field, inputs: element("div", { class: "inputs" }, field) };
  }
  const disabled = kind === "derived";
  const range = { type: "range", min: "0", max: String(STEPS), step: String(sliderStep(parameter)) };
  const slider = element("input", { ...range, "aria-label": `${label}, slider`, disabled });
  const placeholder = kind === "following" ? unsetText(parameter) : "";
  const field = element("input", { id, inputmode: "decimal", disabled, placeholder });
  slider.oninput = () => {
    panelEvents.movedAt ??= performance.now();
    changeParameter(name, sliderValue(parameter, Number(slider.value)), false);
  };
  slider.onchange = () => panelEvents.onRelease();
  field.onchange = () => readField(name);
  const inputs = element("div", { class: "inputs" }, slider, field, element("span", { class: "unit" }, unit));
  return { slider, field, inputs };
};

const parameterRow = (/** @type {Parameter} */ parameter) => {
  const { name, label, doc, allowed, fitted, symbol, value } = parameter;
  const { slider, field, inputs } = inputsOf(parameter);
  const reset = element("button", { type: "button", title: "Reset", "aria-label": `Reset ${label}` }, "↺");
  const helpLabel = { "aria-expanded": "false", "aria-label": `Help on ${label}` };
  const helpButton = element("button", { type: "button", ...helpLabel }, "?");
  const fit = fitted ? " The published value was fitted to one vehicle." : "";
  const help = element("p", { class: "help", hidden: true }, `${doc} Allowed: ${allowed}. Name: ${name}.${fit}`);
  const problem = element("p", { class: "problem", role: "alert", hidden: true });
  const labelElement = element("label", { for: `p-${name}` }, label);
  const heading = element("div", { class: "name" }, labelElement, symbolElement(symbol), reset, helpButton);
  const row = element("div", { class: "parameter", "data-name": name }, heading, inputs, help, problem);
  reset.onclick = () => {
    changeParameter(name, value, true);
    field.focus();
  };
  helpButton.onclick = () => {
    help.hidden = !help.hidden;
    helpButton.setAttribute("aria-expanded", String(!help.hidden));
  };
  rows.set(name, { row, slider, field, reset, problem });
  return row;
};

/** Shows the parameters that contain all words of the search. */
const search = () => {
  const words = byId("search").value.toLowerCase().split(/\s+/).filter(Boolean);
  for (const details of byId("groups").querySelectorAll("details")) {
    let isFound = false;
    for (const row of /** @type {NodeListOf<HTMLElement>} */ (details.querySelectorAll(".parameter"))) {
      const { name, label, symbol, doc, group } = parameterNamed(row.dataset.name ?? "");
      const text = `${name} ${label} ${symbol} ${doc} ${group}`.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
      isFound ||= !row.hidden;
    }
    details.hidden = !isFound;
    if (words.length > 0) details.open = true;
  }
};

const resetAll = () => {
  state.design = {};
  state.hidden = [];
  setMessage("address", "");
  showPanel();
  panelEvents.onChange(true);
};

export const buildPanel = () => {
  /** @type {Map<string, Parameter[]>} */
  const groups = new Map();
  for (const parameter of opened.parameters) {
    const group = groups.get(parameter.group);
    if (group) group.push(parameter);
    else groups.set(parameter.group, [parameter]);
  }
  const details = [...groups].map(([group, parameters]) => {
    const open = group === "drive" || (OPEN_GROUPS.includes(group) && parameters.length < LARGE_GROUP);
    const summary = element("summary", {}, group || "parameters");
    return element("details", { open, "data-group": group }, summary, ...parameters.map(parameterRow));
  });
  byId("groups").replaceChildren(...details);
  byId("search").oninput = search;
  byId("panel").onsubmit = (event) => event.preventDefault();
  byId("reset-all").onclick = resetAll;
};

const showParameter = (/** @type {string} */ name) => {
  const parameter = parameterNamed(name);
  const { row, slider, field, reset } = rowOf(name);
  const value = valueIn(state.design, name);
  const isChanged = name in state.design;
  fieldProblems.delete(name);
  row.classList.toggle("changed", isChanged);
  reset.hidden = !isChanged;
  if (isFiniteNumber(value)) {
    const text = roundedNumber(value * parameter.factor, 6);
    if (field.value !== text) field.value = text;
    const place = Math.round(sliderPlace(parameter, value));
    if (slider && Math.round(Number(slider.value)) !== place) slider.value = String(place);
  } else field.value = value ?? "";
  slider?.setAttribute("aria-valuetext", valueText(parameter, value));
};

/** Shows the design in all fields. */
export const showPanel = () => {
  for (const name of rows.keys()) showParameter(name);
};

/** True if an error concerns a changed parameter, whose field shows it. */
export const isFieldError = (/** @type {ServerError} */ { parameter }) =>
  parameter !== null && parameter in state.design && rows.has(parameter);

/** Marks the fields whose text is not a number, and the field whose value the server has refused. */
export const showProblems = (/** @type {ServerError | null} */ error) => {
  for (const [name, { field, problem }] of rows) {
    const text = fieldProblems.get(name) ?? (error?.parameter === name ? error.text() : "");
    if (text) field.setAttribute("aria-invalid", "true");
    else field.removeAttribute("aria-invalid");
    problem.hidden = !text;
    if (problem.textContent !== text) problem.textContent = text;
    const group = problem.closest("details");
    if (text && group) group.open = true;
  }
};

/** Shows a parameter and moves the focus to it. */
export const focusParameter = (/** @type {string} */ name) => {
  const { row, slider, field } = rowOf(name);
  const group = row.closest("details");
  row.hidden = false;
  if (group) Object.assign(group, { hidden: false, open: true });
  (slider ?? field).focus();
  row.scrollIntoView({ block: "nearest" });
};
