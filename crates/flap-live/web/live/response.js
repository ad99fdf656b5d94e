// @ts-check
// Lines, gaps and bistable bands of a response, computed from the rows of the server.

import { isFiniteNumber } from "../shared/format.js";

/** @import { ResponseAnswer, ResponseGap, ResponseLine, ResponseRow, RowTable } from "../types.d.ts" */

/** Lines with fewer values have marks. */
const FEW_VALUES = 12;

/**
 * The lines and gaps of rows: one line for each value of the column `by`, or one line if `by` is null. A line also ends
 * where rows are missing, because a condition excludes their points.
 *
 * @param {RowTable & Pick<ResponseAnswer, "states">} answer
 * @param {object} axes
 * @param {string} axes.x the column along x
 * @param {number} axes.step distance of neighbouring points along the column `x`
 * @param {number} axes.factor factor from values of the column to values along x
 * @param {string} axes.y the column of the measure
 * @param {string | null} axes.by
 * @param {(value: any) => string} axes.nameOf the name of a line
 * @returns {{ lines: ResponseLine[], gaps: ResponseGap[] }}
 */
export const responseLines = ({ columns, rows, states }, { x, step, factor, y, by, nameOf }) => {
  const [xPlace, yPlace, status, stable, bistable] = [x, y, "status", "stable", "bistable"].map((name) =>
    columns.indexOf(name),
  );
  const key = by === null ? -1 : columns.indexOf(by);
  /** @type {Map<any, ResponseLine>} */
  const lines = new Map();
  /** @type {ResponseGap[]} */
  const gaps = [];
  for (const [i, cells] of rows.entries()) {
    const value = key < 0 ? "" : cells[key];
    let line = lines.get(value);
    if (!line) {
      const name = key < 0 ? "" : nameOf(value);
      const identity = { key: String(value), group: String(value), name };
      line = { ...identity, x: [], y: [], rows: [], place: lines.size, of: 0 };
      lines.set(value, line);
    }
    /** @type {ResponseRow} */
    const row = {
      status: cells[status],
      stable: cells[stable],
      bistable: cells[bistable] === true,
      x: cells[xPlace],
      by: key < 0 ? null : value,
      begin: states?.[i] ?? null,
    };
    const at = row.x * factor;
    const last = line.rows.at(-1);
    if (last && Math.abs(row.x - last.x) > 1.5 * step) {
      line.x.push((line.x[line.x.length - 1] + at) / 2);
      line.y.push(null);
      line.rows.push({ ...row, status: "excluded", bistable: false, x: (last.x + row.x) / 2 });
    }
    line.x.push(at);
    line.y.push(isFiniteNumber(cells[yPlace]) ? cells[yPlace] : null);
    line.rows.push(row);
    if (row.status !== "periodic") gaps.push({ group: line.key, x: at, status: row.status, name: line.name, row });
  }
  const list = [...lines.values()];
  for (const line of list) {
    Object.assign(line, { of: list.length, marks: line.x.length < FEW_VALUES });
    if (line.x.length > 1 && line.x[0] > line.x[1]) {
      for (const values of [line.x, line.y, line.rows]) values.reverse();
    }
    // Lines with the same x share one list, so that the chart does not join them.
    const shared = list[0].x;
    if (line.x.length === shared.length && line.x.every((value, i) => value === shared[i])) line.x = shared;
  }
  return { lines: list, gaps };
};

/**
 * The ranges of x where the line "up" is bistable, from the column `bistable` of its rows.
 *
 * @param {ResponseLine[]} lines
 */
export const bistableBands = (lines) => {
  const up = lines.find((line) => line.key === "up");
  /** @type {{ from: number, to: number }[]} */
  const bands = [];
  up?.rows.forEach((row, i) => {
    if (!row.bistable) return;
    if (up.rows[i - 1]?.bistable) bands[bands.length - 1].to = up.x[i];
    else bands.push({ from: up.x[i], to: up.x[i] });
  });
  return bands;
};

/** The number of gaps of each status. */
export const statusCounts = (/** @type {ResponseGap[]} */ gaps) => {
  /** @type {Map<string, number>} */
  const counts = new Map();
  for (const { status } of gaps) counts.set(status, (counts.get(status) ?? 0) + 1);
  return counts;
};
