// @ts-check
// The numbers of the design and of the published design, and the derivatives of the measure.

import { byId, element } from "../shared/dom.js";
import { differenceText, roundedNumber } from "../shared/format.js";
import { setMessage, setStaleNote } from "./banner.js";
import { hasMeasure, measureNamed, opened, parameterNamed } from "./opened.js";
import { focusParameter } from "./panel.js";
import { request, ServerError } from "./server.js";
import { state } from "./state.js";

/** @import { PointAnswer } from "../types.d.ts" */

/** The measures that are listed first, if the model has them. */
export const MAIN_MEASURES = [
  "lift_to_weight",
  "force_up_mn",
  "force_forward_mn",
  "force_left_mn",
  "torque_roll_unm",
  "torque_pitch_unm",
  "torque_yaw_unm",
  "lift_mean_mn",
  "power_mean_mw",
  "efficiency_gf_per_w",
  "stroke_amplitude_deg",
  "pitch_amplitude_deg",
  "strain_surface_max",
  "hinge_strain_max",
  "field_max_v_per_um",
  "floquet_max",
  "error_estimate",
];
/** Largest number of bars of derivatives. */
const MOST_BARS = 10;

export const designNumbers = {
  answer: /** @type {PointAnswer | null} */ (null),
  /** The design and the measure of the answer, as text. */
  design: "",
};

/** A value of a row of the server; undefined if there is no such column. */
export const answerValue = (/** @type {PointAnswer | null | undefined} */ answer, /** @type {string} */ name) =>
  answer?.row[answer.columns.indexOf(name)];

const designText = () => JSON.stringify([state.design, state.measure]);

/** True if the numbers of the present design are shown. */
export const areNumbersShown = () => designNumbers.design === designText();

/** The answer for the present design; null before it has been computed. */
export const presentAnswer = () => (areNumbersShown() ? designNumbers.answer : null);

/** Computes and shows the numbers and the derivatives of the design. */
export const requestNumbers = async () => {
  const design = designText();
  const { measure } = state;
  try {
    const answer = await request("point", { design: { ...state.design }, gradient: measure });
    if (!answer) return;
    Object.assign(designNumbers, { answer, design });
    setStaleNote("numbers", "");
    setMessage("far", answer.warnings.join(" · "));
    showNumbers(answer);
    showDerivatives(answer, measure);
  } catch (error) {
    if (!(error instanceof ServerError)) throw error;
    if (error.status === 0) return;
    const shown = designNumbers.answer ? "These are the numbers of the last possible design." : "";
    setStaleNote("numbers", shown || "There is no possible design yet.");
  }
};

/**
 * A row of the table of numbers.
 *
 * @param {{ name: string, label: string, unit: string, doc?: string }} measure
 * @param {unknown} value
 * @param {unknown} published
 */
const numberRow = ({ name, label, unit, doc = "" }, value, published) => {
  let text = String(value ?? "–");
  if (typeof value === "number") text = `${roundedNumber(value, 5)} ${unit}`;
  return element(
    "div",
    { class: "number", "data-name": name },
    element("span", { title: doc }, label),
    element("span", { class: "value" }, text),
    element(
      "span",
      { class: "change", title: "difference from the published design" },
      differenceText(value, published),
    ),
  );
};

const motionRow = (/** @type {PointAnswer} */ answer) => {
  const stable = answerValue(answer, "stable");
  const stability = stable === null ? "" : stable ? ", stable" : ", not stable";
  const text = answer.reason ?? `${answerValue(answer, "status")}${stability}`;
  const row = numberRow({ name: "status", label: "Motion", unit: "" }, text, null);
  row.classList.add("words");
  return row;
};

const showNumbers = (/** @type {PointAnswer} */ answer) => {
  const { columns, published, modes, published_modes: publishedModes } = answer;
  const measureRow = (/** @type {string} */ name) =>
    numberRow(measureNamed(name), answerValue(answer, name), published[columns.indexOf(name)]);
  const known = MAIN_MEASURES.filter((name) => hasMeasure(name) && answerValue(answer, name) !== null);
  const modeRows = (modes ?? []).map(({ name, frequency_hz: frequency }) => {
    const other = publishedModes?.find((mode) => mode.name === name)?.frequency_hz ?? null;
    const label = `Natural frequency, ${name.replace(/_/g, " ")}`;
    return numberRow({ name, label, unit: "Hz" }, frequency, other);
  });
  byId("main-numbers").replaceChildren(motionRow(answer), ...known.map(measureRow), ...modeRows);
  const all = opened.measures.map(({ name }) => name).filter((name) => columns.includes(name));
  byId("all-numbers").replaceChildren(...all.map(measureRow));
};

/**
 * Shows bars of the derivatives of a measure, the largest first. A click on a bar shows its parameter.
 *
 * @param {PointAnswer} answer
 * @param {string} measure
 */
const showDerivatives = ({ gradient, gradient_reason: reason }, measure) => {
  const { label, unit } = measureNamed(measure);
  byId("gradient-title").textContent = `Effects on ${label.toLowerCase()} (${unit ? `${unit} ` : ""}per %)`;
  if (!gradient) {
    byId("gradient").textContent = reason ?? "";
    return;
  }
  const shown = gradient.slice(0, MOST_BARS);
  const largest = Math.abs(shown[0]?.per_percent ?? 1) || 1;
  const bars = shown.map(({ parameter, per_percent: slope }) => {
    const { label: name } = parameterNamed(parameter);
    const bar = element("i", slope < 0 ? { class: "less" } : {});
    bar.style[slope < 0 ? "right" : "left"] = "50%";
    bar.style.width = `${(50 * Math.abs(slope)) / largest}%`;
    const button = element(
      "button",
      { type: "button", class: "slope", title: `${name}: show the slider` },
      element("span", { class: "name" }, name),
      element("span", { class: "track" }, bar),
      element("span", { class: "value" }, roundedNumber(slope, 3)),
    );
    button.onclick = () => focusParameter(parameter);
    return button;
  });
  byId("gradient").replaceChildren(...bars);
};
