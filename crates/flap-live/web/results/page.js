// @ts-check
// The page of results: its pictures, and its reactions to the pointer and the controls.

import { Chart } from "../chart/chart.js";
import { readAddress } from "../shared/address.js";
import { byId, download } from "../shared/dom.js";
import { csvText } from "./columns.js";
import { buildControls, controlEvents, showControls } from "./controls.js";
import { columns, results } from "./data.js";
import { filterEvents } from "./filters.js";
import { drawingOf } from "./scene.js";
import { applyShown, saveShown, shown, visibleRows } from "./state.js";
import { showTable, showTip } from "./table.js";

/** @type {Chart[]} */
const charts = [];

/** The rows with rings: those selected, and the row that was clicked. */
const markedRows = () => (shown.pinned === null ? shown.selected : new Set([...shown.selected, shown.pinned]));

/** Draws a view of the rows that are shown. */
const drawView = (/** @type {number} */ i) => {
  const view = shown.views[i];
  const { scene, without, problem } = drawingOf(view, shown.rows);
  const chart = charts[i];
  chart.view = view.zoom;
  chart.hidden = new Set(view.hidden);
  chart.selectedRows = markedRows();
  chart.draw(scene);
  return { without, problem };
};

/** Draws the rows that pass slices and filters. */
const redraw = () => {
  shown.rows = visibleRows();
  const parts = [`${shown.rows.length} of ${results.rows} rows shown`];
  if (results.of > results.rows) parts.push(`the file has ${results.of}: every ${results.stride}th is in this page`);
  if (results.single) parts.push("measures to seven digits");
  for (const i of shown.two ? [0, 1] : [0]) {
    const { without, problem } = drawView(i);
    if (without) parts.push(`${without} without a value`);
    if (problem) parts.push(problem);
  }
  byId("status").textContent = [...new Set(parts)].join(" · ");
  showTable();
  showTip();
};

/** Draws the page, and saves its state. `isStep` is true for a change that the back button undoes. */
const refresh = (/** @type {boolean} */ isStep) => {
  redraw();
  saveShown(isStep);
};

let isWaiting = false;
/** Draws in the next frame, once for all changes before it. The state is saved when the change has ended. */
const refreshSoon = () => {
  if (isWaiting) return;
  isWaiting = true;
  requestAnimationFrame(() => {
    isWaiting = false;
    const begun = performance.now();
    redraw();
    performance.measure("flap-filter-to-picture", { start: begun, end: performance.now() });
  });
};

/** Marks rows in both pictures: the rows of a drag, or the row that was clicked. */
const markRows = (/** @type {number[]} */ selected, /** @type {number | null} */ pinned) => {
  Object.assign(shown, { selected: new Set(selected), pinned });
  for (const chart of charts) chart.select(markedRows());
  showTable();
};

const makeChart = (/** @type {0 | 1} */ i) =>
  new Chart(byId(`chart-${i}`), {
    name: `Picture ${i + 1} of the rows. Arrow keys move from mark to mark.`,
    onPoint: (mark) => {
      shown.hover = mark ? mark.row : null;
      showTip(shown.views[i]);
    },
    onPin: (mark) => markRows([], mark ? mark.row : null),
    onSelect: (rows) => markRows(rows, null),
    onView: (view) => {
      shown.views[i].zoom = view;
      saveShown(true);
    },
    onHidden: (groups) => {
      shown.views[i].hidden = groups;
      saveShown(true);
    },
    onScheme: () => {
      if (!byId(`chart-${i}`).hidden) drawView(i);
    },
  });

const listenToTools = () => {
  byId("drag").onclick = () => {
    const isSelecting = charts[0].drag === "zoom";
    for (const chart of charts) chart.drag = isSelecting ? "select" : "zoom";
    byId("drag").setAttribute("aria-pressed", String(isSelecting));
  };
  byId("whole").onclick = () => {
    for (const view of shown.views) view.zoom = { x: null, y: null };
    refresh(true);
  };
  byId("csv").onclick = () => {
    const rows = shown.selected.size > 0 ? shown.selected : shown.rows;
    download("rows.csv", csvText(columns, rows), "text/csv");
  };
  byId("png").onclick = async () => download("picture.png", await charts[shown.active].png());
  byId("svg").onclick = async () => download("picture.svg", await charts[shown.active].svg(), "image/svg+xml");
};

/** Applies the state in the address, after a reload or the back button. */
const restore = () => {
  applyShown(readAddress());
  showControls();
  refresh(false);
};

const start = () => {
  charts.push(makeChart(0), makeChart(1));
  controlEvents.onChange = refresh;
  filterEvents.onMove = refreshSoon;
  buildControls();
  listenToTools();
  addEventListener("popstate", restore);
  restore();
  requestAnimationFrame(() => performance.measure("flap-first-picture", { start: 0, end: performance.now() }));
};

start();

window.flapTestHook = { charts };
