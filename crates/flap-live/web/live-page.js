// The whole page: controls of the chart, and what follows a change.

/** Time without a change after which a design rests, in milliseconds. */
const REST = 150;

const axisControls = () => {
  const option = ({ name, label }) => element("option", { value: name }, label);
  byId("measure").append(...opened.measures.map(option));
  byId("x").append(...variable().map(option));
  byId("by").append(element("option", { value: "" }, "none"), ...variable().map(option));
};

/** Shows the state in the controls of the chart. */
const showControls = () => {
  const along = parameterOf.get(state.x.name), by = state.by && parameterOf.get(state.by.name);
  byId("measure").value = state.measure;
  byId("x").value = along.name;
  byId("x-unit").textContent = along.unit;
  for (const end of ["from", "to"]) byId(`x-${end}`).removeAttribute("aria-invalid");
  byId("x-problem").hidden = true;
  byId("x-from").value = digits(state.x.from * along.factor, 6);
  byId("x-to").value = digits(state.x.to * along.factor, 6);
  byId("by").value = by ? by.name : "";
  byId("by-unit").textContent = by ? by.unit : "";
  byId("by-values").disabled = !by;
  byId("by-values").value = by ? state.by.values.map((value) => (typeof value === "number" ? digits(value * by.factor, 6) : value)).join(", ") : "";
  byId("log-x").checked = state.log.x;
  byId("log-y").checked = state.log.y;
  byId("hysteresis").setAttribute("aria-pressed", String(family.isUpDown));
};

/** A range around the value of a parameter. */
const rangeAround = ({ name, low, high }) => {
  const value = valueIn(state.design, name);
  return isNumber(value) && value > 0 ? { from: 0.6 * value, to: 1.4 * value } : { from: low, to: high };
};

/** Numbers of a list that the user has typed, in SI units; text with a unit stays text. */
const typedList = (text, factor) => text.split(/[,;\s]+(?=[-+.\d])/).map((part) => part.trim()).filter(Boolean).map((part) => (Number.isFinite(Number(part)) ? inSI(Number(part), factor) : part));

/** Says what is wrong with an end of the axis; the axis stays as it is. */
const refuseEnd = (field, words) => {
  field.setAttribute("aria-invalid", "true");
  byId("x-problem").textContent = words;
  byId("x-problem").hidden = false;
};

const listen = () => {
  const viewed = () => { state.view = { x: null, y: null }; showControls(); changed(true); };
  byId("measure").onchange = () => { state.measure = byId("measure").value; viewed(); };
  byId("x").onchange = () => {
    const name = byId("x").value;
    if (state.by?.name === name) state.by = null;
    state.x = { name, ...rangeAround(parameterOf.get(name)) };
    viewed();
  };
  for (const end of ["from", "to"]) {
    byId(`x-${end}`).onchange = () => {
      const field = byId(`x-${end}`), { unit, factor } = parameterOf.get(state.x.name);
      if (field.value.trim() === "") return showControls();
      const { number, problem } = typedNumber(field.value, unit), value = inSI(number, factor);
      const isSame = !problem && value === state.x[end === "from" ? "to" : "from"];
      if (problem || isSame) return refuseEnd(field, problem ?? "“from” and “to” must differ");
      state.x[end] = value;
      viewed();
    };
  }
  byId("by").onchange = () => {
    const name = byId("by").value;
    state.hidden = [];
    if (!name) state.by = null;
    else {
      const { from, to } = rangeAround(parameterOf.get(name));
      state.by = { name, values: [0, 1, 2, 3, 4].map((i) => Number((from + i * (to - from) / 4).toPrecision(4))) };
      if (state.x.name === name) state.by = null;
    }
    viewed();
  };
  byId("by-values").onchange = () => { state.by.values = typedList(byId("by-values").value, parameterOf.get(state.by.name).factor); viewed(); };
  for (const axis of ["x", "y"]) byId(`log-${axis}`).onchange = () => { state.log[axis] = byId(`log-${axis}`).checked; state.view = { x: null, y: null }; redraw(); remember(true); };
  byId("hysteresis").onclick = () => { state.updown = !state.updown; state.hidden = []; family.ghost = []; showControls(); rest(); };
  byId("pin").onclick = () => { pins.add(); remember(true); };
  addEventListener("popstate", restore);
};

/** Draws the last rows again, as after a change of the axes alone. */
const redraw = () => { if (family.answer) family.draw(family.answer, family.isFine); };

/** What follows a change: a coarse family at once, everything else when the design rests. */
const changed = (isRest) => {
  drawWing();
  if (!family.isUpDown) family.move();
  if (isRest) restSoon.now(); else restSoon();
};

const rest = () => {
  if (family.isBusy) { restSoon(); return; }
  remember(true);
  family.rest();
  numbers.ask(true).then(() => { pins.show(); if (family.lines) family.repaint(); });
  motion.ask(state.design, "of the design");
};

const restSoon = settled(rest, REST);
restSoon.now = settled(rest, 20);

/** The motion of a mark: the design at its place. */
const showMotion = settled((mark) => {
  if (!mark) { motion.ask(state.design, "of the design"); return; }
  const design = { ...state.design, [state.x.name]: mark.row.x };
  if (state.by && mark.row.by !== null && !family.isUpDown) design[state.by.name] = mark.row.by;
  if (mark.row.status === "periodic") motion.ask(design, `at ${digits(mark.x, 5)} ${parameterOf.get(state.x.name).unit}${mark.name ? `, ${mark.name}` : ""}`);
}, 60);

/** Takes over the address, as after a reload or the back button. */
const restore = () => {
  const found = stateOfAddress();
  banner.say("address", foreignAddress(found));
  takeOver(found);
  panel.show();
  showControls();
  pins.show();
  changed(true);
};

const start = () => {
  // The heading may be the path of a file: its name is enough.
  const name = opened.title.split(/[\\/]/).pop();
  Object.assign(byId("title"), { textContent: name, title: opened.title });
  document.title = name;
  byId("about").textContent = `${opened.doc} · model ${opened.model}, preset ${opened.preset} · flap ${opened.version}`;
  panel.build();
  panel.onChange = changed;
  panel.onRest = () => restSoon.now();
  axisControls();
  family.chart = new Chart(byId("chart"), {
    name: "Response family. Arrow keys go along the lines.",
    onPoint: (mark) => { family.tell(mark); showMotion(mark); },
    onView: (view) => { state.view = view; remember(true); },
    onHidden: (groups) => { state.hidden = groups; remember(true); },
    onScheme: () => { if (family.lines) family.repaint(); },
  });
  family.repaint = () => family.paint([...family.ghost.map((line) => ({ ...line, key: `ghost ${line.key}`, ghost: true, marks: false, width: 1.5, dash: [3, 3] })), ...family.lines]);
  server.onGone = () => banner.say("server", "The server is gone: the page shows what it had, and goes on when the server is there again.");
  server.onBack = () => { banner.say("server", ""); changed(true); };
  listen();
  for (const button of document.querySelectorAll(".skip button")) button.onclick = () => document.querySelector(button.dataset.to).focus();
  byId("all").open = window.matchMedia("(min-width: 1181px)").matches;
  saving.start();
  motion.start();
  restore();
};

start();
