// @ts-check
// Gaps of lines: values of x without a settled motion. They are marks at the foot of the chart, a row for each status.

/** @import { Chart, Gap, Mark } from "../types.d.ts" */

/** The distance of the first row of marks from the foot, and between two rows, in pixels. */
const FOOT = 6;
const ROW_HEIGHT = 10;
/** Largest distance of the pointer from a mark, in pixels. */
const REACH = 7;

/** The height of a row of marks above the foot, in pixels. */
export const gapHeight = (/** @type {number} */ row) => FOOT + row * ROW_HEIGHT;

/** The statuses of gaps, one for each row of marks, from the foot upwards. */
export const gapStatuses = (/** @type {Gap[]} */ gaps) => [...new Set(gaps.map(({ status }) => status))];

/**
 * The marks to paint, with pixels from the left and the row. One is painted where several would hide each other.
 *
 * @param {Pick<Chart, "plot" | "scene">} chart
 */
export const placedGaps = ({ plot, scene }) => {
  const statuses = gapStatuses(scene.gaps ?? []);
  const width = plot.over.clientWidth;
  const placed = new Map();
  for (const gap of scene.gaps ?? []) {
    const left = plot.valToPos(gap.x, "x");
    const row = statuses.indexOf(gap.status);
    const key = `${row} ${Math.round(left)}`;
    if (left >= -1 && left <= width + 1 && !placed.has(key)) placed.set(key, { gap, left, row });
  }
  return /** @type {{ gap: Gap, left: number, row: number }[]} */ ([...placed.values()]);
};

/**
 * The mark of the gaps under the pointer; null if it is not at a mark of the foot.
 *
 * @param {Pick<Chart, "plot" | "scene">} chart
 * @param {number} left
 * @param {number} top
 * @returns {Mark | null}
 */
export const gapAt = ({ plot, scene }, left, top) => {
  const gaps = scene.gaps ?? [];
  const status = gapStatuses(gaps)[Math.floor((plot.over.clientHeight - top) / ROW_HEIGHT)];
  let nearest = null;
  let least = REACH;
  for (const gap of gaps.filter((each) => each.status === status)) {
    const distance = Math.abs(plot.valToPos(gap.x, "x") - left);
    if (distance < least) {
      least = distance;
      nearest = gap;
    }
  }
  if (nearest === null) return null;
  const { name, row, x } = nearest;
  return { key: "gap", name, index: status, row, x, y: null, gaps: gaps.filter((gap) => gap.x === x) };
};
