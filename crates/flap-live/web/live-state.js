// The state of the page: the design, the family, the pins; and its text in the address.

const opened = JSON.parse(byId("data").textContent);
const parameterOf = new Map(opened.parameters.map((parameter) => [parameter.name, parameter]));
const measureOf = new Map(opened.measures.map((measure) => [measure.name, measure]));

/** Several wings on a body: numbers of them together, and no single motion. */
const isVehicle = measureOf.has("torque_roll_unm");

const freshState = () => ({
  design: {}, // changed parameters alone: SI numbers, options, or null for one that is taken away
  x: { name: opened.view.x.name, from: opened.view.x.from, to: opened.view.x.to },
  by: opened.view.by && { name: opened.view.by.name, values: [...opened.view.by.values] },
  measure: opened.view.measure,
  log: { x: false, y: false },
  view: { x: null, y: null },
  updown: false, // the ways up and down in place of the family
  hidden: [], // lines that the legend has switched off
  pins: [],
});
const state = freshState();

/** The value of a parameter in a design: the changed one, or the one that was opened. */
const valueIn = (design, name) => (name in design ? design[name] : parameterOf.get(name).value);

/** A value as it is shown, with its unit. */
const shownValue = (parameter, value) => {
  if (value === null || value === undefined) return "not set";
  if (typeof value === "string") return value;
  return `${shortNumber(value * parameter.factor)}${parameter.unit ? ` ${parameter.unit}` : ""}`;
};

/** Changes a parameter of the design; the value that was opened is no change. */
const change = (name, value) => {
  if (value === parameterOf.get(name).value) delete state.design[name];
  else state.design[name] = value;
};

const isNumber = (value) => typeof value === "number" && Number.isFinite(value);
const isRange = (range) => range === null || (Array.isArray(range) && range.length === 2 && range.every(isNumber));

/** Words about an address that was made with another preset. */
const foreignAddress = (found) => {
  const preset = found && typeof found === "object" ? found.preset : undefined;
  if (typeof preset !== "string" || preset === opened.preset) return "";
  return `The address was made with the preset ${preset}: what it says is shown with ${opened.preset}, which this page has.`;
};

/** Takes over what an address says, but for what this model does not have. */
const takeOver = (found) => {
  Object.assign(state, freshState());
  if (!found || typeof found !== "object") return;
  const knownDesign = (design) => Object.fromEntries(Object.entries(design ?? {}).filter(([name, value]) =>
    parameterOf.has(name) && (value === null || isNumber(value) || typeof value === "string")));
  state.design = knownDesign(found.design);
  const { x, by, log, view } = found;
  if (x && parameterOf.has(x.name) && isNumber(x.from) && isNumber(x.to)) state.x = { name: x.name, from: x.from, to: x.to };
  if (by === null) state.by = null;
  if (by && parameterOf.has(by.name) && Array.isArray(by.values) && by.values.every((v) => isNumber(v) || typeof v === "string")) state.by = { name: by.name, values: by.values };
  if (measureOf.has(found.measure)) state.measure = found.measure;
  if (log) state.log = { x: Boolean(log.x), y: Boolean(log.y) };
  if (view && isRange(view.x ?? null) && isRange(view.y ?? null)) state.view = { x: view.x ?? null, y: view.y ?? null };
  state.updown = found.updown === true;
  if (Array.isArray(found.hidden)) state.hidden = found.hidden.filter((group) => typeof group === "string");
  if (Array.isArray(found.pins)) {
    state.pins = found.pins.filter((pin) => pin && typeof pin.name === "string").map((pin) => ({ name: pin.name, design: knownDesign(pin.design) }));
  }
};

/** Writes the preset and what differs from the first view into the address. */
const remember = (isStep) => {
  const fresh = freshState();
  const told = Object.fromEntries(Object.entries(state).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(fresh[key])));
  if (Object.keys(told).length === 0 && !location.hash) return;
  writeAddress({ preset: opened.preset, ...told }, isStep);
};
