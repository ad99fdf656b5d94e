// The state of the page of results, and its text in the address.

const first = results.start;
const freshView = () => ({ kind: first.kind, x: first.x, y: first.y, by: first.by, color: first.color, best: first.best,
  log: { x: false, y: false, color: false }, zoom: { x: null, y: null }, hidden: [] });

const shown = { views: [], two: false, active: 0, slices: {}, filters: [], pinned: null, hover: null, selected: new Set() };

/** Parameters with few values, for which slices are offered. */
const slicedAxes = results.axes.map((place) => ({ place, levels: levelsOf(columns[place]) }))
  .filter(({ levels }) => levels.length > 1 && levels.length <= 1000);

/** True if a view shows one value of a parameter alone. */
const needsSlice = (view, place) => view.kind !== "scatter" && ![view.x, view.y].includes(place) && !(view.kind === "line" && view.by === place);

/** Slices as they must be: those of the command line, or the value in the middle where a view needs one. */
const defaultSlices = () => {
  shown.slices = {};
  for (const { place, levels } of slicedAxes) {
    const column = columns[place], given = first.where[column.name];
    const asked = given === undefined ? -1 : levels.findIndex((level) => (column.words ? column.words[level] === given : Math.abs(level - given) <= 1e-9 * Math.abs(given)));
    shown.slices[place] = asked >= 0 ? asked : needsSlice(shown.views[0], place) ? levels.length >> 1 : null;
  }
};

const freshen = () => {
  Object.assign(shown, { views: [freshView(), freshView()], two: false, active: 0, filters: [], pinned: null, hover: null, selected: new Set() });
  // The second view begins with what the first does not show.
  const other = shown.views[1], measures = numberPlaces.filter((place) => !results.axes.includes(place) && ![other.x, other.y, placeOf.get("point")].includes(place));
  Object.assign(other, { kind: "scatter", x: other.y, y: measures[0] ?? other.x, by: null, color: null, best: "" });
  defaultSlices();
};

/** The rows that slices and filters leave. */
const visibleRows = () => {
  const tests = [];
  for (const { place, levels } of slicedAxes) {
    const slice = shown.slices[place];
    if (slice !== null && slice !== undefined) tests.push({ cells: columns[place].cells, low: levels[slice], high: levels[slice] });
  }
  for (const { place, low, high } of shown.filters) {
    const { cells, extent } = columns[place];
    // A filter that is wide open leaves out nothing, rows without a value neither.
    if (extent && (low > extent[0] || high < extent[1])) tests.push({ cells, low, high });
  }
  const rows = new Int32Array(results.rows);
  let count = 0;
  for (let row = 0; row < results.rows; row++) {
    let passes = true;
    for (const { cells, low, high } of tests) if (!(cells[row] >= low && cells[row] <= high)) { passes = false; break; }
    if (passes) rows[count++] = row;
  }
  return rows.subarray(0, count);
};

/** Writes the state into the address, with names of columns. */
const rememberShown = (isStep) => {
  const name = (place) => (place === null || place === undefined ? null : columns[place].name);
  const views = shown.views.map((view) => ({ ...view, x: name(view.x), y: name(view.y), by: name(view.by), color: name(view.color) }));
  const slices = Object.fromEntries(slicedAxes.map(({ place }) => [columns[place].name, shown.slices[place] ?? null]));
  const filters = shown.filters.map(({ place, low, high }) => ({ name: columns[place].name, low, high }));
  writeAddress({ views: shown.two ? views : views.slice(0, 1), two: shown.two, slices, filters }, isStep);
};

/** Takes over what an address says, but for columns that the page does not have. */
const takeOverShown = (found) => {
  freshen();
  if (!found || typeof found !== "object") return;
  const place = (name, isNumber) => { const at = placeOf.get(name); return at === undefined || (isNumber && columns[at].words) ? undefined : at; };
  (Array.isArray(found.views) ? found.views.slice(0, 2) : []).forEach((view, i) => {
    const into = shown.views[i];
    if (["line", "scatter", "map"].includes(view?.kind)) into.kind = view.kind;
    for (const axis of ["x", "y"]) into[axis] = place(view?.[axis], true) ?? into[axis];
    for (const axis of ["by", "color"]) into[axis] = view?.[axis] === null ? null : place(view?.[axis], false) ?? into[axis];
    if (["", "1,1", "1,-1", "-1,1", "-1,-1"].includes(view?.best)) into.best = view.best;
    for (const axis of ["x", "y", "color"]) into.log[axis] = Boolean(view?.log?.[axis]);
    for (const axis of ["x", "y"]) {
      const range = view?.zoom?.[axis];
      if (Array.isArray(range) && range.length === 2 && range.every(Number.isFinite)) into.zoom[axis] = range;
    }
    if (Array.isArray(view?.hidden)) into.hidden = view.hidden.filter((group) => typeof group === "string");
  });
  shown.two = Boolean(found.two);
  for (const { place: at, levels } of slicedAxes) {
    const slice = found.slices?.[columns[at].name];
    if (slice === null || (Number.isInteger(slice) && slice >= 0 && slice < levels.length)) shown.slices[at] = slice;
  }
  for (const filter of Array.isArray(found.filters) ? found.filters : []) {
    const at = place(filter?.name, true);
    if (at !== undefined && Number.isFinite(filter.low) && Number.isFinite(filter.high)) shown.filters.push({ place: at, low: Math.min(filter.low, filter.high), high: Math.max(filter.low, filter.high) });
  }
};
