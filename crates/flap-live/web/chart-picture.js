// Pictures of a chart to save. They are for papers: in the light scheme, and with the whole legend below.

const PICTURE_LETTERS = "12px system-ui, sans-serif";
const ENTRY_HEIGHT = 18, SHADE = 8, SWATCH = 16;

/** Does something while the chart has the colours of the light scheme. Nothing of this is seen: it ends before the next frame. */
const onPaper = async (chart, work) => {
  const { classList } = document.documentElement;
  classList.add("paper");
  try {
    chart.restyle();
    await null; // the plot paints in a microtask
    return work();
  } finally {
    classList.remove("paper");
    chart.restyle();
  }
};

/** The entries of the legend in rows that are as wide as the picture, statuses below: { entry, left, row, words }. */
const placedEntries = (chart, left) => {
  const pen = document.createElement("canvas").getContext("2d"), end = chart.plot.width - 8;
  pen.font = PICTURE_LETTERS;
  let at = left, row = 0, wasStatus = false;
  return pictureEntries(chart).map((entry) => {
    const across = swatchWidth(entry);
    // A tenth more: the letters of another program may be wider.
    const width = across + 1.1 * pen.measureText(entry.name).width;
    const isApart = entry.shape && !wasStatus;
    wasStatus = Boolean(entry.shape);
    if (at > left && (isApart || at + width > end)) { at = left; row++; }
    const placed = { entry, left: at, row, words: at + across };
    at += width + 14;
    return placed;
  });
};
const swatchWidth = ({ colors, shape }) => (shape ? SWATCH : colors.length === 0 ? 0 : colors.length === 1 ? SWATCH + 5 : SHADE * colors.length + 6);

/** The height of all rows of a legend. */
const legendHeight = (placed) => (placed.length > 0 ? (placed[placed.length - 1].row + 1) * ENTRY_HEIGHT + 8 : 0);

/** The picture as a canvas, with its legend. */
const sheetOfChart = (chart) => {
  const { canvas } = chart.plot.ctx, ratio = uPlot.pxRatio, top = canvas.height / ratio;
  const placed = placedEntries(chart, chart.plot.bbox.left / ratio), sheet = document.createElement("canvas");
  sheet.width = canvas.width;
  sheet.height = canvas.height + Math.ceil(legendHeight(placed) * ratio);
  const pen = sheet.getContext("2d");
  pen.fillStyle = styleColour("--back");
  pen.fillRect(0, 0, sheet.width, sheet.height);
  pen.drawImage(canvas, 0, 0);
  pen.scale(ratio, ratio);
  pen.font = PICTURE_LETTERS;
  for (const { entry: { name, colors, color, shape }, left, row, words } of placed) {
    const middle = top + row * ENTRY_HEIGHT + 8;
    if (shape) {
      pen.save(); pen.translate(left + 5, middle); pen.fillStyle = color; pen.fill(new Path2D(shape)); pen.restore();
    } else {
      const width = colors.length === 1 ? SWATCH : SHADE;
      colors.forEach((shade, i) => { pen.fillStyle = shade; pen.fillRect(left + i * width, middle - 2, width, 4); });
    }
    pen.fillStyle = styleColour("--ink");
    pen.fillText(name, words, middle + 4);
  }
  return sheet;
};

const pngOfChart = async (chart) => {
  const sheet = await onPaper(chart, () => sheetOfChart(chart));
  return new Promise((done) => { sheet.toBlob(done, "image/png"); });
};
