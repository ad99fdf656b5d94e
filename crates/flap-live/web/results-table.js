// Rows as a table, and the tip at the pointer.

const MOST_SHOWN_ROWS = 100;

const showTable = () => {
  const selected = [...shown.selected];
  const rows = selected.length > 0 ? selected : shown.pinned === null ? [] : [shown.pinned];
  byId("rows").hidden = rows.length === 0;
  byId("rows-title").textContent = selected.length > 0
    ? `${selected.length} selected rows${selected.length > MOST_SHOWN_ROWS ? `, the first ${MOST_SHOWN_ROWS}` : ""}`
    : "Row that was clicked";
  if (rows.length === 0) { byId("table").replaceChildren(); return; }
  const head = element("tr", {}, ...columns.map(({ label, name, unit }) => element("th", { scope: "col", title: name }, label, element("small", {}, unit || "\u00a0"))));
  const body = rows.slice(0, MOST_SHOWN_ROWS).map((row) => element("tr", {}, ...columns.map((column) => element("td", {}, shownCell(column, row)))));
  byId("table").replaceChildren(element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)));
};

const showTip = (view) => {
  byId("tip").hidden = shown.hover === null;
  if (shown.hover === null) return;
  const wanted = new Set([0, ...results.axes, view.x, view.y, view.by, view.color, statusPlace].filter((place) => place !== null && place !== undefined));
  byId("tip").replaceChildren(...[...wanted].map((place) => {
    const column = columns[place];
    return element("div", {}, element("b", {}, `${column.label}: `), `${shownCell(column, shown.hover)} ${column.words ? "" : column.unit}`);
  }));
};
