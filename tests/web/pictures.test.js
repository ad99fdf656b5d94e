// Legends, SVG, colours, symbols and texts.

import assert from "node:assert/strict";
import { test } from "node:test";
import { legendHeight, pictureEntries, placedEntries } from "../../crates/flap-live/web/chart/legend.js";
import { svgPicture } from "../../crates/flap-live/web/chart/svg.js";
import { dragSign, pitchSign, valuesAt } from "../../crates/flap-live/web/live/kinematics.js";
import { STEPS, sliderPlace, sliderStep, sliderValue } from "../../crates/flap-live/web/live/slider.js";
import { symbolParts } from "../../crates/flap-live/web/live/symbol.js";
import { wingOutline, wingShape } from "../../crates/flap-live/web/live/wing-outline.js";
import { lineColour, packedColour, unpackedColour, viridis } from "../../crates/flap-live/web/shared/colours.js";
import { differenceText, labelWithUnit, roundedNumber, shortNumber } from "../../crates/flap-live/web/shared/format.js";
import { STATUS_MARKS, statusEntries, statusMark } from "../../crates/flap-live/web/shared/status.js";

const line = (key, more) => ({ key, name: key, color: "#0072b2", x: [0, 1, 2], y: [0, 1, 2], ...more });
const axis = (label) => ({ label, unit: "mN", log: false });

test("the legend of a picture has all entries in order, without lines that are switched off", () => {
  const scene = {
    lines: [line("a"), line("b")],
    title: "Voltage",
    legend: [{ name: "no row", color: "transparent" }],
    bar: { label: "Lift", unit: "mN", low: 1, high: 2, log: true },
    statuses: [{ name: "2 unsettled", color: "#777", shape: "M0 0Z" }],
  };
  const names = pictureEntries(scene, new Set(["b"])).map(({ name }) => name);
  assert.deepEqual(names, ["Lift (mN) from 1 to 2 (log)", "no row", "Voltage:", "a", "2 unsettled"]);
  assert.equal(pictureEntries(scene, new Set())[0].colors.length, 11);
});

test("entries of a legend fill rows, statuses below", () => {
  const entries = ["one", "two", "six"].map((name) => ({ name, colors: ["#000"] }));
  const width = (text) => 10 * text.length;
  const placed = placedEntries([...entries, { name: "bad", shape: "M0 0Z", color: "#777" }], 50, 190, width);
  assert.deepEqual(
    placed.map(({ left, row, words }) => [left, row, words]),
    [
      [50, 0, 71],
      [118, 0, 139],
      [50, 1, 71],
      [50, 2, 66],
    ],
  );
  assert.equal(legendHeight(placed), 3 * 18 + 8);
  assert.equal(legendHeight([]), 0);
});

const layout = {
  hidden: new Set(),
  ticks: { x: [{ value: 1, label: "1" }], y: [{ value: 2, label: "2" }] },
  width: 300,
  height: 200,
  box: { left: 50, top: 10, right: 290, bottom: 160 },
  toX: (value) => 50 + 100 * value,
  toY: (value) => 160 - 50 * value,
  colours: { ink: "#111111", soft: "#555555", grid: "#dddddd", back: "#ffffff" },
  gaps: [],
  entries: [],
  image: null,
};
const picture = (scene, more = {}) =>
  svgPicture({ x: axis("x <&>"), y: axis("y"), lines: [], ...scene }, { ...layout, ...more });

test("a picture has axes, ticks and escaped labels", () => {
  const svg = picture({});
  assert.match(svg, /^<svg xmlns="http:\/\/www.w3.org\/2000\/svg" viewBox="0 0 300 200" width="300" height="200"/);
  assert.match(svg, /<text x="150" y="178" [^>]*>1<\/text>/);
  assert.match(svg, /<text x="42" y="64" [^>]*text-anchor="end">2<\/text>/);
  assert.match(svg, />x &lt;&amp;&gt; \(mN\)<\/text>/);
  assert.match(svg, /<rect width="300" height="200" fill="#ffffff"\/>/);
});

test("lines are paths that end at gaps, and values between two gaps are circles", () => {
  const svg = picture({ lines: [line("a", { x: [0, 1, 2, 3], y: [0, 1, null, 2] })] });
  assert.match(svg, /<path d="M50 160L150 110M350 60"/);
  assert.equal(svg.match(/<circle/g).length, 1);
  assert.match(svg, /<circle cx="350" cy="60" r="2"/);
});

test("marks, hidden lines and ghosts", () => {
  const marked = picture({ lines: [line("a", { marks: true })] });
  assert.equal(marked.match(/<circle/g).length, 3);
  assert.doesNotMatch(picture({ lines: [line("a")] }, { hidden: new Set(["a"]) }), /<path/);
  const ghost = picture({ lines: [line("a", { ghost: true, marks: true, dash: [3, 3] })] }, { hidden: new Set(["a"]) });
  assert.match(ghost, /stroke-dasharray="3 3" opacity="0.35"/);
  assert.doesNotMatch(ghost, /<circle/);
});

test("a logarithmic axis leaves out values that are not positive", () => {
  const svg = picture({ y: { ...axis("y"), log: true }, lines: [line("a", { marks: true, y: [0, 1, 2] })] });
  assert.match(svg, /<path d="M150 110L250 60"/);
  assert.equal(svg.match(/<circle/g).length, 2);
});

test("bands, gaps, the ring, points and cells are where they belong", () => {
  const gap = { shape: "M0 0Z", color: "#123456" };
  const scene = { bands: [{ from: 0.5, to: 1.5 }], marker: { x: 1, y: 1 } };
  const svg = picture(scene, { gaps: [{ gap, x: 70, height: 6 }] });
  assert.match(svg, /<rect x="100" y="10" width="100" height="150" fill="#8888"/);
  assert.match(svg, /<path d="M0 0Z" fill="#123456" transform="translate\(70 154\)"\/>/);
  assert.match(svg, /<circle cx="150" cy="110" r="6" fill="none" stroke="#111111"/);
  const points = { x: [0, 1], y: [1, 2], rows: [0, 1], colors: [packedColour("#ff0000"), 0], size: 6 };
  assert.match(picture({ points }), /<circle cx="50" cy="110" r="3" fill="rgb\(255, 0, 0\)"/);
  assert.match(
    picture({ points }, { image: "data:," }),
    /<image x="50" y="10" width="240" height="150" href="data:,"\/>/,
  );
  const cells = { edgesX: [0, 1], edgesY: [0, 2], i: [0], j: [0], rows: [5], colors: [packedColour("#0000ff")] };
  assert.match(picture({ cells }), /<rect x="50" y="60" width="100.3" height="100.3" fill="rgb\(0, 0, 255\)"/);
});

test("colours: few, shades of many, and numbers", () => {
  assert.equal(lineColour(1, 6, false), "#d55e00");
  assert.equal(viridis(0), "rgb(68,1,84)");
  assert.equal(viridis(1), "rgb(253,231,37)");
  assert.equal(viridis(0.05), "rgb(70,19,101)");
  assert.equal(unpackedColour(packedColour("#0072b2")), "rgb(0, 114, 178)");
  assert.equal(packedColour("rgb(1,2,3)"), 0xff030201);
});

/** The contrast of two colours (red, green, blue), from 1 to 21. */
const contrast = (...colours) => {
  const linear = (part) => (part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4);
  const luminances = colours
    .map((colour) => colour.map(linear))
    .map(([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b);
  return (Math.max(...luminances) + 0.05) / (Math.min(...luminances) + 0.05);
};

test("each of many lines can be read on its background", () => {
  for (const [isDark, back] of [
    [false, [255, 255, 255]],
    [true, [0x15, 0x18, 0x1c]],
  ]) {
    const colours = Array.from({ length: 60 }, (_, i) => lineColour(i, 60, isDark));
    assert.ok(new Set(colours).size > 50);
    for (const colour of colours) assert.ok(contrast(colour.match(/\d+/g).map(Number), back) >= 3, colour);
  }
});

test("each status has a mark of its own", () => {
  const marks = Object.values(STATUS_MARKS);
  for (const part of ["shape", "light", "dark"])
    assert.equal(new Set(marks.map((mark) => mark[part])).size, marks.length);
  assert.deepEqual(statusMark("step_limit", true), { shape: STATUS_MARKS.step_limit.shape, color: "#868e97" });
  assert.equal(statusMark("something else", false).shape, STATUS_MARKS.unsettled.shape);
  assert.equal(statusEntries(new Map([["step_limit", 3]]), false)[0].name, "3 step limit");
});

test("numbers as text", () => {
  assert.deepEqual([0, 1.23456789, 1e6, 1.5e-7, -3e9, Number.NaN, null, "x"].map(shortNumber), [
    "0",
    "1.23457",
    "1e+6",
    "1.5e-7",
    "-3e+9",
    "none",
    "none",
    "none",
  ]);
  assert.equal(roundedNumber(123.456, 4), "123.5");
  assert.equal(labelWithUnit({ label: "Lift", unit: "mN" }), "Lift (mN)");
  assert.equal(labelWithUnit({ label: "Ratio", unit: "" }), "Ratio");
});

test("differences are in per cent where per cent make sense", () => {
  const cases = [
    [110, 100, "+10 %"],
    [-90, -100, "+10 %"],
    [98.7654, 100, "−1.23 %"],
    [100.001, 100, ""],
    [1, 0, ""],
    [1, 1e-5, ""],
    [null, 1, ""],
  ];
  for (const [value, published, text] of cases) assert.equal(differenceText(value, published), text);
});

test("symbols have Greek letters and subscripts", () => {
  const html = (text) =>
    symbolParts(text)
      .map((part) => (part.isSubscript ? `<sub>${part.text}</sub>` : part.text))
      .join("");
  assert.deepEqual(["kappa_wh", "I_zz", "tan delta", "f_31,max", "R", "R_{a b}c^2"].map(html), [
    "κ<sub>wh</sub>",
    "I<sub>zz</sub>",
    "tan δ",
    "f<sub>31,max</sub>",
    "R",
    "R<sub>a b</sub>c²",
  ]);
});

test("sliders are linear, logarithmic or whole", () => {
  const linear = { low: 10, high: 20, log: false, whole: false };
  const log = { low: 1, high: 100, log: true, whole: false };
  assert.equal(sliderPlace(linear, 15), 500);
  assert.equal(sliderValue(linear, 500), 15);
  assert.ok(Math.abs(sliderPlace(log, 10) - 500) < 1e-9);
  assert.equal(sliderValue(log, 500), 10);
  assert.equal(sliderValue({ ...linear, whole: true }, 333), 13);
  assert.equal(sliderValue(linear, 333.33333), 13.3333);
});

test("a step of a slider of whole numbers is one number, and the last number is a place of the slider", () => {
  for (const high of [2, 8, 20, 64]) {
    const scale = { low: 1, high, log: false, whole: true };
    const step = sliderStep(scale);
    const places = Array.from({ length: Math.floor(STEPS / step) + 1 }, (_, i) => i * step);
    assert.deepEqual(
      places.map((place) => sliderValue(scale, place)),
      Array.from({ length: high }, (_, i) => i + 1),
    );
    // The browser moves a rounded place to the nearest step.
    const stepped = Math.round(Math.round(sliderPlace(scale, 2)) / step) * step;
    assert.equal(sliderValue(scale, stepped), 2);
  }
});

test("signals between two samples, and the signs of pitch and drag", () => {
  const signals = { stroke_deg: [0, 10, 0], pitch_deg: [5, 5, -5], lift_mn: null, drag_mn: [1, 1, -1] };
  assert.deepEqual(valuesAt(signals, 0.25), { stroke_deg: 5, pitch_deg: 5, lift_mn: 0, drag_mn: 1 });
  assert.equal(valuesAt(signals, 1).stroke_deg, 0);
  assert.equal(pitchSign(signals), 1);
  assert.equal(pitchSign({ ...signals, pitch_deg: [-5, -5, 5] }), -1);
  assert.equal(dragSign(signals), -1);
  assert.equal(dragSign({ ...signals, drag_mn: [-1, -1, 1] }), 1);
});

test("the wing that is drawn has the mean chord of the design", () => {
  const mean = (values) => {
    const { chord } = wingShape(values);
    const shares = Array.from({ length: 10000 }, (_, i) => (i + 0.5) / 10000);
    return shares.reduce((sum, share) => sum + chord(share), 0) / shares.length;
  };
  assert.ok(Math.abs(mean({ wing_length: 0.02, mean_chord: 0.004 }) / 0.004 - 1) < 1e-5);
  assert.ok(Math.abs(mean({ wing_length: 0.02, wing_area: 6e-5 }) / 0.003 - 1) < 1e-5);
  assert.ok(Math.abs(mean({ wing_length: 0.02, root_chord: 0.004, chord_term_0: 1, chord_term_1: -1 }) - 0.002) < 1e-9);
  assert.equal(wingShape({ wing_area: 6e-5 }), null);
});

test("the outline of a wing begins and ends at its root", () => {
  const points = wingOutline({ length: 10, offset: 2, axis: 0.25, chord: (share) => 4 * (1 - share) });
  assert.equal(points.length, 82);
  assert.deepEqual(
    [points[0], points[40], points[81]],
    [
      [2, 1],
      [12, 0],
      [2, -3],
    ],
  );
});
