// Columns, fronts and cells of the page of results.

import assert from "node:assert/strict";
import { test } from "node:test";
import { cellsOf, edgesAround } from "../../crates/flap-live/web/results/cells.js";
import {
  boundAtCells,
  cellText,
  csvText,
  decodedColumn,
  extentOf,
  levelsOf,
} from "../../crates/flap-live/web/results/columns.js";
import { paretoFront } from "../../crates/flap-live/web/results/front.js";

const base64 = (array) => Buffer.from(array.buffer).toString("base64");
const column = (type, array, more = {}) =>
  decodedColumn({
    name: "a",
    label: "A",
    unit: "mN",
    title: "A (mN)",
    factor: 1000,
    type,
    data: base64(array),
    ...more,
  });

test("numbers, codes of numbers and codes of words are decoded", () => {
  const numbers = column("f64", Float64Array.of(0.5, Number.NaN, -2));
  assert.deepEqual([...numbers.cells], [0.5, Number.NaN, -2]);
  assert.deepEqual(numbers.extent, [-2, 0.5]);
  assert.deepEqual(
    [0, 1, 2].map((row) => cellText(numbers, row)),
    ["500", "none", "-2000"],
  );
  const coded = column("u8", Uint8Array.of(1, 0, 2), { values: [0.1, 0.2, null] });
  assert.deepEqual([...coded.cells], [0.2, 0.1, Number.NaN]);
  const words = column("u16", Uint16Array.of(1, 0, 65535), { words: ["periodic", "un,settled"] });
  assert.deepEqual([...words.cells], [1, 0, Number.NaN]);
  assert.deepEqual(
    [0, 1, 2].map((row) => cellText(words, row)),
    ["un,settled", "periodic", "none"],
  );
  assert.equal(column("f64", Float64Array.of(Number.NaN)).extent, null);
});

test("CSV has the digits and units of the file", () => {
  const columns = [
    column("f32", Float32Array.of(0.1, Number.NaN)),
    column("f64", Float64Array.of(0.1 + 0.2, 1), { name: 'b"c' }),
    column("u8", Uint8Array.of(0, 9), { words: ["x,y"] }),
  ];
  assert.equal(csvText(columns, [1, 0]), 'a,"b""c",a\n,1,\n0.1,0.30000000000000004,"x,y"\n');
});

test("a typed bound includes the cells that equal it except for rounding", () => {
  const cells = column("f64", Float64Array.of(0.3, 0.1 + 0.2, 0.4, Number.NaN));
  // 0.3 / 1000 * 1000 may differ from 0.3 in the last digit.
  assert.equal(boundAtCells(cells, "low", 0.3 + 5e-17), 0.3);
  assert.equal(boundAtCells(cells, "high", 0.3), 0.1 + 0.2);
  assert.equal(boundAtCells(cells, "low", 0.3001), 0.3001);
  const single = column("f32", Float32Array.of(0.1, 5));
  assert.equal(boundAtCells(single, "high", 0.1), Math.fround(0.1));
  assert.ok(Math.fround(0.1) > 0.1, "without the cell, the filter would exclude the row");
});

test("levels rise and have no missing values", () => {
  const cells = column("f64", Float64Array.of(3, 1, Number.NaN, 3, 2));
  assert.deepEqual(levelsOf(cells), [1, 2, 3]);
  assert.deepEqual(levelsOf(cells, [0, 2, 3]), [3]);
  assert.equal(extentOf([]), null);
});

test("a front has the rows that no other row dominates", () => {
  const x = [1, 2, 3, 2, 3, 1];
  const y = [5, 4, 1, 3, 1, 5];
  const front = (better) =>
    paretoFront(
      [0, 1, 2, 3, 4, 5],
      (row) => x[row],
      (row) => y[row],
      better,
    ).sort();
  assert.deepEqual(front([1, 1]), [0, 1, 2, 4, 5]);
  assert.deepEqual(front([-1, 1]), [0, 5]);
  assert.deepEqual(front([1, -1]), [2, 4]);
  assert.deepEqual(front([-1, -1]), [0, 2, 3, 4, 5]);
});

test("edges of cells are half-way between levels, or at their geometric mean", () => {
  assert.deepEqual(edgesAround([1, 2, 4], false), [0.5, 1.5, 3, 5]);
  const log = edgesAround([1, 100], true);
  for (const [i, edge] of [0.1, 10, 1000].entries()) assert.ok(Math.abs(log[i] / edge - 1) < 1e-12);
  assert.deepEqual(edgesAround([10], false), [9.5, 10.5]);
  assert.deepEqual(edgesAround([0], false), [-1, 1]);
});

test("the first row at a place has the cell", () => {
  const x = [2, 1, 2, 2];
  const y = [5, 5, 6, 5];
  const cells = cellsOf(
    [0, 1, 2, 3],
    (row) => x[row],
    (row) => y[row],
  );
  assert.deepEqual(cells, { levelsX: [1, 2], levelsY: [5, 6], i: [1, 0, 1], j: [0, 0, 1], rows: [0, 1, 2], twice: 1 });
});
