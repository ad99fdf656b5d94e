// @ts-check
// Creates scenes for the chart from the rows that are shown: lines, points with a front, or a map.

import { FEW_COLOURS, lineColour, packedColour, viridis } from "../shared/colours.js";
import { shortNumber } from "../shared/format.js";
import { statusEntries, statusMark } from "../shared/status.js";
import { isDark, styleColour } from "../shared/theme.js";
import { cellsOf, edgesAround } from "./cells.js";
import { cellText, extentOf, levelsOf } from "./columns.js";
import { branchColumn, columns, results, statusColumn } from "./data.js";
import { paretoFront } from "./front.js";
import { slicedParameters, sliceOf } from "./state.js";

/** @import { Axis, Column, ResultsView, Scene } from "../types.d.ts" */

/** A scene, and a problem as text, which may be empty. @typedef {{ scene: Scene, problem: string }} Drawing */
/** The number of a row. @typedef {(row: number) => number} NumberOf */

/** Largest number of lines in a picture, and of cells in a map. */
const MOST_LINES = 60;
const MOST_CELLS = 400000;
/** Pictures with fewer values have marks on their lines; pictures with more lines have thin lines. */
const FEW_VALUES = 400;
const FEW_LINES = 12;
/** Number of shades of a colour scale. */
const SHADES = 256;
const FRONT_COLOUR = "#d55e00";

/** @returns {NumberOf} the numbers of a column, in the unit of the page */
const numbersOf =
  (/** @type {Column} */ { cells, factor }) =>
  (row) =>
    cells[row] * factor;

/** @returns {Axis} */
const axisOf = (/** @type {number} */ place, /** @type {boolean} */ log) => {
  const { label, unit } = columns[place];
  return { label, unit, log };
};

/** True if an axis can show a number. */
const isOnAxis = (/** @type {number} */ number, /** @type {boolean} */ log) =>
  Number.isFinite(number) && (!log || number > 0);

/** The number of rows of each status without a settled motion. Unstable orbits of a response are drawn as lines. */
const statusCounts = (/** @type {Iterable<number>} */ rows) => {
  /** @type {Map<string, number>} */
  const counts = new Map();
  if (!statusColumn?.words) return counts;
  const { cells, words } = statusColumn;
  for (const row of rows) {
    const status = words[cells[row]];
    if (!status || status === "periodic" || (status === "unstable" && branchColumn)) continue;
    counts.set(status, (counts.get(status) ?? 0) + 1);
  }
  return counts;
};

/** The colour of a row without a value, which depends on its status. */
const missingColours = () => {
  const missing = packedColour(styleColour("--missing"));
  if (!statusColumn?.words) return () => missing;
  const { cells, words } = statusColumn;
  const dark = isDark();
  const known = words.map((word) => (word === "periodic" ? missing : packedColour(statusMark(word, dark).color)));
  return (/** @type {number} */ row) => known[cells[row]] ?? missing;
};

/**
 * The colour of each row by a column, and the legend of the colours.
 *
 * @param {Column} column
 * @param {boolean} log
 * @param {Int32Array} rows
 * @returns {Required<Pick<Scene, "legend" | "bar">> & { colourOf: NumberOf }}
 */
const shading = (column, log, rows) => {
  const missing = missingColours();
  const { label, unit, words, cells } = column;
  if (words) {
    const few = FEW_COLOURS.map(packedColour);
    const entry = (/** @type {number} */ code) => ({ name: words[code], color: FEW_COLOURS[code % few.length] });
    const colourOf = (/** @type {number} */ row) => few[cells[row] % few.length] ?? missing(row);
    return { colourOf, legend: levelsOf(column, rows).map(entry), bar: null };
  }
  const value = numbersOf(column);
  const range = extentOf(Array.from(rows, value).filter((number) => isOnAxis(number, log)));
  if (!range) return { colourOf: missing, legend: [{ name: "no value", color: styleColour("--missing") }], bar: null };
  const shades = Array.from({ length: SHADES }, (_, i) => packedColour(viridis(i / (SHADES - 1))));
  const of = log ? Math.log : Number;
  const low = of(range[0]);
  const span = of(range[1]) - low || 1;
  const colourOf = (/** @type {number} */ row) => {
    const number = value(row);
    return isOnAxis(number, log) ? shades[Math.round(((SHADES - 1) * (of(number) - low)) / span)] : missing(row);
  };
  return { colourOf, legend: [], bar: { label, unit, low: range[0], high: range[1], log } };
};

/** Some elements of a list, evenly spaced. */
const evenly = (/** @type {Group[]} */ list, /** @type {number} */ most) => {
  if (list.length <= most) return list;
  return Array.from({ length: most }, (_, i) => list[Math.round((i * (list.length - 1)) / (most - 1))]);
};

/**
 * Rows of one line: their value in the lines' column, and their branch.
 *
 * @typedef {{ key: string, value: number, branch: number, rows: number[] }} Group
 */

/**
 * Rows in groups, one line each, in rising order of values; rows without a value come last. A parameter that is not an
 * axis, not the lines' column and not fixed by a slice gives one line per value.
 *
 * @param {ResultsView} view
 * @param {Int32Array} rows
 * @param {Column | null} by
 */
const groupsOf = (view, rows, by) => {
  const held = [view.x, view.y, view.by, results.branch];
  const free = slicedParameters
    .map(({ place }) => place)
    .filter((place) => sliceOf(place) === null && !held.includes(place));
  const keys = [by, branchColumn, ...free.map((place) => columns[place])].flatMap((column) => column?.cells ?? []);
  /** @type {Map<string, Group>} */
  const groups = new Map();
  for (const row of rows) {
    let key = "";
    for (const cells of keys) key += `${cells[row]} `;
    const group = groups.get(key);
    if (group) group.rows.push(row);
    else groups.set(key, { key, value: by?.cells[row] ?? 0, branch: branchColumn?.cells[row] ?? 0, rows: [row] });
  }
  const isEmpty = (/** @type {Group} */ { value }) => Number(Number.isNaN(value));
  return [...groups.values()].sort((a, b) => isEmpty(a) - isEmpty(b) || a.value - b.value);
};

/** The name of a value of a column. */
const nameOf = (/** @type {Column} */ { words, factor, unit }, /** @type {number} */ value) => {
  if (Number.isNaN(value)) return "none";
  return words ? words[value] : `${shortNumber(value * factor)} ${unit}`.trim();
};

/**
 * @param {ResultsView} view
 * @param {Int32Array} rows
 * @param {Scene} scene
 * @param {NumberOf} xOf
 * @param {NumberOf} yOf
 * @returns {Drawing}
 */
const linesDrawing = (view, rows, scene, xOf, yOf) => {
  const dark = isDark();
  const by = view.by === null ? null : columns[view.by];
  const branch = by ? null : branchColumn;
  const onAxis = rows.filter((row) => isOnAxis(xOf(row), view.log.x));
  const groups = groupsOf(view, onAxis, by);
  const kept = evenly(groups, MOST_LINES);
  const values = [...new Set(kept.map(({ value }) => value))];
  const places = new Map(values.map((value, place) => [value, place]));
  const count = kept.reduce((sum, group) => sum + group.rows.length, 0);
  scene.gaps = [];
  for (const group of kept) {
    const members = group.rows.sort((a, b) => xOf(a) - xOf(b));
    const isUnstable = branchColumn?.words?.[group.branch] === "unstable";
    const legendGroup = String(branch ? group.branch : group.value);
    const name = by ? nameOf(by, group.value) : branch ? nameOf(branch, group.branch) : "";
    const y = members.map((row) => (Number.isFinite(yOf(row)) ? yOf(row) : null));
    for (const [i, row] of members.entries()) {
      if (y[i] !== null || !statusColumn?.words) continue;
      const status = cellText(statusColumn, row);
      if (status === "periodic") continue;
      scene.gaps.push({ group: legendGroup, x: xOf(row), status, row, name, ...statusMark(status, dark) });
    }
    scene.lines.push({
      key: group.key,
      group: legendGroup,
      name,
      color: branch
        ? lineColour(group.branch, branch.words?.length ?? 1, dark)
        : lineColour(places.get(group.value) ?? 0, values.length, dark),
      x: members.map(xOf),
      y,
      rows: members,
      dash: isUnstable ? [7, 5] : undefined,
      marks: count < FEW_VALUES && !isUnstable,
      width: kept.length > FEW_LINES ? 1.3 : 2,
    });
  }
  if (by) scene.title = by.label;
  const isCapped = kept.length < groups.length;
  const problem = `${MOST_LINES} of ${groups.length} lines are drawn, evenly chosen: choose slices`;
  return { scene, problem: isCapped ? problem : "" };
};

/** The size of points, in pixels. */
const pointSize = (/** @type {number} */ count) => {
  if (count > 20000) return 2;
  return count > 3000 ? 3 : 6;
};

/**
 * @param {ResultsView} view
 * @param {Int32Array} rows
 * @param {Scene} scene
 * @param {NumberOf} xOf
 * @param {NumberOf} yOf
 * @returns {Drawing}
 */
const pointsDrawing = (view, rows, scene, xOf, yOf) => {
  const plain = packedColour(styleColour("--accent"));
  const shades = view.color === null ? null : shading(columns[view.color], view.log.color, rows);
  const x = Float64Array.from(rows, xOf);
  const y = Float64Array.from(rows, yOf);
  const colors = Uint32Array.from(rows, shades?.colourOf ?? (() => plain));
  scene.points = { x, y, rows, colors, size: pointSize(rows.length) };
  scene.extent = { x: extentOf(x) ?? [0, 0], y: extentOf(y) ?? [0, 0] };
  scene.legend = shades?.legend ?? [];
  scene.bar = shades?.bar ?? null;
  if (view.best) {
    const front = paretoFront(rows, xOf, yOf, view.best.split(",").map(Number)).sort((a, b) => xOf(a) - xOf(b));
    const line = { key: "front", name: `Pareto front (${front.length})`, color: FRONT_COLOUR, marks: true };
    scene.lines.push({ ...line, x: front.map(xOf), y: front.map(yOf), rows: front });
  }
  return { scene, problem: "" };
};

/**
 * @param {ResultsView} view
 * @param {Int32Array} rows
 * @param {Scene} scene
 * @param {NumberOf} xOf
 * @param {NumberOf} yOf
 * @returns {Drawing}
 */
const mapDrawing = (view, rows, scene, xOf, yOf) => {
  const { levelsX, levelsY, twice, ...cells } = cellsOf([...rows], xOf, yOf);
  const count = levelsX.length * levelsY.length;
  if (count > MOST_CELLS) return { scene, problem: "too many different values for a map: choose Points" };
  const { colourOf, legend, bar } = shading(columns[view.color ?? view.y], view.log.color, rows);
  const edgesX = edgesAround(levelsX, view.log.x);
  const edgesY = edgesAround(levelsY, view.log.y);
  scene.cells = { edgesX, edgesY, ...cells, colors: cells.rows.map(colourOf) };
  scene.extent = { x: [edgesX[0], edgesX[edgesX.length - 1]], y: [edgesY[0], edgesY[edgesY.length - 1]] };
  const empty = count - cells.rows.length;
  scene.legend = [...legend, ...(empty > 0 ? [{ name: `no row (${empty} cells)`, color: "transparent" }] : [])];
  scene.bar = bar;
  const problem = `${twice} rows have the same cell as an earlier row and are not drawn: choose slices`;
  return { scene, problem: twice > 0 ? problem : "" };
};

/**
 * The scene of a view, the number of rows without both values, and a problem as text, which may be empty.
 *
 * @param {ResultsView} view
 * @param {Int32Array} rows
 * @returns {Drawing & { without: number }}
 */
export const drawingOf = (view, rows) => {
  const [xOf, yOf] = [view.x, view.y].map((place) => numbersOf(columns[place]));
  const whole = rows.filter((row) => isOnAxis(xOf(row), view.log.x) && isOnAxis(yOf(row), view.log.y));
  /** @type {Scene} */
  const scene = {
    x: axisOf(view.x, view.log.x),
    y: axisOf(view.y, view.log.y),
    lines: [],
    legend: [],
    statuses: statusEntries(statusCounts(rows), isDark()),
  };
  const without = rows.length - whole.length;
  if (whole.length === 0) return { scene, without, problem: "no row has both values: nothing is drawn" };
  if (view.kind === "line") return { ...linesDrawing(view, rows, scene, xOf, yOf), without };
  if (view.kind === "map") return { ...mapDrawing(view, whole, scene, xOf, yOf), without };
  return { ...pointsDrawing(view, whole, scene, xOf, yOf), without };
};
