// @ts-check
// Pictures of a chart to save. They are for papers: in the light scheme, with the whole legend below.

import { styleColour } from "../shared/theme.js";
import { gapHeight, placedGaps } from "./gaps.js";
import { ENTRY_HEIGHT, legendHeight, pictureEntries, placedEntries, SHADE, SWATCH } from "./legend.js";
import { MOST_CIRCLES, svgPicture } from "./svg.js";

/** @import { Chart } from "../types.d.ts" */

export const PICTURE_FONT = "12px system-ui, sans-serif";

/**
 * Runs `work` while the chart has the colours of the light scheme. The window does not show them, because `work` ends
 * before the next frame.
 *
 * @template T
 * @param {Chart} chart
 * @param {() => T} work
 */
const onPaper = async (chart, work) => {
  const { classList } = document.documentElement;
  classList.add("paper");
  try {
    chart.repaint();
    await null; // the plot paints in a microtask
    return work();
  } finally {
    classList.remove("paper");
    chart.repaint();
  }
};

/** A pen that fills a new canvas. */
const penOf = (/** @type {HTMLCanvasElement} */ canvas) =>
  /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));

/** The legend's entries below the plot, in pixels of the page. */
const entriesBelow = (/** @type {Chart} */ { scene, hidden, plot }) => {
  const pen = penOf(document.createElement("canvas"));
  pen.font = PICTURE_FONT;
  const left = plot.bbox.left / uPlot.pxRatio;
  return placedEntries(pictureEntries(scene, hidden), left, plot.width - 8, (text) => pen.measureText(text).width);
};

/** The picture as a canvas, with its legend. */
const canvasPicture = (/** @type {Chart} */ chart) => {
  const { canvas } = chart.plot.ctx;
  const ratio = uPlot.pxRatio;
  const placed = entriesBelow(chart);
  const sheet = document.createElement("canvas");
  sheet.width = canvas.width;
  sheet.height = canvas.height + Math.ceil(legendHeight(placed) * ratio);
  const pen = penOf(sheet);
  pen.fillStyle = styleColour("--back");
  pen.fillRect(0, 0, sheet.width, sheet.height);
  pen.drawImage(canvas, 0, 0);
  pen.scale(ratio, ratio);
  pen.font = PICTURE_FONT;
  for (const { entry, left, row, words } of placed) {
    const middle = canvas.height / ratio + row * ENTRY_HEIGHT + 8;
    const { name, colors = [], color = "", shape } = entry;
    if (shape) {
      pen.save();
      pen.translate(left + 5, middle);
      pen.fillStyle = color;
      pen.fill(new Path2D(shape));
      pen.restore();
    }
    const width = colors.length === 1 ? SWATCH : SHADE;
    colors.forEach((shade, i) => {
      pen.fillStyle = shade;
      pen.fillRect(left + i * width, middle - 2, width, 4);
    });
    pen.fillStyle = styleColour("--ink");
    pen.fillText(name, words, middle + 4);
  }
  return sheet;
};

/** The inside of the plot as the address of an image. */
const insideOf = (/** @type {Chart} */ { plot }) => {
  const { left, top, width, height } = plot.bbox;
  const sheet = Object.assign(document.createElement("canvas"), { width, height });
  penOf(sheet).drawImage(plot.ctx.canvas, -left, -top);
  return sheet.toDataURL("image/png");
};

/** The picture of a chart as a PNG. */
export const pngOf = async (/** @type {Chart} */ chart) => {
  const sheet = await onPaper(chart, () => canvasPicture(chart));
  return /** @type {Promise<Blob>} */ (new Promise((done) => sheet.toBlob((blob) => done(/** @type {Blob} */ (blob)))));
};

/** The picture of a chart as SVG: lines as paths, and many points as an image. */
export const svgOf = (/** @type {Chart} */ chart) =>
  onPaper(chart, () => {
    const { scene, hidden, plot, ticks } = chart;
    const ratio = uPlot.pxRatio;
    const [left, top, width, height] = [plot.bbox.left, plot.bbox.top, plot.bbox.width, plot.bbox.height].map(
      (size) => size / ratio,
    );
    return svgPicture(scene, {
      hidden,
      ticks,
      width: plot.width,
      height: plot.height,
      box: { left, top, right: left + width, bottom: top + height },
      toX: (value) => left + plot.valToPos(value, "x"),
      toY: (value) => top + plot.valToPos(value, "y"),
      colours: {
        ink: styleColour("--ink"),
        soft: styleColour("--soft"),
        grid: styleColour("--line"),
        back: styleColour("--back"),
      },
      gaps: placedGaps(chart).map(({ gap, left: at, row }) => ({ gap, x: left + at, height: gapHeight(row) })),
      entries: entriesBelow(chart),
      image: (scene.points?.x.length ?? 0) > MOST_CIRCLES ? insideOf(chart) : null,
    });
  });
