// Ticks of a chart's axes and their labels.

/** Even ticks from `low` to `high`, at most about `most` and at least two: multiples of 1, 2 or 5 times a power of ten. */
const evenTicks = (low, high, most) => {
  const span = high - low;
  if (!(span > 0)) return [low];
  const power = 10 ** Math.floor(Math.log10(span / most));
  let step = [1, 2, 5, 10].map((times) => times * power).find((size) => span / size <= most + 1e-9) ?? 10 * power;
  for (;;) {
    const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
    if (last > first) return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(12)));
    step /= 2;
  }
};

/** Ticks of a logarithmic axis: 1, 2 and 5 in each decade, more where there is room, fewer over many decades, and even ones within a decade. */
const logTicks = (low, high, most) => {
  if (high / low < 10) return evenTicks(low, high, most);
  const first = Math.floor(Math.log10(low)), last = Math.ceil(Math.log10(high));
  const ticks = (times, stride) => {
    const powers = Array.from({ length: last - first + 1 }, (_, i) => first + i).filter((power) => power % stride === 0);
    return powers.flatMap((power) => times.map((part) => Number(`${part}e${power}`))).filter((value) => value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9));
  };
  const fine = [ticks([1, 2, 3, 5, 7], 1), ticks([1, 2, 5], 1), ticks([1, 3], 1), ticks([1], 1)].find((list) => list.length <= most + 1);
  if (fine && fine.length > 1) return fine;
  return ticks([1], Math.max(Math.ceil((last - first) / most), 1));
};

const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

/** A number of an axis, with a power of ten if it is to have one. */
const tickLabel = (value, precision, hasPower) => {
  if (value === 0 || !hasPower) return String(Number(value.toPrecision(precision))).replace("-", "−");
  const [part, power] = value.toExponential(precision - 1).split("e");
  const ten = `10${[...String(Number(power))].map((letter) => RAISED[letter]).join("")}`;
  const times = String(Number(part)).replace("-", "−");
  return times === "1" ? ten : `${times}·${ten}`;
};

/** Most letters of a number without a power of ten. */
const MOST_LETTERS = 7;

/** Labels of ticks: with four digits, or with as many more as tell neighbours apart; those of long numbers with powers of ten. */
const tickLabels = (values) => {
  const isLong = values.some((value) => tickLabel(Math.abs(value), 4, false).length > MOST_LETTERS);
  for (let precision = 4; ; precision++) {
    const labels = values.map((value) => tickLabel(value, precision, isLong));
    if (precision === 12 || new Set(labels).size === values.length) return labels;
  }
};
