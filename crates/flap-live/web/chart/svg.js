// @ts-check
// The picture of a chart as SVG.

import { unpackedColour } from "../shared/colours.js";
import { labelWithUnit } from "../shared/format.js";
import { ENTRY_HEIGHT, legendHeight, SHADE, SWATCH } from "./legend.js";
import { groupOf, isolatedPoints, reachableLines } from "./lines.js";

/** @import { CellSet, Gap, Line, PlacedEntry, PointSet, Scene, Tick } from "../types.d.ts" */

/** Largest number of points drawn as circles. A file with more is too large for other programs. */
export const MOST_CIRCLES = 20000;

/**
 * The places of a picture, in pixels.
 *
 * @typedef {object} Layout
 * @property {Set<string>} hidden groups of lines that the legend has switched off
 * @property {{ x: Tick[], y: Tick[] }} ticks
 * @property {number} width
 * @property {number} height without the legend
 * @property {{ left: number, top: number, right: number, bottom: number }} box the inside of the axes
 * @property {(value: number) => number} toX
 * @property {(value: number) => number} toY
 * @property {{ ink: string, soft: string, grid: string, back: string }} colours
 * @property {{ gap: Gap, x: number, height: number }[]} gaps
 * @property {PlacedEntry[]} entries
 * @property {string | null} image the address of an image of the points, if they are too many for circles
 */

/** @type {Record<string, string>} */
const ESCAPES = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
const escaped = (/** @type {string} */ text) => text.replace(/[&<>"]/g, (letter) => ESCAPES[letter]);

/** A number with at most two decimals. */
const rounded = (/** @type {number} */ value) => String(Number(value.toFixed(2)));

/**
 * An element with attributes: numbers are rounded to two decimals.
 *
 * @param {string} name
 * @param {Record<string, string | number>} attributes
 */
const tag = (name, attributes, contents = "") => {
  const text = Object.entries(attributes).map(
    ([key, value]) => ` ${key}="${escaped(typeof value === "number" ? rounded(value) : value)}"`,
  );
  return contents === "" ? `<${name}${text.join("")}/>` : `<${name}${text.join("")}>${contents}</${name}>`;
};

const INSIDE = { "clip-path": "url(#inside)" };

const textTag = (
  /** @type {number} */ x,
  /** @type {number} */ y,
  /** @type {string} */ words,
  /** @type {string} */ fill,
  attributes = {},
) => tag("text", { x, y, fill, "text-anchor": "middle", ...attributes }, escaped(words));

/** Grid lines, labels of ticks, and names of axes. */
const axesTags = (/** @type {Scene} */ scene, /** @type {Layout} */ layout) => {
  const { box, toX, toY, ticks, colours, height } = layout;
  const lines = [
    ...ticks.x.map(({ value }) => ({ x1: toX(value), y1: box.top, x2: toX(value), y2: box.bottom })),
    ...ticks.y.map(({ value }) => ({ x1: box.left, y1: toY(value), x2: box.right, y2: toY(value) })),
  ];
  const middle = `translate(14 ${rounded((box.top + box.bottom) / 2)}) rotate(-90)`;
  return [
    ...lines.map((ends) => tag("line", { ...ends, stroke: colours.grid })),
    ...ticks.x.map(({ value, label }) => textTag(toX(value), box.bottom + 18, label, colours.soft)),
    ...ticks.y.map(({ value, label }) =>
      textTag(box.left - 8, toY(value) + 4, label, colours.soft, { "text-anchor": "end" }),
    ),
    textTag((box.left + box.right) / 2, height - 6, labelWithUnit(scene.x), colours.soft),
    textTag(0, 0, labelWithUnit(scene.y), colours.soft, { transform: middle }),
  ];
};

const cellTags = (/** @type {CellSet} */ { edgesX, edgesY, i, j, rows, colors }, /** @type {Layout} */ { toX, toY }) =>
  rows.map((_, at) => {
    const [x1, x2] = [toX(edgesX[i[at]]), toX(edgesX[i[at] + 1])];
    const [y1, y2] = [toY(edgesY[j[at] + 1]), toY(edgesY[j[at]])];
    // A third of a pixel is added, so that no background is visible between neighbours.
    const size = { width: x2 - x1 + 0.3, height: y2 - y1 + 0.3 };
    return tag("rect", { x: x1, y: y1, ...size, fill: unpackedColour(colors[at]), ...INSIDE });
  });

const pointTags = (/** @type {PointSet} */ { x, y, colors, size }, /** @type {Layout} */ { image, box, toX, toY }) => {
  if (image !== null) {
    const { left, top, right, bottom } = box;
    return [tag("image", { x: left, y: top, width: right - left, height: bottom - top, href: image })];
  }
  return Array.from(x, (value, at) => {
    const fill = unpackedColour(colors[at]);
    return tag("circle", { cx: toX(value), cy: toY(y[at]), r: size / 2, fill, ...INSIDE });
  });
};

/** True if the value of a line at a place can be drawn on the axes. */
const isDrawn = (/** @type {Scene} */ scene, /** @type {Line} */ { x, y }, /** @type {number} */ place) => {
  const value = y[place];
  return value !== null && value !== undefined && !(scene.y.log && value <= 0) && !(scene.x.log && x[place] <= 0);
};

const lineTag = (/** @type {Scene} */ scene, /** @type {Line} */ line, /** @type {Layout} */ { toX, toY }) => {
  const { x, y, color, width = 2, dash = [], ghost } = line;
  let path = "";
  let isDown = false;
  x.forEach((value, i) => {
    const isUsable = isDrawn(scene, line, i);
    if (isUsable) path += `${isDown ? "L" : "M"}${rounded(toX(value))} ${rounded(toY(Number(y[i])))}`;
    isDown = isUsable;
  });
  const style = { "stroke-width": width, "stroke-dasharray": dash.join(" "), opacity: ghost ? 0.35 : 1 };
  return tag("path", { d: path, fill: "none", stroke: color, ...style, "stroke-linejoin": "round", ...INSIDE });
};

/** Circles of a line: at all values if it has marks, and at values between two gaps. */
const lineMarkTags = (/** @type {Scene} */ scene, /** @type {Line} */ line, /** @type {Layout} */ layout) => {
  const { toX, toY, colours } = layout;
  const places = line.marks ? line.x.map((_, place) => place) : (isolatedPoints(line.y) ?? []);
  const style = { r: 2, fill: colours.back, stroke: line.color, ...INSIDE };
  return places
    .filter((place) => isDrawn(scene, line, place))
    .map((place) => tag("circle", { cx: toX(line.x[place]), cy: toY(Number(line.y[place])), ...style }));
};

const shapeTag = (
  /** @type {string} */ shape,
  /** @type {string} */ fill,
  /** @type {number} */ x,
  /** @type {number} */ y,
) => tag("path", { d: shape, fill, transform: `translate(${rounded(x)} ${rounded(y)})` });

const entryTags = (
  /** @type {PlacedEntry} */ { entry, left, row, words },
  /** @type {Layout} */ { height, colours },
) => {
  const { name, colors = [], color = "", shape } = entry;
  const middle = height + row * ENTRY_HEIGHT + 8;
  const width = colors.length === 1 ? SWATCH : SHADE;
  return [
    ...(shape ? [shapeTag(shape, color, left + 5, middle)] : []),
    ...colors.map((fill, i) => tag("rect", { x: left + i * width, y: middle - 2, width, height: 4, fill })),
    textTag(words, middle + 4, name, colours.ink, { "text-anchor": "start" }),
  ];
};

/**
 * The picture of a scene as the text of an SVG file.
 *
 * @param {Scene} scene
 * @param {Layout} layout
 */
export const svgPicture = (scene, layout) => {
  const { hidden, box, width, colours, toX, toY } = layout;
  const height = layout.height + legendHeight(layout.entries);
  const inside = { x: box.left, y: box.top, width: box.right - box.left, height: box.bottom - box.top };
  const bands = (scene.bands ?? []).map(({ from, to }) => {
    const across = Math.max(toX(to) - toX(from), 2);
    return tag("rect", { ...inside, x: toX(from), width: across, fill: "#8888", ...INSIDE });
  });
  const lines = scene.lines.filter((line) => line.ghost || !hidden.has(groupOf(line)));
  const { marker } = scene;
  const ring = marker && Number.isFinite(marker.y) ? [{ cx: toX(marker.x), cy: toY(marker.y), r: 6 }] : [];
  const parts = [
    tag("rect", { width, height, fill: colours.back }),
    tag("clipPath", { id: "inside" }, tag("rect", inside)),
    ...axesTags(scene, layout),
    ...bands,
    ...(scene.cells ? cellTags(scene.cells, layout) : []),
    ...(scene.points ? pointTags(scene.points, layout) : []),
    ...lines.map((line) => lineTag(scene, line, layout)),
    ...reachableLines(scene.lines, hidden).flatMap((line) => lineMarkTags(scene, line, layout)),
    ...layout.gaps.map(({ gap, x, height: up }) => shapeTag(gap.shape, gap.color, x, box.bottom - up)),
    ...ring.map((circle) => tag("circle", { ...circle, fill: "none", stroke: colours.ink, "stroke-width": 2 })),
    ...layout.entries.flatMap((entry) => entryTags(entry, layout)),
  ];
  const size = { viewBox: `0 0 ${width} ${rounded(height)}`, width, height };
  const font = { "font-family": "system-ui, sans-serif", "font-size": 12 };
  return tag("svg", { xmlns: "http://www.w3.org/2000/svg", ...size, ...font }, parts.join(""));
};
