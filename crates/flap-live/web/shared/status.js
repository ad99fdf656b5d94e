// @ts-check
// Marks of rows without a settled motion.

/** Each status has a shape, around the middle of a box of 10 by 10, and a grey. */
export const STATUS_MARKS = {
  subharmonic: { shape: "M-3 -3H3V3H-3Z", light: "#4a4f55", dark: "#d5d9de" },
  unsettled: { shape: "M-4 3.5H4L0 -3.5Z", light: "#7d848c", dark: "#a3aab2" },
  diverged: {
    shape: "M-4 -3L-3 -4L0 -1L3 -4L4 -3L1 0L4 3L3 4L0 1L-3 4L-4 3L-1 0Z",
    light: "#5d6670",
    dark: "#bcc3ca",
  },
  step_limit: { shape: "M0 -4.5L4.5 0L0 4.5L-4.5 0Z", light: "#9aa1a8", dark: "#868e97" },
  invalid: { shape: "M-4 -1.2H4V1.2H-4Z", light: "#b9bec4", dark: "#6a727b" },
  unstable: {
    shape: "M3.5 0A3.5 3.5 0 1 1 -3.5 0A3.5 3.5 0 1 1 3.5 0Z",
    light: "#8b9299",
    dark: "#959da5",
  },
};

/**
 * The shape and the colour of a status.
 *
 * @param {string} status
 * @param {boolean} isDark
 */
export const statusMark = (status, isDark) => {
  /** @type {Record<string, { shape: string, light: string, dark: string }>} */
  const marks = STATUS_MARKS;
  const { shape, light, dark } = marks[status] ?? marks.unsettled;
  return { shape, color: isDark ? dark : light };
};

/**
 * Entries of the legend for the number of rows of each status.
 *
 * @param {Map<string, number>} counts
 * @param {boolean} isDark
 */
export const statusEntries = (counts, isDark) =>
  [...counts].map(([status, count]) => ({
    name: `${count} ${status.replace("_", " ")}`,
    ...statusMark(status, isDark),
  }));
