// The page of results: its pictures, and what follows the pointer and the controls.

const charts = [];

/** Draws the rows that slices and filters leave. */
const refresh = (isStep) => {
  const rows = visibleRows(), parts = [`${rows.length} of ${results.rows} rows shown`];
  if (results.of > results.rows) parts.push(`the file has ${results.of}: every ${results.stride}th is in this page`);
  if (results.single) parts.push("measures to seven digits");
  shown.rows = rows;
  for (const i of shown.two ? [0, 1] : [0]) {
    const { without, problem } = drawView(i);
    if (without) parts.push(`${without} without a value`);
    if (problem) parts.push(problem);
  }
  byId("status").textContent = [...new Set(parts)].join(" · ");
  showTable();
  showTip(activeView());
  rememberShown(isStep);
};

/** Draws a view of the rows that are shown. */
const drawView = (i) => {
  const view = shown.views[i], { scene, without, problem } = sceneOf(view, shown.rows), chart = charts[i];
  chart.view = view.zoom;
  chart.hidden = new Set(view.hidden);
  chart.selectedRows = marked();
  chart.draw(scene);
  return { without, problem };
};

let isWaiting = false;
/** Draws in the next frame, once for all changes until then. */
const refreshSoon = () => {
  if (isWaiting) return;
  isWaiting = true;
  requestAnimationFrame(() => {
    isWaiting = false;
    const begun = performance.now();
    refresh(false);
    performance.measure("flap-filter-to-picture", { start: begun, end: performance.now() });
  });
};

/** The rows with rings: those selected, and the one that was clicked. */
const marked = () => (shown.pinned === null ? shown.selected : new Set([...shown.selected, shown.pinned]));
const mark = () => {
  for (const chart of charts) chart.select(marked());
  showTable();
};

const makeChart = (i) => new Chart(byId(`chart-${i}`), {
  name: `Picture ${i + 1} of the rows. Arrow keys go from mark to mark.`,
  onPoint: (mark) => { shown.hover = mark ? mark.row : null; showTip(shown.views[i]); },
  onPin: (pinned) => { shown.pinned = pinned ? pinned.row : null; shown.selected = new Set(); mark(); },
  onSelect: (rows) => { shown.selected = new Set(rows); shown.pinned = null; mark(); },
  onView: (view) => { shown.views[i].zoom = view; rememberShown(true); },
  onHidden: (groups) => { shown.views[i].hidden = groups; rememberShown(true); },
  onScheme: () => { if (!byId(`chart-${i}`).hidden) drawView(i); },
});

const listenToTools = () => {
  byId("drag").onclick = () => {
    const isSelecting = charts[0].drag === "zoom";
    for (const chart of charts) chart.drag = isSelecting ? "select" : "zoom";
    byId("drag").setAttribute("aria-pressed", String(isSelecting));
  };
  byId("whole").onclick = () => { for (const view of shown.views) view.zoom = { x: null, y: null }; refresh(true); };
  byId("csv").onclick = () => download("rows.csv", csvOf(shown.selected.size > 0 ? shown.selected : shown.rows), "text/csv");
  byId("png").onclick = async () => download("picture.png", await charts[shown.active].png());
  byId("svg").onclick = async () => download("picture.svg", await charts[shown.active].svg(), "image/svg+xml");
};

const restoreShown = () => {
  takeOverShown(stateOfAddress());
  showControls();
  refresh(false);
};

const begin = () => {
  freshen();
  charts.push(makeChart(0), makeChart(1));
  fillSelects();
  listenToControls();
  listenToTools();
  addEventListener("popstate", restoreShown);
  restoreShown();
  requestAnimationFrame(() => performance.measure("flap-first-picture", { start: 0, end: performance.now() }));
};

begin();
