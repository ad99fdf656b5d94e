// @ts-check
// A small picture of the wing to scale.

import { byId, svgElement } from "../shared/dom.js";
import { isFiniteNumber, roundedNumber } from "../shared/format.js";
import { hasParameter } from "./opened.js";
import { state, valueIn } from "./state.js";
import { wingOutline } from "./wing-outline.js";

/** @import { Design, WingShape } from "../types.d.ts" */

/** Size of the picture, position of the wing's axis, and space for the wing, in pixels. */
const PICTURE = { width: 280, height: 92, left: 24, top: 22, across: 235, down: 54 };

/**
 * The shape of a design's wing; null if the model does not have its length.
 *
 * @param {Design} design
 * @returns {WingShape | null}
 */
export const wingShape = (design) => {
  const number = (/** @type {string} */ name) => {
    const value = hasParameter(name) ? valueIn(design, name) : null;
    return isFiniteNumber(value) ? value : null;
  };
  const length = number("wing_length");
  if (!length) return null;
  const area = number("wing_area");
  const meanChord = number("mean_chord") ?? (area === null ? length / 4 : area / length);
  const rootChord = number("root_chord");
  let chord = (/** @type {number} */ share) => meanChord * 1.25 * Math.sqrt(Math.max(1 - share ** 4, 0));
  if (rootChord !== null) {
    const terms = [0, 1, 2, 3, 4].map((power) => number(`chord_term_${power}`) ?? 0);
    chord = (share) => rootChord * terms.reduce((sum, term, power) => sum + term * share ** power, 0);
  }
  if (hasParameter("chord_table") && valueIn(design, "chord_table") !== "off") {
    const table = Array.from({ length: 11 }, (_, i) => number(`chord_${i}`) ?? 0);
    chord = (share) => {
      const place = Math.min(Math.floor(share * 10), 9);
      const part = share * 10 - place;
      return table[place] * (1 - part) + table[place + 1] * part;
    };
  }
  return { length, offset: number("wing_offset") ?? 0, axis: number("axis_position") ?? 0.1, chord };
};

/** Draws the wing of the design, with the wing that was opened as a dashed line. */
export const drawWing = () => {
  const wing = wingShape(state.design);
  byId("wing").hidden = wing === null;
  if (wing === null) return;
  const original = wingShape({}) ?? wing;
  const { width, height, left, top, across, down } = PICTURE;
  const shapes = [original, wing];
  const chords = shapes.flatMap((shape) => wingOutline(shape).map(([, y]) => Math.abs(y)));
  const longest = Math.max(...shapes.map((shape) => shape.length + shape.offset));
  const scale = Math.min(across / longest, down / Math.max(...chords));
  const path = (/** @type {WingShape} */ shape) => {
    const points = wingOutline(shape).map(
      ([x, y]) => `${(left + x * scale).toFixed(1)} ${(top - y * scale).toFixed(1)}`,
    );
    return `M${points.join("L")}Z`;
  };
  const axisEnd = left + (wing.offset + wing.length) * scale;
  const caption = `${roundedNumber(wing.length * 1e3, 4)} mm; dashed: as opened`;
  const dashed = { fill: "none", stroke: "var(--soft)", "stroke-dasharray": "3 3" };
  const filled = { fill: "var(--accent)", "fill-opacity": 0.25, stroke: "var(--accent)", "stroke-width": 1.5 };
  const axis = { x1: left, x2: axisEnd, y1: top, y2: top, stroke: "var(--ink)", "stroke-dasharray": "6 3" };
  const text = { x: width, y: height - 4, "text-anchor": "end", "font-size": 11, fill: "var(--soft)" };
  byId("wing").replaceChildren(
    svgElement(
      "svg",
      { viewBox: `0 0 ${width} ${height}` },
      svgElement("path", { d: path(original), ...dashed }),
      svgElement("path", { d: path(wing), ...filled }),
      svgElement("line", axis),
      svgElement("circle", { cx: left, cy: top, r: 4, fill: "var(--ink)" }),
      svgElement("text", text, caption),
    ),
  );
};
