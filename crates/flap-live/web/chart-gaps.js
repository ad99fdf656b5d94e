// Gaps of lines: values of x without a settled motion, as marks at the foot of the chart, a row of them for each status.

const GAP_FOOT = 6, GAP_LANE = 10;

/** The rows of marks: statuses from the foot upwards. */
const gapLanes = ({ gaps = [] }) => [...new Set(gaps.map(({ text }) => text))];

/** Marks to paint: { gap, at, lane }, `at` in pixels from the left; one where several would hide each other. */
const placedGaps = ({ plot, scene }) => {
  const lanes = gapLanes(scene), placed = new Map(), width = plot.over.clientWidth;
  for (const gap of scene.gaps ?? []) {
    const at = plot.valToPos(gap.x, "x"), lane = lanes.indexOf(gap.text), key = `${lane} ${Math.round(at)}`;
    if (at >= -1 && at <= width + 1 && !placed.has(key)) placed.set(key, { gap, at, lane });
  }
  return [...placed.values()];
};

/** The mark of the gaps under the pointer, if it is at the foot. */
const gapAt = ({ plot, scene }, left, top) => {
  const lane = Math.floor((plot.over.clientHeight - top) / GAP_LANE), text = gapLanes(scene)[lane];
  if (text === undefined) return null;
  let best = null, least = 7;
  for (const gap of scene.gaps) {
    const distance = Math.abs(plot.valToPos(gap.x, "x") - left);
    if (gap.text === text && distance < least) { least = distance; best = gap; }
  }
  if (best === null) return null;
  return { key: "gap", name: best.name, index: text, row: best.row, x: best.x, y: null, gaps: scene.gaps.filter(({ x }) => x === best.x) };
};

/** The places of values between two gaps: no line leads to them, so they are points. `undefined` is no gap but a place of other lines. */
const alone = (values) => {
  const places = [];
  let before = null, last = -1; // the value before the last one, and the place of the last one
  for (let i = 0; i <= values.length; i++) {
    const value = i === values.length ? null : values[i];
    if (value === undefined) continue;
    if (last >= 0 && values[last] !== null && before === null && value === null) places.push(last);
    before = last < 0 ? null : values[last];
    last = i;
  }
  return places.length > 0 ? places : null;
};
