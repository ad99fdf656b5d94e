// A chart of lines, points or cells on uPlot, which both pages use.
//
//   const chart = new Chart(element, { height, name, onPoint(mark), onPin(mark), onSelect(rows), onView(view), onHidden(groups), onScheme() });
//   chart.draw({ x: { label, unit, log }, y, lines, points, cells, extent, title, legend, bar, statuses, gaps, bands, marker });
//   lines:  [{ key, group, name, color, x, y, rows, dash, width, ghost, marks }]   null in y is a gap; the legend switches groups
//   points, cells: see chart-points.js; extent: { x: [low, high], y } of them
//   title:  what the lines differ in; legend: [{ name, color }] of points and cells; bar: { label, unit, low, high, log } of shades
//   statuses: [{ name, color, shape }] of rows without a settled motion
//   gaps:   [{ x, text, color, shape, row, name }]   values of x without a value of y, with the status
//   bands:  [{ from, to, name }]     shaded ranges of x
//   marker: { x, y } or null         a ring
//
// A mark is { key, row, x, y, name }; that of a gap has the key "gap" and all gaps at its x. `view` is { x: [low, high] or null, y }; null shows everything. Drag zooms, Shift and
// drag moves, the wheel zooms, a double click shows everything. Keys: arrows go along a line and from line to line, Enter
// pins, + and - zoom, Shift and arrows move, Escape shows everything. With `chart.drag = "select"` a drag selects rows. Two
// fingers zoom and move. `onScheme` draws the scene again after its colours have changed.

class Chart {
  constructor(parent, options = {}) {
    this.options = options;
    this.view = { x: null, y: null };
    this.drag = "zoom";
    this.hidden = new Set();
    this.selectedRows = new Set();
    this.box = element("div", { class: "chart-box" });
    this.legend = element("div", { class: "legend" });
    parent.append(this.box, this.legend);
    this.plot = null;
    this.scene = null;
    this.shape = "";
    this.mark = null;
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.box);
    this.repaint = () => this.restyle();
    darkScheme.addEventListener("change", this.repaint);
  }

  /** Draws everything in the colours of the scheme, which has changed. */
  restyle() {
    if (this.options.onScheme) this.options.onScheme();
    else this.plot?.redraw(false);
  }

  /** Draws a scene. Scenes of the same shape keep the plot and change its data alone. */
  draw(scene) {
    this.scene = scene;
    const shape = JSON.stringify([scene.x, scene.y, scene.lines.length, Boolean(scene.extent)]);
    const data = this.data();
    if (!this.plot || shape !== this.shape) {
      this.plot?.destroy();
      this.shape = shape;
      this.plot = new uPlot(this.settings(), data, this.box);
      this.listen();
    }
    scene.lines.forEach((line, i) => {
      const series = this.plot.series[i + 1];
      Object.assign(series, { show: line.ghost || !this.hidden.has(groupOf(line)), width: line.width ?? 2, dash: line.dash, alpha: line.ghost ? 0.35 : 1 });
      series.points.show = () => line.marks ?? false;
    });
    this.plot.setData(data);
    writeLegend(this);
  }

  /** Columns for uPlot: x, then y of each line, null where there is none. */
  data() {
    const { x, y, extent } = this.scene;
    // The extent of points and cells is a line that is not seen.
    const lines = extent ? [...this.scene.lines, extent] : this.scene.lines;
    if (lines.length === 0) return [[0, 1]];
    const positive = (list, log) => (log ? list.map((value) => (value > 0 ? value : null)) : list);
    const isShared = lines.every((line) => line.x === lines[0].x);
    if (isShared && !x.log) return [lines[0].x, ...lines.map((line) => positive(line.y, y.log))];
    const tables = lines.map((line) => {
      const kept = line.x.map((_, i) => i).filter((i) => !x.log || line.x[i] > 0);
      const values = positive(line.y, y.log);
      return [kept.map((i) => line.x[i]), kept.map((i) => values[i])];
    });
    return tables.length === 1 ? tables[0] : uPlot.join(tables);
  }

  settings() {
    const { x, y, lines, extent, cells } = this.scene;
    const font = PICTURE_LETTERS;
    const axis = (scale, side) => ({ scale, side, label: titled(scale === "x" ? x : y), font, labelFont: font, labelSize: 22,
      size: (_, labels) => (scale === "x" ? 40 : Math.max(46, 24 + 7.5 * Math.max(...(labels ?? []).map((label) => label.length), 0))),
      splits: (plot, _, low, high) => {
        const room = scale === "x" ? plot.bbox.width / 80 : plot.bbox.height / 42;
        return ((scale === "x" ? x : y).log ? logTicks : evenTicks)(low, high, Math.max(room / uPlot.pxRatio, 2));
      },
      filter: (_, ticks) => ticks,
      stroke: () => styleColour("--soft"), grid: { stroke: () => styleColour("--line"), width: 1 },
      ticks: { stroke: () => styleColour("--line"), width: 1 },
      values: (_, ticks) => tickLabels(ticks) });
    return {
      ...this.size(), legend: { show: false }, padding: [10, 14, 0, 0],
      cursor: { drag: { x: true, y: true, setScale: false, uni: 12 }, points: { size: 8 }, bind: { dblclick: () => () => this.setView({ x: null, y: null }, true) } },
      scales: {
        x: { time: false, distr: x.log ? 3 : 1, range: (_, low, high) => this.view.x ?? Chart.range(low, high, x.log, this.scene.points ? 0.02 : 0) },
        y: { distr: y.log ? 3 : 1, range: (_, low, high) => this.view.y ?? Chart.range(low, high, y.log, cells ? 0 : 0.06) },
      },
      axes: [axis("x", 2), axis("y", 3)],
      series: [{}, ...lines.map((line, i) => this.series(i, line.width ?? 2)), ...(extent ? [this.series(lines.length, 0)] : [])],
      hooks: { drawAxes: [() => this.paintBehind()], draw: [() => this.paintBefore()], setCursor: [() => this.pointed()], setSelect: [() => this.selected()] },
    };
  }

  /** The series of a line. Values between two gaps are points, in lines without marks too. */
  series(place, width) {
    const filter = (plot, at, isMarked) => (isMarked || place >= this.scene.lines.length ? null : alone(plot.data[at]));
    return { stroke: () => this.scene.lines[place]?.color ?? "transparent", width, pxAlign: 0, points: { show: false, size: 5, filter } };
  }

  /** The range of an axis, with a margin; from zero if the values come near it. */
  static range(low, high, log, margin) {
    if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return log ? [1, 10] : [0, 1];
    if (log) return low === high ? [low / 2, high * 2] : [low / (high / low) ** margin, high * (high / low) ** margin];
    if (low === high) { const around = high === 0 ? 1 : 0.05 * Math.abs(high); return [low - around, high + around]; }
    const room = margin * (high - low);
    return [margin > 0.05 && low >= 0 && low < 0.3 * high ? 0 : low - room, high + room];
  }

  size() {
    return { width: Math.max(this.box.clientWidth, 160), height: this.options.height ?? Math.max(this.box.clientHeight, 120) };
  }

  resize() {
    const { width, height } = this.size();
    if (this.plot && (this.plot.width !== width || this.plot.height !== height)) this.plot.setSize({ width, height });
  }

  /** Bands, cells and points under the lines. */
  paintBehind() {
    const { plot, scene } = this, { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath(); ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height); ctx.clip();
    if (scene.cells) paintCells(this);
    if (scene.points) paintPoints(this);
    for (const { from, to } of scene.bands ?? []) {
      const [left, right] = [from, to].map((value) => Math.min(Math.max(plot.valToPos(value, "x", true), bbox.left), bbox.left + bbox.width));
      ctx.fillStyle = styleColour("--band");
      ctx.fillRect(left, bbox.top, Math.max(right - left, 2), bbox.height);
    }
    ctx.restore();
  }

  /** Gaps and the marker, over the lines. */
  paintBefore() {
    const { plot, scene } = this, { ctx, bbox } = plot, ratio = uPlot.pxRatio;
    ctx.save();
    ctx.beginPath(); ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height); ctx.clip();
    for (const { gap: { color, shape }, at, lane } of placedGaps(this)) {
      ctx.save();
      ctx.translate(bbox.left + at * ratio, bbox.top + bbox.height - (GAP_FOOT + lane * GAP_LANE) * ratio);
      ctx.scale(ratio, ratio);
      ctx.fillStyle = color;
      ctx.fill(new Path2D(shape));
      ctx.restore();
    }
    ctx.setLineDash([]); // the last line may have been dashed
    if (this.selectedRows.size > 0) paintSelected(this, this.selectedRows);
    ctx.strokeStyle = styleColour("--ink");
    ctx.lineWidth = 2 * ratio;
    if (scene.marker && Number.isFinite(scene.marker.y)) {
      ctx.beginPath(); ctx.arc(plot.valToPos(scene.marker.x, "x", true), plot.valToPos(scene.marker.y, "y", true), 6 * ratio, 0, 7); ctx.stroke();
    }
    ctx.restore();
  }

  /** Moves a vertical line to a value of x: nothing is painted again. */
  setTime(time) {
    if (!this.plot) return;
    if (this.time?.parentNode !== this.plot.over) {
      this.time = element("div", { class: "chart-time" });
      this.plot.over.append(this.time);
    }
    this.time.style.left = `${this.plot.valToPos(time, "x")}px`;
  }

  // ---- Marks under the pointer. ----

  pointed() {
    const { left, top } = this.plot.cursor;
    this.tell(left < 0 ? null : this.nearest(left, top));
  }

  nearest(left, top) {
    if (this.scene.cells) return cellAt(this, left, top);
    if (this.scene.points) return nearestPoint(this, left, top);
    const gap = gapAt(this, left, top);
    if (gap) return gap;
    let best = null, least = 30 * 30;
    for (const line of this.scene.lines) {
      if (line.ghost || this.hidden.has(groupOf(line))) continue;
      const middle = Chart.closest(line.x, this.plot.posToVal(left, "x"));
      for (let i = Math.max(middle - 2, 0); i <= Math.min(middle + 2, line.x.length - 1); i++) {
        if (line.y[i] === null || line.y[i] === undefined) continue;
        const distance = (this.plot.valToPos(line.x[i], "x") - left) ** 2 + (this.plot.valToPos(line.y[i], "y") - top) ** 2;
        if (distance < least) { least = distance; best = this.markOf(line, i); }
      }
    }
    return best;
  }

  markOf(line, i) {
    return { key: line.key, name: line.name, row: line.rows ? line.rows[i] : i, index: i, x: line.x[i], y: line.y[i] };
  }

  /** The place of the value nearest to `value` in a rising list. */
  static closest(list, value) {
    let low = 0, high = list.length - 1;
    while (high - low > 1) { const middle = (low + high) >> 1; if (list[middle] < value) low = middle; else high = middle; }
    return value - list[low] < list[high] - value ? low : high;
  }

  tell(mark) {
    const isSame = mark?.key === this.mark?.key && mark?.index === this.mark?.index && mark?.y === this.mark?.y && mark?.x === this.mark?.x;
    this.mark = mark;
    if (!isSame) this.options.onPoint?.(mark);
  }

  /** The mark again after its line has changed: at the same x, or the nearest. */
  markAgain() {
    const line = this.scene.lines.find(({ key }) => key === this.mark?.key);
    const at = line ? Chart.closest(line.x, this.mark.x) : -1, isThere = at >= 0 && line.y[at] !== null && line.y[at] !== undefined;
    this.mark = isThere ? this.markOf(line, at) : null;
    return this.mark;
  }

  // ---- Zoom and movement. ----

  selected() {
    const { select } = this.plot;
    if (select.width < 8 && select.height < 8) return;
    if (this.drag === "select") {
      const value = (scale, at) => this.plot.posToVal(at, scale);
      const x = [value("x", select.left), value("x", select.left + select.width)], y = [value("y", select.top + select.height), value("y", select.top)];
      this.plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
      this.wasDragged = true;
      this.options.onSelect?.(rowsWithin(this.scene, x, y));
      return;
    }
    this.wasDragged = true;
    const view = { ...this.view };
    if (select.width >= 8) view.x = [this.plot.posToVal(select.left, "x"), this.plot.posToVal(select.left + select.width, "x")];
    if (select.height >= 8) view.y = [this.plot.posToVal(select.top + select.height, "y"), this.plot.posToVal(select.top, "y")];
    this.plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.setView(view, true);
  }

  /** Marks the rows of a set. */
  select(rows) {
    this.selectedRows = rows;
    this.plot?.redraw(false);
  }

  /** Shows a part of the plane; `byUser` tells `onView`. */
  setView(view, byUser = false) {
    this.view = { x: view?.x ?? null, y: view?.y ?? null };
    if (this.plot) this.plot.setData(this.plot.data);
    if (byUser) this.options.onView?.(this.view);
  }

  /** Zooms by `factor` around a point of the plane (shares of the box), and moves by shares of the box. */
  change(factor, [atX, atY], [moveX, moveY]) {
    const moved = (scale, at, move) => {
      const { min, max, distr } = this.plot.scales[scale];
      const [to, from] = distr === 3 ? [Math.log, Math.exp] : [(v) => v, (v) => v];
      const [low, high] = [to(min), to(max)], width = (high - low) * factor, middle = low + at * (high - low);
      const start = middle - at * width + move * (high - low);
      return [from(start), from(start + width)];
    };
    this.setView({ x: moved("x", atX, moveX), y: moved("y", atY, moveY) }, true);
  }

  listen() {
    const { over } = this.plot;
    over.tabIndex = 0;
    over.setAttribute("role", "img");
    over.setAttribute("aria-label", this.options.name ?? "Chart");
    const share = (event) => {
      const box = over.getBoundingClientRect();
      return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    };
    over.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.shiftKey && !event.metaKey) return;
      event.preventDefault();
      this.change(event.deltaY + event.deltaX > 0 ? 1.2 : 1 / 1.2, share(event), [0, 0]);
    }, { passive: false });
    over.addEventListener("mousedown", (event) => {
      if (!event.shiftKey) return;
      event.stopImmediatePropagation();
      let last = share(event);
      const move = (next) => { const now = share(next); this.change(1, [0.5, 0.5], [last[0] - now[0], last[1] - now[1]]); last = now; };
      const end = () => { removeEventListener("mousemove", move); removeEventListener("mouseup", end); };
      addEventListener("mousemove", move);
      addEventListener("mouseup", end);
    }, true);
    over.addEventListener("mousedown", () => { this.wasDragged = false; });
    over.addEventListener("click", () => { if (!this.wasDragged) this.options.onPin?.(this.mark); });
    over.addEventListener("keydown", (event) => this.pressed(event));
    listenToFingers(this, over);
  }

  pressed(event) {
    const [right, up] = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [0, 0];
    if ((right || up) && event.shiftKey) this.change(1, [0.5, 0.5], [0.1 * right, 0.1 * up]);
    else if (right || up) this.step(right, up);
    else if (event.key === "+" || event.key === "-") this.change(event.key === "-" ? 1.25 : 0.8, [0.5, 0.5], [0, 0]);
    else if (event.key === "Enter") this.options.onPin?.(this.mark);
    else if (event.key === "Escape") this.setView({ x: null, y: null }, true);
    else return;
    event.preventDefault();
  }

  /** Goes along a line, or to the line above or below. */
  step(right, up) {
    const { points, cells } = this.scene;
    const show = (mark) => {
      this.plot.setCursor({ left: this.plot.valToPos(mark.x, "x"), top: this.plot.valToPos(mark.y, "y") }, false);
      this.tell(mark);
    };
    if (cells) return show(cellStep(cells, this.mark, right, up));
    if (points && points.x.length > 0) {
      const at = this.mark?.key === "point" ? (this.mark.index + (right || up) + points.x.length) % points.x.length : 0;
      return show(pointMark(points, at));
    }
    const lines = this.scene.lines.filter((line) => !line.ghost && !this.hidden.has(groupOf(line)));
    if (lines.length === 0) return;
    let place = lines.findIndex((line) => line.key === this.mark?.key);
    const begins = place < 0;
    place = begins ? 0 : (place + up + lines.length) % lines.length;
    const line = lines[place], full = line.x.map((_, i) => i).filter((i) => line.y[i] !== null && line.y[i] !== undefined);
    if (full.length === 0) return;
    const before = begins ? -1 : full.findIndex((i) => i >= this.mark.index);
    const next = full[Math.min(Math.max(before + right, 0), full.length - 1)];
    show(this.markOf(line, next));
  }

  // ---- Pictures. ----

  /** The picture as a PNG, with its legend. */
  png() { return pngOfChart(this); }

  /** The picture as SVG: lines as paths. */
  svg() { return onPaper(this, () => svgOfChart(this)); }

  destroy() {
    this.observer.disconnect();
    darkScheme.removeEventListener("change", this.repaint);
    this.plot?.destroy();
    this.box.remove();
    this.legend.remove();
  }
}
