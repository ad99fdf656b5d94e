// Controls of the page of results: columns, slices, filters.

const activeView = () => shown.views[shown.active];

const fillSelects = () => {
  const option = (place) => element("option", { value: String(place) }, columns[place].title);
  const all = columns.map((_, place) => place);
  for (const axis of ["x", "y"]) byId(axis).append(...numberPlaces.map(option));
  byId("by").append(element("option", { value: "" }, "one line"), ...all.map(option));
  byId("color").append(element("option", { value: "" }, "one colour"), ...all.map(option));
};

/** Shows the state of the active view in the controls. */
const showControls = () => {
  const view = activeView();
  for (const name of ["kind", "best"]) byId(name).value = view[name];
  for (const name of ["x", "y", "by", "color"]) byId(name).value = view[name] ?? "";
  byId("by").parentElement.hidden = view.kind !== "line";
  byId("color").parentElement.hidden = view.kind === "line";
  byId("best").parentElement.hidden = view.kind !== "scatter";
  for (const axis of ["x", "y", "color"]) byId(`log-${axis}`).checked = view.log[axis];
  byId("log-color").parentElement.hidden = view.kind === "line";
  byId("two").setAttribute("aria-pressed", String(shown.two));
  byId("which").hidden = !shown.two;
  for (const i of [0, 1]) {
    byId(`view-${i}`).setAttribute("aria-pressed", String(shown.active === i));
    byId(`chart-${i}`).classList.toggle("active", shown.two && shown.active === i);
  }
  byId("charts").classList.toggle("two", shown.two);
  byId("chart-1").hidden = !shown.two;
  byId("slices").replaceChildren(...slicedAxes.map(sliceRow));
  if (slicedAxes.length === 0) byId("slices").textContent = "none of few values";
  byId("filters").replaceChildren(...shown.filters.map(filterRow));
};

const sliceRow = ({ place, levels }) => {
  const column = columns[place];
  const select = element("select", { "data-column": column.name }, element("option", { value: "" }, "all"),
    ...levels.map((level, at) => element("option", { value: String(at) }, column.words ? column.words[level] : shortNumber(level * column.factor))));
  select.value = shown.slices[place] ?? "";
  select.onchange = () => { shown.slices[place] = select.value === "" ? null : Number(select.value); refresh(true); };
  return element("label", {}, `${column.title} `, select);
};

/** A filter from the least to the largest value of a column. */
const filterOf = (place) => {
  const [low, high] = columns[place].extent ?? [0, 1];
  return { place, low, high };
};

/** A filter: its column, two bounds to be typed, and a slider for each. Bounds do not cross. */
const filterRow = (filter, number) => {
  const column = columns[filter.place], [least, most] = column.extent ?? [0, 1];
  const select = element("select", { "aria-label": "Column of the filter" }, ...numberPlaces.map((place) => element("option", { value: String(place) }, columns[place].title)));
  select.value = String(filter.place);
  select.onchange = () => { shown.filters[number] = filterOf(Number(select.value)); showControls(); refresh(true); };
  const bounds = element("div", { class: "bounds" }), row = element("div", { class: "filter" }, select, bounds);
  const fields = {}, problems = element("p", { class: "problem", role: "alert", hidden: true });
  const write = () => { for (const side of ["low", "high"]) { fields[side].box.value = shortNumber(filter[side] * column.factor); fields[side].slider.value = String(1000 * (filter[side] - least) / (most - least || 1)); } };
  const set = (side, value) => {
    filter[side] = side === "low" ? Math.min(value, filter.high) : Math.max(value, filter.low);
    write();
    refreshSoon();
  };
  for (const [side, words] of [["low", "at least"], ["high", "at most"]]) {
    const box = element("input", { inputmode: "decimal", "aria-label": `${column.title}, ${words}` });
    const slider = element("input", { type: "range", min: "0", max: "1000", step: "1", "aria-label": `${column.title}, ${words}, slider` });
    box.onchange = () => {
      const { number, problem } = box.value.trim() === "" ? { number: null } : typedNumber(box.value, column.unit);
      box.setAttribute("aria-invalid", String(Boolean(problem)));
      problems.textContent = problem ?? "";
      problems.hidden = !problem;
      if (problem) return;
      if (number === null) write(); else set(side, number / column.factor);
      rememberShown(true);
    };
    slider.oninput = () => {
      // The ends of a slider are the least and the largest value exactly.
      const at = Number(slider.value);
      set(side, at === 0 ? least : at === 1000 ? most : least + at / 1000 * (most - least));
    };
    slider.onchange = () => rememberShown(true);
    fields[side] = { box, slider };
  }
  bounds.append(fields.low.box, fields.high.box);
  const remove = element("button", { type: "button" }, "Remove");
  remove.onclick = () => { shown.filters.splice(number, 1); showControls(); refresh(true); byId("add").focus(); };
  row.append(problems, fields.low.slider, fields.high.slider, remove);
  write();
  return row;
};

const listenToControls = () => {
  for (const name of ["kind", "x", "y", "by", "color", "best"]) {
    byId(name).onchange = () => {
      const view = activeView(), value = byId(name).value;
      view[name] = ["kind", "best"].includes(name) ? value : value === "" ? null : Number(value);
      if (name === "kind" && view.kind === "map") chooseMapAxes(view);
      view.zoom = { x: null, y: null };
      if (["kind", "by"].includes(name)) view.hidden = [];
      if (["kind", "x", "y", "by"].includes(name)) chooseSlices();
      showControls();
      refresh(true);
    };
  }
  for (const axis of ["x", "y", "color"]) byId(`log-${axis}`).onchange = () => { const view = activeView(); view.log[axis] = byId(`log-${axis}`).checked; view.zoom = { x: null, y: null }; refresh(true); };
  byId("add").onclick = () => { shown.filters.push(filterOf(activeView().y)); showControls(); refresh(true); byId("filters").lastElementChild.querySelector("select").focus(); };
  byId("two").onclick = () => { shown.two = !shown.two; shown.active = shown.two ? 1 : 0; showControls(); refresh(true); };
  for (const i of [0, 1]) byId(`view-${i}`).onclick = () => { shown.active = i; showControls(); };
  byId("controls").onsubmit = (event) => event.preventDefault();
  byId("controls").onreset = (event) => { event.preventDefault(); freshen(); showControls(); refresh(true); };
};

/** A map is drawn over two parameters that vary, if there are two. */
const chooseMapAxes = (view) => {
  const [a, b] = slicedAxes.map(({ place }) => place), isAxis = (place) => slicedAxes.some((axis) => axis.place === place);
  if (a === undefined || b === undefined) return;
  if (view.color === null || isAxis(view.color)) view.color = isAxis(view.y) ? first.y : view.y;
  if (!isAxis(view.x)) view.x = b;
  if (!isAxis(view.y) || view.y === view.x) view.y = view.x === a ? b : a;
};

/** What a line or a cell shows alone is one value of everything else. */
const chooseSlices = () => {
  const views = shown.two ? shown.views : shown.views.slice(0, 1);
  for (const { place, levels } of slicedAxes) {
    const isNeeded = views.some((view) => needsSlice(view, place));
    if (!isNeeded) shown.slices[place] = null;
    else shown.slices[place] ??= levels.length >> 1;
  }
};
