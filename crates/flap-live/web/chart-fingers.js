// Two fingers zoom and move a chart. One finger scrolls the page.

const listenToFingers = (chart, over) => {
  let last = null;
  /** The middle of two fingers and their distance, as shares of the chart. */
  const placeOf = ([one, other]) => {
    const box = over.getBoundingClientRect();
    return { x: ((one.clientX + other.clientX) / 2 - box.left) / box.width, y: 1 - ((one.clientY + other.clientY) / 2 - box.top) / box.height,
      apart: Math.max(Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY), 10) };
  };
  over.addEventListener("touchstart", (event) => {
    last = event.touches.length === 2 ? placeOf(event.touches) : null;
    if (last) event.preventDefault();
  }, { passive: false });
  over.addEventListener("touchmove", (event) => {
    if (!last || event.touches.length !== 2) return;
    event.preventDefault();
    const now = placeOf(event.touches);
    const factor = last.apart / now.apart;
    chart.change(factor, [last.x, last.y], [factor * (last.x - now.x), factor * (last.y - now.y)]);
    last = now;
  }, { passive: false });
  for (const end of ["touchend", "touchcancel"]) over.addEventListener(end, () => { last = null; });
};
