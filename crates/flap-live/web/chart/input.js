// @ts-check
// The mouse and the keyboard on a chart.

import { nextMark } from "./marks.js";

/** @import { Chart } from "../types.d.ts" */

/** Zoom per step of the wheel, zoom per key press, and the share of the chart by which a key moves it. */
const WHEEL_ZOOM = 1.2;
const KEY_ZOOM = 1.25;
const KEY_MOVE = 0.1;

/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowRight: [1, 0], ArrowLeft: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/** Zooms around the pointer for the wheel with Ctrl, Shift or Meta. The wheel alone scrolls the page. */
const onWheel = (/** @type {Chart} */ chart, /** @type {WheelEvent} */ event, /** @type {[number, number]} */ at) => {
  if (!event.ctrlKey && !event.shiftKey && !event.metaKey) return;
  event.preventDefault();
  chart.zoomBy(event.deltaY + event.deltaX > 0 ? WHEEL_ZOOM : 1 / WHEEL_ZOOM, at, [0, 0]);
};

/** Keys: arrows move from mark to mark, Enter pins, + and - zoom, Shift and arrows move, Escape shows everything. */
const onKey = (/** @type {Chart} */ chart, /** @type {KeyboardEvent} */ event) => {
  const [right, up] = ARROWS[event.key] ?? [0, 0];
  if ((right || up) && event.shiftKey) chart.zoomBy(1, [0.5, 0.5], [KEY_MOVE * right, KEY_MOVE * up]);
  else if (right || up) {
    const mark = nextMark(chart, right, up);
    if (mark) chart.moveTo(mark);
  } else if (event.key === "+") chart.zoomBy(1 / KEY_ZOOM, [0.5, 0.5], [0, 0]);
  else if (event.key === "-") chart.zoomBy(KEY_ZOOM, [0.5, 0.5], [0, 0]);
  else if (event.key === "Enter") chart.options.onPin?.(chart.mark);
  else if (event.key === "Escape") chart.setView(null, true);
  else return;
  event.preventDefault();
};

/** Listens to the mouse and the keyboard. The plot itself draws the rectangle of a drag. */
export const listenToInput = (/** @type {Chart} */ chart) => {
  const { over } = chart.plot;
  over.tabIndex = 0;
  over.setAttribute("role", "img");
  over.setAttribute("aria-label", chart.options.name ?? "Chart");
  /** @returns {[number, number]} the place of the pointer as shares of the chart, from the bottom left */
  const placeOf = (/** @type {MouseEvent} */ event) => {
    const box = over.getBoundingClientRect();
    return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
  };
  const beginMove = (/** @type {MouseEvent} */ event) => {
    if (!event.shiftKey) return;
    event.stopImmediatePropagation();
    let last = placeOf(event);
    const move = (/** @type {MouseEvent} */ next) => {
      const now = placeOf(next);
      chart.zoomBy(1, [0.5, 0.5], [last[0] - now[0], last[1] - now[1]]);
      last = now;
    };
    const end = () => {
      removeEventListener("mousemove", move);
      removeEventListener("mouseup", end);
    };
    addEventListener("mousemove", move);
    addEventListener("mouseup", end);
  };
  over.addEventListener("wheel", (event) => onWheel(chart, event, placeOf(event)), { passive: false });
  over.addEventListener("mousedown", beginMove, true);
  over.addEventListener("mousedown", () => {
    chart.wasDragged = false;
  });
  over.addEventListener("click", () => {
    if (!chart.wasDragged) chart.options.onPin?.(chart.mark);
  });
  over.addEventListener("keydown", (event) => onKey(chart, event));
};
