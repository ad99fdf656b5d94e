// @ts-check
// Columns of rows: numbers, or codes with their words.

import { shortNumber } from "../shared/format.js";

/** @import { Cells, Column, Range, StoredColumn } from "../types.d.ts" */

const ARRAYS = { f64: Float64Array, f32: Float32Array, u8: Uint8Array, u16: Uint16Array, u32: Uint32Array };

/** @returns {ArrayBuffer} */
const decodedBytes = (/** @type {string} */ text) => {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text).buffer;
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0)).buffer;
};

/**
 * The smallest and the largest of some numbers; null if there are none.
 *
 * @param {Iterable<number>} values
 * @returns {Range | null}
 */
export const extentOf = (values) => {
  let low = Number.POSITIVE_INFINITY;
  let high = Number.NEGATIVE_INFINITY;
  for (const value of values) {
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : null;
};

/**
 * A column of the page. Its cells are decoded when they are first needed.
 *
 * @param {StoredColumn} stored
 * @returns {Column}
 */
export const decodedColumn = (stored) => {
  const { type, data, values, words = null } = stored;
  /** @type {Cells | undefined} */
  let cells;
  /** @type {Range | null | undefined} */
  let extent;
  return {
    ...stored,
    words,
    get extent() {
      if (extent === undefined) extent = extentOf(this.cells);
      return extent;
    },
    get cells() {
      if (cells) return cells;
      const codes = new ARRAYS[type](decodedBytes(data));
      if (values) cells = Float64Array.from(codes, (code) => values[code] ?? Number.NaN);
      else if (words) cells = Float64Array.from(codes, (code) => (code < words.length ? code : Number.NaN));
      else cells = codes;
      return cells;
    },
  };
};

/**
 * The different values of a column in rising order, in some rows or in all.
 *
 * @param {Column} column
 * @param {Iterable<number>} rows
 */
export const levelsOf = (column, rows = column.cells.keys()) => {
  /** @type {Set<number>} */
  const levels = new Set();
  for (const row of rows) {
    const value = column.cells[row];
    if (!Number.isNaN(value)) levels.add(value);
  }
  return [...levels].sort((a, b) => a - b);
};

/**
 * A typed bound of a filter without its rounding: the outermost of the cells that equal the bound to nine digits, or to
 * six digits in a column with seven; the bound itself if there are none.
 *
 * @param {Column} column
 * @param {"low" | "high"} side
 * @param {number} bound
 */
export const boundAtCells = ({ cells, type }, side, bound) => {
  const tolerance = (type === "f32" ? 1e-6 : 1e-9) * Math.abs(bound);
  const equal = extentOf(Array.from(cells).filter((cell) => Math.abs(cell - bound) <= tolerance));
  return equal?.[side === "low" ? 0 : 1] ?? bound;
};

/** A cell as text, in the page's unit. */
export const cellText = (/** @type {Column} */ column, /** @type {number} */ row) => {
  const value = column.cells[row];
  if (column.words) return Number.isNaN(value) ? "none" : column.words[value];
  return shortNumber(value * column.factor);
};

const quoted = (/** @type {string} */ text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** A cell as in the file: with all digits that the page has, in the file's unit. */
const csvCell = (/** @type {Column} */ { cells, words, type }, /** @type {number} */ row) => {
  const value = cells[row];
  if (Number.isNaN(value)) return "";
  if (words) return quoted(words[value]);
  return String(type === "f32" ? Number(value.toPrecision(7)) : value);
};

/**
 * Some rows as CSV.
 *
 * @param {Column[]} columns
 * @param {Iterable<number>} rows
 */
export const csvText = (columns, rows) => {
  const lines = [columns.map(({ name }) => quoted(name)).join(",")];
  for (const row of rows) lines.push(columns.map((column) => csvCell(column, row)).join(","));
  return `${lines.join("\n")}\n`;
};
