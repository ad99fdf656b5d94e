// @ts-check
// A small picture of the wing to scale.

import { byId, svgElement } from "../shared/dom.js";
import { roundedNumber } from "../shared/format.js";
import { presentAnswer } from "./design-numbers.js";
import { opened } from "./opened.js";
import { state, valueIn } from "./state.js";
import { wingOutline, wingShape } from "./wing-outline.js";

/** @import { Design, Parameter, WingShape } from "../types.d.ts" */

/** Size of the picture, position of the wing's axis, and space for the wing, in pixels. */
const PICTURE = { width: 280, height: 92, left: 24, top: 22, across: 235, down: 54 };

/**
 * The values of the design in SI units; null if only the server has them, because a value has a unit or a formula.
 *
 * @returns {Design | null}
 */
const designValues = () => {
  const answer = presentAnswer();
  if (answer) return answer.values;
  const values = Object.fromEntries(opened.parameters.map(({ name }) => [name, valueIn(state.design, name)]));
  const isText = (/** @type {Parameter} */ { name, kind }) => kind !== "choice" && typeof values[name] === "string";
  return opened.parameters.some((each) => each.kind === "derived" || isText(each)) ? null : values;
};

/**
 * Draws the wing of the design, with the wing that was opened as a dashed line. Keeps the picture if the values of the
 * design are not known yet.
 */
export const drawWing = () => {
  const values = designValues();
  if (values === null) return;
  const wing = wingShape(values);
  byId("wing").hidden = wing === null;
  if (wing === null) return;
  const original = wingShape(Object.fromEntries(opened.parameters.map(({ name, value }) => [name, value]))) ?? wing;
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
