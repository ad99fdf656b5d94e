// Lines, gaps and marks of a chart.

import assert from "node:assert/strict";
import { test } from "node:test";
import { gapAt, gapHeight, placedGaps } from "../../crates/flap-live/web/chart/gaps.js";
import { isolatedPoints, legendLines, nearestPlace } from "../../crates/flap-live/web/chart/lines.js";
import { nextMark, renewedMark, rowsWithin } from "../../crates/flap-live/web/chart/marks.js";

test("a value between two gaps is a point", () => {
  assert.deepEqual(isolatedPoints([1, null, 2, null, 3, 4]), [0, 2]);
  assert.deepEqual(isolatedPoints([null, 1, null]), [1]);
  assert.deepEqual(isolatedPoints([1, 2]), null);
  assert.deepEqual(isolatedPoints([5]), [0]);
  assert.deepEqual(isolatedPoints([null]), null);
  assert.deepEqual(isolatedPoints([1, 2, null, 3]), [3]);
  // undefined is the place of another line, not a gap.
  assert.deepEqual(isolatedPoints([1, undefined, 2, null, 3]), [4]);
});

test("the nearest place is found in rising lists", () => {
  const list = [0, 1, 4, 9];
  assert.deepEqual(
    [-5, 0.4, 0.6, 2.6, 6, 20].map((value) => nearestPlace(list, value)),
    [0, 0, 1, 2, 2, 3],
  );
  assert.equal(nearestPlace([7], 3), 0);
  assert.equal(nearestPlace([], 3), -1);
});

const line = (key, more) => ({
  key,
  name: key,
  color: "#000",
  x: [1, 2, 3],
  y: [1, null, 3],
  rows: [10, 11, 12],
  ...more,
});

test("lines of a group have one entry in the legend, ghosts and nameless lines none", () => {
  const lines = [
    line("a", { group: "g" }),
    line("b", { group: "g" }),
    line("c", { ghost: true }),
    line("d", { name: "" }),
  ];
  assert.deepEqual(
    legendLines(lines).map(({ key }) => key),
    ["a"],
  );
});

test("arrow keys leave out gaps and lines that are switched off", () => {
  const chart = { scene: { lines: [line("a"), line("b"), line("c")] }, hidden: new Set(["b"]), mark: null };
  const go = (right, up) => {
    chart.mark = nextMark(chart, right, up);
    return [chart.mark.key, chart.mark.x, chart.mark.row];
  };
  assert.deepEqual(go(1, 0), ["a", 1, 10]);
  assert.deepEqual(go(1, 0), ["a", 3, 12]);
  assert.deepEqual(go(1, 0), ["a", 3, 12]);
  assert.deepEqual(go(0, 1), ["c", 3, 12]);
  assert.deepEqual(go(0, 1), ["a", 3, 12]);
  assert.deepEqual(go(-1, 0), ["a", 1, 10]);
});

test("arrow keys go to the nearest x of a line with other values", () => {
  const long = line("a", { x: [0, 1, 2, 3, 4, 5], y: [1, 2, 3, 4, 5, 6] });
  const lines = [long, line("b"), line("c", { x: [3, 4, 6], y: [1, 2, 3] })];
  const above = (index, up) =>
    nextMark({ scene: { lines }, hidden: new Set(), mark: { key: "a", index, x: long.x[index] } }, 0, up).x;
  assert.deepEqual([above(4, 1), above(5, 1), above(4, -1)], [3, 3, 4]);
});

test("arrow keys pass several values at one x", () => {
  const lines = [line("a", { x: [1, 1, 2], y: [1, 2, 3] })];
  const chart = { scene: { lines }, hidden: new Set(), mark: { key: "a", index: 1, x: 1 } };
  assert.equal(nextMark(chart, 1, 0).x, 2);
});

test("arrow keys go from cell to cell with a row, and stop at the edge", () => {
  const cells = { edgesX: [0, 1, 2, 3], edgesY: [0, 1], i: [0, 2], j: [0, 0], rows: [7, 8], colors: [0, 0] };
  const chart = { scene: { lines: [], cells }, hidden: new Set(), mark: null };
  const go = (right, up) => {
    chart.mark = nextMark(chart, right, up);
    return [chart.mark.row, chart.mark.x];
  };
  assert.deepEqual(go(1, 0), [7, 0.5]);
  assert.deepEqual(go(1, 0), [8, 2.5]);
  assert.deepEqual(go(1, 0), [8, 2.5]);
  assert.deepEqual(go(0, 1), [8, 2.5]);
  assert.deepEqual(go(-1, 0), [7, 0.5]);
});

test("a mark is at the nearest value after its line has changed", () => {
  const mark = { key: "a", x: 2.8 };
  assert.deepEqual(renewedMark({ lines: [line("a")] }, mark).row, 12);
  assert.equal(renewedMark({ lines: [line("a", { y: [1, 2, null] })] }, mark), null);
  assert.equal(renewedMark({ lines: [line("b")] }, mark), null);
});

test("rows within a part of the plane", () => {
  const points = { x: [1, 2, 3], y: [1, 2, 3], rows: [4, 5, 6] };
  const cells = { edgesX: [0, 2, 4], edgesY: [0, 2], i: [0, 1], j: [0, 0], rows: [8, 9] };
  assert.deepEqual(rowsWithin({ lines: [line("a")], points }, new Set(), [1.5, 3], [0, 3]), [5, 6, 12]);
  assert.deepEqual(rowsWithin({ lines: [line("a")], points }, new Set(["a"]), [1.5, 3], [0, 3]), [5, 6]);
  assert.deepEqual(rowsWithin({ lines: [], cells }, new Set(), [2.5, 4], [0, 2]), [9]);
});

/** A plot of 100 by 50 pixels, in which x is the pixel. */
const gaps = [
  { group: "a", x: 10, status: "unsettled", name: "one", row: 1 },
  { group: "b", x: 10.2, status: "unsettled", name: "two", row: 2 },
  { group: "b", x: 10, status: "step_limit", name: "three", row: 3 },
  { group: "b", x: 500, status: "unsettled", name: "four", row: 4 },
];
const chart = {
  plot: { over: { clientWidth: 100, clientHeight: 50 }, valToPos: (x) => x },
  scene: { gaps },
  hidden: new Set(),
};

test("gaps are marks in rows by status, one at each pixel", () => {
  const placed = placedGaps(chart).map(({ gap, left, row }) => [gap.name, left, row]);
  assert.deepEqual(placed, [
    ["one", 10, 0],
    ["three", 10, 1],
  ]);
  assert.deepEqual([gapHeight(0), gapHeight(1)], [6, 16]);
});

test("the pointer at a gap finds all gaps at its x", () => {
  const found = gapAt(chart, 12, 50 - gapHeight(1));
  assert.deepEqual([found.row, found.gaps.map(({ name }) => name)], [3, ["one", "three"]]);
  assert.equal(gapAt(chart, 30, 50 - gapHeight(0)), null);
  assert.equal(gapAt(chart, 10, 10), null);
});

test("gaps of a line that is switched off have no marks", () => {
  const switched = { ...chart, hidden: new Set(["a"]) };
  const placed = placedGaps(switched).map(({ gap, row }) => [gap.name, row]);
  assert.deepEqual(placed, [
    ["two", 0],
    ["three", 1],
  ]);
  assert.deepEqual(
    gapAt(switched, 10, 50 - gapHeight(1)).gaps.map(({ name }) => name),
    ["three"],
  );
});
