// The panel of parameters: sliders, numbers, options, help.

const STEPS = 1000;

/** `refused`: what is wrong with the texts of fields that were not understood. */
const panel = { rows: new Map(), refused: new Map(), onChange: () => {} };

/** The place of a value on a slider, and back. */
const toSlider = ({ low, high, log }, value) =>
  STEPS * (log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
const fromSlider = ({ low, high, log, whole }, place) => {
  const share = place / STEPS, value = log ? low * (high / low) ** share : low + share * (high - low);
  return whole ? Math.round(value) : Number(value.toPrecision(6));
};

/** What stands for a parameter that is not set. */
const followed = ({ allowed }) => {
  const rule = allowed.split("if not set, ")[1] ?? "";
  return rule === "" || rule.startsWith("nothing") ? "not set" : rule;
};

const parameterRow = (parameter) => {
  const { name, kind } = parameter, id = `p-${name}`;
  const row = element("div", { class: "parameter", "data-name": name });
  const reset = element("button", { type: "button", title: "Reset", "aria-label": `Reset ${parameter.label}` }, "↺");
  const ask = element("button", { type: "button", "aria-expanded": "false", "aria-label": `Help on ${parameter.label}` }, "?");
  const help = element("p", { class: "help", hidden: true }, `${parameter.doc} Allowed: ${parameter.allowed}. Name: ${name}.${parameter.fitted ? " The published value is a fit to one vehicle." : ""}`);
  const problem = element("p", { class: "problem", role: "alert", hidden: true });
  row.append(element("div", { class: "name" }, element("label", { for: id }, parameter.label),
    symbolOf(parameter.symbol), reset, ask));
  const inputs = element("div", { class: "inputs" });
  let slider = null, field;
  const isFixed = kind === "derived";
  if (kind === "choice") {
    field = element("select", { id, style: "grid-column: 1 / 4" }, ...parameter.options.map((option) => element("option", { value: option }, option)));
    field.onchange = () => panel.set(name, field.value, true);
    inputs.append(field);
  } else {
    slider = element("input", { type: "range", min: "0", max: String(STEPS), step: "1", "aria-label": `${parameter.label}, slider`, disabled: isFixed });
    field = element("input", { id, inputmode: "decimal", disabled: isFixed, placeholder: kind === "following" ? followed(parameter) : "" });
    slider.oninput = () => { panel.moved ??= performance.now(); panel.set(name, fromSlider(parameter, Number(slider.value)), false); };
    slider.onchange = () => panel.onRest();
    field.onchange = () => panel.typed(name);
    inputs.append(slider, field, element("span", { class: "unit" }, parameter.unit));
  }
  reset.onclick = () => { panel.set(name, parameter.value, true); field.focus(); };
  ask.onclick = () => { help.hidden = !help.hidden; ask.setAttribute("aria-expanded", String(!help.hidden)); };
  row.append(inputs, help, problem);
  panel.rows.set(name, { row, slider, field, reset, problem });
  return row;
};

panel.build = () => {
  const groups = new Map();
  for (const parameter of opened.parameters) {
    if (!groups.has(parameter.group)) groups.set(parameter.group, []);
    groups.get(parameter.group).push(parameter);
  }
  const first = ["drive", "hinge", "wing", "transmission", "actuator"];
  byId("groups").replaceChildren(...[...groups].map(([group, parameters]) =>
    element("details", { open: first.includes(group) && parameters.length < 16 || group === "drive", "data-group": group }, element("summary", {}, group || "parameters"), ...parameters.map(parameterRow))));
  byId("search").oninput = panel.search;
  byId("panel").onsubmit = (event) => event.preventDefault();
  byId("reset-all").onclick = () => { state.design = {}; state.hidden = []; banner.say("address", ""); panel.show(); panel.onChange(true); };
};

/** Shows the parameters that have all words of the search in their names, symbols or meanings. */
panel.search = () => {
  const words = byId("search").value.toLowerCase().split(/\s+/).filter(Boolean);
  for (const details of byId("groups").children) {
    let any = false;
    for (const row of details.querySelectorAll(".parameter")) {
      const { name, label, symbol, doc, group } = parameterOf.get(row.dataset.name);
      const text = `${name} ${label} ${symbol} ${doc} ${group}`.toLowerCase();
      row.hidden = !words.every((word) => text.includes(word));
      any ||= !row.hidden;
    }
    details.hidden = !any;
    if (words.length > 0) details.open = true;
  }
};

/** Changes a parameter, by a slider that still moves or for good. */
panel.set = (name, value, isRest) => {
  change(name, value);
  panel.showOne(name);
  panel.onChange(isRest);
};

/** Takes a number, or text with a unit, which the server reads. */
panel.typed = (name) => {
  const parameter = parameterOf.get(name), text = panel.rows.get(name).field.value.trim();
  if (text === "") return panel.set(name, parameter.kind === "following" ? null : parameter.value, true);
  const { number, rest, problem } = splitNumber(text);
  if (problem && /^[-+−.\d]/.test(text)) {
    panel.refused.set(name, problem);
    panel.complain(null);
    return;
  }
  panel.set(name, problem ? text : rest === "" ? inSI(number, parameter.factor) : `${number} ${rest}`, true);
};

panel.showOne = (name) => {
  const parameter = parameterOf.get(name), { row, slider, field, reset } = panel.rows.get(name);
  const value = valueIn(state.design, name), isChanged = name in state.design;
  panel.refused.delete(name);
  row.classList.toggle("changed", isChanged);
  reset.hidden = !isChanged;
  if (isNumber(value)) {
    const shown = digits(value * parameter.factor, 6);
    if (field.value !== shown) field.value = shown;
    const place = Math.round(toSlider(parameter, value));
    if (slider && Math.round(Number(slider.value)) !== place) slider.value = place;
  } else field.value = value ?? "";
  slider?.setAttribute("aria-valuetext", shownValue(parameter, value));
};

panel.show = () => { for (const name of panel.rows.keys()) panel.showOne(name); };

/** Marks the field that the server has refused, and those that were not understood. */
panel.complain = (error) => {
  for (const [name, { field, problem }] of panel.rows) {
    const ofServer = error !== null && error.parameter === name ? [error.message, error.help].filter(Boolean).join(". ") : "";
    const words = panel.refused.get(name) ?? ofServer;
    if (words) field.setAttribute("aria-invalid", "true"); else field.removeAttribute("aria-invalid");
    problem.hidden = !words;
    if (problem.textContent !== words) problem.textContent = words;
    if (words) problem.closest("details").open = true;
  }
};

/** Shows a parameter and puts the keyboard there. */
panel.focus = (name) => {
  const { row, slider, field } = panel.rows.get(name);
  row.hidden = false;
  row.closest("details").hidden = false;
  row.closest("details").open = true;
  (slider ?? field).focus();
  row.scrollIntoView({ block: "nearest" });
};
