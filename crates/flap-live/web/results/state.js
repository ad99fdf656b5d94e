// @ts-check
// The state of the page of results, and its text in the address.

import { writeAddress } from "../shared/address.js";
import { levelsOf } from "./columns.js";
import { columns, numberPlaces, placeOf, results } from "./data.js";

/** @import { Filter, ResultsView } from "../types.d.ts" */

/** Largest number of values of a parameter with slices. */
const MOST_LEVELS = 1000;

const { start } = results;

/** @returns {ResultsView} */
const startView = () => ({
  kind: start.kind,
  x: start.x,
  y: start.y,
  by: start.by,
  color: start.color,
  best: start.best,
  log: { x: false, y: false, color: false },
  zoom: { x: null, y: null },
  hidden: [],
});

export const shown = {
  views: [startView(), startView()],
  /** True if both views are shown. */
  two: false,
  /** The view that the controls change. */
  active: 0,
  /** By the place of a column, the place of its value; null for all. @type {Record<number, number | null>} */
  slices: {},
  /** @type {Filter[]} */
  filters: [],
  /** The row that was clicked. @type {number | null} */
  pinned: null,
  /** The row under the pointer. @type {number | null} */
  hover: null,
  /** @type {Set<number>} */
  selected: new Set(),
  /** The rows that pass slices and filters. */
  rows: new Int32Array(0),
};

export const activeView = () => shown.views[shown.active];

/** Parameters with few values, which have slices. */
export const slicedParameters = results.axes
  .map((place) => ({ place, levels: levelsOf(columns[place]) }))
  .filter(({ levels }) => levels.length > 1 && levels.length <= MOST_LEVELS);

/** The slice of a parameter; null for all values. */
export const sliceOf = (/** @type {number} */ place) => shown.slices[place] ?? null;

/** True if a view shows only one value of a parameter at a time. */
const needsSlice = (/** @type {ResultsView} */ { kind, x, y, by }, /** @type {number} */ place) =>
  kind !== "scatter" && place !== x && place !== y && !(kind === "line" && by === place);

/** The slices of the command line, or the middle value if the first view needs a slice. */
const startSlices = () => {
  shown.slices = {};
  for (const { place, levels } of slicedParameters) {
    const { name, words } = columns[place];
    const given = start.where[name];
    const isGiven = (/** @type {number} */ level) =>
      words ? words[level] === given : Math.abs(level - Number(given)) <= 1e-9 * Math.abs(Number(given));
    const at = given === undefined ? -1 : levels.findIndex(isGiven);
    const middle = needsSlice(shown.views[0], place) ? levels.length >> 1 : null;
    shown.slices[place] = at >= 0 ? at : middle;
  }
};

/** Adds the slices that a view needs, and removes the others. */
export const chooseSlices = () => {
  const views = shown.two ? shown.views : shown.views.slice(0, 1);
  for (const { place, levels } of slicedParameters) {
    if (!views.some((view) => needsSlice(view, place))) shown.slices[place] = null;
    else shown.slices[place] ??= levels.length >> 1;
  }
};

/** Chooses two parameters as the axes of a map, if the page has two. */
export const chooseMapAxes = (/** @type {ResultsView} */ view) => {
  const [a, b] = slicedParameters.map(({ place }) => place);
  const isParameter = (/** @type {number} */ place) => slicedParameters.some((each) => each.place === place);
  if (a === undefined || b === undefined) return;
  if (view.color === null || isParameter(view.color)) view.color = isParameter(view.y) ? start.y : view.y;
  if (!isParameter(view.x)) view.x = b;
  if (!isParameter(view.y) || view.y === view.x) view.y = view.x === a ? b : a;
};

/** Sets the state of a newly opened page. */
export const resetShown = () => {
  const views = [startView(), startView()];
  Object.assign(shown, { views, two: false, active: 0, filters: [], pinned: null, hover: null, selected: new Set() });
  // The second view starts with columns that the first does not show.
  const [, second] = views;
  const taken = [...results.axes, second.x, second.y, placeOf("point")];
  const other = numberPlaces.find((place) => !taken.includes(place)) ?? second.x;
  Object.assign(second, { kind: "scatter", x: second.y, y: other, by: null, color: null, best: "" });
  startSlices();
};

/** The rows that pass slices and filters. */
export const visibleRows = () => {
  const slices = slicedParameters.flatMap(({ place, levels }) => {
    const slice = sliceOf(place);
    return slice === null ? [] : [{ cells: columns[place].cells, low: levels[slice], high: levels[slice] }];
  });
  const filters = shown.filters.flatMap(({ place, low, high }) => {
    const { cells, extent } = columns[place];
    // A filter with its whole range keeps all rows, even rows without a value.
    return extent && (low > extent[0] || high < extent[1]) ? [{ cells, low, high }] : [];
  });
  const tests = [...slices, ...filters];
  const rows = new Int32Array(results.rows);
  let count = 0;
  for (let row = 0; row < results.rows; row++) {
    if (tests.every(({ cells, low, high }) => cells[row] >= low && cells[row] <= high)) rows[count++] = row;
  }
  return rows.subarray(0, count);
};

/** Writes the state into the address, with names of columns. */
export const saveShown = (/** @type {boolean} */ isStep) => {
  const name = (/** @type {number | null} */ place) => (place === null ? null : columns[place].name);
  const views = shown.views.map((view) => ({
    ...view,
    x: name(view.x),
    y: name(view.y),
    by: name(view.by),
    color: name(view.color),
  }));
  const slices = Object.fromEntries(slicedParameters.map(({ place }) => [name(place), sliceOf(place)]));
  const filters = shown.filters.map(({ place, low, high }) => ({ name: name(place), low, high }));
  writeAddress({ views: shown.two ? views : views.slice(0, 1), two: shown.two, slices, filters }, isStep);
};

/** The place of a column in an address; undefined if the page does not have it, or if it must have numbers but has words. */
const knownPlace = (/** @type {any} */ name, /** @type {boolean} */ isNumber) => {
  const at = placeOf(name);
  return at === undefined || (isNumber && columns[at].words) ? undefined : at;
};

/** Applies a view of an address, as far as the page has its columns. */
const applyView = (/** @type {ResultsView} */ view, /** @type {any} */ found) => {
  if (["line", "scatter", "map"].includes(found?.kind)) view.kind = found.kind;
  if (["", "1,1", "1,-1", "-1,1", "-1,-1"].includes(found?.best)) view.best = found.best;
  for (const axis of /** @type {const} */ (["x", "y"])) {
    view[axis] = knownPlace(found?.[axis], true) ?? view[axis];
    const range = found?.zoom?.[axis];
    if (Array.isArray(range) && range.length === 2 && range.every(Number.isFinite)) {
      view.zoom[axis] = [range[0], range[1]];
    }
  }
  for (const axis of /** @type {const} */ (["by", "color"])) {
    view[axis] = found?.[axis] === null ? null : (knownPlace(found?.[axis], false) ?? view[axis]);
  }
  for (const axis of /** @type {const} */ (["x", "y", "color"])) view.log[axis] = Boolean(found?.log?.[axis]);
  if (Array.isArray(found?.hidden)) {
    view.hidden = found.hidden.filter((/** @type {unknown} */ group) => typeof group === "string");
  }
};

/** Applies the state in an address, except columns that the page does not have. */
export const applyShown = (/** @type {any} */ found) => {
  resetShown();
  if (!found || typeof found !== "object") return;
  const views = Array.isArray(found.views) ? found.views.slice(0, 2) : [];
  for (const [i, view] of views.entries()) applyView(shown.views[i], view);
  shown.two = Boolean(found.two);
  for (const { place, levels } of slicedParameters) {
    const slice = found.slices?.[columns[place].name];
    if (slice === null || (Number.isInteger(slice) && slice >= 0 && slice < levels.length)) shown.slices[place] = slice;
  }
  for (const filter of Array.isArray(found.filters) ? found.filters : []) {
    const place = knownPlace(filter?.name, true);
    if (place === undefined || !Number.isFinite(filter.low) || !Number.isFinite(filter.high)) continue;
    const [low, high] = [Math.min(filter.low, filter.high), Math.max(filter.low, filter.high)];
    shown.filters.push({ place, low, high });
  }
};
