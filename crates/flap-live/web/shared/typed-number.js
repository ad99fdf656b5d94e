// @ts-check
// Numbers that the user types, with or without a unit.

/** @type {Record<string, number>} */
const PREFIXES = { G: 1e9, M: 1e6, k: 1e3, "": 1, c: 1e-2, m: 1e-3, u: 1e-6, n: 1e-9, p: 1e-12 };

/** A unit in plain letters: `µN·m/rad` becomes `uN*m/rad`. */
const plainUnit = (/** @type {string} */ unit) =>
  unit
    .replace(/[µμ]/g, "u")
    .replace(/[·.×]/g, "*")
    .replace(/°/g, "deg")
    .replace(/²/g, "2")
    .replace(/³/g, "3")
    .replace(/[\s^]/g, "");

/** All ways to split a unit into a prefix and a unit without a prefix. */
const prefixReadings = (/** @type {string} */ unit) =>
  Object.entries(PREFIXES)
    .filter(([prefix]) => unit.startsWith(prefix) && unit.length > prefix.length)
    .map(([prefix, size]) => {
      const base = unit.slice(prefix.length);
      const power = /^[A-Za-z]+([23])$/.exec(base);
      return { size: size ** (power ? Number(power[1]) : 1), base };
    });

/**
 * The number of units `shown` in one unit `typed`; null if they are not units of the same quantity.
 *
 * @param {string} typed
 * @param {string} shown
 */
export const unitRatio = (typed, shown) => {
  const [from, to] = [typed, shown].map(plainUnit);
  if (from === to) return 1;
  for (const { size, base } of prefixReadings(to)) {
    const other = prefixReadings(from).find((reading) => reading.base === base);
    if (other) return other.size / size;
  }
  return null;
};

/**
 * A text as a number and the rest of the text, or the problem of the text. A decimal comma counts as a point.
 *
 * @param {string} text
 * @returns {{ number: number, rest: string, problem?: undefined }
 *   | { problem: string, number?: undefined, rest?: undefined }}
 */
export const splitNumber = (text) => {
  const found = /^([-+−]?[\d.,]+(?:e[-+]?\d+)?)\s*(.*)$/i.exec(text.trim());
  if (!found) return { problem: `“${text}” does not begin with a number` };
  const digits = found[1].replace("−", "-");
  if (/,\d{3}(?!\d)/.test(digits)) {
    const [whole, decimal] = [digits.replace(/,/g, ""), Number(digits.replace(",", "."))];
    return { problem: `“${digits}” may be ${whole} or ${decimal}: write it without a comma` };
  }
  const number = Number(digits.replace(",", "."));
  if (!Number.isFinite(number)) return { problem: `“${digits}” is not a number` };
  return { number, rest: found[2] };
};

/**
 * A typed text as a number in `unit`, or the problem of the text.
 *
 * @param {string} text
 * @param {string} unit
 * @returns {{ number: number, problem?: undefined } | { problem: string, number?: undefined }}
 */
export const typedNumber = (text, unit) => {
  const { number, rest, problem } = splitNumber(text);
  if (problem !== undefined) return { problem };
  if (rest === "") return { number };
  if (!unit) return { problem: `“${rest}” is not allowed: this number has no unit` };
  const ratio = unitRatio(rest, unit);
  if (ratio === null)
    return { problem: `“${rest}” is not a unit of this quantity: use ${unit}, with or without a prefix` };
  return { number: Number((number * ratio).toPrecision(15)) };
};

/**
 * The SI value of a number in the shown unit, which is `factor` times the SI value. It is rounded to fifteen digits to
 * remove rounding errors.
 *
 * @param {number} number
 * @param {number} factor
 */
export const inSI = (number, factor) => Number((number / factor).toPrecision(15));

/**
 * The numbers of a typed list as SI values. Other texts stay text, which the server converts or refuses. With a
 * semicolon in the list, a comma between digits is a decimal comma.
 *
 * @param {string} text
 * @param {number} factor
 */
export const typedList = (text, factor) =>
  text
    .split(text.includes(";") ? /(?:[;\s]|,\s)+(?=[-+−.\d])/ : /[,;\s]+(?=[-+−.\d])/)
    .map((part) => part.trim())
    .filter(Boolean)
    .map((part) => {
      const { number, rest, problem } = splitNumber(part);
      if (problem !== undefined) return part;
      return rest === "" ? inSI(number, factor) : `${number} ${rest}`;
    });
