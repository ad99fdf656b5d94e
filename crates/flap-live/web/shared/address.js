// @ts-check
// The state of a page in its address, after the `#`: JSON, so that people can read and share it.

/** The state in the address; null if there is none. */
export const readAddress = () => {
  try {
    return JSON.parse(decodeURIComponent(location.hash.slice(1)));
  } catch {
    return null;
  }
};

/**
 * Writes the state into the address, as a step that the back button undoes, or in place of the last step.
 *
 * @param {unknown} state
 * @param {boolean} isStep
 */
export const writeAddress = (state, isStep) => {
  const hash = `#${encodeURIComponent(JSON.stringify(state))}`;
  if (hash === location.hash) return;
  history[isStep ? "pushState" : "replaceState"](null, "", hash);
};
