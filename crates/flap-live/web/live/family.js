// @ts-check
// The response family: coarse while a slider moves, fine when the design rests.

import { Chart } from "../chart/chart.js";
import { lineColour } from "../shared/colours.js";
import { byId } from "../shared/dom.js";
import { isFiniteNumber, roundedNumber, shortNumber } from "../shared/format.js";
import { statusEntries, statusMark } from "../shared/status.js";
import { isDark } from "../shared/theme.js";
import { setMessage } from "./banner.js";
import { answerValue, presentAnswer } from "./design-numbers.js";
import { measureNamed } from "./opened.js";
import { isFieldError, panelEvents, showProblems } from "./panel.js";
import { bistableBands, responseLines, statusCounts } from "./response.js";
import { request, ServerError } from "./server.js";
import { lineParameter, state, valueText, xParameter } from "./state.js";

/** @import { ChartOptions, Gap, Line, Mark, Measure, Parameter, ResponseAnswer, ResponseGap, ResponseLine } from "../types.d.ts" */

/** Values of x of a fine family, and the smallest and largest number of a coarse one. */
export const FINE = 81;
const FEWEST = 9;
const MOST = 33;
/** Time in which a coarse family should be drawn, in milliseconds. */
const COARSE_TIME = 45;

export const family = {
  /** Made by `createFamilyChart`. */
  chart: /** @type {Chart} */ (/** @type {any} */ (null)),
  /** Values of x of a coarse family. */
  coarseCount: 17,
  /** True while coarse families are requested. */
  isBusy: false,
  /** True if the design has changed since the last coarse request. */
  isStale: false,
  /** True if the lines belong to a design that rests. */
  isFine: false,
  answer: /** @type {ResponseAnswer | null} */ (null),
  /** The parameter along x, the measure and the lines' parameter of the lines that are drawn, set by `drawAnswer`. */
  axes: /** @type {{ x: Parameter, measure: Measure, by: Parameter | null }} */ (/** @type {any} */ (null)),
  lines: /** @type {ResponseLine[]} */ ([]),
  /** Lines of the fine family before the last one. */
  earlier: /** @type {ResponseLine[]} */ ([]),
  /** Lines that are drawn pale: with a fine family the previous one, with a coarse family the last fine one. */
  ghosts: /** @type {ResponseLine[]} */ ([]),
  gaps: /** @type {ResponseGap[]} */ ([]),
  bands: /** @type {{ from: number, to: number }[]} */ ([]),
  /** The last fine family, with its design and its view as text. */
  fine: /** @type {{ lines: ResponseLine[], design: string, view: string } | null} */ (null),
};

const viewText = () => JSON.stringify([state.x, state.measure, state.updown]);

/** True if the fine family of the present design is drawn. */
export const isFamilyFine = () => {
  const present = JSON.stringify([state.design, state.x, state.by, state.measure, state.updown]);
  return !family.isBusy && family.fine?.design === present;
};

/** True if the axes of an answer are still the axes of the page. */
const isWanted = (/** @type {Pick<ResponseAnswer, "kind" | "request">} */ { kind, request: { x, by } }) => {
  if (kind !== (state.updown ? "hysteresis" : "family") || x.name !== state.x.name) return false;
  return kind === "hysteresis" || by?.name === state.by?.name;
};

/** Shows an error at the field of its parameter, or above the page. A lost connection has its own message. */
const showError = (/** @type {ServerError | null} */ error) => {
  const isAtField = error !== null && isFieldError(error);
  showProblems(isAtField ? error : null);
  setMessage("error", error === null || error.status === 0 || isAtField ? "" : error.text());
};

/**
 * The rows of the design, with their request; null if there are none, or if they are not needed any longer.
 *
 * @param {"family" | "hysteresis"} kind
 * @param {number} n values of x
 * @returns {Promise<ResponseAnswer | null>}
 */
const requestRows = async (kind, n) => {
  const response = { design: state.design, x: { ...state.x, n } };
  // The state may change while the server computes.
  const sent = structuredClone(state.updown ? response : { ...response, by: state.by });
  try {
    const found = await request(kind, sent);
    if (!found) return null;
    showError(null);
    const answer = { ...found, kind, request: sent };
    return isWanted(answer) ? answer : null;
  } catch (error) {
    if (!(error instanceof ServerError)) throw error;
    if (isWanted({ kind, request: sent })) showError(error);
    return null;
  }
};

/** Draws a coarse family as soon as possible; if several are requested, only the newest. */
export const requestCoarse = async () => {
  family.isStale = true;
  if (family.isBusy) return;
  family.isBusy = true;
  while (family.isStale) {
    family.isStale = false;
    const movedAt = panelEvents.movedAt;
    const sentAt = performance.now();
    panelEvents.movedAt = undefined;
    const answer = await requestRows("family", family.coarseCount);
    if (!answer) continue;
    const took = performance.now() - sentAt;
    if (took > COARSE_TIME) family.coarseCount = Math.max(FEWEST, Math.floor(family.coarseCount * 0.75));
    else if (took < COARSE_TIME / 2) family.coarseCount = Math.min(MOST, family.coarseCount + 4);
    drawAnswer(answer, false);
    if (movedAt !== undefined) {
      requestAnimationFrame(() => {
        performance.measure("flap-slider-to-picture", { start: movedAt, end: performance.now() });
      });
    }
  }
  family.isBusy = false;
};

/** Number of fine families and responses up and down that the server computes. */
let fineRuns = 0;

/** Draws the fine family, or the responses up and down if the page shows them. */
export const requestFine = async () => {
  if (family.isBusy || family.isStale) return;
  fineRuns++;
  byId("chart").setAttribute("aria-busy", "true");
  const answer = await requestRows(state.updown ? "hysteresis" : "family", FINE);
  fineRuns--;
  if (fineRuns === 0) byId("chart").removeAttribute("aria-busy");
  if (answer) drawAnswer(answer, true);
};

/** Draws the last rows again, after a change of only the axes. */
export const redrawFamily = () => {
  if (family.answer && isWanted(family.answer)) drawAnswer(family.answer, family.isFine);
};

const drawAnswer = (/** @type {ResponseAnswer} */ answer, /** @type {boolean} */ isFine) => {
  const x = xParameter();
  const by = lineParameter();
  const nameOf = (/** @type {any} */ value) => (by ? valueText(by, value) : value);
  const key = state.updown ? "branch" : (by?.name ?? null);
  const { n, ...along } = answer.request.x;
  const step = Math.abs(along.to - along.from) / (n - 1);
  const axes = { x: x.name, step, factor: x.factor, y: state.measure, by: key, nameOf };
  const { lines, gaps } = responseLines(answer, axes);
  for (const line of lines) if (state.updown && line.key === "down") line.dash = [7, 4];
  const view = viewText();
  let ghosts = family.fine?.view === view ? family.fine.lines : [];
  if (isFine) {
    const design = JSON.stringify([answer.request.design, along, state.by, state.measure, state.updown]);
    if (family.fine && family.fine.design !== design) family.earlier = ghosts;
    ghosts = family.earlier;
    family.fine = { lines, design, view };
  }
  const bands = state.updown ? bistableBands(lines) : [];
  family.axes = { x, measure: measureNamed(state.measure), by };
  Object.assign(family, { answer, isFine, lines, gaps, ghosts, bands });
  paintFamily();
  showReadout(family.chart.renewMark());
};

/** Paints the lines in the colours of the present scheme, with the ring of the design. */
export const paintFamily = () => {
  const dark = isDark();
  const { x, measure, by } = family.axes;
  const coloured = (/** @type {ResponseLine} */ line) => ({ ...line, color: lineColour(line.place, line.of, dark) });
  /** @returns {Line} */
  const ghost = (/** @type {ResponseLine} */ line) => {
    const style = { ghost: true, marks: false, width: 1.5, dash: [3, 3] };
    return { ...coloured(line), key: `ghost ${line.key}`, ...style };
  };
  /** @returns {Gap} */
  const marked = (/** @type {ResponseGap} */ gap) => ({ ...gap, ...statusMark(gap.status, dark) });
  const design = presentAnswer();
  const here = design?.values[x.name];
  const value = answerValue(design, measure.name);
  const hasRing = isFiniteNumber(here) && isFiniteNumber(value);
  family.chart.view = state.view;
  family.chart.hidden = new Set(state.hidden);
  family.chart.draw({
    x: { label: x.label, unit: x.unit, log: state.log.x },
    y: { label: measure.label, unit: measure.unit, log: state.log.y },
    lines: [...family.ghosts.map(ghost), ...family.lines.map(coloured)],
    title: by?.label,
    bands: family.bands,
    gaps: family.gaps.map(marked),
    statuses: statusEntries(statusCounts(family.gaps), dark),
    marker: hasRing ? { x: here * x.factor, y: value } : null,
  });
};

/** The text for a mark, or for the whole chart if there is none. */
const readout = (/** @type {Mark | null} */ mark) => {
  if (!family.answer) return "";
  const { x, measure } = family.axes;
  const { unit } = x;
  if (mark?.gaps) {
    const each = mark.gaps.map((gap) => `${gap.name ? `${gap.name} ` : ""}${gap.status.replace("_", " ")}`);
    return `No settled motion at ${roundedNumber(mark.x, 5)} ${unit}: ${each.join(", ")}`;
  }
  if (mark) {
    const { status, stable } = mark.row;
    const value = `${measure.label} ${shortNumber(mark.y)} ${measure.unit} at ${roundedNumber(mark.x, 5)} ${unit}`;
    return `${value}${mark.name ? `, ${mark.name}` : ""}: ${status}${stable === false ? ", not stable" : ""}`;
  }
  if (family.bands.length > 0) {
    const ranges = family.bands.map(({ from, to }) => `${roundedNumber(from, 5)} and ${roundedNumber(to, 5)} ${unit}`);
    return `Bistable between ${ranges.join("; ")}`;
  }
  if (family.gaps.length === 0) return "";
  return `${family.gaps.length} of ${family.answer.rows.length} points have no settled motion: see the marks at the bottom`;
};

/** Writes the line below the chart. */
export const showReadout = (/** @type {Mark | null} */ mark) => {
  byId("tip").textContent = [readout(mark), family.isFine ? "" : "coarse, refining …"].filter(Boolean).join(" · ");
};

export const createFamilyChart = (/** @type {ChartOptions} */ options) => {
  family.chart = new Chart(byId("chart"), {
    name: "Response family. Arrow keys move along the lines.",
    onScheme: () => {
      if (family.answer) paintFamily();
    },
    ...options,
  });
};
