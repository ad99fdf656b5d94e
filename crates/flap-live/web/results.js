"use strict";
// Draws the rows in the page. Nothing is fetched; all text goes into the page as text, never as markup.
(() => {
const $ = (id) => document.getElementById(id);
const data = JSON.parse($("data").textContent);

// ---- Columns: numbers by row; words as codes with their names. ----
const bytes = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
const TYPES = { f64: Float64Array, f32: Float32Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array };
const columns = data.columns.map((column) => {
  const raw = new TYPES[column.type](bytes(column.data));
  const words = column.words || null;
  let cells = raw;
  if (column.values) cells = Float64Array.from(raw, (code) => column.values[code] ?? NaN);
  if (words) cells = Float64Array.from(raw, (code) => (code < words.length ? code : NaN));
  return { ...column, words, cells };
});
const rows = data.rows;
const short = (value) => {
  if (Number.isNaN(value)) return "none";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) return value.toExponential(3).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(6)));
};
const shown = (column, row) => {
  const value = column.cells[row];
  if (column.words) return Number.isNaN(value) ? "none" : column.words[value];
  return short(value * column.factor);
};
const levelsOf = (column, among) => {
  const seen = new Set();
  for (const row of among) { const value = column.cells[row]; if (!Number.isNaN(value)) seen.add(value); if (seen.size > 5000) break; }
  return [...seen].sort((a, b) => a - b);
};
const everyRow = Array.from({ length: rows }, (_, row) => row);

// ---- State. ----
const start = data.start;
const state = {};
const reset = () => Object.assign(state, { kind: start.kind, x: start.x, y: start.y, by: start.by, color: start.color,
  best: start.best, slices: {}, filters: [], pinned: null, hover: null, selected: null, brush: null });
reset();

// Slices are offered for parameters with few values.
const axes = data.axes.map((index) => ({ index, levels: levelsOf(columns[index], everyRow) }))
  .filter((axis) => axis.levels.length > 1 && axis.levels.length <= 1000);
const needsSlice = (index) => state.kind !== "scatter" && ![state.x, state.y].includes(index)
  && !(state.kind === "line" && state.by === index);
const defaultSlices = () => {
  for (const axis of axes) {
    const given = start.where[columns[axis.index].name];
    const asked = given === undefined ? -1 : axis.levels.findIndex((level) => {
      const column = columns[axis.index];
      return column.words ? column.words[level] === given : Math.abs(level - given) <= 1e-9 * Math.abs(given);
    });
    if (asked >= 0) state.slices[axis.index] = asked;
    else state.slices[axis.index] = needsSlice(axis.index) ? axis.levels.length >> 1 : null;
  }
};
defaultSlices();

// ---- Which rows are drawn. ----
const visible = () => {
  const tests = [];
  for (const axis of axes) {
    const place = state.slices[axis.index];
    if (place !== null && place !== undefined) {
      const { cells } = columns[axis.index], value = axis.levels[place];
      tests.push((row) => cells[row] === value);
    }
  }
  for (const filter of state.filters) {
    const { cells } = columns[filter.index];
    tests.push((row) => cells[row] >= filter.low && cells[row] <= filter.high);
  }
  return everyRow.filter((row) => tests.every((test) => test(row)));
};

// ---- Colours. ----
const VIRIDIS = [[68,1,84],[72,36,117],[65,68,135],[53,95,141],[42,120,142],[33,145,140],[34,168,132],[68,191,112],[122,209,81],[189,223,38],[253,231,37]];
const shade = (share) => {
  const place = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1), low = Math.min(Math.floor(place), VIRIDIS.length - 2);
  const mix = VIRIDIS[low].map((part, i) => Math.round(part + (VIRIDIS[low + 1][i] - part) * (place - low)));
  return `rgb(${mix})`;
};
const FEW = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// ---- Axes. ----
const extent = (values) => {
  let low = Infinity, high = -Infinity;
  for (const value of values) { if (value < low) low = value; if (value > high) high = value; }
  return low <= high ? [low, high] : null;
};
const padded = ([low, high], share) => {
  const width = high - low;
  if (!(width > 1e-12 * Math.max(Math.abs(low), Math.abs(high)))) { const around = high === 0 ? 1 : 0.05 * Math.abs(high); return [low - around, high + around]; }
  return [low - share * width, high + share * width];
};
const ticks = ([low, high], count) => {
  const rough = (high - low) / count, ten = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5].find((factor) => factor * ten >= 0.75 * rough) || 10) * ten;
  const all = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; i++) all.push(i * step);
  const decimals = Math.min(Math.max(-Math.floor(Math.log10(step * 1.0001)), 0), 6);
  const plain = Math.max(Math.abs(low), Math.abs(high)) < 1e6 && step > 1e-5;
  return all.map((value) => ({ value, text: plain ? value.toFixed(decimals).replace(/^-(?=0\.?0*$)/, "") : short(value) }));
};
const edges = (levels) => {
  if (levels.length === 1) return padded([levels[0], levels[0]], 0);
  const middle = levels.slice(1).map((level, i) => (level + levels[i]) / 2), last = levels.length - 1;
  return [levels[0] - (levels[1] - levels[0]) / 2, ...middle, levels[last] + (levels[last] - levels[last - 1]) / 2];
};

// ---- The front: rows that no other row dominates. ----
const front = (list, xs, ys, [betterX, betterY]) => {
  const order = list.filter((row) => !Number.isNaN(xs[row]) && !Number.isNaN(ys[row]))
    .sort((a, b) => betterX * (xs[b] - xs[a]) || betterY * (ys[b] - ys[a]));
  const kept = [];
  for (const row of order) {
    const last = kept[kept.length - 1];
    if (last === undefined || betterY * ys[row] > betterY * ys[last] || (ys[row] === ys[last] && xs[row] === xs[last])) kept.push(row);
  }
  return kept.reverse();
};

// ---- Drawing. ----
const canvas = $("canvas"), pen = canvas.getContext("2d");
// The picture without what follows the pointer, so that pointing costs no drawing of every mark.
const base = document.createElement("canvas");
let scene = null;
const draw = () => {
  const width = canvas.clientWidth, height = canvas.clientHeight, ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio);
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  pen.font = "13px system-ui, sans-serif";
  const list = visible();
  const [x, y] = [columns[state.x], columns[state.y]];
  const colour = state.kind === "line" || state.color === null ? null : columns[state.color];
  const bar = colour !== null && !colour.words;
  const box = { left: 74, top: 14, right: width - (bar ? 120 : 18), bottom: height - 52 };
  const number = (column) => (row) => column.cells[row] * column.factor;
  const [ofX, ofY] = [number(x), number(y)];
  const whole = list.filter((row) => !Number.isNaN(ofX(row)) && !Number.isNaN(ofY(row)));
  scene = { box, list, marks: [], cells: null };
  const without = state.kind === "map" ? 0 : list.length - whole.length;
  let cells = null, rangeX = extent(whole.map(ofX)), rangeY = extent(whole.map(ofY));
  if (!rangeX || !rangeY) return say(list, without, "no row has both values: nothing is drawn");
  let problem = "";
  if (state.kind === "map") {
    const levelsX = levelsOf(x, whole).map((v) => v * x.factor), levelsY = levelsOf(y, whole).map((v) => v * y.factor);
    if (levelsX.length * levelsY.length > 400000) return say(list, without, "too many different values for a map: choose Points");
    cells = { edgesX: edges(levelsX), edgesY: edges(levelsY), levelsX, levelsY };
    rangeX = extent(cells.edgesX); rangeY = extent(cells.edgesY);
  } else {
    rangeX = padded(rangeX, 0.03);
    rangeY = rangeY[0] >= 0 && rangeY[0] < 0.3 * rangeY[1] ? [0, padded(rangeY, 0.05)[1]] : padded(rangeY, 0.05);
  }
  const toX = (value) => box.left + (value - rangeX[0]) / (rangeX[1] - rangeX[0]) * (box.right - box.left);
  const toY = (value) => box.bottom - (value - rangeY[0]) / (rangeY[1] - rangeY[0]) * (box.bottom - box.top);
  Object.assign(scene, { toX, toY });
  frame(box, rangeX, rangeY, toX, toY, x, y, state.kind !== "map");
  const legend = [];
  let rangeC = null;
  if (colour) {
    rangeC = extent(whole.map(number(colour)));
    if (rangeC) rangeC = padded(rangeC, 0);
  }
  const tint = (row) => {
    const value = colour.cells[row];
    if (Number.isNaN(value) || !rangeC) return css("--missing");
    if (colour.words) return FEW[value % FEW.length];
    return shade((value * colour.factor - rangeC[0]) / (rangeC[1] - rangeC[0]));
  };
  pen.save();
  pen.beginPath(); pen.rect(box.left, box.top, box.right - box.left, box.bottom - box.top); pen.clip();
  if (state.kind === "map") {
    problem = drawCells(cells, whole, ofX, ofY, toX, toY, colour ? tint : () => css("--accent"), legend, colour);
  } else if (state.kind === "line") {
    drawLines(list, ofX, ofY, toX, toY, legend);
  } else {
    const gone = css("--soft");
    pen.globalAlpha = whole.length > 5000 ? 0.7 : 1;
    const size = whole.length > 20000 ? 2 : whole.length > 3000 ? 3 : 5;
    for (const row of whole) {
      const [px, py] = [toX(ofX(row)), toY(ofY(row))];
      pen.fillStyle = colour ? tint(row) : gone;
      if (size < 5) pen.fillRect(px - size / 2, py - size / 2, size, size);
      else { pen.beginPath(); pen.arc(px, py, 2.7, 0, 7); pen.fill(); }
      scene.marks.push({ row, px, py });
    }
    pen.globalAlpha = 1;
    if (state.best) {
      const best = front(whole, x.cells, y.cells, state.best.split(",").map(Number));
      path(best.map((row) => [toX(ofX(row)), toY(ofY(row))]), "#d55e00", 2, true);
      legend.push(["#d55e00", `not dominated (${best.length})`]);
    }
  }
  pen.restore();
  if (bar && rangeC) colourBar(box, width, rangeC, colour);
  if (colour && colour.words) for (const level of levelsOf(colour, whole)) legend.push([FEW[level % FEW.length], colour.words[level]]);
  legendText(legend);
  base.width = canvas.width; base.height = canvas.height;
  base.getContext("2d").drawImage(canvas, 0, 0);
  overlay();
  return say(list, without, problem);
};
const frame = (box, rangeX, rangeY, toX, toY, x, y, grid) => {
  pen.strokeStyle = css("--line"); pen.fillStyle = css("--ink"); pen.lineWidth = 1;
  pen.textAlign = "center"; pen.textBaseline = "top";
  for (const { value, text } of ticks(rangeX, Math.min(9, (box.right - box.left) / 90))) {
    const place = Math.round(toX(value)) + 0.5;
    rule(place, grid ? box.top : box.bottom, place, box.bottom + 5);
    if (!x.words) pen.fillText(text, place, box.bottom + 8);
  }
  pen.textAlign = "right"; pen.textBaseline = "middle";
  for (const { value, text } of ticks(rangeY, Math.min(9, (box.bottom - box.top) / 60))) {
    const place = Math.round(toY(value)) + 0.5;
    rule(box.left - 5, place, grid ? box.right : box.left, place);
    if (!y.words) pen.fillText(text, box.left - 8, place);
  }
  pen.strokeStyle = css("--soft");
  pen.strokeRect(box.left + 0.5, box.top + 0.5, box.right - box.left, box.bottom - box.top);
  pen.textAlign = "center"; pen.textBaseline = "alphabetic";
  pen.font = "600 13.5px system-ui, sans-serif";
  pen.fillText(x.title, (box.left + box.right) / 2, box.bottom + 42);
  turned(y.title, 16, (box.top + box.bottom) / 2);
  pen.font = "13px system-ui, sans-serif";
};
const rule = (x1, y1, x2, y2) => { pen.beginPath(); pen.moveTo(x1, y1); pen.lineTo(x2, y2); pen.stroke(); };
const turned = (text, x, y) => { pen.save(); pen.translate(x, y); pen.rotate(-Math.PI / 2); pen.fillText(text, 0, 0); pen.restore(); };
const path = (points, colour, width, dots, dashes = []) => {
  pen.strokeStyle = pen.fillStyle = colour; pen.lineWidth = width; pen.lineJoin = "round";
  pen.beginPath();
  let down = false;
  for (const [px, py] of points) {
    if (Number.isNaN(py)) { down = false; continue; }
    if (down) pen.lineTo(px, py); else pen.moveTo(px, py);
    down = true;
  }
  pen.setLineDash(dashes);
  pen.stroke();
  pen.setLineDash([]);
  if (dots) for (const [px, py] of points) if (!Number.isNaN(py)) { pen.beginPath(); pen.arc(px, py, width + 0.6, 0, 7); pen.fill(); }
};
const drawLines = (list, ofX, ofY, toX, toY, legend) => {
  const by = state.by === null ? null : columns[state.by];
  const groups = new Map();
  for (const row of list) {
    const key = by ? by.cells[row] : 0;
    if (!groups.has(key)) groups.set(key, []);
    groups.get(key).push(row);
  }
  const keys = [...groups.keys()].sort((a, b) => a - b);
  // Rows of a response lie in the order of its branches, which go up and down: each is a line of its own.
  const branch = data.branch === null ? null : columns[data.branch], dark = window.matchMedia("(prefers-color-scheme: dark)").matches;
  keys.forEach((key, place) => {
    const members = groups.get(key);
    if (!branch) members.sort((a, b) => ofX(a) - ofX(b));
    const colour = by && !by.words && keys.length > 2 ? shade(dark ? 0.25 + 0.75 * place / (keys.length - 1) : 0.93 * place / (keys.length - 1)) : FEW[place % FEW.length];
    const points = members.map((row) => [toX(ofX(row)), toY(ofY(row))]);
    const stretches = branch ? new Map(members.map((row) => [branch.cells[row], []])) : new Map([[0, points]]);
    if (branch) members.forEach((row, i) => stretches.get(branch.cells[row]).push(points[i]));
    for (const [code, stretch] of stretches) {
      const unstable = branch && branch.words && branch.words[code] === "unstable";
      path(stretch, colour, 2, list.length < 400 && !unstable, unstable ? [7, 5] : []);
    }
    members.forEach((row, i) => { if (!Number.isNaN(points[i][1])) scene.marks.push({ row, px: points[i][0], py: points[i][1] }); });
    if (by && place < 40) legend.push([colour, by.words ? by.words[key] ?? "none" : `${short(key * by.factor)} ${by.unit}`]);
  });
  if (by) legend.unshift([null, by.label + ":"]);
};
const drawCells = (cells, list, ofX, ofY, toX, toY, tint, legend, colour) => {
  const place = (levels) => new Map(levels.map((level, i) => [level, i]));
  const [placeX, placeY] = [place(cells.levelsX), place(cells.levelsY)];
  const [ex, ey] = [cells.edgesX.map(toX), cells.edgesY.map(toY)];
  pen.fillStyle = css("--missing");
  pen.fillRect(ex[0], ey[ey.length - 1], ex[ex.length - 1] - ex[0], ey[0] - ey[ey.length - 1]);
  const taken = new Map();
  let twice = 0;
  for (const row of list) {
    const [i, j] = [placeX.get(ofX(row)), placeY.get(ofY(row))];
    const key = j * cells.levelsX.length + i;
    if (taken.has(key)) { twice++; continue; }
    taken.set(key, row);
    pen.fillStyle = tint(row);
    pen.fillRect(ex[i], ey[j + 1], ex[i + 1] - ex[i] + 0.5, ey[j] - ey[j + 1] + 0.5);
    scene.marks.push({ row, px: (ex[i] + ex[i + 1]) / 2, py: (ey[j] + ey[j + 1]) / 2, cell: [ex[i], ey[j + 1], ex[i + 1], ey[j]] });
  }
  const empty = cells.levelsX.length * cells.levelsY.length - taken.size;
  const without = colour ? [...taken.values()].filter((row) => Number.isNaN(colour.cells[row])).length : 0;
  if (empty + without) legend.push([css("--missing"), `no value (${empty + without} cells)`]);
  return twice ? `${twice} rows share a cell with another, of which the first is drawn: choose slices` : "";
};
const colourBar = (box, width, range, column) => {
  const left = box.right + 18;
  for (let i = 0; i < 100; i++) {
    const y = box.bottom - (i + 1) / 100 * (box.bottom - box.top);
    pen.fillStyle = shade(i / 99);
    pen.fillRect(left, y, 16, (box.bottom - box.top) / 100 + 0.7);
  }
  pen.fillStyle = css("--ink"); pen.textAlign = "left"; pen.textBaseline = "middle";
  for (const { value, text } of ticks(range, 6)) {
    pen.fillText(text, left + 21, box.bottom - (value - range[0]) / (range[1] - range[0]) * (box.bottom - box.top));
  }
  pen.textAlign = "center"; pen.textBaseline = "alphabetic";
  pen.font = "600 13.5px system-ui, sans-serif";
  turned(column.title, width - 8, (box.top + box.bottom) / 2);
  pen.font = "13px system-ui, sans-serif";
};
const legendText = (entries) => {
  $("legend").replaceChildren(...entries.map(([colour, text]) => {
    const entry = document.createElement("span");
    if (colour) { const swatch = document.createElement("i"); swatch.style.background = colour; entry.append(swatch); }
    entry.append(text);
    return entry;
  }));
};
const point = () => {
  if (!scene.toX || base.width !== canvas.width || base.height !== canvas.height) return draw();
  pen.save();
  pen.setTransform(1, 0, 0, 1, 0, 0);
  pen.clearRect(0, 0, canvas.width, canvas.height);
  pen.drawImage(base, 0, 0);
  pen.restore();
  return overlay();
};
const overlay = () => {
  for (const [row, colour] of [[state.pinned, "#d55e00"], [state.hover, css("--ink")]]) {
    const mark = row === null ? null : scene.marks.find((mark) => mark.row === row);
    if (!mark) continue;
    pen.strokeStyle = colour; pen.lineWidth = 2;
    pen.beginPath();
    if (mark.cell) pen.rect(mark.cell[0], mark.cell[1], mark.cell[2] - mark.cell[0], mark.cell[3] - mark.cell[1]);
    else pen.arc(mark.px, mark.py, 7, 0, 7);
    pen.stroke();
  }
  if (state.brush) {
    const [x1, y1, x2, y2] = state.brush;
    pen.fillStyle = css("--accent"); pen.globalAlpha = 0.18; pen.fillRect(x1, y1, x2 - x1, y2 - y1);
    pen.globalAlpha = 1; pen.strokeStyle = css("--accent"); pen.strokeRect(x1, y1, x2 - x1, y2 - y1);
  }
};
const say = (list, without, problem) => {
  const parts = [`${list.length} of ${rows} rows shown`];
  if (data.of > rows) parts.push(`the file has ${data.of}: every ${data.stride}th is in this page`);
  if (data.single) parts.push("measures to seven digits");
  if (without) parts.push(`${without} without a value`);
  if (problem) parts.push(problem);
  $("status").textContent = parts.join(" · ");
  canvas.setAttribute("aria-label", `${state.kind}: ${columns[state.y].title} over ${columns[state.x].title}, ${list.length} rows`);
};

// ---- Rows as a table. ----
const table = () => {
  const list = state.selected || (state.pinned !== null ? [state.pinned] : state.hover !== null ? [state.hover] : []);
  const most = 100;
  $("rows-title").textContent = state.selected
    ? `${list.length} selected rows${list.length > most ? `, the first ${most}` : ""}` : state.pinned !== null ? "The row that was clicked" : "The row pointed at";
  const head = document.createElement("tr");
  for (const column of columns) {
    const cell = document.createElement("th");
    cell.scope = "col"; cell.textContent = column.label; cell.title = column.name;
    const unit = document.createElement("small"); unit.textContent = column.unit || "\u00a0"; cell.append(unit);
    head.append(cell);
  }
  const body = list.slice(0, most).map((row) => {
    const line = document.createElement("tr");
    for (const column of columns) { const cell = document.createElement("td"); cell.textContent = shown(column, row); line.append(cell); }
    return line;
  });
  const element = document.createElement("table");
  element.append(head, ...body);
  $("table").replaceChildren(element);
};
const tip = () => {
  const mark = state.hover === null ? null : scene.marks.find((mark) => mark.row === state.hover);
  $("tip").hidden = !mark;
  if (!mark) return;
  const wanted = new Set([0, ...data.axes, state.x, state.y, state.by, state.color].filter((index) => index !== null));
  $("tip").replaceChildren(...[...wanted].map((index) => {
    const line = document.createElement("div"), name = document.createElement("b");
    name.textContent = `${columns[index].label}: `;
    line.append(name, `${shown(columns[index], mark.row)} ${columns[index].words ? "" : columns[index].unit}`);
    return line;
  }));
  const right = mark.px > canvas.clientWidth * 0.6;
  $("tip").style.left = right ? "" : `${mark.px + 14}px`;
  $("tip").style.right = right ? `${canvas.clientWidth - mark.px + 14}px` : "";
  $("tip").style.top = `${Math.max(mark.py - 20, 0)}px`;
};
const refresh = (whole = true) => { if (whole) draw(); else point(); tip(); table(); };

// ---- Controls. ----
const option = (value, text) => { const element = document.createElement("option"); element.value = value; element.textContent = text; return element; };
const fill = (select, list, none) => select.replaceChildren(...(none ? [option("", none)] : []), ...list.map((index) => option(index, columns[index].title)));
const numbers = columns.map((_, index) => index).filter((index) => !columns[index].words);
const all = columns.map((_, index) => index);
fill($("x"), numbers); fill($("y"), numbers); fill($("by"), all, "one line"); fill($("color"), all, "one colour");
const show = () => {
  for (const name of ["kind", "x", "y", "best"]) $(name).value = state[name];
  for (const name of ["by", "color"]) $(name).value = state[name] ?? "";
  $("by").parentElement.hidden = state.kind !== "line";
  $("color").parentElement.hidden = state.kind === "line";
  $("best").parentElement.hidden = state.kind !== "scatter";
  $("slices").replaceChildren(...axes.map((axis) => {
    const label = document.createElement("label"), select = document.createElement("select"), column = columns[axis.index];
    label.append(`${column.title} `, select);
    select.append(option("", "all"), ...axis.levels.map((level, place) => option(place, column.words ? column.words[level] : short(level * column.factor))));
    select.dataset.column = column.name;
    select.value = state.slices[axis.index] ?? "";
    select.onchange = () => { state.slices[axis.index] = select.value === "" ? null : Number(select.value); changed(); };
    return label;
  }));
  if (!axes.length) $("slices").textContent = "none of few values";
  $("filters").replaceChildren(...state.filters.map((filter, number) => filterRow(filter, number)));
};
const filterRow = (filter, number) => {
  const row = document.createElement("div"), select = document.createElement("select"), output = document.createElement("output");
  row.className = "filter";
  fill(select, numbers); select.value = filter.index; select.setAttribute("aria-label", `Column of filter ${number + 1}`);
  const remove = document.createElement("button");
  remove.type = "button"; remove.textContent = "Remove";
  const sliders = ["low", "high"].map((end) => {
    const slider = document.createElement("input");
    slider.type = "range"; slider.min = 0; slider.max = 1000; slider.step = 1;
    slider.setAttribute("aria-label", `${end === "low" ? "Least" : "Most"} of filter ${number + 1}`);
    slider.oninput = () => {
      const [low, high] = filter.range;
      filter[end] = Number(slider.value) === (end === "low" ? 0 : 1000) ? (end === "low" ? low : high) : low + slider.value / 1000 * (high - low);
      text(); changed(false);
    };
    return slider;
  });
  const text = () => {
    const { factor, unit } = columns[filter.index];
    output.textContent = `${short(filter.low * factor)} to ${short(filter.high * factor)} ${unit}`;
  };
  const place = () => {
    const [low, high] = filter.range, width = high - low || 1;
    sliders[0].value = Math.round((filter.low - low) / width * 1000);
    sliders[1].value = high === low ? 1000 : Math.round((filter.high - low) / width * 1000);
    text();
  };
  select.onchange = () => { Object.assign(filter, filterOf(Number(select.value))); place(); changed(false); };
  remove.onclick = () => { state.filters.splice(number, 1); changed(); };
  row.append(select, ...sliders, output, remove);
  place();
  return row;
};
const filterOf = (index) => {
  const range = extent(columns[index].cells) || [0, 0];
  return { index, range, low: range[0], high: range[1] };
};
const changed = (rebuild = true) => {
  state.hover = state.selected = state.brush = null;
  if (rebuild) show();
  refresh();
};
for (const name of ["kind", "x", "y", "by", "color", "best"]) {
  $(name).onchange = () => {
    const value = $(name).value;
    state[name] = ["kind", "best"].includes(name) ? value : value === "" ? null : Number(value);
    if (name === "kind" && state.kind === "map") {
      const [a, b] = axes.map((axis) => axis.index);
      if (a !== undefined && b !== undefined) {
        if (state.color === null || axes.some((axis) => axis.index === state.color)) state.color = state.y;
        if (!axes.some((axis) => axis.index === state.x)) state.x = b;
        if (!axes.some((axis) => axis.index === state.y) || state.y === state.x) state.y = state.x === a ? b : a;
      }
    }
    // What a line or a cell shows alone is one value of everything else.
    if (["kind", "x", "y", "by"].includes(name)) {
      for (const axis of axes) {
        const needed = needsSlice(axis.index);
        if (!needed) state.slices[axis.index] = null;
        else if (state.slices[axis.index] === null) state.slices[axis.index] = axis.levels.length >> 1;
      }
    }
    changed();
  };
}
$("add").onclick = () => { state.filters.push(filterOf(state.y)); changed(); $("filters").lastElementChild.querySelector("select").focus(); };
$("controls").onsubmit = (event) => event.preventDefault();
$("controls").onreset = (event) => { event.preventDefault(); reset(); defaultSlices(); changed(); };

// ---- Pointer and keyboard. ----
const at = (event) => { const box = canvas.getBoundingClientRect(); return [event.clientX - box.left, event.clientY - box.top]; };
const nearest = ([px, py]) => {
  let best = null, least = 18 * 18;
  for (const mark of scene.marks) {
    if (mark.cell) { if (px >= mark.cell[0] && px < mark.cell[2] && py >= mark.cell[1] && py < mark.cell[3]) return mark; continue; }
    const distance = (mark.px - px) ** 2 + (mark.py - py) ** 2;
    if (distance < least) { least = distance; best = mark; }
  }
  return best;
};
let from = null;
canvas.onpointerdown = (event) => { from = at(event); canvas.setPointerCapture(event.pointerId); };
canvas.onpointermove = (event) => {
  const place = at(event);
  if (from && Math.hypot(place[0] - from[0], place[1] - from[1]) > 5) {
    state.brush = [Math.min(from[0], place[0]), Math.min(from[1], place[1]), Math.max(from[0], place[0]), Math.max(from[1], place[1])];
    state.hover = null;
  } else {
    const mark = nearest(place), hover = mark ? mark.row : null;
    if (hover === state.hover) return;
    state.hover = hover;
  }
  later();
};
canvas.onpointerup = (event) => {
  if (state.brush && from && Math.hypot(at(event)[0] - from[0], at(event)[1] - from[1]) > 5) {
    const [x1, y1, x2, y2] = state.brush;
    state.selected = scene.marks.filter(({ px, py }) => px >= x1 && px <= x2 && py >= y1 && py <= y2).map((mark) => mark.row);
  } else {
    const mark = nearest(at(event));
    Object.assign(state, { pinned: mark ? mark.row : null, selected: null, brush: null });
  }
  from = null;
  later();
};
canvas.onpointerleave = () => { if (!from) { state.hover = null; later(); } };
canvas.onkeydown = (event) => {
  const step = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
  if (step && scene.marks.length) {
    const place = scene.marks.findIndex((mark) => mark.row === state.hover);
    const next = place < 0 ? 0 : (place + step + scene.marks.length) % scene.marks.length;
    state.hover = scene.marks[next].row;
  } else if (event.key === "Enter") Object.assign(state, { pinned: state.hover, selected: null });
  else if (event.key === "Escape") Object.assign(state, { pinned: null, hover: null, selected: null, brush: null });
  else return;
  event.preventDefault();
  later();
};
let waiting = false;
const later = () => { if (!waiting) { waiting = true; requestAnimationFrame(() => { waiting = false; refresh(false); }); } };
window.addEventListener("resize", () => refresh());
window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => refresh());
show();
refresh();
})();
