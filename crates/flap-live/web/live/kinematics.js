// @ts-check
// The signals of a motion over a cycle.

/** @import { Signals } from "../types.d.ts" */

/** The integral of a signal over the stroke. */
const overStroke = (/** @type {number[]} */ values, /** @type {number[]} */ stroke) => {
  let sum = 0;
  for (let i = 1; i < stroke.length; i++) sum += values[i] * (stroke[i] - stroke[i - 1]);
  return sum;
};

/** 1 if the pitch is positive while the stroke rises, else -1. The trailing edge follows the leading edge. */
export const pitchSign = (/** @type {Signals} */ { stroke_deg: stroke, pitch_deg: pitch }) =>
  overStroke(pitch ?? [], stroke ?? []) < 0 ? -1 : 1;

/** The sign that makes drag point against the motion. */
export const dragSign = (/** @type {Signals} */ { stroke_deg: stroke, drag_mn: drag }) =>
  overStroke(drag ?? [], stroke ?? []) > 0 ? -1 : 1;

/**
 * The values of the signals at a share of the cycle, between two samples; 0 for a signal that is missing.
 *
 * @param {Signals} signals
 * @param {number} share
 */
export const valuesAt = (signals, share) =>
  Object.fromEntries(
    Object.entries(signals).map(([name, list]) => {
      if (!list) return [name, 0];
      const place = share * (list.length - 1);
      const low = Math.min(Math.floor(place), list.length - 2);
      const part = place - low;
      return [name, list[low] * (1 - part) + list[low + 1] * part];
    }),
  );
