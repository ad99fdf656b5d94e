// @ts-check

/**
 * A function that calls `work` once, `delay` milliseconds after its last call.
 *
 * @template {unknown[]} A
 * @param {(...given: A) => void} work
 * @param {number} delay
 * @returns {(...given: A) => void}
 */
export const debounced = (work, delay) => {
  let timer = 0;
  return (...given) => {
    clearTimeout(timer);
    timer = setTimeout(() => work(...given), delay);
  };
};
