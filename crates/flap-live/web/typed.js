// Numbers that the user types, with or without a unit.

const PREFIXES = { G: 1e9, M: 1e6, k: 1e3, "": 1, c: 1e-2, m: 1e-3, u: 1e-6, n: 1e-9, p: 1e-12 };

/** A unit in plain letters: `µN·m/rad` and `uN*m/rad` are the same. */
const plainUnit = (unit) => unit.replace(/[µμ]/g, "u").replace(/[·.×]/g, "*").replace(/°/g, "deg").replace(/²/g, "2").replace(/³/g, "3").replace(/[\s^]/g, "");

/** The ways to read a unit as a prefix and the rest: { size, stem }. */
const readings = (unit) => Object.entries(PREFIXES).filter(([prefix]) => unit.startsWith(prefix) && unit.length > prefix.length).map(([prefix, size]) => {
  const stem = unit.slice(prefix.length), power = /^[A-Za-z]+([23])$/.exec(stem);
  return { size: size ** (power ? Number(power[1]) : 1), stem };
});

/** How many of the unit `shown` one of the unit `typed` is; null if they do not measure the same. */
const unitRatio = (typed, shown) => {
  const [from, to] = [typed, shown].map(plainUnit);
  if (from === to) return 1;
  for (const { size, stem } of readings(to)) {
    const other = readings(from).find((reading) => reading.stem === stem);
    if (other) return other.size / size;
  }
  return null;
};

/** A text as a number and what stands behind it: { number, rest } or { problem }. A decimal comma is a point. */
const splitNumber = (text) => {
  const found = /^([-+−]?[\d.,]+(?:e[-+]?\d+)?)\s*(.*)$/i.exec(text.trim());
  if (!found) return { problem: `“${text}” does not begin with a number` };
  const digits = found[1].replace("−", "-");
  if (/,\d{3}(?!\d)/.test(digits)) {
    const [whole, decimal] = [digits.replace(/,/g, ""), Number(digits.replace(",", "."))];
    return { problem: `“${digits}” may be ${whole} or ${decimal}: write it without a comma` };
  }
  const number = Number(digits.replace(",", "."));
  return Number.isFinite(number) ? { number, rest: found[2] } : { problem: `“${digits}” is not a number` };
};

/** A number in the unit that is shown: { number } or { problem }. */
const typedNumber = (text, unit) => {
  const { number, rest, problem } = splitNumber(text);
  if (problem) return { problem };
  if (rest === "") return { number };
  const ratio = unit ? unitRatio(rest, unit) : null;
  if (ratio === null) return { problem: unit ? `“${rest}” is not a unit for this: write ${unit}, or another size of it` : `“${rest}” is too much: this number has no unit` };
  return { number: Number((number * ratio).toPrecision(15)) };
};

/** A number in the unit that is shown as a number in SI units, without the digits that rounding adds. */
const inSI = (number, factor) => Number((number / factor).toPrecision(15));
