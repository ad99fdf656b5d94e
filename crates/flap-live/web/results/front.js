// @ts-check

/**
 * The rows that no other row dominates, from the best to the worst x.
 *
 * @param {Iterable<number>} rows
 * @param {(row: number) => number} xOf
 * @param {(row: number) => number} yOf
 * @param {number[]} better 1 for x and y if larger is better, -1 if smaller is better
 */
export const paretoFront = (rows, xOf, yOf, [betterX, betterY]) => {
  const order = [...rows].sort((a, b) => betterX * (xOf(b) - xOf(a)) || betterY * (yOf(b) - yOf(a)));
  /** @type {number[]} */
  const front = [];
  for (const row of order) {
    const last = front.at(-1);
    const isEqual = last !== undefined && yOf(row) === yOf(last) && xOf(row) === xOf(last);
    if (last === undefined || betterY * yOf(row) > betterY * yOf(last) || isEqual) front.push(row);
  }
  return front;
};
