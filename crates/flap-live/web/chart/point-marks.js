// @ts-check
// Marks of points and cells: the nearest point, and the cell at a place or beside another.

/** @import { CellSet, Chart, Mark, PointSet } from "../types.d.ts" */

/** The side of the squares of the canvas by which points are found, in pixels. */
const SQUARE = 24;
/** Largest distance of the pointer from a point, in pixels of the page. */
const REACH = 18;
/** A key for two small whole numbers. */
const pairKey = (/** @type {number} */ i, /** @type {number} */ j) => i * 65536 + j;

/** Points by the squares of the canvas that contain them. */
const pointsBySquare = (/** @type {Float32Array} */ px, /** @type {Float32Array} */ py) => {
  /** @type {Map<number, number[]>} */
  const squares = new Map();
  for (let at = 0; at < px.length; at++) {
    const key = pairKey(Math.floor(px[at] / SQUARE), Math.floor(py[at] / SQUARE));
    const list = squares.get(key);
    if (list) list.push(at);
    else squares.set(key, [at]);
  }
  return squares;
};

/**
 * @param {PointSet} points
 * @param {number} at
 * @returns {Mark}
 */
export const pointMark = ({ x, y, rows }, at) => ({
  key: "point",
  name: "",
  index: at,
  row: rows[at],
  x: x[at],
  y: y[at],
});

/**
 * The mark of the point nearest to a place of the plot, in pixels of the page; null if none is near.
 *
 * @param {Chart} chart
 * @param {PointSet} points
 * @param {number} left
 * @param {number} top
 */
export const nearestPoint = ({ plot, placed }, points, left, top) => {
  if (!placed) return null;
  const { px, py } = placed;
  placed.squares ??= pointsBySquare(px, py);
  const ratio = uPlot.pxRatio;
  const [atX, atY] = [left * ratio + plot.bbox.left, top * ratio + plot.bbox.top];
  const [column, row] = [Math.floor(atX / SQUARE), Math.floor(atY / SQUARE)];
  let nearest = -1;
  let least = (REACH * ratio) ** 2;
  for (let i = column - 1; i <= column + 1; i++) {
    for (let j = row - 1; j <= row + 1; j++) {
      for (const point of placed.squares.get(pairKey(i, j)) ?? []) {
        const distance = (px[point] - atX) ** 2 + (py[point] - atY) ** 2;
        if (distance < least) {
          least = distance;
          nearest = point;
        }
      }
    }
  }
  return nearest < 0 ? null : pointMark(points, nearest);
};

/** Cells by their places among the edges. */
const cellsByPlace = (/** @type {CellSet} */ cells) => {
  cells.byPlace ??= new Map(cells.rows.map((_, at) => [pairKey(cells.i[at], cells.j[at]), at]));
  return cells.byPlace;
};

/** The middle of a cell. */
export const cellMiddle = (/** @type {CellSet} */ { edgesX, edgesY, i, j }, /** @type {number} */ at) => ({
  x: (edgesX[i[at]] + edgesX[i[at] + 1]) / 2,
  y: (edgesY[j[at]] + edgesY[j[at] + 1]) / 2,
});

/**
 * @param {CellSet} cells
 * @param {number} at
 * @returns {Mark}
 */
const cellMark = (cells, at) => ({ key: "cell", name: "", index: at, row: cells.rows[at], ...cellMiddle(cells, at) });

/**
 * The mark of the cell that contains a place of the plane; null if there is none.
 *
 * @param {CellSet} cells
 * @param {number} x
 * @param {number} y
 */
export const cellAt = (cells, x, y) => {
  const placeIn = (/** @type {number[]} */ edges, /** @type {number} */ value) =>
    edges.findIndex((edge, at) => {
      if (at + 1 === edges.length) return false;
      return value >= Math.min(edge, edges[at + 1]) && value < Math.max(edge, edges[at + 1]);
    });
  const at = cellsByPlace(cells).get(pairKey(placeIn(cells.edgesX, x), placeIn(cells.edgesY, y)));
  return at === undefined ? null : cellMark(cells, at);
};

/**
 * The mark of the next cell with a row, to the right or upwards; the same one at the edge.
 *
 * @param {CellSet} cells
 * @param {Mark | null} mark
 * @param {number} right
 * @param {number} up
 */
export const nextCell = (cells, mark, right, up) => {
  if (mark?.key !== "cell") return cellMark(cells, 0);
  const start = Number(mark.index);
  const [width, height] = [cells.edgesX.length - 1, cells.edgesY.length - 1];
  let [column, row] = [cells.i[start] + right, cells.j[start] + up];
  for (; column >= 0 && column < width && row >= 0 && row < height; column += right, row += up) {
    const at = cellsByPlace(cells).get(pairKey(column, row));
    if (at !== undefined) return cellMark(cells, at);
  }
  return cellMark(cells, start);
};
