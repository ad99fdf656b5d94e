// @ts-check
// Pinned designs, shown side by side.

import { byId, element } from "../shared/dom.js";
import { isFiniteNumber, labelWithUnit, roundedNumber } from "../shared/format.js";
import { answerValue, MAIN_MEASURES, presentAnswer } from "./design-numbers.js";
import { hasMeasure, hasParameter, measureNamed, parameterNamed } from "./opened.js";
import { panelEvents, showPanel } from "./panel.js";
import { request, ServerError } from "./server.js";
import { saveState, state, valueIn, valueText } from "./state.js";

/** @import { Design, LiveState, PointAnswer } from "../types.d.ts" */
/** @typedef {LiveState["pins"][number]} Pin */

const MOST_PINS = 8;
/** Largest number of rows of measures. */
const MOST_MEASURES = 7;

/** Numbers of pinned designs by `pinKey`; null if there are none. @type {Map<string, PointAnswer | null>} */
const answers = new Map();

const pinKey = (/** @type {Design} */ design) => JSON.stringify(Object.entries(design).sort());

/** Pins the design. If there are too many pins, removes the oldest one. */
export const addPin = () => {
  if (state.pins.length === MOST_PINS) state.pins.shift();
  const taken = state.pins.map((pin) => pin.name);
  const letters = Array.from({ length: MOST_PINS + 1 }, (_, i) => String.fromCharCode(65 + i));
  const name = letters.find((letter) => !taken.includes(letter)) ?? "";
  state.pins.push({ name, design: { ...state.design } });
  showPins();
};

/** Computes the numbers of a pinned design once. */
const requestPin = async (/** @type {Pin} */ { name, design }) => {
  const key = pinKey(design);
  if (answers.has(key)) return;
  try {
    const answer = await request("point", { design, gradient: null }, `pin ${name}`);
    if (!answer) return;
    answers.set(key, answer);
    showPins();
  } catch (error) {
    // After a lost connection, the numbers are requested again.
    const isLost = error instanceof ServerError && error.status === 0;
    if (!isLost) answers.set(key, null);
  }
};

/** The heading of a pin, with its buttons. */
const pinHeading = (/** @type {Pin} */ pin, /** @type {number} */ place) => {
  const restore = element("button", { type: "button", "aria-label": `restore ${pin.name}` }, "Restore");
  const remove = element("button", { type: "button", "aria-label": `remove ${pin.name}` }, "×");
  restore.onclick = () => {
    state.design = { ...pin.design };
    showPanel();
    panelEvents.onChange(true);
  };
  remove.onclick = () => {
    state.pins.splice(place, 1);
    showPins();
    saveState(true);
  };
  return element("th", {}, pin.name, " ", restore, " ", remove);
};

const tableRow = (/** @type {string} */ label, /** @type {string[]} */ cells) =>
  element("tr", {}, element("td", {}, label), ...cells.map((text) => element("td", {}, text)));

/** Shows the pins beside the design: the parameters that differ, and the main measures. */
export const showPins = () => {
  const { pins, design, measure } = state;
  byId("pins").hidden = pins.length === 0;
  if (pins.length === 0) return;
  pins.forEach(requestPin);
  const designs = [...pins.map((pin) => pin.design), design];
  const changed = [...new Set(designs.flatMap(Object.keys))].filter(hasParameter);
  const parameterRows = changed.map((name) => {
    const parameter = parameterNamed(name);
    return tableRow(
      parameter.label,
      designs.map((each) => valueText(parameter, valueIn(each, name))),
    );
  });
  const found = [...pins.map((pin) => answers.get(pinKey(pin.design))), presentAnswer()];
  const isKnown = (/** @type {string} */ name) => found.some((answer) => isFiniteNumber(answerValue(answer, name)));
  const others = MAIN_MEASURES.filter((name) => name !== measure && isKnown(name));
  const measures = [measure, ...others].filter(hasMeasure).slice(0, MOST_MEASURES);
  const measureRows = measures.map((name) => {
    const values = found.map((answer) => answerValue(answer, name));
    const cells = values.map((value) => (isFiniteNumber(value) ? roundedNumber(value, 5) : "–"));
    return tableRow(labelWithUnit(measureNamed(name)), cells);
  });
  const head = element("tr", {}, element("th", {}, ""), ...pins.map(pinHeading), element("th", {}, "now"));
  const body = element("tbody", {}, ...parameterRows, ...measureRows);
  byId("pin-table").replaceChildren(element("table", {}, element("thead", {}, head), body));
};
