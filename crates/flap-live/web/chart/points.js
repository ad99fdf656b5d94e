// @ts-check
// Points and cells of a chart, painted on the canvas of its plot.

import { unpackedColour } from "../shared/colours.js";
import { styleColour } from "../shared/theme.js";
import { reachableLines } from "./lines.js";

/** @import { CellSet, Chart, PointSet, UPlot } from "../types.d.ts" */

/** From this number of points on, points are painted as squares into an image, which is faster. */
const MANY_POINTS = 4000;
/** From this number of points on, selected points have dots instead of rings, which would hide each other. */
const MANY_RINGS = 2000;

/**
 * The function from values of a scale to pixels of the canvas. It is faster than the method of uPlot.
 *
 * @param {UPlot} plot
 * @param {"x" | "y"} scale
 * @returns {(value: number) => number}
 */
export const toPixels = (plot, scale) => {
  const { min = 0, max = 1, distr } = plot.scales[scale];
  const { left, top, width, height } = plot.bbox;
  const of = distr === 3 ? Math.log : (/** @type {number} */ value) => value;
  const low = of(min);
  const span = of(max) - low;
  if (scale === "x") return (value) => left + ((of(value) - low) / span) * width;
  return (value) => top + height - ((of(value) - low) / span) * height;
};

/**
 * The corners of cells in pixels of the canvas.
 *
 * @param {UPlot} plot
 * @param {CellSet} cells
 */
const cellCorners = (plot, { edgesX, edgesY, i, j }) => {
  const xs = edgesX.map(toPixels(plot, "x"));
  const ys = edgesY.map(toPixels(plot, "y"));
  return (/** @type {number} */ at) => [xs[i[at]], ys[j[at] + 1], xs[i[at] + 1], ys[j[at]]];
};

/** Paints points, and stores their pixels for the search of the nearest point. */
export const paintPoints = (/** @type {Chart} */ chart, /** @type {PointSet} */ { x, y, colors, size }) => {
  const { plot } = chart;
  const { ctx, bbox } = plot;
  const count = x.length;
  const px = Float32Array.from(x, toPixels(plot, "x"));
  const py = Float32Array.from(y, toPixels(plot, "y"));
  chart.placed = { px, py, squares: null };
  const side = Math.max(Math.round(size * uPlot.pxRatio), 1);
  if (count < MANY_POINTS) {
    for (let at = 0; at < count; at++) {
      ctx.fillStyle = unpackedColour(colors[at]);
      ctx.beginPath();
      ctx.arc(px[at], py[at], side / 2, 0, 7);
      ctx.fill();
    }
    return;
  }
  const half = side >> 1;
  const [left, top, width, height] = [bbox.left, bbox.top, bbox.width, bbox.height].map(Math.round);
  const image = new ImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  for (let at = 0; at < count; at++) {
    const x1 = Math.round(px[at]) - left - half;
    const y1 = Math.round(py[at]) - top - half;
    for (let row = Math.max(y1, 0); row < Math.min(y1 + side, height); row++) {
      for (let column = Math.max(x1, 0); column < Math.min(x1 + side, width); column++) {
        pixels[row * width + column] = colors[at];
      }
    }
  }
  const sheet = Object.assign(document.createElement("canvas"), { width, height });
  sheet.getContext("2d")?.putImageData(image, 0, 0);
  ctx.drawImage(sheet, left, top);
};

/** Paints cells as rectangles. */
export const paintCells = (/** @type {UPlot} */ plot, /** @type {CellSet} */ cells) => {
  const corners = cellCorners(plot, cells);
  for (let at = 0; at < cells.rows.length; at++) {
    const [x1, y1, x2, y2] = corners(at);
    plot.ctx.fillStyle = unpackedColour(cells.colors[at]);
    // Half a pixel is added, so that no background is visible between neighbours.
    plot.ctx.fillRect(x1, y1, x2 - x1 + 0.5, y2 - y1 + 0.5);
  }
};

/** Paints rings around points and values of lines, and frames around cells, of the selected rows. */
export const paintSelected = (/** @type {Chart} */ chart) => {
  const { plot, scene, hidden, placed, selectedRows } = chart;
  const { ctx } = plot;
  const { points, cells, lines } = scene;
  const ring = (/** @type {number} */ x, /** @type {number} */ y) => {
    ctx.beginPath();
    ctx.arc(x, y, 5 * uPlot.pxRatio, 0, 7);
    ctx.stroke();
  };
  /**
   * @param {ArrayLike<number>} rows
   * @param {(at: number) => void} paint
   */
  const paintEach = (rows, paint) => {
    for (let at = 0; at < rows.length; at++) if (selectedRows.has(rows[at])) paint(at);
  };
  ctx.strokeStyle = ctx.fillStyle = styleColour("--ink");
  ctx.lineWidth = 1.5 * uPlot.pxRatio;
  if (points && placed) {
    const { px, py } = placed;
    const dot = (/** @type {number} */ at) => ctx.fillRect(px[at] - 1, py[at] - 1, 3, 3);
    paintEach(points.rows, selectedRows.size > MANY_RINGS ? dot : (at) => ring(px[at], py[at]));
  }
  if (cells) {
    const corners = cellCorners(plot, cells);
    paintEach(cells.rows, (at) => {
      const [x1, y1, x2, y2] = corners(at);
      ctx.strokeRect(x1, y1, x2 - x1, y2 - y1);
    });
  }
  const toX = toPixels(plot, "x");
  const toY = toPixels(plot, "y");
  for (const { x, y, rows } of reachableLines(lines, hidden)) {
    paintEach(rows ?? [], (at) => {
      if (y[at] !== null) ring(toX(x[at]), toY(Number(y[at])));
    });
  }
};
