// @ts-check
// The state of the page (design, axes of the chart, pins), and its text in the address.

import { writeAddress } from "../shared/address.js";
import { isFiniteNumber, shortNumber } from "../shared/format.js";
import { hasMeasure, hasParameter, opened, parameterNamed } from "./opened.js";

/** @import { Design, LiveState, Parameter } from "../types.d.ts" */

/** @returns {LiveState} */
const freshState = () => ({
  design: {},
  x: { name: opened.view.x.name, from: opened.view.x.from, to: opened.view.x.to },
  by: opened.view.by && { name: opened.view.by.name, values: [...opened.view.by.values] },
  measure: opened.view.measure,
  log: { x: false, y: false },
  view: { x: null, y: null },
  updown: false,
  hidden: [],
  pins: [],
});

export const state = freshState();

/** The parameter along x. */
export const xParameter = () => parameterNamed(state.x.name);

/** The parameter with a line for each of its values; null if there is none, or if responses up and down are shown. */
export const lineParameter = () => (state.updown || !state.by ? null : parameterNamed(state.by.name));

/**
 * The value of a parameter in a design: the changed value, or the value that was opened.
 *
 * @param {Design} design
 * @param {string} name
 */
export const valueIn = (design, name) => (name in design ? design[name] : parameterNamed(name).value);

/**
 * A value as text, with the unit that is shown.
 *
 * @param {Parameter} parameter
 * @param {number | string | null | undefined} value
 */
export const valueText = (parameter, value) => {
  if (value === null || value === undefined) return "not set";
  if (typeof value === "string") return value;
  return `${shortNumber(value * parameter.factor)}${parameter.unit ? ` ${parameter.unit}` : ""}`;
};

/**
 * Sets a parameter of the design. If the value equals the opened value, the change is removed.
 *
 * @param {string} name
 * @param {number | string | null} value
 */
export const setParameter = (name, value) => {
  if (value === parameterNamed(name).value) delete state.design[name];
  else state.design[name] = value;
};

/** The warning for an address that was made with another preset; empty if none is needed. */
export const foreignPresetWarning = (/** @type {any} */ found) => {
  const preset = found && typeof found === "object" ? found.preset : undefined;
  if (typeof preset !== "string" || preset === opened.preset) return "";
  return `The address was made with the preset ${preset}. Its changes are applied to the preset ${opened.preset}.`;
};

/** @returns {Design} the changes of a design that this model has */
const knownChanges = (/** @type {any} */ design) =>
  Object.fromEntries(
    Object.entries(design ?? {}).filter(
      ([name, value]) => hasParameter(name) && (value === null || isFiniteNumber(value) || typeof value === "string"),
    ),
  );

const isRange = (/** @type {unknown} */ range) =>
  range === null || (Array.isArray(range) && range.length === 2 && range.every(isFiniteNumber));

/** Applies the state in an address, except parameters and measures that this model does not have. */
export const applyState = (/** @type {any} */ found) => {
  Object.assign(state, freshState());
  if (!found || typeof found !== "object") return;
  state.design = knownChanges(found.design);
  const { x, by, log, view } = found;
  if (x && hasParameter(x.name) && isFiniteNumber(x.from) && isFiniteNumber(x.to)) {
    state.x = { name: x.name, from: x.from, to: x.to };
  }
  if (by === null) state.by = null;
  const isValue = (/** @type {unknown} */ value) => isFiniteNumber(value) || typeof value === "string";
  if (by && hasParameter(by.name) && Array.isArray(by.values) && by.values.every(isValue)) {
    state.by = { name: by.name, values: by.values };
  }
  if (hasMeasure(found.measure)) state.measure = found.measure;
  if (log) state.log = { x: Boolean(log.x), y: Boolean(log.y) };
  if (view && isRange(view.x ?? null) && isRange(view.y ?? null)) {
    state.view = { x: view.x ?? null, y: view.y ?? null };
  }
  state.updown = found.updown === true;
  if (Array.isArray(found.hidden)) {
    state.hidden = found.hidden.filter((/** @type {unknown} */ group) => typeof group === "string");
  }
  if (Array.isArray(found.pins)) {
    const pins = found.pins.filter((/** @type {any} */ pin) => pin && typeof pin.name === "string");
    state.pins = pins.map((/** @type {any} */ pin) => ({ name: pin.name, design: knownChanges(pin.design) }));
  }
};

/** Writes the preset and the differences from the first view into the address. */
export const saveState = (/** @type {boolean} */ isStep) => {
  /** @type {Record<string, unknown>} */
  const fresh = { ...freshState() };
  const changes = Object.entries(state).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(fresh[key]));
  if (changes.length === 0 && !location.hash) return;
  writeAddress({ preset: opened.preset, ...Object.fromEntries(changes) }, isStep);
};
