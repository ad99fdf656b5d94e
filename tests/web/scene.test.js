// Scenes of the page of results. The parts of a browser that the page reads at its start are replaced.

import assert from "node:assert/strict";
import { test } from "node:test";

const column = (name, values) => ({
  name,
  label: name,
  unit: "mm",
  title: name,
  factor: 1,
  type: "f64",
  data: Buffer.from(Float64Array.from(values).buffer).toString("base64"),
});
// The third and the sixth row have no length, and the last two rows have no lift. Only the last row is unsettled.
const columns = [
  column("length", [1, 2, Number.NaN, 1, 2, Number.NaN, 3, 4]),
  column("lift", [5, 6, 7, 8, 9, 10, Number.NaN, Number.NaN]),
  column("mass", [1, 1, 1, 2, 2, Number.NaN, 1, 1]),
];
const statuses = ["periodic", "unsettled"];
columns.push({
  ...column("status", []),
  type: "u8",
  words: statuses,
  data: Buffer.of(0, 0, 0, 0, 0, 0, 0, 1).toString("base64"),
});
const start = { kind: "line", x: 0, y: 1, by: null, color: null, best: "", where: {} };
const results = { columns, axes: [], branch: null, rows: 8, of: 8, stride: 1, single: false, start };

globalThis.window = { matchMedia: () => ({ matches: false }) };
globalThis.document = {
  documentElement: { classList: { contains: () => false } },
  getElementById: () => ({ textContent: JSON.stringify(results) }),
};
globalThis.getComputedStyle = () => ({ getPropertyValue: () => "#888888" });
const { drawingOf } = await import("../../crates/flap-live/web/results/scene.js");

const view = (more) => ({ ...start, log: { x: false, y: false, color: false }, ...more });
const rows = Int32Array.of(0, 1, 2, 3, 4, 5, 6, 7);

test("rows that a view cannot draw are counted, for each kind of view", () => {
  for (const kind of ["line", "scatter", "map"]) assert.equal(drawingOf(view({ kind }), rows).without, 4, kind);
  assert.deepEqual(drawingOf(view({ kind: "map" }), rows).scene.cells.rows, [0, 1, 3, 4]);
});

test("lines have no values without x", () => {
  const [line] = drawingOf(view({}), rows).scene.lines;
  assert.deepEqual(line.x, [1, 1, 2, 2, 3, 4]);
  assert.deepEqual(line.y, [5, 8, 6, 9, null, null]);
});

test("rows without a value of the lines' column have the last line, with a colour of its own", () => {
  const { lines } = drawingOf(view({ x: 1, y: 1, by: 2 }), rows).scene;
  assert.deepEqual(
    lines.map(({ name, x }) => [name, x]),
    [
      ["1 mm", [5, 6, 7]],
      ["2 mm", [8, 9]],
      ["none", [10]],
    ],
  );
  assert.equal(new Set(lines.map(({ color }) => color)).size, 3);
  assert.ok(lines.every(({ color }) => /^(#|rgb)/.test(color)));
});

test("a settled row without a value has no mark", () => {
  const { gaps } = drawingOf(view({}), rows).scene;
  assert.deepEqual(
    gaps.map(({ x, status }) => [x, status]),
    [[4, "unsettled"]],
  );
});
