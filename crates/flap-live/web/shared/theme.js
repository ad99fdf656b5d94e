// @ts-check
// The light or dark scheme of the page.

/** The scheme of the system. */
export const darkScheme = window.matchMedia("(prefers-color-scheme: dark)");

/** True if the page is dark. Pictures to save are drawn with the class `paper`, which is light. */
export const isDark = () => darkScheme.matches && !document.documentElement.classList.contains("paper");

/** The value of a variable of the style, such as `--ink`, in the present scheme. */
export const styleColour = (/** @type {string} */ name) =>
  getComputedStyle(document.documentElement).getPropertyValue(name).trim();
