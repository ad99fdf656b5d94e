// Pinned designs, side by side.

const MOST_PINS = 8;

const pins = { rows: new Map() };

const pinKey = (design) => JSON.stringify(Object.entries(design).sort());

pins.add = () => {
  if (state.pins.length === MOST_PINS) state.pins.shift();
  const taken = state.pins.map((pin) => pin.name);
  const name = Array.from({ length: MOST_PINS + 1 }, (_, i) => String.fromCharCode(65 + i)).find((letter) => !taken.includes(letter));
  state.pins.push({ name, design: { ...state.design } });
  pins.show();
};

/** The numbers of a pinned design, asked for once. */
pins.numbers = async ({ name, design }) => {
  const key = pinKey(design);
  if (pins.rows.has(key)) return;
  try {
    const answer = await server.ask("point", { design, gradient: null }, `pin ${name}`);
    if (answer) { pins.rows.set(key, answer); pins.show(); }
  } catch { pins.rows.set(key, null); }
};

pins.show = () => {
  byId("pins").hidden = state.pins.length === 0;
  if (state.pins.length === 0) return;
  for (const pin of state.pins) pins.numbers(pin);
  const shownPins = [...state.pins, { name: "now", design: state.design }];
  const changed = [...new Set(shownPins.flatMap((pin) => Object.keys(pin.design)))].filter((name) => parameterOf.has(name));
  const head = element("tr", {}, element("th", {}, ""), ...shownPins.map((pin, i) => {
    const cell = element("th", {}, pin.name);
    if (i < state.pins.length) {
      const [restore, remove] = [["Restore", "restore"], ["×", "remove"]].map(([text, what]) => element("button", { type: "button", "aria-label": `${what} ${pin.name}` }, text));
      restore.onclick = () => { state.design = { ...pin.design }; panel.show(); panel.onChange(true); };
      remove.onclick = () => { state.pins.splice(i, 1); pins.show(); remember(true); };
      cell.append(" ", restore, " ", remove);
    }
    return cell;
  }));
  const parameterRows = changed.map((name) => element("tr", {}, element("td", {}, parameterOf.get(name).label),
    ...shownPins.map(({ design }) => element("td", {}, shownValue(parameterOf.get(name), valueIn(design, name))))));
  const answers = shownPins.map(({ design }, i) => (i < state.pins.length ? pins.rows.get(pinKey(design)) : numbers.answer));
  const valueOf = (answer, name) => answer?.row[answer.columns.indexOf(name)];
  const isKnown = (name) => answers.some((answer) => isNumber(valueOf(answer, name)));
  const measureRows = [state.measure, ...MAIN_NUMBERS.filter((name) => name !== state.measure && isKnown(name))].filter((name) => measureOf.has(name)).slice(0, 7).map((name) => {
    const { label, unit } = measureOf.get(name);
    return element("tr", {}, element("td", {}, unit ? `${label} (${unit})` : label), ...answers.map((answer) => {
      const value = valueOf(answer, name);
      return element("td", {}, isNumber(value) ? digits(value, 5) : "–");
    }));
  });
  byId("pin-table").replaceChildren(element("table", {}, element("thead", {}, head), element("tbody", {}, ...parameterRows, ...measureRows)));
};
