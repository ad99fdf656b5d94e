// @ts-check
// The scale of a parameter's slider.

/** @import { Parameter } from "../types.d.ts" */

/** @typedef {Pick<Parameter, "low" | "high" | "log" | "whole">} SliderScale */

/** Number of steps of a slider. */
export const STEPS = 1000;

/**
 * The place of a value on a slider, from 0 to `STEPS`.
 *
 * @param {SliderScale} scale
 * @param {number} value
 */
export const sliderPlace = ({ low, high, log }, value) =>
  STEPS * (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));

/** The distance of neighbouring places of a slider. For whole numbers it is rounded down, so that the last place remains. */
export const sliderStep = (/** @type {SliderScale} */ { low, high, whole }) =>
  whole ? Math.floor((1e6 * STEPS) / (high - low)) / 1e6 : 1;

/**
 * The value at a place of a slider, to six digits.
 *
 * @param {SliderScale} scale
 * @param {number} place
 */
export const sliderValue = ({ low, high, log, whole }, place) => {
  const share = place / STEPS;
  const value = log ? low * (high / low) ** share : low + share * (high - low);
  return whole ? Math.round(value) : Number(value.toPrecision(6));
};
