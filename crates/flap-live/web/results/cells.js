// @ts-check
// Cells of a map around the values of two columns.

/**
 * The edges of cells around some levels: halfway between two levels, or at their geometric mean.
 *
 * @param {number[]} levels
 * @param {boolean} log
 */
export const edgesAround = (levels, log) => {
  const [of, back] = log ? [Math.log, Math.exp] : [Number, Number];
  const at = levels.map((level) => of(level));
  const last = at.length - 1;
  if (last === 0) {
    const around = log ? 0.05 : Math.abs(at[0]) * 0.05 || 1;
    return [back(at[0] - around), back(at[0] + around)];
  }
  const middles = at.slice(1).map((level, i) => (level + at[i]) / 2);
  const [first, end] = [at[0] - (at[1] - at[0]) / 2, at[last] + (at[last] - at[last - 1]) / 2];
  return [first, ...middles, end].map((edge) => back(edge));
};

/**
 * The cells of rows. If several rows have the same place, the cell belongs to the first.
 *
 * @param {number[]} rows
 * @param {(row: number) => number} xOf
 * @param {(row: number) => number} yOf
 * @returns {{ levelsX: number[], levelsY: number[], i: number[], j: number[], rows: number[], twice: number }}
 */
export const cellsOf = (rows, xOf, yOf) => {
  const levels = (/** @type {(row: number) => number} */ of) => [...new Set(rows.map(of))].sort((a, b) => a - b);
  const [levelsX, levelsY] = [levels(xOf), levels(yOf)];
  const placesX = new Map(levelsX.map((level, place) => [level, place]));
  const placesY = new Map(levelsY.map((level, place) => [level, place]));
  const taken = new Set();
  /** @type {{ i: number[], j: number[], rows: number[] }} */
  const cells = { i: [], j: [], rows: [] };
  for (const row of rows) {
    const i = placesX.get(xOf(row)) ?? 0;
    const j = placesY.get(yOf(row)) ?? 0;
    const key = j * levelsX.length + i;
    if (taken.has(key)) continue;
    taken.add(key);
    cells.i.push(i);
    cells.j.push(j);
    cells.rows.push(row);
  }
  return { levelsX, levelsY, ...cells, twice: rows.length - taken.size };
};
