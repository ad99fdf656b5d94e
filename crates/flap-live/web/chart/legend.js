// @ts-check
// The legend of a chart: shades, names of colours, switches of lines, and statuses.

import { viridisRamp } from "../shared/colours.js";
import { element, svgElement } from "../shared/dom.js";
import { labelWithUnit, shortNumber } from "../shared/format.js";
import { groupOf, legendLines } from "./lines.js";

/** @import { Chart, ColourBar, PictureEntry, PlacedEntry, Scene, StatusEntry } from "../types.d.ts" */

/** Height of a row of a picture's legend, width of a shade, and width of a swatch, in pixels. */
export const ENTRY_HEIGHT = 18;
export const SHADE = 8;
export const SWATCH = 16;

const statusSwatch = (/** @type {StatusEntry} */ { shape, color }) => {
  const box = { viewBox: "-5 -5 10 10", width: 10, height: 10, "aria-hidden": "true" };
  return svgElement("svg", box, svgElement("path", { d: shape, fill: color }));
};

const colourSwatch = (/** @type {string} */ color) => {
  const swatch = element("i");
  swatch.style.background = color;
  return swatch;
};

const shades = (/** @type {ColourBar} */ bar) => {
  const ramp = element("b");
  ramp.style.background = `linear-gradient(to right, ${viridisRamp()})`;
  const scale = bar.log ? " (log)" : "";
  const ends = [shortNumber(bar.low), shortNumber(bar.high)];
  return element("span", { class: "shades" }, labelWithUnit(bar), " ", ends[0], ramp, ends[1], scale);
};

/** Writes the legend of a chart, unless it already shows the same contents. */
export const writeLegend = (/** @type {Chart} */ chart) => {
  const { lines, title, legend = [], bar, statuses = [] } = chart.scene;
  const entries = legendLines(lines);
  const states = entries.map((line) => [groupOf(line), line.name, line.color, chart.hidden.has(groupOf(line))]);
  const text = JSON.stringify([states, title, legend, bar, statuses]);
  if (text === chart.legendText) return;
  chart.legendText = text;
  const focused = document.activeElement;
  const held = focused instanceof HTMLElement && chart.legend.contains(focused) ? focused.dataset.group : undefined;
  const switches = entries.map((line) => {
    const group = groupOf(line);
    const attributes = { type: "button", "aria-pressed": String(!chart.hidden.has(group)), "data-group": group };
    const button = element("button", attributes, colourSwatch(line.color), line.name);
    button.onclick = () => {
      if (!chart.hidden.delete(group)) chart.hidden.add(group);
      chart.draw(chart.scene);
      chart.options.onHidden?.([...chart.hidden]);
    };
    return button;
  });
  const marks = statuses.map((status) => element("span", {}, statusSwatch(status), status.name));
  chart.legend.replaceChildren(
    ...(bar ? [shades(bar)] : []),
    ...legend.map(({ name, color }) => element("span", {}, colourSwatch(color), name)),
    ...(title && switches.length > 0 ? [element("span", { class: "of" }, `${title}:`)] : []),
    ...switches,
    ...(marks.length > 0 ? [element("div", { class: "statuses" }, ...marks)] : []),
  );
  if (held !== undefined) switches.find((button) => button.dataset.group === held)?.focus();
};

/**
 * The entries of the legend in a picture. Lines that are switched off have no entry.
 *
 * @param {Scene} scene
 * @param {Set<string>} hidden
 * @returns {PictureEntry[]}
 */
export const pictureEntries = ({ lines, title, legend = [], bar, statuses = [] }, hidden) => {
  const shown = legendLines(lines).filter((line) => !hidden.has(groupOf(line)));
  const scale = bar?.log ? " (log)" : "";
  const range = bar ? `from ${shortNumber(bar.low)} to ${shortNumber(bar.high)}${scale}` : "";
  return [
    ...(bar ? [{ name: `${labelWithUnit(bar)} ${range}`, colors: viridisRamp() }] : []),
    ...legend.map(({ name, color }) => ({ name, colors: [color] })),
    ...(title && shown.length > 0 ? [{ name: `${title}:`, colors: [] }] : []),
    ...shown.map(({ name, color }) => ({ name, colors: [color] })),
    ...statuses,
  ];
};

const swatchWidth = (/** @type {PictureEntry} */ { colors = [], shape }) => {
  if (shape) return SWATCH;
  if (colors.length === 0) return 0;
  return colors.length === 1 ? SWATCH + 5 : SHADE * colors.length + 6;
};

/**
 * Entries in rows from `left` to `right`, statuses below the others.
 *
 * @param {PictureEntry[]} entries
 * @param {number} left
 * @param {number} right
 * @param {(text: string) => number} textWidth the width of a text in pixels
 * @returns {PlacedEntry[]}
 */
export const placedEntries = (entries, left, right, textWidth) => {
  let at = left;
  let row = 0;
  let wasStatus = false;
  return entries.map((entry) => {
    const across = swatchWidth(entry);
    // The width has a margin of a tenth, because the font of another program may be wider.
    const width = across + 1.1 * textWidth(entry.name);
    const isStatus = Boolean(entry.shape);
    if (at > left && ((isStatus && !wasStatus) || at + width > right)) {
      at = left;
      row++;
    }
    wasStatus = isStatus;
    const placed = { entry, left: at, row, words: at + across };
    at += width + 14;
    return placed;
  });
};

/** The height of all rows of a picture's legend, in pixels. */
export const legendHeight = (/** @type {PlacedEntry[]} */ placed) =>
  placed.length > 0 ? (placed[placed.length - 1].row + 1) * ENTRY_HEIGHT + 8 : 0;
