// The response family: coarse while a slider moves, fine when it rests.

const FINE = 81;
const FEWEST = 9, MOST = 33;
/** Time in which a coarse family is to be there, in milliseconds. */
const SOON = 45;

const family = {
  chart: null,
  n: 17, // values of x of a coarse family
  isBusy: false,
  isStale: false,
  isFine: false, // the lines are those of a design that rests
  get isUpDown() { return state.updown; },
  rested: null, // the lines of the last fine family, and their text
  ghost: [],
  gaps: [],
  onDrawn: () => {},
};

/** The parameters that the chart may vary: numbers that no formula gives. */
const variable = () => opened.parameters.filter(({ kind }) => kind === "number" || kind === "following");

family.request = (n) => ({ design: state.design, x: { ...state.x, n }, by: family.isUpDown ? null : state.by });

/** A coarse family as soon as possible; the newest one if several are wanted. */
family.move = async () => {
  family.isStale = true;
  if (family.isBusy) return;
  family.isBusy = true;
  while (family.isStale) {
    family.isStale = false;
    const begun = panel.moved, sent = performance.now();
    panel.moved = undefined;
    const answer = await family.ask("family", family.request(family.n));
    if (!answer || !family.isWanted(answer)) continue;
    const took = performance.now() - sent;
    if (took > SOON) family.n = Math.max(FEWEST, Math.floor(family.n * 0.75));
    else if (took < SOON / 2) family.n = Math.min(MOST, family.n + 4);
    family.draw(answer, false);
    if (begun !== undefined) {
      requestAnimationFrame(() => performance.measure("flap-slider-to-picture", { start: begun, end: performance.now() }));
    }
  }
  family.isBusy = false;
};

/** The fine family, and up and down if that is shown. */
family.rest = async () => {
  if (family.isBusy || family.isStale) return;
  const kind = family.isUpDown ? "hysteresis" : "family";
  byId("chart").setAttribute("aria-busy", "true");
  const answer = await family.ask(kind, family.request(FINE));
  byId("chart").removeAttribute("aria-busy");
  if (answer && family.isWanted(answer)) family.draw(answer, true);
};

/** An answer with its kind and request; null if there is none. */
family.ask = async (kind, request) => {
  const sent = structuredClone(request); // the state may change while the server works
  try {
    const answer = await server.ask(kind, sent);
    if (!answer) return null;
    family.complain(null);
    return { ...answer, kind, request: sent };
  } catch (error) {
    family.complain(error);
    return null;
  }
};

/** Whether the axes are still those of an answer's request. */
family.isWanted = ({ kind, request }) => kind === (family.isUpDown ? "hysteresis" : "family")
  && request.x.name === state.x.name && (kind === "hysteresis" || request.by?.name === state.by?.name);

family.complain = (error) => {
  // What is about a changed parameter stands at its field alone.
  const isOfField = error !== null && error.parameter in state.design && panel.rows.has(error.parameter);
  panel.complain(isOfField ? error : null);
  banner.say("error", error === null || error.status === 0 || isOfField ? "" : [error.message, error.help].filter(Boolean).join(". "));
};

/** Lines of an answer: one for each value of the lines' parameter, or one up and one down. */
const linesOf = ({ columns, rows }) => {
  const place = (name) => columns.indexOf(name);
  const along = parameterOf.get(state.x.name), by = family.isUpDown || !state.by ? null : parameterOf.get(state.by.name);
  const [x, y, status, stable, bistable] = [along.name, state.measure, "status", "stable", "bistable"].map(place);
  const key = family.isUpDown ? place("branch") : by ? place(by.name) : -1;
  const lines = new Map(), gaps = [];
  for (const row of rows) {
    const value = key < 0 ? "" : row[key];
    if (!lines.has(value)) {
      const name = family.isUpDown ? value : by ? shownValue(by, value) : "";
      lines.set(value, { key: String(value), group: String(value), name, x: [], y: [], rows: [], value });
    }
    const line = lines.get(value), number = isNumber(row[y]) ? row[y] : null;
    line.x.push(row[x] * along.factor);
    line.y.push(number);
    line.rows.push({ status: row[status], stable: row[stable], bistable: row[bistable] === true, x: row[x], by: key < 0 ? null : value });
    if (row[status] !== "periodic") gaps.push({ x: row[x] * along.factor, text: row[status], name: line.name, row: line.rows[line.rows.length - 1] });
  }
  const list = [...lines.values()];
  list.forEach((line, i) => Object.assign(line, { place: i, of: list.length, marks: line.x.length < 12 }));
  if (family.isUpDown) for (const line of list) if (line.key === "down") line.dash = [7, 4];
  // One list of x for all lines where they have the same: the chart then joins nothing.
  for (const line of list) if (line.x.length === list[0].x.length && line.x.every((value, i) => value === list[0].x[i])) line.x = list[0].x;
  if (family.isUpDown) for (const line of list) if (line.x.length > 1 && line.x[0] > line.x[1]) for (const part of ["x", "y", "rows"]) line[part] = [...line[part]].reverse();
  return { lines: list, gaps };
};

/** Ranges of x where the ways up and down have different motions. */
const bistable = (lines) => {
  const up = lines.find((line) => line.key === "up"), bands = [];
  up?.rows.forEach((row, i) => {
    if (!row.bistable) return;
    if (up.rows[i - 1]?.bistable) bands[bands.length - 1].to = up.x[i]; else bands.push({ from: up.x[i], to: up.x[i] });
  });
  return bands;
};

family.draw = (answer, isFine) => {
  family.answer = answer;
  family.isFine = isFine;
  const { lines, gaps } = linesOf(answer), { design, x: { n, ...along } } = answer.request;
  const text = JSON.stringify([design, along, state.by, state.measure, family.isUpDown]);
  if (isFine) {
    const isSameView = family.rested && family.rested.view === JSON.stringify([state.x, state.measure, family.isUpDown]);
    if (family.rested && family.rested.text !== text) family.ghost = isSameView ? family.rested.lines : [];
    family.rested = { lines, text, view: JSON.stringify([state.x, state.measure, family.isUpDown]) };
  }
  const shown = isFine ? family.ghost : (family.rested && family.rested.view === JSON.stringify([state.x, state.measure, family.isUpDown]) ? family.rested.lines : []);
  const ghosts = shown.map((line) => ({ ...line, key: `ghost ${line.key}`, ghost: true, marks: false, width: 1.5, dash: [3, 3] }));
  family.gaps = gaps;
  family.lines = lines;
  family.bands = family.isUpDown ? bistable(lines) : [];
  family.paint([...ghosts, ...lines]);
  family.tell(family.chart.markAgain());
  family.onDrawn(isFine);
};

/** Paints lines in the colours of the scheme, with the marker of the design. */
family.paint = (lines) => {
  for (const line of lines) line.color = lineColour(line.place, line.of);
  const along = parameterOf.get(state.x.name), measure = measureOf.get(state.measure);
  const here = valueIn(state.design, along.name), value = numbers.value(state.measure);
  const by = family.isUpDown || !state.by ? null : parameterOf.get(state.by.name);
  family.chart.view = state.view;
  family.chart.hidden = new Set(state.hidden);
  family.chart.draw({
    x: { label: along.label, unit: along.unit, log: state.log.x }, y: { label: measure.label, unit: measure.unit, log: state.log.y },
    lines, title: by?.label, bands: family.bands,
    gaps: family.gaps.map((gap) => ({ ...gap, ...statusMark(gap.text) })),
    statuses: statusCounts(family.gaps).map(([status, count]) => ({ name: `${count} ${status.replace("_", " ")}`, ...statusMark(status) })),
    marker: isNumber(here) && isNumber(value) ? { x: here * along.factor, y: value } : null,
  });
};

/** How many gaps have each status. */
const statusCounts = (gaps) => {
  const counts = new Map();
  for (const { text } of gaps) counts.set(text, (counts.get(text) ?? 0) + 1);
  return [...counts];
};

/** The line below the chart: the mark under the pointer, or the points without a settled motion; and whether more is to come. */
family.tell = (mark) => {
  const along = parameterOf.get(state.x.name), measure = measureOf.get(state.measure);
  let text = "";
  if (mark?.key === "gap") {
    const each = mark.gaps.map((gap) => `${gap.name ? `${gap.name} ` : ""}${gap.text.replace("_", " ")}`);
    text = `No settled motion at ${digits(mark.x, 5)} ${along.unit}: ${each.join(", ")}`;
  } else if (mark) {
    const { status, stable } = mark.row;
    text = `${measure.label} ${shortNumber(mark.y)} ${measure.unit} at ${digits(mark.x, 5)} ${along.unit}${mark.name ? `, ${mark.name}` : ""}: ${status}${stable === false ? ", not stable" : ""}`;
  } else if (family.bands.length > 0) {
    text = `Two motions between ${family.bands.map(({ from, to }) => `${digits(from, 5)} and ${digits(to, 5)} ${along.unit}`).join("; ")}`;
  } else if (family.gaps.length > 0) {
    text = `${family.gaps.length} of ${family.answer.rows.length} points have no settled motion: the marks at the foot`;
  }
  byId("tip").textContent = [text, family.isFine ? "" : "coarse, refining …"].filter(Boolean).join(" · ");
};
