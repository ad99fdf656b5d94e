// The numbers of the design, beside those of the published one; and the derivatives of the measure.

const MAIN_NUMBERS = ["lift_to_weight", "force_up_mn", "force_forward_mn", "force_left_mn",
  "torque_roll_unm", "torque_pitch_unm", "torque_yaw_unm",
  "lift_mean_mn", "power_mean_mw", "efficiency_gf_per_w", "stroke_amplitude_deg", "pitch_amplitude_deg",
  "strain_surface_max", "hinge_strain_max", "field_max_v_per_um", "floquet_max", "error_estimate"];
const MOST_SLOPES = 10;

const numbers = { answer: null, design: "" };

/** A measure of the design; undefined before it is known. */
numbers.value = (name) => (numbers.answer ? numbers.answer.row[numbers.answer.columns.indexOf(name)] : undefined);

/** Asks for the numbers, with derivatives when the design rests. */
numbers.ask = async (isRest) => {
  const design = { ...state.design }, measure = state.measure;
  try {
    const answer = await server.ask("point", { design, gradient: isRest ? measure : null });
    if (!answer) return;
    numbers.answer = answer;
    numbers.design = JSON.stringify([design, measure]);
    markOld("numbers", "");
    banner.say("far", answer.warnings.join(" · "));
    numbers.show(isRest);
  } catch (error) {
    if (error.status === 0) return;
    markOld("numbers", numbers.answer ? "These are the numbers of the last possible design." : "There is no possible design yet.");
  }
};

const numberRow = (name, label, unit, value, published) => {
  const text = value === null || value === undefined ? "–" : typeof value === "number" ? `${digits(value, 5)} ${unit}` : String(value);
  const both = isNumber(value) && isNumber(published) && published !== 0;
  const share = both ? 100 * (value - published) / Math.abs(published) : 0;
  // A difference from almost nothing says nothing in per cent.
  const shown = both && Math.abs(share) >= 0.005 && Math.abs(share) < 1e4 ? `${share > 0 ? "+" : "−"}${digits(Math.abs(share), 3)} %` : "";
  return element("div", { class: "number", "data-name": name },
    element("span", { title: measureOf.get(name)?.doc ?? "" }, label), element("span", { class: "value" }, text), element("span", { class: "change", title: "difference from the published design" }, shown));
};

numbers.show = (isRest) => {
  const { columns, row, published, modes, published_modes: publishedModes, reason } = numbers.answer;
  const place = (name) => columns.indexOf(name);
  const status = row[place("status")], rowOf = (name) => {
    const { label, unit } = measureOf.get(name);
    return numberRow(name, label, unit, row[place(name)], published[place(name)]);
  };
  const stable = row[place("stable")];
  const known = MAIN_NUMBERS.filter((name) => measureOf.has(name) && row[place(name)] !== null);
  const motionRow = numberRow("status", "Motion", "", reason ?? `${status}${stable === null ? "" : stable ? ", stable" : ", not stable"}`, null);
  motionRow.classList.add("words");
  const publishedMode = (name) => publishedModes?.find((mode) => mode.name === name)?.frequency_hz ?? null;
  byId("main-numbers").replaceChildren(
    motionRow,
    ...known.map(rowOf),
    ...(modes ?? []).map(({ name, frequency_hz }) => numberRow(name, `Natural frequency, ${name.replace(/_/g, " ")}`, "Hz", frequency_hz, publishedMode(name))));
  byId("all-numbers").replaceChildren(...opened.measures.filter(({ name }) => place(name) >= 0).map(({ name }) => rowOf(name)));
  if (isRest) numbers.showSlopes();
};

/** Bars of the derivatives, the largest first. A bar leads to its parameter. */
numbers.showSlopes = () => {
  const { gradient, gradient_reason: reason } = numbers.answer, { label, unit } = measureOf.get(state.measure);
  byId("gradient-title").textContent = `What moves ${label.toLowerCase()}${unit ? ` (${unit} per %)` : " (per %)"}`;
  if (!gradient) { byId("gradient").textContent = reason ?? ""; return; }
  const shown = gradient.slice(0, MOST_SLOPES), largest = Math.abs(shown[0]?.per_percent ?? 1) || 1;
  byId("gradient").replaceChildren(...shown.map(({ parameter, per_percent: slope }) => {
    const bar = element("i", slope < 0 ? { class: "less" } : {});
    const half = 50 * Math.abs(slope) / largest;
    bar.style.cssText = slope < 0 ? `right: 50%; width: ${half}%` : `left: 50%; width: ${half}%`;
    const { label: name } = parameterOf.get(parameter);
    const button = element("button", { type: "button", class: "slope", title: `${name}: show the slider` },
      element("span", { class: "name" }, name), element("span", { class: "track" }, bar), element("span", { class: "value" }, digits(slope, 3)));
    button.onclick = () => panel.focus(parameter);
    return button;
  }));
};
