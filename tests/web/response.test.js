// Lines and bistable bands of responses.

import assert from "node:assert/strict";
import { test } from "node:test";
import { bistableBands, responseLines, statusCounts } from "../../crates/flap-live/web/live/response.js";

const columns = ["point", "drive_frequency", "voltage", "branch", "status", "stable", "bistable", "lift"];
const row = (frequency, voltage, branch, lift, bistable = null, status = "periodic") => [
  0,
  frequency,
  voltage,
  branch,
  status,
  true,
  bistable,
  lift,
];
const axes = {
  x: "drive_frequency",
  step: 1000,
  factor: 1e-3,
  y: "lift",
  by: "voltage",
  nameOf: (value) => `${value} V`,
};

test("each value of the lines' parameter has a line, in the unit that is shown", () => {
  const rows = [row(1000, 50, null, 1), row(1000, 60, null, 3), row(2000, 50, null, 2), row(2000, 60, null, "inf")];
  const { lines, gaps } = responseLines({ columns, rows }, axes);
  assert.deepEqual(
    lines.map(({ name, x, y }) => [name, x, y]),
    [
      ["50 V", [1, 2], [1, 2]],
      ["60 V", [1, 2], [3, null]],
    ],
  );
  assert.equal(lines[1].x, lines[0].x, "one list for all lines");
  assert.deepEqual(
    lines.map(({ place, of, marks }) => [place, of, marks]),
    [
      [0, 2, true],
      [1, 2, true],
    ],
  );
  const fixed = { status: "periodic", stable: true, bistable: false, begin: null };
  assert.deepEqual(lines[1].rows[0], { ...fixed, x: 1000, by: 60 });
  assert.deepEqual(gaps, []);
});

test("without a parameter there is one line without a name", () => {
  const { lines } = responseLines({ columns, rows: [row(1000, 50, null, 1)] }, { ...axes, by: null });
  assert.deepEqual(
    lines.map(({ key, name }) => [key, name]),
    [["", ""]],
  );
});

test("rows that are not periodic are gaps with their status", () => {
  const rows = [row(1000, 50, null, null, null, "unsettled"), row(2000, 50, null, null, null, "invalid")];
  const { gaps } = responseLines({ columns, rows: [...rows, rows[0]] }, axes);
  assert.deepEqual(
    gaps.map(({ x, status, name }) => [x, status, name]),
    [
      [1, "unsettled", "50 V"],
      [2, "invalid", "50 V"],
      [1, "unsettled", "50 V"],
    ],
  );
  assert.deepEqual(
    [...statusCounts(gaps)],
    [
      ["unsettled", 2],
      ["invalid", 1],
    ],
  );
});

test("a line has a gap where a condition excludes points", () => {
  const rows = [row(1000, 50, null, 1), row(2000, 50, null, 2), row(5000, 50, null, 5), row(6000, 50, null, 6)];
  const { lines, gaps } = responseLines({ columns, rows }, axes);
  assert.deepEqual(lines[0].x, [1, 2, 3.5, 5, 6]);
  assert.deepEqual(lines[0].y, [1, 2, null, 5, 6]);
  assert.equal(lines[0].rows[3].x, 5000);
  assert.deepEqual(gaps, []);
});

test("rows up and down have the states at the beginning of their motions", () => {
  const rows = [row(1000, 50, "up", 1), row(2000, 50, "up", 2), row(2000, 50, "down", 4), row(1000, 50, "down", 3)];
  const states = [[1], [2], [4], [3]];
  const { lines } = responseLines({ columns, rows, states }, { ...axes, by: "branch", nameOf: String });
  const begins = lines.map((line) => line.rows.map(({ begin }) => begin[0]));
  assert.deepEqual(begins, [
    [1, 2],
    [3, 4],
  ]);
});

/** Rows up and down. `marks` are the verdicts of the server, from the lowest frequency to the highest. */
const loop = (marks, lift) => {
  const up = marks.map((mark, i) => row(1000 * (i + 1), 50, "up", lift(i, "up"), mark));
  const down = marks.map((mark, i) => row(1000 * (i + 1), 50, "down", lift(i, "down"), mark)).reverse();
  return responseLines({ columns, rows: [...up, ...down] }, { ...axes, by: "branch", nameOf: String }).lines;
};

test("the way down is reversed, so that x rises", () => {
  const lines = loop([false, true], (i, way) => (way === "up" ? i : 10 + i));
  assert.deepEqual(
    lines.map(({ key, x, y }) => [key, x, y]),
    [
      ["up", [1, 2], [0, 1]],
      ["down", [1, 2], [10, 11]],
    ],
  );
});

test("bistable bands are runs of the rows that the server marks", () => {
  const marks = [false, true, true, true, false, true, false];
  assert.deepEqual(bistableBands(loop(marks, (i) => i)), [
    { from: 2, to: 4 },
    { from: 6, to: 6 },
  ]);
  assert.deepEqual(bistableBands(loop([true, true], (i) => i)), [{ from: 1, to: 2 }]);
  assert.deepEqual(bistableBands(loop([null, false], (i) => i)), []);
  assert.deepEqual(bistableBands([]), []);
});

test("a measure decides nothing: bands are the same if both ways have the same values, and if they do not", () => {
  const marks = [false, true, false];
  assert.deepEqual(bistableBands(loop(marks, () => 1)), [{ from: 2, to: 2 }]);
  const different = loop([false, false, false], (_, way) => (way === "up" ? 1 : 100));
  assert.deepEqual(bistableBands(different), []);
});
