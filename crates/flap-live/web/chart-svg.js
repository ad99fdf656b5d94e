// The picture of a chart as SVG, from the scales and ticks of its plot.

/** Most points that are circles in a file. */
const MOST_CIRCLES = 20000;

/** Values of lines that are marked: all of lines with marks, and those between two gaps: { line, place }. */
const svgMarks = ({ scene, hidden }) => scene.lines.filter((line) => !line.ghost && !hidden.has(groupOf(line))).flatMap((line) => {
  const isDrawn = (place) => line.y[place] !== null && !(scene.y.log && line.y[place] <= 0) && !(scene.x.log && line.x[place] <= 0);
  const places = line.marks ? line.x.map((_, place) => place) : alone(line.y) ?? [];
  return places.filter(isDrawn).map((place) => ({ line, place }));
});

const svgOfChart = (chart) => {
  const { plot, scene } = chart, ratio = uPlot.pxRatio;
  const box = { left: plot.bbox.left / ratio, top: plot.bbox.top / ratio, width: plot.bbox.width / ratio, height: plot.bbox.height / ratio };
  const [right, bottom] = [box.left + box.width, box.top + box.height];
  const toX = (value) => box.left + plot.valToPos(value, "x"), toY = (value) => box.top + plot.valToPos(value, "y");
  const at2 = (value) => value.toFixed(2);
  const [ink, soft, faint, back] = ["--ink", "--soft", "--line", "--back"].map(styleColour);
  const placed = placedEntries(chart, box.left), height = plot.height + legendHeight(placed);
  const page = drawn("svg", { xmlns: "http://www.w3.org/2000/svg", viewBox: `0 0 ${plot.width} ${height}`, width: plot.width, height,
    "font-family": "system-ui, sans-serif", "font-size": 12 });
  const text = (x, y, words, more = {}) => page.append(drawn("text", { x: at2(x), y: at2(y), fill: soft, "text-anchor": "middle", ...more }, words));
  page.append(drawn("rect", { width: plot.width, height, fill: back }));
  page.append(drawn("clipPath", { id: "inside" }, drawn("rect", { x: box.left, y: box.top, width: box.width, height: box.height })));
  for (const [scale, axis] of [["x", plot.axes[0]], ["y", plot.axes[1]]]) {
    (axis._splits ?? []).forEach((value, i) => {
      const words = axis._values?.[i];
      if (value === null || value < plot.scales[scale].min || value > plot.scales[scale].max) return;
      const [x1, y1, x2, y2] = scale === "x" ? [toX(value), box.top, toX(value), bottom] : [box.left, toY(value), right, toY(value)];
      page.append(drawn("line", { x1: at2(x1), y1: at2(y1), x2: at2(x2), y2: at2(y2), stroke: faint }));
      if (scale === "x") text(x1, bottom + 18, words ?? "");
      else text(box.left - 8, y1 + 4, words ?? "", { "text-anchor": "end" });
    });
  }
  text(box.left + box.width / 2, plot.height - 6, titled(scene.x));
  text(0, 0, titled(scene.y), { transform: `translate(14 ${at2(box.top + box.height / 2)}) rotate(-90)` });
  for (const { from, to } of scene.bands ?? []) {
    page.append(drawn("rect", { x: at2(toX(from)), y: box.top, width: at2(Math.max(toX(to) - toX(from), 2)), height: box.height, fill: "#8888", "clip-path": "url(#inside)" }));
  }
  const { points, cells } = scene;
  if (cells) {
    cells.rows.forEach((_, at) => {
      const [x1, x2, y1, y2] = [toX(cells.edgesX[cells.i[at]]), toX(cells.edgesX[cells.i[at] + 1]), toY(cells.edgesY[cells.j[at] + 1]), toY(cells.edgesY[cells.j[at]])];
      page.append(drawn("rect", { x: at2(x1), y: at2(y1), width: at2(x2 - x1 + 0.3), height: at2(y2 - y1 + 0.3), fill: unpackedColour(cells.colors[at]), "clip-path": "url(#inside)" }));
    });
  }
  if (points && points.x.length > MOST_CIRCLES) {
    // So many circles make a file that nothing opens: they go in as an image.
    const { canvas } = plot.ctx, sheet = document.createElement("canvas");
    Object.assign(sheet, { width: plot.bbox.width, height: plot.bbox.height });
    sheet.getContext("2d").drawImage(canvas, -plot.bbox.left, -plot.bbox.top);
    page.append(drawn("image", { x: box.left, y: box.top, width: box.width, height: box.height, href: sheet.toDataURL("image/png") }));
  } else if (points) {
    points.rows.forEach((_, at) => page.append(drawn("circle", { cx: at2(toX(points.x[at])), cy: at2(toY(points.y[at])), r: points.size / 2, fill: unpackedColour(points.colors[at]), "clip-path": "url(#inside)" })));
  }
  for (const line of scene.lines) {
    const { x, y, color, width, dash, ghost } = line;
    if (!line.ghost && chart.hidden.has(groupOf(line))) continue;
    let path = "", isDown = false;
    x.forEach((value, i) => {
      const usable = y[i] !== null && y[i] !== undefined && !(scene.y.log && y[i] <= 0) && !(scene.x.log && value <= 0);
      if (usable) path += `${isDown ? "L" : "M"}${at2(toX(value))} ${at2(toY(y[i]))}`;
      isDown = usable;
    });
    page.append(drawn("path", { d: path, fill: "none", stroke: color, "stroke-width": width ?? 2, "stroke-dasharray": (dash ?? []).join(" "),
      opacity: ghost ? 0.35 : 1, "stroke-linejoin": "round", "clip-path": "url(#inside)" }));
  }
  for (const { line, place } of svgMarks(chart)) {
    page.append(drawn("circle", { cx: at2(toX(line.x[place])), cy: at2(toY(line.y[place])), r: 2, fill: back, stroke: line.color, "clip-path": "url(#inside)" }));
  }
  const shapeAt = (shape, fill, x, y) => page.append(drawn("path", { d: shape, fill, transform: `translate(${at2(x)} ${at2(y)})` }));
  for (const { gap, at, lane } of placedGaps(chart)) shapeAt(gap.shape, gap.color, box.left + at, bottom - GAP_FOOT - lane * GAP_LANE);
  if (scene.marker && Number.isFinite(scene.marker.y)) {
    page.append(drawn("circle", { cx: at2(toX(scene.marker.x)), cy: at2(toY(scene.marker.y)), r: 6, fill: "none", stroke: ink, "stroke-width": 2 }));
  }
  for (const { entry: { name, colors, color, shape }, left, row, words } of placed) {
    const middle = plot.height + row * ENTRY_HEIGHT + 8, width = colors?.length === 1 ? SWATCH : SHADE;
    if (shape) shapeAt(shape, color, left + 5, middle);
    else colors.forEach((fill, i) => page.append(drawn("rect", { x: at2(left + i * width), y: middle - 2, width, height: 4, fill })));
    text(words, middle + 4, name, { "text-anchor": "start", fill: ink });
  }
  return new XMLSerializer().serializeToString(page);
};
