// Numbers that the user types.

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  inSI,
  splitNumber,
  typedList,
  typedNumber,
  unitRatio,
} from "../../crates/flap-live/web/shared/typed-number.js";

test("a number with another size of the unit is converted", () => {
  const cases = [
    ["0.1 kHz", "Hz", 100],
    ["99,5", "Hz", 99.5],
    ["−3", "mm", -3],
    ["1.5e-2 m", "mm", 15],
    ["0.7486 uN*m/rad", "µN·m/rad", 0.7486],
    ["2 cm2", "mm²", 200],
    ["1 cm^3", "mm³", 1000],
    ["20 deg", "°", 20],
    ["5", "", 5],
  ];
  for (const [text, unit, number] of cases) assert.deepEqual(typedNumber(text, unit), { number }, text);
});

test("texts that are no numbers have a problem in words", () => {
  const cases = [
    ["1,400", "Hz", /may be 1400 or 1\.4/],
    ["-1,400.5", "Hz", /may be -1400\.5/],
    ["5 cats", "Hz", /“cats” is not a unit of this quantity: use Hz/],
    ["5 Hz", "", /this number has no unit/],
    ["much", "Hz", /does not begin with a number/],
    ["1.2.3", "Hz", /is not a number/],
  ];
  for (const [text, unit, problem] of cases) assert.match(typedNumber(text, unit).problem, problem);
});

test("the rest of a text is kept for the server", () => {
  assert.deepEqual(splitNumber(" 3 cats "), { number: 3, rest: "cats" });
  assert.deepEqual(splitNumber("1e3V"), { number: 1000, rest: "V" });
});

test("units of other quantities have no ratio", () => {
  assert.equal(unitRatio("kV", "V"), 1000);
  assert.equal(unitRatio("mm²", "m²"), 1e-6);
  assert.equal(unitRatio("mN", "MN"), 1e-9);
  assert.equal(unitRatio("s", "m"), null);
});

test("SI values have no digits of rounding", () => {
  assert.deepEqual([inSI(156, 1000), inSI(0.7, 1e3), inSI(55, 1e6), inSI(1.1, 1e9)], [0.156, 0.0007, 5.5e-5, 1.1e-9]);
});

test("lists hold SI values, and texts with units", () => {
  assert.deepEqual(typedList("100, 0.15 kV; 200 -3", 1), [100, "0.15 kV", 200, -3]);
  assert.deepEqual(typedList("1 2", 1000), [0.001, 0.002]);
  assert.deepEqual(typedList(" ", 1), []);
  assert.deepEqual(typedList("−5, −3", 1), [-5, -3]);
  assert.deepEqual(typedList("much", 1), ["much"]);
});

test("a comma in a list with semicolons is a decimal comma", () => {
  assert.deepEqual(typedList("0,5; 0,7 kV;0,9", 1), [0.5, "0.7 kV", 0.9]);
  assert.deepEqual(typedList("100, 200; 300", 1), [100, 200, 300]);
  assert.deepEqual(typedList("1,400; 1,5", 1), ["1,400", 1.5]);
});
