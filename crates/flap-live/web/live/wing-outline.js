// @ts-check

/** @import { WingShape } from "../types.d.ts" */

/** Intervals along the span. */
const INTERVALS = 40;

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
