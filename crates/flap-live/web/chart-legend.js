// The legend of a chart: shades, names of colours, lines that it switches, and statuses apart from them.

/** A mark of a status: its shape in its grey. */
const statusSwatch = ({ shape, color }) =>
  drawn("svg", { viewBox: "-5 -5 10 10", width: 10, height: 10, "aria-hidden": "true" }, drawn("path", { d: shape, fill: color }));

const colourSwatch = (color) => {
  const swatch = element("i");
  swatch.style.background = color;
  return swatch;
};

/** Lines with one entry for each group: lines of a group are switched together. */
const groupedLines = (lines) => {
  const groups = new Map();
  for (const line of lines) if (line.name && !line.ghost && !groups.has(groupOf(line))) groups.set(groupOf(line), line);
  return [...groups.values()];
};
const groupOf = (line) => line.group ?? line.key;

const writeLegend = (chart) => {
  const { lines, title, legend = [], bar, statuses = [] } = chart.scene, entries = groupedLines(lines);
  const text = JSON.stringify([entries.map((line) => [groupOf(line), line.name, line.color, chart.hidden.has(groupOf(line))]), title, legend, bar, statuses]);
  if (text === chart.legendText) return;
  chart.legendText = text;
  const held = chart.legend.contains(document.activeElement) ? document.activeElement.dataset.group : null;
  const shades = [];
  if (bar) {
    const ramp = element("b");
    ramp.style.background = `linear-gradient(to right, ${Array.from({ length: 11 }, (_, i) => viridis(i / 10))})`;
    shades.push(element("span", { class: "shades" }, titled(bar), " ", shortNumber(bar.low), ramp, shortNumber(bar.high), bar.log ? " (log)" : ""));
  }
  const fixed = legend.map(({ name, color }) => element("span", {}, colourSwatch(color), name));
  const switches = entries.map((line) => {
    const group = groupOf(line), isShown = !chart.hidden.has(group);
    const button = element("button", { type: "button", "aria-pressed": String(isShown), "data-group": group }, colourSwatch(line.color), line.name);
    button.onclick = () => {
      if (!chart.hidden.delete(group)) chart.hidden.add(group);
      chart.draw(chart.scene);
      chart.options.onHidden?.([...chart.hidden]);
    };
    return button;
  });
  const heading = title && switches.length > 0 ? [element("span", { class: "of" }, `${title}:`)] : [];
  const apart = statuses.length > 0 ? [element("div", { class: "statuses" }, ...statuses.map((status) => element("span", {}, statusSwatch(status), status.name)))] : [];
  chart.legend.replaceChildren(...shades, ...fixed, ...heading, ...switches, ...apart);
  if (held !== null) [...chart.legend.querySelectorAll("button")].find((button) => button.dataset.group === held)?.focus();
};

/** The entries of the legend of a picture: { name, colors } or, for statuses, { name, color, shape }. */
const pictureEntries = ({ scene, hidden }) => {
  const { lines, title, legend = [], bar, statuses = [] } = scene;
  const shadesOf = () => Array.from({ length: 11 }, (_, i) => viridis(i / 10));
  const shades = bar ? [{ name: `${titled(bar)} from ${shortNumber(bar.low)} to ${shortNumber(bar.high)}${bar.log ? " (log)" : ""}`, colors: shadesOf() }] : [];
  const shown = groupedLines(lines).filter((line) => !hidden.has(groupOf(line)));
  const heading = title && shown.length > 0 ? [{ name: `${title}:`, colors: [] }] : [];
  const coloured = [...legend, ...shown.map(({ name, color }) => ({ name, color }))].map(({ name, color }) => ({ name, colors: [color] }));
  return [...shades, ...coloured.slice(0, legend.length), ...heading, ...coloured.slice(legend.length), ...statuses];
};
