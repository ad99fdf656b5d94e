// @ts-check
// Two fingers zoom and move a chart. One finger scrolls the page.

/** @import { Chart } from "../types.d.ts" */

/** Smallest distance of two fingers, in pixels. */
const LEAST_DISTANCE = 10;

/** The middle of two fingers as shares of a box, and their distance in pixels. */
const pinchOf = (/** @type {TouchList} */ [one, other], /** @type {DOMRect} */ box) => ({
  x: ((one.clientX + other.clientX) / 2 - box.left) / box.width,
  y: 1 - ((one.clientY + other.clientY) / 2 - box.top) / box.height,
  distance: Math.max(Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY), LEAST_DISTANCE),
});

/**
 * @param {Chart} chart
 * @param {HTMLElement} over the part of the chart that is touched
 */
export const listenToTouch = (chart, over) => {
  /** @type {ReturnType<typeof pinchOf> | null} */
  let last = null;
  const begin = (/** @type {TouchEvent} */ event) => {
    last = event.touches.length === 2 ? pinchOf(event.touches, over.getBoundingClientRect()) : null;
    if (last) event.preventDefault();
  };
  const move = (/** @type {TouchEvent} */ event) => {
    if (!last || event.touches.length !== 2) return;
    event.preventDefault();
    const now = pinchOf(event.touches, over.getBoundingClientRect());
    const factor = last.distance / now.distance;
    chart.zoomBy(factor, [last.x, last.y], [factor * (last.x - now.x), factor * (last.y - now.y)]);
    last = now;
  };
  const end = () => {
    last = null;
  };
  over.addEventListener("touchstart", begin, { passive: false });
  over.addEventListener("touchmove", move, { passive: false });
  over.addEventListener("touchend", end);
  over.addEventListener("touchcancel", end);
};
