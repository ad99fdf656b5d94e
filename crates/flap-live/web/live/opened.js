// @ts-check
// The design that was opened: its parameters, measures and first view, as the server has written them into the page.

import { byId } from "../shared/dom.js";

/** @import { Measure, OpenedDesign, Parameter } from "../types.d.ts" */

/** @type {OpenedDesign} */
export const opened = JSON.parse(byId("data").textContent ?? "");

const parameters = new Map(opened.parameters.map((parameter) => [parameter.name, parameter]));
const measures = new Map(opened.measures.map((measure) => [measure.name, measure]));

export const hasParameter = (/** @type {string} */ name) => parameters.has(name);
export const hasMeasure = (/** @type {string} */ name) => measures.has(name);

/** The parameter with this name. The caller has made sure that there is one. */
export const parameterNamed = (/** @type {string} */ name) => /** @type {Parameter} */ (parameters.get(name));
/** The measure with this name. The caller has made sure that there is one. */
export const measureNamed = (/** @type {string} */ name) => /** @type {Measure} */ (measures.get(name));

/** The parameters that the chart can vary: numbers that no formula gives. */
export const variableParameters = opened.parameters.filter(({ kind }) => kind === "number" || kind === "following");

/** True for several wings on a body: their rows have the sums of the wings, and there is no single motion. */
export const isVehicle = hasMeasure("torque_roll_unm");
