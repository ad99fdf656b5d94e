// @ts-check
// A chart of lines, points or cells on uPlot, which both pages use.
//
// A drag zooms, or selects rows if `drag` is "select". A double click shows everything. The other gestures and the keys
// are in `input.js` and `touch.js`. `types.d.ts` describes scenes, marks and options.

import { element } from "../shared/dom.js";
import { labelWithUnit } from "../shared/format.js";
import { darkScheme, styleColour } from "../shared/theme.js";
import { evenTicks, logTicks, tickLabels } from "./axes.js";
import { gapHeight, placedGaps } from "./gaps.js";
import { listenToInput } from "./input.js";
import { writeLegend } from "./legend.js";
import { axisRange, groupOf, isolatedPoints } from "./lines.js";
import { isSameMark, markAt, renewedMark, rowsWithin } from "./marks.js";
import { PICTURE_FONT, pngOf, svgOf } from "./picture.js";
import { paintCells, paintPoints, paintSelected } from "./points.js";
import { listenToTouch } from "./touch.js";

/** @import { ChartOptions, Line, Mark, PlacedPoints, Range, Scene, Tick, UPlot, ZoomView } from "../types.d.ts" */

/** Smallest width in pixels of a drag that zooms. */
const LEAST_DRAG = 8;
/** The number of uPlot for a logarithmic scale. */
const LOGARITHMIC = 3;

export class Chart {
  /**
   * @param {Element} parent
   * @param {ChartOptions} options
   */
  constructor(parent, options = {}) {
    this.options = options;
    /** @type {ZoomView} */
    this.view = { x: null, y: null };
    /** @type {"zoom" | "select"} */
    this.drag = "zoom";
    /** True after a drag, whose click pins nothing. */
    this.wasDragged = false;
    /** Groups of lines that the legend has switched off. @type {Set<string>} */
    this.hidden = new Set();
    /** @type {Set<any>} */
    this.selectedRows = new Set();
    /** @type {Mark | null} */
    this.mark = null;
    /** @type {Scene} */
    this.scene = { x: { label: "", unit: "", log: false }, y: { label: "", unit: "", log: false }, lines: [] };
    /** The plot; null before the first scene. @type {UPlot} */
    this.plot = /** @type {any} */ (null);
    /** The ticks that are drawn. @type {{ x: Tick[], y: Tick[] }} */
    this.ticks = { x: [], y: [] };
    /** Pixels of the points. @type {PlacedPoints | null} */
    this.placed = null;
    this.legendText = "";
    this.shape = "";
    this.box = element("div", { class: "chart-box" });
    this.legend = element("div", { class: "legend" });
    this.timeLine = element("div", { class: "chart-time" });
    parent.append(this.box, this.legend);
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.box);
    this.onSchemeChange = () => this.repaint();
    darkScheme.addEventListener("change", this.onSchemeChange);
  }

  /** Draws everything in the colours of the present scheme. */
  repaint() {
    if (this.options.onScheme) this.options.onScheme();
    else this.plot?.redraw(false);
  }

  /** Draws a scene. Scenes of the same shape keep the plot and change only its data. */
  draw(/** @type {Scene} */ scene) {
    this.scene = scene;
    const shape = JSON.stringify([scene.x, scene.y, scene.lines.length, Boolean(scene.extent)]);
    const data = this.data();
    if (!this.plot || shape !== this.shape) {
      this.plot?.destroy();
      this.shape = shape;
      this.plot = new uPlot(this.settings(), data, this.box);
      listenToInput(this);
      listenToTouch(this, this.plot.over);
    }
    scene.lines.forEach((line, i) => {
      const series = this.plot.series[i + 1];
      const show = line.ghost || !this.hidden.has(groupOf(line));
      Object.assign(series, { show, width: line.width ?? 2, dash: line.dash, alpha: line.ghost ? 0.35 : 1 });
      Object.assign(series.points ?? {}, { show: () => line.marks ?? false });
    });
    this.plot.setData(data);
    writeLegend(this);
  }

  /** Columns for uPlot: x, then y of each line, null where there is no value. @returns {any} */
  data() {
    const { x, y, extent } = this.scene;
    // The ranges of points and cells are an invisible line.
    const lines = extent ? [...this.scene.lines, extent] : this.scene.lines;
    if (lines.length === 0) return [[0, 1]];
    const onAxis = (/** @type {Line["y"]} */ list) =>
      y.log ? list.map((value) => (Number(value) > 0 ? value : null)) : list;
    const isShared = lines.every((line) => line.x === lines[0].x);
    if (isShared && !x.log) return [lines[0].x, ...lines.map((line) => onAxis(line.y))];
    const tables = lines.map((line) => {
      const kept = line.x.map((_, i) => i).filter((i) => !x.log || line.x[i] > 0);
      const values = onAxis(line.y);
      return [kept.map((i) => line.x[i]), kept.map((i) => values[i])];
    });
    return tables.length === 1 ? tables[0] : uPlot.join(/** @type {any} */ (tables));
  }

  /** @returns {UPlot.Axis} */
  axis(/** @type {"x" | "y"} */ scale) {
    const isX = scale === "x";
    const { log } = this.scene[scale];
    const grid = { stroke: () => styleColour("--line"), width: 1 };
    const widest = (/** @type {string[] | null} */ labels) =>
      Math.max(...(labels ?? []).map((label) => label.length), 0);
    return {
      scale,
      side: isX ? 2 : 3,
      label: labelWithUnit(this.scene[scale]),
      font: PICTURE_FONT,
      labelFont: PICTURE_FONT,
      labelSize: 22,
      size: (_, labels) => (isX ? 40 : Math.max(46, 24 + 7.5 * widest(labels))),
      splits: (plot, _, low, high) => {
        const room = isX ? plot.bbox.width / 80 : plot.bbox.height / 42;
        return (log ? logTicks : evenTicks)(low, high, Math.max(room / uPlot.pxRatio, 2));
      },
      filter: (_, values) => values,
      values: (plot, values) => {
        const labels = tickLabels(values);
        const { min = -Infinity, max = Infinity } = plot.scales[scale];
        const ticks = values.map((value, i) => ({ value, label: labels[i] }));
        this.ticks[scale] = ticks.filter(({ value }) => value >= min && value <= max);
        return labels;
      },
      stroke: () => styleColour("--soft"),
      grid,
      ticks: grid,
    };
  }

  /** @returns {UPlot.Options} */
  settings() {
    const { lines, extent, cells, points } = this.scene;
    /**
     * @param {"x" | "y"} scale
     * @param {number} margin
     * @returns {UPlot.Scale}
     */
    const scaleOf = (scale, margin) => ({
      time: false,
      distr: this.scene[scale].log ? LOGARITHMIC : 1,
      range: (_, ...ends) => {
        // With points at one x, uPlot widens the range itself.
        const [low, high] = this.scene.extent?.[scale] ?? ends;
        return this.view[scale] ?? axisRange(low, high, this.scene[scale].log, margin);
      },
    });
    return {
      ...this.size(),
      legend: { show: false },
      padding: [10, 14, 0, 0],
      cursor: {
        drag: { x: true, y: true, setScale: false, uni: 12 },
        points: { size: 8 },
        bind: {
          dblclick: () => () => {
            this.setView(null, true);
            return null;
          },
        },
      },
      scales: { x: scaleOf("x", points ? 0.02 : 0), y: scaleOf("y", cells ? 0 : 0.06) },
      axes: [this.axis("x"), this.axis("y")],
      series: [
        {},
        ...lines.map((line, i) => this.series(i, line.width ?? 2)),
        ...(extent ? [this.series(lines.length, 0)] : []),
      ],
      hooks: {
        drawAxes: [() => this.paintBehind()],
        draw: [() => this.paintInFront()],
        setCursor: [() => this.followPointer()],
        setSelect: [() => this.endDrag()],
      },
    };
  }

  /**
   * The series of a line. A value between two gaps is drawn as a point, even if the line has no marks.
   *
   * @param {number} place
   * @param {number} width
   * @returns {UPlot.Series}
   */
  series(place, width) {
    /** @type {UPlot.Series.Points.Filter} */
    const filter = (plot, at, isMarked) =>
      isMarked || place >= this.scene.lines.length ? null : isolatedPoints(/** @type {Line["y"]} */ (plot.data[at]));
    const stroke = () => this.scene.lines[place]?.color ?? "transparent";
    return { stroke, width, pxAlign: 0, points: { show: false, size: 5, filter } };
  }

  size() {
    const { clientWidth, clientHeight } = this.box;
    return { width: Math.max(clientWidth, 160), height: this.options.height ?? Math.max(clientHeight, 120) };
  }

  resize() {
    const { width, height } = this.size();
    if (this.plot && (this.plot.width !== width || this.plot.height !== height)) this.plot.setSize({ width, height });
  }

  /** Paints only inside the axes. */
  paintInside(/** @type {() => void} */ paint) {
    const { ctx, bbox } = this.plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
    ctx.clip();
    paint();
    ctx.restore();
  }

  /** Cells, points and bands, under the lines. */
  paintBehind() {
    const { plot, scene } = this;
    const { ctx, bbox } = plot;
    this.paintInside(() => {
      if (scene.cells) paintCells(plot, scene.cells);
      if (scene.points) paintPoints(this, scene.points);
      for (const band of scene.bands ?? []) {
        const [left, right] = [band.from, band.to].map((value) =>
          Math.min(Math.max(plot.valToPos(value, "x", true), bbox.left), bbox.left + bbox.width),
        );
        ctx.fillStyle = styleColour("--band");
        ctx.fillRect(left, bbox.top, Math.max(right - left, 2), bbox.height);
      }
    });
  }

  /** Gaps, selected rows and the marker, over the lines. */
  paintInFront() {
    const { plot, scene } = this;
    const { ctx, bbox } = plot;
    const ratio = uPlot.pxRatio;
    this.paintInside(() => {
      for (const { gap, left, row } of placedGaps(this)) {
        ctx.save();
        ctx.translate(bbox.left + left * ratio, bbox.top + bbox.height - gapHeight(row) * ratio);
        ctx.scale(ratio, ratio);
        ctx.fillStyle = gap.color;
        ctx.fill(new Path2D(gap.shape));
        ctx.restore();
      }
      ctx.setLineDash([]); // the last line may have been dashed
      if (this.selectedRows.size > 0) paintSelected(this);
      if (scene.marker && Number.isFinite(scene.marker.y)) {
        ctx.strokeStyle = styleColour("--ink");
        ctx.lineWidth = 2 * ratio;
        ctx.beginPath();
        ctx.arc(plot.valToPos(scene.marker.x, "x", true), plot.valToPos(scene.marker.y, "y", true), 6 * ratio, 0, 7);
        ctx.stroke();
      }
    });
  }

  /** Moves a vertical line to a value of x. Nothing is painted again. */
  setTime(/** @type {number} */ time) {
    if (!this.plot) return;
    if (this.timeLine.parentNode !== this.plot.over) this.plot.over.append(this.timeLine);
    this.timeLine.style.left = `${this.plot.valToPos(time, "x")}px`;
  }

  // ---- Marks. ----

  followPointer() {
    const { left = -1, top = -1 } = this.plot.cursor;
    this.setMark(left < 0 ? null : markAt(this, left, top));
  }

  setMark(/** @type {Mark | null} */ mark) {
    const isSame = isSameMark(mark, this.mark);
    this.mark = mark;
    if (!isSame) this.options.onPoint?.(mark);
  }

  /** Puts the cursor on a mark. */
  moveTo(/** @type {Mark} */ mark) {
    const { plot } = this;
    plot.setCursor({ left: plot.valToPos(mark.x, "x"), top: plot.valToPos(Number(mark.y), "y") }, false);
    this.setMark(mark);
  }

  /** The mark again, after its line has changed. */
  renewMark() {
    this.mark = renewedMark(this.scene, this.mark);
    return this.mark;
  }

  // ---- Zoom and movement. ----

  /** The end of a drag: zooms, or selects the rows inside. */
  endDrag() {
    const { plot } = this;
    const { left, top, width, height } = plot.select;
    if (width < LEAST_DRAG && height < LEAST_DRAG) return;
    /** @type {Range} */
    const x = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
    /** @type {Range} */
    const y = [plot.posToVal(top + height, "y"), plot.posToVal(top, "y")];
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.wasDragged = true;
    if (this.drag === "select") this.options.onSelect?.(rowsWithin(this.scene, this.hidden, x, y));
    else this.setView({ x: width < LEAST_DRAG ? this.view.x : x, y: height < LEAST_DRAG ? this.view.y : y }, true);
  }

  /** Marks the rows of a set. */
  select(/** @type {Set<any>} */ rows) {
    this.selectedRows = rows;
    this.plot?.redraw(false);
  }

  /**
   * Shows a part of the plane; null shows everything.
   *
   * @param {ZoomView | null} view
   * @param {boolean} byUser true if `onView` is called
   */
  setView(view, byUser = false) {
    this.view = { x: view?.x ?? null, y: view?.y ?? null };
    if (this.plot) this.plot.setData(this.plot.data);
    if (byUser) this.options.onView?.(this.view);
  }

  /**
   * Zooms by `factor` around a place of the chart, and moves it. Both are shares of the chart, from the bottom left.
   *
   * @param {number} factor
   * @param {[number, number]} place
   * @param {[number, number]} move
   */
  zoomBy(factor, [atX, atY], [moveX, moveY]) {
    /**
     * @param {"x" | "y"} scale
     * @param {number} at
     * @param {number} by
     * @returns {Range}
     */
    const zoomed = (scale, at, by) => {
      const { min = 0, max = 1, distr } = this.plot.scales[scale];
      const isLog = distr === LOGARITHMIC;
      const [low, high] = isLog ? [Math.log(min), Math.log(max)] : [min, max];
      const span = high - low;
      const start = low + at * span - at * span * factor + by * span;
      const ends = [start, start + span * factor];
      return /** @type {Range} */ (isLog ? ends.map(Math.exp) : ends);
    };
    this.setView({ x: zoomed("x", atX, moveX), y: zoomed("y", atY, moveY) }, true);
  }

  // ---- Pictures. ----

  /** The picture as a PNG, with its legend. */
  png() {
    return pngOf(this);
  }

  /** The picture as SVG. */
  svg() {
    return svgOf(this);
  }

  destroy() {
    this.observer.disconnect();
    darkScheme.removeEventListener("change", this.onSchemeChange);
    this.plot?.destroy();
    this.box.remove();
    this.legend.remove();
  }
}
