// @ts-check
// Gaps of lines: values of x without a settled motion. Each has a mark at the bottom of the chart; each status has a row.

/** @import { Chart, Gap, Mark } from "../types.d.ts" */

/** Distance in pixels of the first row of marks from the bottom, and between two rows. */
const FOOT = 6;
const ROW_HEIGHT = 10;
/** Largest distance in pixels of the pointer from a mark. */
const REACH = 7;

/** Height in pixels of a row of marks above the bottom. */
export const gapHeight = (/** @type {number} */ row) => FOOT + row * ROW_HEIGHT;

/** The gaps of lines that are not switched off. */
const shownGaps = (/** @type {Pick<Chart, "scene" | "hidden">} */ { scene, hidden }) =>
  (scene.gaps ?? []).filter(({ group }) => !hidden.has(group));

/** The statuses of gaps, one for each row of marks, from the bottom upwards. */
export const gapStatuses = (/** @type {Gap[]} */ gaps) => [...new Set(gaps.map(({ status }) => status))];

/**
 * The marks to paint, with pixels from the left and the row. Marks at the same pixel are painted once.
 *
 * @param {Pick<Chart, "plot" | "scene" | "hidden">} chart
 */
export const placedGaps = (chart) => {
  const { plot } = chart;
  const gaps = shownGaps(chart);
  const statuses = gapStatuses(gaps);
  const width = plot.over.clientWidth;
  const placed = new Map();
  for (const gap of gaps) {
    const left = plot.valToPos(gap.x, "x");
    const row = statuses.indexOf(gap.status);
    const key = `${row} ${Math.round(left)}`;
    if (left >= -1 && left <= width + 1 && !placed.has(key)) placed.set(key, { gap, left, row });
  }
  return /** @type {{ gap: Gap, left: number, row: number }[]} */ ([...placed.values()]);
};

/**
 * The mark of the gaps under the pointer; null if the pointer is not at such a mark.
 *
 * @param {Pick<Chart, "plot" | "scene" | "hidden">} chart
 * @param {number} left
 * @param {number} top
 * @returns {Mark | null}
 */
export const gapAt = (chart, left, top) => {
  const { plot } = chart;
  const gaps = shownGaps(chart);
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
