// @ts-check
// Lines of a chart: their groups, their values, and the range of an axis.

/** @import { Line } from "../types.d.ts" */

/** The group of a line, which the legend switches on and off. */
export const groupOf = (/** @type {Pick<Line, "group" | "key">} */ line) => line.group ?? line.key;

/** The first line of each group that has an entry in the legend. */
export const legendLines = (/** @type {Line[]} */ lines) => {
  /** @type {Map<string, Line>} */
  const groups = new Map();
  for (const line of lines) {
    if (line.name && !line.ghost && !groups.has(groupOf(line))) groups.set(groupOf(line), line);
  }
  return [...groups.values()];
};

/**
 * The lines that the pointer can mark: all lines except ghosts and lines that the legend has switched off.
 *
 * @param {Line[]} lines
 * @param {Set<string>} hidden
 */
export const reachableLines = (lines, hidden) => lines.filter((line) => !line.ghost && !hidden.has(groupOf(line)));

/** True if a line has a value at a place. */
export const hasValue = (/** @type {Line} */ line, /** @type {number} */ place) =>
  line.y[place] !== null && line.y[place] !== undefined;

/**
 * The places of values between two gaps, which are drawn as points because no line leads to them; null if there are
 * none. `null` is a gap; `undefined` is a place that only other lines have.
 *
 * @param {(number | null | undefined)[]} values
 */
export const isolatedPoints = (values) => {
  const places = [];
  let before = null; // the value before the last one
  let last = -1; // the place of the last value
  for (let i = 0; i <= values.length; i++) {
    const value = i === values.length ? null : values[i];
    if (value === undefined) continue;
    if (last >= 0 && values[last] !== null && before === null && value === null) places.push(last);
    before = last < 0 ? null : values[last];
    last = i;
  }
  return places.length > 0 ? places : null;
};

/**
 * The place of the value nearest to `value` in a rising list.
 *
 * @param {number[]} list
 * @param {number} value
 */
export const nearestPlace = (list, value) => {
  let low = 0;
  let high = list.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (list[middle] < value) low = middle;
    else high = middle;
  }
  return value - list[low] < list[high] - value ? low : high;
};

/**
 * The range of an axis with values from `low` to `high`, with the share `margin` added on both sides. If the margin is
 * more than 0.05 and the values come near zero, the range begins at zero.
 *
 * @param {number | null} low
 * @param {number | null} high
 * @param {boolean} log
 * @param {number} margin
 * @returns {[number, number]}
 */
export const axisRange = (low, high, log, margin) => {
  if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return log ? [1, 10] : [0, 1];
  if (log) return low === high ? [low / 2, high * 2] : [low / (high / low) ** margin, high * (high / low) ** margin];
  if (low === high) {
    const around = high === 0 ? 1 : 0.05 * Math.abs(high);
    return [low - around, high + around];
  }
  const room = margin * (high - low);
  return [margin > 0.05 && low >= 0 && low < 0.3 * high ? 0 : low - room, high + room];
};
