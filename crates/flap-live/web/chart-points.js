// Points and cells of a chart, painted on the canvas of its plot.
//
//   points: { x, y, rows, colors, size }      colors: one number 0xAABBGGRR for each point
//   cells:  { edgesX, edgesY, i, j, rows, colors }   i, j: place of each cell among the edges

/** A colour of the style, such as `#0072b2` or `rgb(1, 2, 3)`, as one number. */
const packedColour = (text) => {
  const parts = text.startsWith("#") ? [1, 3, 5].map((at) => parseInt(text.slice(at, at + 2), 16)) : text.match(/\d+/g).map(Number);
  return (0xff000000 | (parts[2] << 16) | (parts[1] << 8) | parts[0]) >>> 0;
};
const unpackedColour = (packed) => `rgb(${packed & 255}, ${(packed >> 8) & 255}, ${(packed >> 16) & 255})`;

/** The function from values to pixels of the canvas, fast enough for many points. */
const toPixels = (plot, scale) => {
  const { min, max, distr } = plot.scales[scale], { left, top, width, height } = plot.bbox;
  const of = distr === 3 ? Math.log : (value) => value, low = of(min), span = of(max) - low;
  return scale === "x" ? (value) => left + (of(value) - low) / span * width : (value) => top + height - (of(value) - low) / span * height;
};

/** Paints points: as small squares into an image if there are many. */
const paintPoints = (chart) => {
  const { plot, scene } = chart, { ctx, bbox } = plot, { x, y, colors, size } = scene.points;
  const toX = toPixels(plot, "x"), toY = toPixels(plot, "y"), count = x.length;
  const [px, py] = [new Float32Array(count), new Float32Array(count)];
  for (let i = 0; i < count; i++) { px[i] = toX(x[i]); py[i] = toY(y[i]); }
  chart.placed = { px, py, grid: null };
  const side = Math.max(Math.round(size * uPlot.pxRatio), 1), half = side >> 1;
  if (count < 4000) {
    for (let i = 0; i < count; i++) {
      ctx.fillStyle = unpackedColour(colors[i]);
      ctx.beginPath(); ctx.arc(px[i], py[i], side / 2, 0, 7); ctx.fill();
    }
    return;
  }
  const [left, top, width, height] = [bbox.left, bbox.top, bbox.width, bbox.height].map(Math.round);
  const image = new ImageData(width, height), pixels = new Uint32Array(image.data.buffer);
  for (let i = 0; i < count; i++) {
    const [x1, y1] = [Math.round(px[i]) - left - half, Math.round(py[i]) - top - half];
    for (let row = Math.max(y1, 0); row < Math.min(y1 + side, height); row++) {
      for (let column = Math.max(x1, 0); column < Math.min(x1 + side, width); column++) pixels[row * width + column] = colors[i];
    }
  }
  const sheet = document.createElement("canvas");
  Object.assign(sheet, { width, height });
  sheet.getContext("2d").putImageData(image, 0, 0);
  ctx.drawImage(sheet, left, top);
};

/** Paints cells as rectangles. */
const paintCells = (chart) => {
  const { plot, scene } = chart, { ctx } = plot, { edgesX, edgesY, i, j, colors } = scene.cells;
  const [xs, ys] = [edgesX.map(toPixels(plot, "x")), edgesY.map(toPixels(plot, "y"))];
  for (let cell = 0; cell < i.length; cell++) {
    ctx.fillStyle = unpackedColour(colors[cell]);
    const [x1, x2, y1, y2] = [xs[i[cell]], xs[i[cell] + 1], ys[j[cell] + 1], ys[j[cell]]];
    // Half a pixel more, so that no light shines through between neighbours.
    ctx.fillRect(x1, y1, x2 - x1 + 0.5, y2 - y1 + 0.5);
  }
};

/** Rings around points, and frames around cells, of the rows in a set. */
const paintSelected = (chart, selected) => {
  const { plot, scene } = chart, { ctx } = plot;
  ctx.strokeStyle = styleColour("--ink");
  ctx.lineWidth = 1.5 * uPlot.pxRatio;
  if (scene.points && selected.size > 2000) {
    // So many rings would hide each other: everything else is faded.
    ctx.fillStyle = styleColour("--ink");
    scene.points.rows.forEach((row, at) => { if (selected.has(row)) ctx.fillRect(chart.placed.px[at] - 1, chart.placed.py[at] - 1, 3, 3); });
  } else if (scene.points) {
    scene.points.rows.forEach((row, at) => {
      if (!selected.has(row)) return;
      ctx.beginPath(); ctx.arc(chart.placed.px[at], chart.placed.py[at], 5 * uPlot.pxRatio, 0, 7); ctx.stroke();
    });
  }
  if (scene.cells) {
    const { edgesX, edgesY, i, j, rows } = scene.cells, toX = toPixels(plot, "x"), toY = toPixels(plot, "y");
    rows.forEach((row, at) => {
      if (!selected.has(row)) return;
      const [x1, x2, y1, y2] = [toX(edgesX[i[at]]), toX(edgesX[i[at] + 1]), toY(edgesY[j[at] + 1]), toY(edgesY[j[at]])];
      ctx.strokeRect(x1, y1, x2 - x1, y2 - y1);
    });
  }
  const toX = toPixels(plot, "x"), toY = toPixels(plot, "y");
  for (const line of scene.lines) {
    line.rows?.forEach((row, at) => {
      if (!selected.has(row) || line.y[at] === null) return;
      ctx.beginPath(); ctx.arc(toX(line.x[at]), toY(line.y[at]), 5 * uPlot.pxRatio, 0, 7); ctx.stroke();
    });
  }
};

/** Squares of the canvas with the points in them, so that the nearest is found among few. */
const SQUARE = 24;
const gridOf = ({ px, py }) => {
  const grid = new Map();
  for (let i = 0; i < px.length; i++) {
    const key = Math.floor(px[i] / SQUARE) * 65536 + Math.floor(py[i] / SQUARE);
    const list = grid.get(key);
    if (list) list.push(i); else grid.set(key, [i]);
  }
  return grid;
};

/** The mark of the point nearest to a place of the plot, in pixels of the page; null if none is near. */
const nearestPoint = (chart, left, top) => {
  const { plot, scene, placed } = chart, ratio = uPlot.pxRatio;
  const [atX, atY] = [left * ratio + plot.bbox.left, top * ratio + plot.bbox.top];
  placed.grid ??= gridOf(placed);
  let best = -1, least = (18 * ratio) ** 2;
  const [column, row] = [Math.floor(atX / SQUARE), Math.floor(atY / SQUARE)];
  for (let i = column - 1; i <= column + 1; i++) {
    for (let j = row - 1; j <= row + 1; j++) {
      for (const point of placed.grid.get(i * 65536 + j) ?? []) {
        const distance = (placed.px[point] - atX) ** 2 + (placed.py[point] - atY) ** 2;
        if (distance < least) { least = distance; best = point; }
      }
    }
  }
  return best < 0 ? null : pointMark(scene.points, best);
};
const pointMark = ({ x, y, rows }, at) => ({ key: "point", name: "", index: at, row: rows[at], x: x[at], y: y[at] });

/** The mark of the cell at a place of the plot. */
const cellAt = (chart, left, top) => {
  const { plot, scene } = chart, { edgesX, edgesY } = scene.cells;
  const place = (edges, value) => edges.findIndex((edge, at) => at + 1 < edges.length && value >= Math.min(edge, edges[at + 1]) && value < Math.max(edge, edges[at + 1]));
  const [column, row] = [place(edgesX, plot.posToVal(left, "x")), place(edgesY, plot.posToVal(top, "y"))];
  const at = cellsByPlace(scene.cells).get(column * 65536 + row);
  return at === undefined ? null : cellMark(scene.cells, at);
};
const cellsByPlace = (cells) => (cells.byPlace ??= new Map(cells.rows.map((_, at) => [cells.i[at] * 65536 + cells.j[at], at])));
const cellMark = ({ edgesX, edgesY, i, j, rows }, at) => {
  const middle = (edges, place) => (edges[place] + edges[place + 1]) / 2;
  return { key: "cell", name: "", index: at, row: rows[at], x: middle(edgesX, i[at]), y: middle(edgesY, j[at]) };
};

/** The mark of the next cell to the right or upwards that has a row; the same one at the edge. */
const cellStep = (cells, mark, right, up) => {
  if (mark?.key !== "cell") return cellMark(cells, 0);
  const across = cells.edgesX.length - 1, along = cells.edgesY.length - 1;
  let [column, row] = [cells.i[mark.index] + right, cells.j[mark.index] + up];
  for (; column >= 0 && column < across && row >= 0 && row < along; column += right, row += up) {
    const at = cellsByPlace(cells).get(column * 65536 + row);
    if (at !== undefined) return cellMark(cells, at);
  }
  return cellMark(cells, mark.index);
};

/** The rows of all marks within a part of the plane. */
const rowsWithin = (scene, [lowX, highX], [lowY, highY]) => {
  const found = [], inside = (x, y) => x >= lowX && x <= highX && y >= lowY && y <= highY;
  if (scene.points) scene.points.rows.forEach((row, at) => { if (inside(scene.points.x[at], scene.points.y[at])) found.push(row); });
  if (scene.cells) {
    const { edgesX, edgesY, i, j, rows } = scene.cells, middle = (edges, at) => (edges[at] + edges[at + 1]) / 2;
    rows.forEach((row, at) => { if (inside(middle(edgesX, i[at]), middle(edgesY, j[at]))) found.push(row); });
  }
  for (const line of scene.lines) line.rows?.forEach((row, at) => { if (line.y[at] !== null && inside(line.x[at], line.y[at])) found.push(row); });
  return found;
};
