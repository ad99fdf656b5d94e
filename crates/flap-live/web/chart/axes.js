// @ts-check
// Ticks of a chart's axes and their labels.

/**
 * Even ticks from `low` to `high`: multiples of 1, 2 or 5 times a power of ten, about `most` at most and two at least.
 *
 * @param {number} low
 * @param {number} high
 * @param {number} most
 */
export const evenTicks = (low, high, most) => {
  const span = high - low;
  if (!(span > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(span / most));
  const steps = [1, 2, 5, 10].map((times) => times * power);
  let step = steps.find((size) => span / size <= most + 1e-9) ?? 10 * power;
  for (;;) {
    const first = Math.ceil(low / step - 1e-9);
    const last = Math.floor(high / step + 1e-9);
    if (last > first) {
      return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
    }
    step /= 2;
  }
};

/**
 * Ticks of a logarithmic axis: 1, 2 and 5 in each decade. They are more where there is room, fewer over many decades,
 * and even within a decade.
 *
 * @param {number} low
 * @param {number} high
 * @param {number} most
 */
export const logTicks = (low, high, most) => {
  if (high / low < 10) return evenTicks(low, high, most);
  const first = Math.floor(Math.log10(low));
  const last = Math.ceil(Math.log10(high));
  const ticks = (/** @type {number[]} */ times, /** @type {number} */ stride) => {
    const powers = Array.from({ length: last - first + 1 }, (_, i) => first + i);
    return powers
      .filter((power) => power % stride === 0)
      .flatMap((power) => times.map((part) => Number(`${part}e${power}`)))
      .filter((value) => value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9));
  };
  const dense = [ticks([1, 2, 3, 5, 7], 1), ticks([1, 2, 5], 1), ticks([1, 3], 1), ticks([1], 1)];
  const found = dense.find((list) => list.length <= most + 1);
  if (found && found.length > 1) return found;
  return ticks([1], Math.max(Math.ceil((last - first) / most), 1));
};

/** @type {Record<string, string>} */
const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

/**
 * The label of a tick, with a power of ten if it is to have one.
 *
 * @param {number} value
 * @param {number} precision
 * @param {boolean} hasPower
 */
const tickLabel = (value, precision, hasPower) => {
  if (value === 0 || !hasPower) return String(Number(value.toPrecision(precision))).replace("-", "−");
  const [part, power] = value.toExponential(precision - 1).split("e");
  const ten = `10${[...String(Number(power))].map((letter) => RAISED[letter]).join("")}`;
  const times = String(Number(part)).replace("-", "−");
  return times === "1" ? ten : `${times}·${ten}`;
};

/** Most letters of a label without a power of ten. */
const MOST_LETTERS = 7;

/**
 * Labels of ticks: four digits, or more if four digits change a value by more than a thousandth of the distance of two
 * ticks. Long numbers have powers of ten.
 */
export const tickLabels = (/** @type {number[]} */ values) => {
  const isLong = values.some((value) => tickLabel(Math.abs(value), 4, false).length > MOST_LETTERS);
  const distance = Math.min(...values.slice(1).map((value, i) => Math.abs(value - values[i])));
  const isExact = (/** @type {number} */ value, /** @type {number} */ precision) =>
    Math.abs(Number(value.toPrecision(precision)) - value) <= 1e-3 * distance;
  let precision = 4;
  while (precision < 12 && !values.every((value) => isExact(value, precision))) precision++;
  return values.map((value) => tickLabel(value, precision, isLong));
};
