// @ts-check
// The outline of a wing.

import { isFiniteNumber } from "../shared/format.js";

/** @import { Design, WingShape } from "../types.d.ts" */

/** Intervals along the span. */
const INTERVALS = 40;
/** Root chord of the usual outline, in mean chords: the mean of √(1 − s⁴) over s from 0 to 1 is 0.87402. */
const ROOT_CHORD = 1 / 0.87402;

/**
 * The shape of a wing with these values of its parameters; null if the model does not have its length.
 *
 * @param {Design} values
 * @returns {WingShape | null}
 */
export const wingShape = (values) => {
  const number = (/** @type {string} */ name) => {
    const value = values[name];
    return isFiniteNumber(value) ? value : null;
  };
  const length = number("wing_length");
  if (!length) return null;
  const area = number("wing_area");
  const meanChord = number("mean_chord") ?? (area === null ? length / 4 : area / length);
  const rootChord = number("root_chord");
  let chord = (/** @type {number} */ share) => meanChord * ROOT_CHORD * Math.sqrt(Math.max(1 - share ** 4, 0));
  if (rootChord !== null) {
    const terms = [0, 1, 2, 3, 4].map((power) => number(`chord_term_${power}`) ?? 0);
    chord = (share) => rootChord * terms.reduce((sum, term, power) => sum + term * share ** power, 0);
  }
  if ("chord_table" in values && values.chord_table !== "off") {
    const table = Array.from({ length: 11 }, (_, i) => number(`chord_${i}`) ?? 0);
    chord = (share) => {
      const place = Math.min(Math.floor(share * 10), 9);
      const part = share * 10 - place;
      return table[place] * (1 - part) + table[place + 1] * part;
    };
  }
  return { length, offset: number("wing_offset") ?? 0, axis: number("axis_position") ?? 0.1, chord };
};

/**
 * Points [along the span, ahead of the axis] of a wing's outline in metres: the leading edge outwards, then back along
 * the trailing edge.
 *
 * @param {WingShape} shape
 */
export const wingOutline = ({ length, offset, chord, axis }) => {
  const shares = Array.from({ length: INTERVALS + 1 }, (_, i) => i / INTERVALS);
  const edge = (/** @type {number} */ place) =>
    shares.map((share) => [offset + share * length, place * Math.max(chord(share), 0)]);
  return [...edge(axis), ...edge(axis - 1).reverse()];
};
