// A small picture of the wing, to scale with its measures.

const WING_VIEW = { width: 280, height: 92, left: 24, across: 235 };

/** The first of some parameters that has a number. */
const firstNumber = (design, names) => {
  for (const name of names) {
    const value = parameterOf.has(name) ? valueIn(design, name) : null;
    if (isNumber(value)) return value;
  }
  return null;
};

/** Length, offset and chord along the span (0 to 1) of a design's wing, in metres; null if the model does not tell. */
const wingShape = (design) => {
  const length = firstNumber(design, ["wing_length"]);
  if (!length) return null;
  const offset = firstNumber(design, ["wing_offset"]) ?? 0;
  const area = firstNumber(design, ["wing_area"]);
  const mean = firstNumber(design, ["mean_chord"]) ?? (area === null ? null : area / length);
  const root = firstNumber(design, ["root_chord"]);
  const number = (name) => firstNumber(design, [name]) ?? 0;
  let chord = (share) => (mean ?? length / 4) * 1.25 * Math.sqrt(Math.max(1 - share ** 4, 0)) ;
  if (root !== null) chord = (share) => root * [0, 1, 2, 3, 4].reduce((sum, power) => sum + number(`chord_term_${power}`) * share ** power, 0);
  if (parameterOf.has("chord_table") && valueIn(design, "chord_table") !== "off") {
    chord = (share) => { const place = Math.min(Math.floor(share * 10), 9), part = share * 10 - place; return number(`chord_${place}`) * (1 - part) + number(`chord_${place + 1}`) * part; };
  }
  return { length, offset, chord, axis: firstNumber(design, ["axis_position"]) ?? 0.1 };
};

/** Points of the outline in metres: along the leading edge, then back along the trailing edge. */
const outline = ({ length, offset, chord, axis }) => {
  const shares = Array.from({ length: 41 }, (_, i) => i / 40);
  const ahead = shares.map((share) => [offset + share * length, axis * Math.max(chord(share), 0)]);
  const behind = shares.map((share) => [offset + share * length, -(1 - axis) * Math.max(chord(share), 0)]);
  return [...ahead, ...behind.reverse()];
};

const drawWing = () => {
  const wing = wingShape(state.design);
  byId("wing").hidden = wing === null;
  if (wing === null) return;
  const original = wingShape({}) ?? wing;
  const { width, height, left, across } = WING_VIEW;
  const widest = Math.max(...[original, wing].flatMap((shape) => outline(shape).map(([, y]) => Math.abs(y))));
  const scale = Math.min(across / Math.max(original.length + original.offset, wing.length + wing.offset), 54 / widest);
  const path = (shape) => outline(shape).map(([x, y], i) => `${i ? "L" : "M"}${(left + x * scale).toFixed(1)} ${(22 - y * scale).toFixed(1)}`).join("") + "Z";
  const picture = drawn("svg", { viewBox: `0 0 ${width} ${height}` },
    drawn("path", { d: path(original), fill: "none", stroke: "var(--soft)", "stroke-dasharray": "3 3" }),
    drawn("path", { d: path(wing), fill: "var(--accent)", "fill-opacity": 0.25, stroke: "var(--accent)", "stroke-width": 1.5 }),
    drawn("line", { x1: left, x2: left + (wing.offset + wing.length) * scale, y1: 22, y2: 22, stroke: "var(--ink)", "stroke-dasharray": "6 3" }),
    drawn("circle", { cx: left, cy: 22, r: 4, fill: "var(--ink)" }),
    drawn("text", { x: width, y: height - 4, "text-anchor": "end", "font-size": 11, fill: "var(--soft)" }, `${shortNumber(Number((wing.length * 1e3).toPrecision(4)))} mm; dashed: as opened`));
  byId("wing").replaceChildren(picture);
};
