// Ticks of axes, their labels, and ranges.

import assert from "node:assert/strict";
import { test } from "node:test";
import { evenTicks, logTicks, tickLabels } from "../../crates/flap-live/web/chart/axes.js";
import { axisRange } from "../../crates/flap-live/web/chart/lines.js";

test("even ticks are multiples of 1, 2 or 5", () => {
  assert.deepEqual(evenTicks(0, 10, 5), [0, 2, 4, 6, 8, 10]);
  assert.deepEqual(evenTicks(60, 200, 3), [100, 150, 200]);
  assert.deepEqual(evenTicks(-1, 1, 4), [-1, -0.5, 0, 0.5, 1]);
  assert.deepEqual(evenTicks(3, 3, 5), [3]);
});

test("small charts have two ticks at least", () => {
  const ranges = [
    [0.9, 1.1],
    [-1, 1],
    [0, 7e-4],
    [99, 100.3],
  ];
  for (const [low, high] of ranges) assert.ok(evenTicks(low, high, 2).length >= 2, `${low} to ${high}`);
});

test("logarithmic ticks of all sizes are inside, few, and told apart", () => {
  const ranges = [
    [60, 200],
    [72, 168],
    [2.02651e-4, 0.02],
    [1e-9, 1e9],
    [3, 31],
    [0.98, 1.01],
    [1e5, 3e7],
  ];
  for (const [low, high] of ranges) {
    const ticks = logTicks(low, high, 8);
    const labels = tickLabels(ticks);
    assert.ok(ticks.length >= 3 && ticks.length <= 10, `${ticks}`);
    assert.ok(
      ticks.every((tick) => tick >= low && tick <= high),
      `${ticks}`,
    );
    assert.equal(new Set(labels).size, labels.length);
    assert.ok(
      labels.every((label) => label.length <= 7),
      `${labels}`,
    );
  }
});

test("logarithmic ticks have steps by their room", () => {
  assert.deepEqual(logTicks(1, 100, 12), [1, 2, 3, 5, 7, 10, 20, 30, 50, 70, 100]);
  assert.deepEqual(logTicks(1, 100, 6), [1, 2, 5, 10, 20, 50, 100]);
  assert.deepEqual(logTicks(1, 1e4, 5), [1, 10, 100, 1000, 1e4]);
  assert.deepEqual(logTicks(1e-9, 1e9, 3), [1e-6, 1, 1e6]);
});

test("labels have as many digits as tell neighbours apart", () => {
  const labels = ["100.01", "100.02", "100.03", "100.04", "100.05"];
  assert.deepEqual(tickLabels(evenTicks(100.01, 100.05, 4)), labels);
  assert.deepEqual(tickLabels([-0.5, 0, 0.5]), ["−0.5", "0", "0.5"]);
  assert.deepEqual(tickLabels([0, 1e-6, 2e-6]), ["0", "10⁻⁶", "2·10⁻⁶"]);
  assert.deepEqual(tickLabels([1e8, 5e8]), ["10⁸", "5·10⁸"]);
});

test("labels of ticks are not rounded to other values", () => {
  assert.deepEqual(tickLabels([1000, 1002.5, 1005]), ["1000", "1002.5", "1005"]);
  assert.deepEqual(tickLabels([12350, 12375, 12400]), ["12350", "12375", "12400"]);
  assert.deepEqual(tickLabels([1.235e8, 1.2375e8]), ["1.235·10⁸", "1.2375·10⁸"]);
});

test("ranges have a margin, and begin at zero if they come near it", () => {
  assert.deepEqual(axisRange(0, 10, false, 0), [0, 10]);
  assert.deepEqual(axisRange(1, 11, false, 0.1), [0, 12]);
  assert.deepEqual(axisRange(10, 20, false, 0.1), [9, 21]);
  assert.deepEqual(axisRange(5, 5, false, 0), [4.75, 5.25]);
  assert.deepEqual(axisRange(0, 0, false, 0), [-1, 1]);
  assert.deepEqual(axisRange(3, 3, true, 0.1), [1.5, 6]);
  assert.deepEqual(axisRange(1, 100, true, 0.5), [0.1, 1000]);
  assert.deepEqual(axisRange(null, null, true, 0), [1, 10]);
});
