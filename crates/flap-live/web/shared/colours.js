// @ts-check
// Colours of lines, shades of values, and colours as numbers.

/** Colours that colour-blind readers can distinguish (Okabe and Ito). */
export const FEW_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

const VIRIDIS = [
  [68, 1, 84],
  [72, 36, 117],
  [65, 68, 135],
  [53, 95, 141],
  [42, 120, 142],
  [33, 145, 140],
  [34, 168, 132],
  [68, 191, 112],
  [122, 209, 81],
  [189, 223, 38],
  [253, 231, 37],
];

/** The colour of the colour map viridis at a share from 0 to 1. */
export const viridis = (/** @type {number} */ share) => {
  const place = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(place), VIRIDIS.length - 2);
  const parts = VIRIDIS[low].map((part, i) => Math.round(part + (VIRIDIS[low + 1][i] - part) * (place - low)));
  return `rgb(${parts})`;
};

/** Eleven colours of viridis, evenly spaced. */
export const viridisRamp = () => Array.from({ length: 11 }, (_, i) => viridis(i / 10));

/** Shares of viridis whose contrast with a light or dark background is at least 3. */
const READABLE = { light: [0, 0.58], dark: [0.36, 1] };

/**
 * The colour of line `index` of `count`: a shade of viridis if there are more lines than colours.
 *
 * @param {number} index
 * @param {number} count
 * @param {boolean} isDark
 */
export const lineColour = (index, count, isDark) => {
  if (count <= FEW_COLOURS.length) return FEW_COLOURS[index];
  const [low, high] = isDark ? READABLE.dark : READABLE.light;
  return viridis(low + ((high - low) * index) / (count - 1));
};

/** A colour such as `#0072b2` or `rgb(1, 2, 3)` as one number 0xAABBGGRR, the order of bytes of an image. */
export const packedColour = (/** @type {string} */ text) => {
  const isHex = text.startsWith("#");
  const [red, green, blue] = isHex
    ? [1, 3, 5].map((at) => Number.parseInt(text.slice(at, at + 2), 16))
    : (text.match(/\d+/g) ?? []).map(Number);
  return (0xff000000 | (blue << 16) | (green << 8) | red) >>> 0;
};

/** The inverse of `packedColour`. */
export const unpackedColour = (/** @type {number} */ packed) =>
  `rgb(${packed & 255}, ${(packed >> 8) & 255}, ${(packed >> 16) & 255})`;
