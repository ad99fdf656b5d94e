// @ts-check
// The motion over a cycle: the wing from above and from its tip, and its signals over time.

import { Chart } from "../chart/chart.js";
import { FEW_COLOURS } from "../shared/colours.js";
import { byId, element } from "../shared/dom.js";
import { styleColour } from "../shared/theme.js";
import { setStaleNote } from "./banner.js";
import { dragSign, pitchSign, valuesAt } from "./kinematics.js";
import { isVehicle, opened } from "./opened.js";
import { request, ServerError } from "./server.js";
import { wingOutline, wingShape } from "./wing-outline.js";

/** @import { Design, RowTable, Signals, WingShape } from "../types.d.ts" */

/** Intervals of a cycle. */
const SAMPLES = 120;
/** Seconds that a cycle takes on the screen at full speed. */
const CYCLE_TIME = 0.6;
/** Charts of signals: name, unit, columns. @type {[string, string, string[]][]} */
const SIGNAL_CHARTS = [
  ["Angles", "°", ["stroke_deg", "pitch_deg"]],
  ["Forces", "mN", ["lift_mn", "drag_mn"]],
  ["Power", "mW", ["power_mw"]],
  ["Current", "mA", ["current_ma", "current_1_ma", "current_2_ma"]],
];
/** Signals of the moving wing. */
const WING_SIGNALS = ["stroke_deg", "pitch_deg", "lift_mn", "drag_mn"];
/** A wing of a model that has no sizes. @type {WingShape} */
const PLAIN_WING = { length: 1, offset: 0, axis: 0.25, chord: () => 0.25 };
const LIFT_COLOUR = "#009e73";
const DRAG_COLOUR = "#d55e00";

const hasMotion = opened.can.motion && !isVehicle;

const motion = {
  /** The wing of the motion that is shown. */
  wing: PLAIN_WING,
  /** Signals of the wing; null before there is a motion. @type {Signals | null} */
  signals: null,
  /** The sign of `pitchSign`. */
  pitchSign: 1,
  /** @type {Chart[]} */
  charts: [],
  /** The time that is shown, as a share of the cycle. */
  share: 0,
  isPlaying: true,
  /** The time of the last frame. */
  lastFrame: 0,
};

/**
 * Computes and shows the motion of a design.
 *
 * @param {Design} design
 * @param {string} title the name of the design
 * @param {number[] | null} begin the state at the beginning of the motion; null for the motion that settles from rest
 */
export const requestMotion = async (design, title, begin = null) => {
  if (!hasMotion) return;
  try {
    const answer = await request("motion", { design, samples: SAMPLES, begin });
    if (!answer) return;
    motion.wing = wingShape(answer.values) ?? PLAIN_WING;
    byId("motion-of").textContent = title;
    setStaleNote("motion", "");
    showSignals(answer);
  } catch (error) {
    if (!(error instanceof ServerError)) throw error;
    if (error.status === 0) return;
    const last = error.parameter ? "possible design" : "design with a settled motion";
    setStaleNote("motion", motion.signals ? `This is the last ${last}.` : `There is no ${last} yet.`);
  }
};

/** The name of a signal in a legend: the name of its column without the unit. */
const signalName = (/** @type {string} */ column) => column.replace(/_(deg|mn|mw|ma)$/, "").replace(/_/g, " ");

/** Creates one chart for each kind of signal. */
const makeCharts = (/** @type {string[]} */ names) => {
  if (motion.charts.length === names.length) return;
  for (const chart of motion.charts) chart.destroy();
  const places = names.map(() => element("div"));
  byId("series").dataset.count = String(names.length);
  byId("series").replaceChildren(...places);
  motion.charts = names.map((name, i) => new Chart(places[i], { height: 150, name }));
};

const showSignals = (/** @type {RowTable} */ { columns, rows }) => {
  const signal = (/** @type {string} */ name) => {
    const place = columns.indexOf(name);
    return place < 0 ? null : rows.map((row) => /** @type {number} */ (row[place]));
  };
  const time = signal("time_s") ?? [];
  const x = time.map((value) => value / time[time.length - 1]);
  motion.signals = Object.fromEntries(WING_SIGNALS.map((name) => [name, signal(name)]));
  motion.pitchSign = pitchSign(motion.signals);
  const known = SIGNAL_CHARTS.map(([name, unit, all]) => ({ name, unit, shown: all.filter((each) => signal(each)) }));
  const shown = known.filter((chart) => chart.shown.length > 0);
  makeCharts(shown.map(({ name }) => name));
  shown.forEach(({ name, unit, shown: signals }, i) => {
    const lines = signals.map((key, j) => {
      const legend = signals.length > 1 ? signalName(key) : "";
      return { key, name: legend, color: FEW_COLOURS[j], x, y: signal(key) ?? [], width: 1.5 };
    });
    const axis = { label: name, unit, log: false };
    motion.charts[i].draw({ x: { label: "cycle", unit: "", log: false }, y: axis, lines });
  });
};

/** A pen whose units are pixels of the page, on an empty canvas. */
const penOf = (/** @type {HTMLCanvasElement} */ canvas) => {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const pen = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
};

/**
 * @param {CanvasRenderingContext2D} pen
 * @param {[number, number]} from
 * @param {[number, number]} by
 * @param {string} color
 */
const drawArrow = (pen, [x, y], [dx, dy], color) => {
  const size = Math.hypot(dx, dy);
  if (size < 3) return;
  const [ux, uy] = [dx / size, dy / size];
  const [endX, endY] = [x + dx, y + dy];
  pen.strokeStyle = pen.fillStyle = color;
  pen.lineWidth = 2.5;
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(endX, endY);
  pen.stroke();
  pen.beginPath();
  pen.moveTo(endX + 4 * ux, endY + 4 * uy);
  pen.lineTo(endX - 6 * ux - 4 * uy, endY - 6 * uy + 4 * ux);
  pen.lineTo(endX - 6 * ux + 4 * uy, endY - 6 * uy - 4 * ux);
  pen.fill();
};

/**
 * A line with the colour of a variable of the style.
 *
 * @param {CanvasRenderingContext2D} pen
 * @param {[number, number]} from
 * @param {[number, number]} to
 * @param {string} colour
 * @param {number} width
 */
const drawLine = (pen, from, to, colour, width) => {
  pen.strokeStyle = styleColour(colour);
  pen.lineWidth = width;
  pen.beginPath();
  pen.moveTo(...from);
  pen.lineTo(...to);
  pen.stroke();
};

/** Writes a caption below a picture, unless it is already there. */
const setCaption = (/** @type {string} */ id, /** @type {string} */ text) => {
  if (byId(id).textContent !== text) byId(id).textContent = text;
};

const radians = (/** @type {number} */ degrees) => (degrees * Math.PI) / 180;

/**
 * @param {Record<string, number>} now
 * @param {number[]} stroke
 * @param {WingShape} wing
 */
const paintFromAbove = (now, stroke, wing) => {
  const { pen, width, height } = penOf(byId("above"));
  const span = wing.length + wing.offset;
  const scale = (Math.min(width * 0.8, height * 0.95) / span) * 0.62;
  const angle = radians(now.stroke_deg);
  const lean = Math.sin(radians(now.pitch_deg)) * motion.pitchSign;
  /** @type {[number, number]} */
  const root = [width / 2, height * 0.9];
  const [alongX, alongY] = [Math.sin(angle), -Math.cos(angle)];
  const [least, most] = [Math.min(...stroke), Math.max(...stroke)].map((degrees) => radians(degrees - 90));
  pen.fillStyle = styleColour("--panel");
  pen.beginPath();
  pen.moveTo(...root);
  pen.arc(...root, span * scale, least, most);
  pen.fill();
  pen.beginPath();
  for (const [along, chord] of wingOutline(wing)) {
    // Seen from above, the chord appears as its projection on the stroke plane.
    const across = chord * lean;
    pen.lineTo(
      root[0] + scale * (along * alongX - across * alongY),
      root[1] + scale * (along * alongY + across * alongX),
    );
  }
  pen.closePath();
  pen.globalAlpha = 0.35;
  pen.fillStyle = pen.strokeStyle = styleColour("--accent");
  pen.fill();
  pen.globalAlpha = 1;
  pen.lineWidth = 1.5;
  pen.stroke();
  drawLine(pen, root, [root[0] + span * scale * alongX, root[1] + span * scale * alongY], "--ink", 2.5);
  setCaption("above-caption", `from above · stroke ${Math.round(now.stroke_deg)}°`);
};

/**
 * @param {Record<string, number>} now
 * @param {Signals} signals
 */
const paintFromTip = (now, signals) => {
  const { pen, width, height } = penOf(byId("tip-view"));
  const widest = Math.max(...(signals.stroke_deg ?? []).map(Math.abs), 1);
  const x = width / 2 + (now.stroke_deg / widest) * width * 0.33;
  const y = height * 0.36;
  const size = height * 0.34;
  const lean = radians(now.pitch_deg);
  const [endX, endY] = [x - Math.sin(lean) * motion.pitchSign * size, y + Math.cos(lean) * size];
  drawLine(pen, [width * 0.12, y], [width * 0.88, y], "--line", 1);
  pen.lineCap = "round";
  drawLine(pen, [x, y], [endX, endY], "--accent", 4);
  pen.fillStyle = styleColour("--ink");
  pen.beginPath();
  pen.arc(x, y, 5, 0, 7);
  pen.fill();
  const forces = [...(signals.lift_mn ?? []), ...(signals.drag_mn ?? [])];
  const unit = (height * 0.42) / Math.max(...forces.map(Math.abs), 1e-9);
  /** @type {[number, number]} */
  const middle = [(x + endX) / 2, (y + endY) / 2];
  drawArrow(pen, middle, [0, -now.lift_mn * unit], LIFT_COLOUR);
  if (signals.drag_mn) drawArrow(pen, middle, [now.drag_mn * unit * dragSign(signals), 0], DRAG_COLOUR);
  setCaption("tip-caption", `from the tip · pitch ${Math.round(now.pitch_deg)}°`);
};

const drawFrame = (/** @type {number} */ time) => {
  const passed = Math.min(time - motion.lastFrame, 100) / 1000;
  motion.lastFrame = time;
  if (motion.signals) {
    if (motion.isPlaying) motion.share = (motion.share + (passed * Number(byId("speed").value)) / CYCLE_TIME) % 1;
    const now = valuesAt(motion.signals, motion.share);
    paintFromAbove(now, motion.signals.stroke_deg ?? [], motion.wing);
    paintFromTip(now, motion.signals);
    for (const chart of motion.charts) chart.setTime(motion.share);
  }
  requestAnimationFrame(drawFrame);
};

const setPlaying = (/** @type {boolean} */ isPlaying) => {
  motion.isPlaying = isPlaying;
  byId("play").textContent = isPlaying ? "Pause" : "Play";
};

/** Stops at a time, which is given as a share of the cycle. */
export const showMoment = (/** @type {number} */ share) => {
  setPlaying(false);
  motion.share = share;
};

export const startMotion = () => {
  if (!hasMotion) {
    const reason = isVehicle ? ": the design has several wings" : "";
    byId("motion").classList.add("without");
    byId("motion-of").textContent = `There is no single motion to show${reason}.`;
    return;
  }
  byId("play").onclick = () => setPlaying(!motion.isPlaying);
  setPlaying(!window.matchMedia("(prefers-reduced-motion: reduce)").matches);
  requestAnimationFrame(drawFrame);
};
