// @ts-check
// Numbers and labels as text.

/**
 * @param {unknown} value
 * @returns {value is number}
 */
export const isFiniteNumber = (value) => typeof value === "number" && Number.isFinite(value);

/** A number with at most six digits; "none" for NaN and everything that is not a number. */
export const shortNumber = (/** @type {unknown} */ value) => {
  if (typeof value !== "number" || Number.isNaN(value)) return "none";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) return value.toExponential(3).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(6)));
};

/**
 * A number rounded to this many digits.
 *
 * @param {number} value
 * @param {number} digits
 */
export const roundedNumber = (value, digits) => shortNumber(Number(value.toPrecision(digits)));

/** A label with its unit. */
export const labelWithUnit = (/** @type {{ label: string, unit: string }} */ { label, unit }) =>
  unit ? `${label} (${unit})` : label;

/**
 * The difference from the published value in per cent; empty if it is undefined.
 *
 * @param {unknown} value
 * @param {unknown} published
 */
export const differenceText = (value, published) => {
  if (!isFiniteNumber(value) || !isFiniteNumber(published) || published === 0) return "";
  const share = (100 * (value - published)) / Math.abs(published);
  if (Math.abs(share) < 0.005 || Math.abs(share) >= 1e4) return "";
  return `${share > 0 ? "+" : "−"}${roundedNumber(Math.abs(share), 3)} %`;
};
