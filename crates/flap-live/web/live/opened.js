// @ts-check
// The design that was opened: its parameters, measures and first view, as data that the server has written into the page.

import { byId } from "../shared/dom.js";

/** @import { Measure, OpenedDesign, Parameter } from "../types.d.ts" */

/** @type {OpenedDesign} */
export const opened = JSON.parse(byId("data").textContent ?? "");

const parameters = new Map(opened.parameters.map((parameter) => [parameter.name, parameter]));
const measures = new Map(opened.measures.map((measure) => [measure.name, measure]));

export const hasParameter = (/** @type {string} */ name) => parameters.has(name);
export const hasMeasure = (/** @type {string} */ name) => measures.has(name);

/** The parameter with this name, which must exist. */
export const parameterNamed = (/** @type {string} */ name) => /** @type {Parameter} */ (parameters.get(name));
/** The measure with this name, which must exist. */
export const measureNamed = (/** @type {string} */ name) => /** @type {Measure} */ (measures.get(name));

/** The parameters that the chart can vary: numbers that are not computed by a formula. */
export const variableParameters = opened.parameters.filter(({ kind }) => kind === "number" || kind === "following");

/** True for a vehicle of several wings: its rows have the sums over the wings, and there is no single motion. */
export const isVehicle = hasMeasure("torque_roll_unm");
