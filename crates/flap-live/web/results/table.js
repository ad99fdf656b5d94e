// @ts-check
// Rows as a table, and the tooltip at the pointer.

import { byId, element } from "../shared/dom.js";
import { cellText } from "./columns.js";
import { columns, results, statusColumn } from "./data.js";
import { activeView, shown } from "./state.js";

/** @import { ResultsView } from "../types.d.ts" */

const MOST_SHOWN_ROWS = 100;

const headings = () =>
  columns.map(({ label, name, unit }) =>
    element("th", { scope: "col", title: name }, label, element("small", {}, unit || "\u00a0")),
  );

/** Shows the rows that are selected, or the row that was clicked. */
export const showTable = () => {
  const selected = [...shown.selected];
  const pinned = shown.pinned === null ? [] : [shown.pinned];
  const rows = selected.length > 0 ? selected : pinned;
  const excess = selected.length > MOST_SHOWN_ROWS ? `, the first ${MOST_SHOWN_ROWS}` : "";
  const title = selected.length > 0 ? `${selected.length} selected rows${excess}` : "Row that was clicked";
  byId("rows").hidden = rows.length === 0;
  byId("rows-title").textContent = title;
  const body = rows
    .slice(0, MOST_SHOWN_ROWS)
    .map((row) => element("tr", {}, ...columns.map((column) => element("td", {}, cellText(column, row)))));
  const table = () =>
    element("table", {}, element("thead", {}, element("tr", {}, ...headings())), element("tbody", {}, ...body));
  byId("table").replaceChildren(...(rows.length > 0 ? [table()] : []));
};

/** Shows the row under the pointer: its number, its parameters, and the columns of a view. */
export const showTip = (/** @type {ResultsView} */ view = activeView()) => {
  const row = shown.hover;
  byId("tip").hidden = row === null;
  if (row === null) return;
  const viewed = [view.x, view.y, view.by, view.color].flatMap((place) => (place === null ? [] : columns[place]));
  const status = statusColumn ? [statusColumn] : [];
  const wanted = new Set([columns[0], ...results.axes.map((place) => columns[place]), ...viewed, ...status]);
  const lines = [...wanted].map((column) => {
    const text = `${cellText(column, row)} ${column.words ? "" : column.unit}`;
    return element("div", {}, element("b", {}, `${column.label}: `), text);
  });
  byId("tip").replaceChildren(...lines);
};
