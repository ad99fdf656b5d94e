// @ts-check
// Marks of a chart: the place that the pointer or the keyboard has selected, and rows within a part of the plane.

import { gapAt } from "./gaps.js";
import { hasValue, nearestPlace, reachableLines } from "./lines.js";
import { cellAt, cellMiddle, nearestPoint, nextCell, pointMark } from "./point-marks.js";

/** @import { Chart, Line, Mark, Range, Scene } from "../types.d.ts" */

/** Largest distance of the pointer from a value of a line, in pixels. */
const REACH = 30;

/**
 * @param {Line} line
 * @param {number} place
 * @returns {Mark}
 */
const lineMark = (line, place) => ({
  key: line.key,
  name: line.name,
  row: line.rows ? line.rows[place] : place,
  index: place,
  x: line.x[place],
  y: line.y[place] ?? null,
});

/**
 * The mark nearest to a place of the plot, in pixels; null if none is near.
 *
 * @param {Chart} chart
 * @param {number} left
 * @param {number} top
 */
export const markAt = (chart, left, top) => {
  const { plot, scene, hidden } = chart;
  if (scene.cells) return cellAt(scene.cells, plot.posToVal(left, "x"), plot.posToVal(top, "y"));
  if (scene.points) return nearestPoint(chart, scene.points, left, top);
  const gap = gapAt(chart, left, top);
  if (gap) return gap;
  let nearest = null;
  let least = REACH ** 2;
  for (const line of reachableLines(scene.lines, hidden)) {
    const middle = nearestPlace(line.x, plot.posToVal(left, "x"));
    for (let i = Math.max(middle - 2, 0); i <= Math.min(middle + 2, line.x.length - 1); i++) {
      if (!hasValue(line, i)) continue;
      const across = plot.valToPos(line.x[i], "x") - left;
      const distance = across ** 2 + (plot.valToPos(Number(line.y[i]), "y") - top) ** 2;
      if (distance < least) {
        least = distance;
        nearest = lineMark(line, i);
      }
    }
  }
  return nearest;
};

/**
 * The mark of a line after the line has changed: at the same x, or at the nearest one. Null if there is no value.
 *
 * @param {Scene} scene
 * @param {Mark | null} mark
 */
export const renewedMark = ({ lines }, mark) => {
  const line = lines.find(({ key }) => key === mark?.key);
  if (!line || !mark) return null;
  const place = nearestPlace(line.x, mark.x);
  return place >= 0 && hasValue(line, place) ? lineMark(line, place) : null;
};

/**
 * The next mark along a line, or the mark of the line above or below; null if nothing is drawn.
 *
 * @param {Chart} chart
 * @param {number} right
 * @param {number} up
 */
export const nextMark = ({ scene, hidden, mark }, right, up) => {
  const { points, cells } = scene;
  if (cells) return nextCell(cells, mark, right, up);
  if (points && points.x.length > 0) {
    const count = points.x.length;
    return pointMark(points, mark?.key === "point" ? (Number(mark.index) + (right || up) + count) % count : 0);
  }
  const lines = reachableLines(scene.lines, hidden);
  if (lines.length === 0) return null;
  const place = lines.findIndex((line) => line.key === mark?.key);
  const line = lines[place < 0 ? 0 : (place + up + lines.length) % lines.length];
  const places = line.x.map((_, i) => i).filter((i) => hasValue(line, i));
  if (places.length === 0) return null;
  if (!mark || place < 0) return lineMark(line, places[0]);
  // Lines may have different values of x, and a line may have several values at one x.
  const same = line.key === mark.key ? places.indexOf(Number(mark.index)) : -1;
  const x = places.map((i) => line.x[i]);
  const before = same < 0 ? nearestPlace(x, mark.x) : same;
  return lineMark(line, places[Math.min(Math.max(before + right, 0), places.length - 1)]);
};

/** True if two marks are at the same place. */
export const isSameMark = (/** @type {Mark | null} */ a, /** @type {Mark | null} */ b) =>
  a?.key === b?.key && a?.index === b?.index && a?.y === b?.y && a?.x === b?.x;

/**
 * The rows of all points, cells and values of lines within a part of the plane. Lines that are switched off do not count.
 *
 * @param {Scene} scene
 * @param {Set<string>} hidden
 * @param {Range} x
 * @param {Range} y
 */
export const rowsWithin = ({ points, cells, lines }, hidden, [lowX, highX], [lowY, highY]) => {
  /** @type {any[]} */
  const found = [];
  /**
   * @param {ArrayLike<any>} rows
   * @param {(at: number) => { x: number, y: number | null | undefined }} placeOf
   */
  const collect = (rows, placeOf) => {
    for (let at = 0; at < rows.length; at++) {
      const { x, y } = placeOf(at);
      if (y === null || y === undefined) continue;
      if (x >= lowX && x <= highX && y >= lowY && y <= highY) found.push(rows[at]);
    }
  };
  if (points) collect(points.rows, (at) => ({ x: points.x[at], y: points.y[at] }));
  if (cells) collect(cells.rows, (at) => cellMiddle(cells, at));
  for (const { x, y, rows } of reachableLines(lines, hidden)) collect(rows ?? [], (at) => ({ x: x[at], y: y[at] }));
  return found;
};
