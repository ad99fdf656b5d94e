// Scenes for the chart from the rows that are shown: lines, points with a front, or a map.

const shownNumber = (column) => { const { cells, factor } = column; return (row) => cells[row] * factor; };
const axisOf = (place, log) => ({ label: columns[place].label, unit: columns[place].unit, log });

/** Most lines of a picture. */
const MOST_LINES = 60;

/** Entries of the legend for rows without a settled motion. Unstable orbits of a response have a line of their own. */
const statusEntries = (rows) => {
  if (statusPlace === undefined) return [];
  const { cells, words } = columns[statusPlace], counts = new Map();
  for (const row of rows) { const status = words?.[cells[row]]; if (status && status !== "periodic" && !(status === "unstable" && results.branch !== null)) counts.set(status, (counts.get(status) ?? 0) + 1); }
  return [...counts].map(([status, count]) => ({ name: `${count} ${status.replace("_", " ")}`, ...statusMark(status) }));
};

/** The colour of a row without a value: that of its status. */
const missingColours = () => {
  const missing = packedColour(styleColour("--missing"));
  if (statusPlace === undefined) return () => missing;
  const { cells, words } = columns[statusPlace], known = words.map((word) => (word === "periodic" ? missing : packedColour(statusMark(word).color)));
  return (row) => known[cells[row]] ?? missing;
};

/** The colour of each row by a column, and what the legend says of it. */
const shading = (place, log, rows) => {
  if (place === null) return { colorOf: null, legend: [], bar: null };
  const column = columns[place], missing = missingColours();
  if (column.words) {
    const few = FEW_COLOURS.map(packedColour);
    const legend = levelsOf(column, rows).map((code) => ({ name: column.words[code], color: FEW_COLOURS[code % FEW_COLOURS.length] }));
    return { colorOf: (row) => (Number.isNaN(column.cells[row]) ? missing(row) : few[column.cells[row] % few.length]), legend, bar: null };
  }
  const value = shownNumber(column), usable = (number) => Number.isFinite(number) && (!log || number > 0);
  const range = extentOf(Array.from(rows, value).filter(usable));
  if (!range) return { colorOf: missing, legend: [{ name: "no value", color: styleColour("--missing") }], bar: null };
  const shades = Array.from({ length: 256 }, (_, i) => packedColour(viridis(i / 255)));
  const of = log ? Math.log : (number) => number, [low, high] = range.map(of), span = high - low || 1;
  const colorOf = (row) => { const number = value(row); return usable(number) ? shades[Math.round(255 * (of(number) - low) / span)] : missing(row); };
  return { colorOf, legend: [], bar: { label: column.label, unit: column.unit, low: range[0], high: range[1], log } };
};

/** The scene of a view, the number of rows without both values, and a problem in words. */
const sceneOf = (view, rows) => {
  const [ofX, ofY] = [view.x, view.y].map((place) => shownNumber(columns[place]));
  const usable = (number, log) => Number.isFinite(number) && (!log || number > 0);
  const whole = rows.filter((row) => usable(ofX(row), view.log.x) && usable(ofY(row), view.log.y));
  const scene = { x: axisOf(view.x, view.log.x), y: axisOf(view.y, view.log.y), lines: [], legend: [], statuses: statusEntries(rows) };
  const without = view.kind === "map" ? 0 : rows.length - whole.length;
  if (whole.length === 0) return { scene, without, problem: "no row has both values: nothing is drawn" };
  if (view.kind === "line") return { ...linesScene(view, rows, scene, ofX, ofY), without };
  if (view.kind === "map") return { ...mapScene(view, whole, scene, ofX, ofY), without };
  return { ...pointsScene(view, whole, scene, ofX, ofY), without };
};

/** Parameters that neither an axis, nor the lines, nor a slice of a view holds: each of their values has lines of its own. */
const freeAxes = (view) => slicedAxes.map(({ place }) => place)
  .filter((place) => (shown.slices[place] ?? null) === null && ![view.x, view.y, view.by, results.branch].includes(place));

/** Some of a list, evenly chosen. */
const evenly = (list, most) => (list.length <= most ? list : Array.from({ length: most }, (_, i) => list[Math.round(i * (list.length - 1) / (most - 1))]));

/** Rows in groups, a line each: { value, way, rows }, by rising values. */
const groupsOf = (view, rows, by, branch) => {
  const groups = new Map(), keys = [by, branch, ...freeAxes(view).map((place) => columns[place])].filter((column) => column !== null).map(({ cells }) => cells);
  for (const row of rows) {
    let key = "";
    for (const cells of keys) key += `${cells[row]} `;
    const group = groups.get(key);
    if (group) group.rows.push(row);
    else groups.set(key, { key, value: by ? by.cells[row] : 0, way: branch ? branch.cells[row] : 0, rows: [row] });
  }
  return [...groups.values()].sort((a, b) => a.value - b.value);
};

const linesScene = (view, rows, scene, ofX, ofY) => {
  const by = view.by === null ? null : columns[view.by], branch = results.branch === null ? null : columns[results.branch];
  const groups = groupsOf(view, rows, by, branch), kept = evenly(groups, MOST_LINES);
  const values = [...new Set(kept.map(({ value }) => value))], placeOfValue = new Map(values.map((value, place) => [value, place]));
  const count = kept.reduce((sum, { rows: { length } }) => sum + length, 0), status = statusPlace === undefined ? null : columns[statusPlace];
  const wordOf = (column, value) => (column.words ? column.words[value] ?? "none" : `${shortNumber(value * column.factor)} ${column.unit}`.trim());
  scene.gaps = [];
  for (const { key, value, way, rows: members } of kept) {
    members.sort((a, b) => ofX(a) - ofX(b));
    const isUnstable = branch?.words?.[way] === "unstable", isBranch = !by && branch !== null;
    const name = by ? wordOf(by, value) : branch ? wordOf(branch, way) : "";
    const color = isBranch ? lineColour(way, branch.words?.length ?? 1) : lineColour(placeOfValue.get(value), values.length);
    const y = members.map((row) => { const number = ofY(row); return Number.isFinite(number) ? number : null; });
    if (status?.words) members.forEach((row, i) => { if (y[i] === null) scene.gaps.push({ x: ofX(row), text: shownCell(status, row), row, name, ...statusMark(shownCell(status, row)) }); });
    scene.lines.push({ key, group: String(isBranch ? way : value), name, color, x: members.map(ofX), y, rows: members,
      dash: isUnstable ? [7, 5] : undefined, marks: count < 400 && !isUnstable, width: kept.length > 12 ? 1.3 : 2 });
  }
  if (by) scene.title = by.label;
  return { scene, problem: kept.length < groups.length ? `${MOST_LINES} of ${groups.length} lines are drawn, evenly chosen: choose slices` : "" };
};

const pointsScene = (view, rows, scene, ofX, ofY) => {
  const { colorOf, legend, bar } = shading(view.color, view.log.color, rows), plain = packedColour(styleColour("--accent"));
  const [x, y, colors] = [new Float64Array(rows.length), new Float64Array(rows.length), new Uint32Array(rows.length)];
  rows.forEach((row, i) => { x[i] = ofX(row); y[i] = ofY(row); colors[i] = colorOf ? colorOf(row) : plain; });
  const size = rows.length > 20000 ? 2 : rows.length > 3000 ? 3 : 6;
  scene.points = { x, y, rows, colors, size };
  const [rangeX, rangeY] = [extentOf(x), extentOf(y)];
  scene.extent = { x: rangeX[0] === rangeX[1] ? [rangeX[0]] : rangeX, y: rangeX[0] === rangeX[1] ? [rangeY[0]] : rangeY };
  scene.extent.y = scene.extent.x.length === 1 ? [rangeY[1]] : rangeY;
  scene.legend = legend;
  scene.bar = bar;
  if (view.best) {
    const best = frontOf(rows, ofX, ofY, view.best.split(",").map(Number)).sort((a, b) => ofX(a) - ofX(b));
    scene.lines.push({ key: "front", name: `not dominated (${best.length})`, color: "#d55e00", x: best.map(ofX), y: best.map(ofY), rows: best, marks: true });
  }
  return { scene, problem: "" };
};

/** The rows that no other row dominates. */
const frontOf = (rows, ofX, ofY, [betterX, betterY]) => {
  const order = Array.from(rows).sort((a, b) => betterX * (ofX(b) - ofX(a)) || betterY * (ofY(b) - ofY(a)));
  const kept = [];
  for (const row of order) {
    const last = kept[kept.length - 1];
    if (last === undefined || betterY * ofY(row) > betterY * ofY(last) || (ofY(row) === ofY(last) && ofX(row) === ofX(last))) kept.push(row);
  }
  return kept;
};

/** The edges of cells around some levels: half-way between them, or at their geometric mean. */
const edgesAround = (levels, log) => {
  const [of, back] = log ? [Math.log, Math.exp] : [(value) => value, (value) => value], at = levels.map(of), last = at.length - 1;
  if (last === 0) { const around = log ? 0.05 : Math.abs(at[0]) * 0.05 || 1; return [back(at[0] - around), back(at[0] + around)]; }
  const middles = at.slice(1).map((level, i) => (level + at[i]) / 2);
  return [at[0] - (at[1] - at[0]) / 2, ...middles, at[last] + (at[last] - at[last - 1]) / 2].map(back);
};

const mapScene = (view, rows, scene, ofX, ofY) => {
  const [levelsX, levelsY] = [ofX, ofY].map((of) => [...new Set(Array.from(rows, of))].sort((a, b) => a - b));
  if (levelsX.length * levelsY.length > 400000) return { scene, problem: "too many different values for a map: choose Points" };
  const { colorOf, legend, bar } = shading(view.color ?? view.y, view.log.color, rows);
  const [placeX, placeY] = [levelsX, levelsY].map((levels) => new Map(levels.map((level, i) => [level, i])));
  const cells = { edgesX: edgesAround(levelsX, view.log.x), edgesY: edgesAround(levelsY, view.log.y), i: [], j: [], rows: [], colors: [] };
  const taken = new Set();
  let twice = 0;
  for (const row of rows) {
    const [i, j] = [placeX.get(ofX(row)), placeY.get(ofY(row))], key = j * levelsX.length + i;
    if (taken.has(key)) { twice++; continue; }
    taken.add(key);
    cells.i.push(i); cells.j.push(j); cells.rows.push(row); cells.colors.push(colorOf(row));
  }
  scene.cells = cells;
  scene.extent = { x: extentOf(cells.edgesX), y: extentOf(cells.edgesY) };
  const empty = levelsX.length * levelsY.length - taken.size;
  scene.legend = [...legend, ...(empty > 0 ? [{ name: `no row (${empty} cells)`, color: "transparent" }] : [])];
  scene.bar = bar;
  return { scene, problem: twice ? `${twice} rows share a cell with another, of which the first is drawn: choose slices` : "" };
};
