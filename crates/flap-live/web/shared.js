// Small parts that both pages use.

const byId = (id) => document.getElementById(id);

/** A new element with attributes and contents; text stays text. */
const element = (name, attributes = {}, ...contents) => {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in made && typeof value !== "string") made[key] = value;
    else made.setAttribute(key, value);
  }
  made.append(...contents);
  return made;
};

/** The same for SVG. */
const drawn = (name, attributes = {}, ...contents) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...contents);
  return made;
};

/** A number with at most six digits. */
const shortNumber = (value) => {
  if (typeof value !== "number" || Number.isNaN(value)) return "none";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) return value.toExponential(3).replace(/\.?0+e/, "e");
  return String(Number(value.toPrecision(6)));
};

/** A number with so many digits. */
const digits = (value, count) => shortNumber(Number(value.toPrecision(count)));

/** A label with its unit. */
const titled = ({ label, unit }) => (unit ? `${label} (${unit})` : label);

/** The value of a variable of the style, in light or dark. */
const styleColour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/** The scheme of the system, but for pictures to save: those are light. */
const darkScheme = window.matchMedia("(prefers-color-scheme: dark)");
const isDark = () => darkScheme.matches && !document.documentElement.classList.contains("paper");

// Colours that differ for colour-blind readers too (Okabe and Ito), and viridis for many lines.
const FEW_COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const VIRIDIS = [[68, 1, 84], [72, 36, 117], [65, 68, 135], [53, 95, 141], [42, 120, 142], [33, 145, 140],
  [34, 168, 132], [68, 191, 112], [122, 209, 81], [189, 223, 38], [253, 231, 37]];
const viridis = (share) => {
  const place = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1);
  const low = Math.min(Math.floor(place), VIRIDIS.length - 2);
  return `rgb(${VIRIDIS[low].map((part, i) => Math.round(part + (VIRIDIS[low + 1][i] - part) * (place - low)))})`;
};
/** The shades that can be told from a light or dark ground: all have a contrast of 3 at least. */
const READABLE = { light: [0, 0.58], dark: [0.36, 1] };
/** The colour of line `index` of `count`: shades by value if there are many. */
const lineColour = (index, count) => {
  if (count <= FEW_COLOURS.length) return FEW_COLOURS[index];
  const [low, high] = isDark() ? READABLE.dark : READABLE.light;
  return viridis(low + (high - low) * index / (count - 1));
};

// Rows without a settled motion: each status has a shape, around the middle of a box of 10, and a grey.
const STATUS_MARKS = {
  subharmonic: { shape: "M-3 -3H3V3H-3Z", light: "#4a4f55", dark: "#d5d9de" },
  unsettled: { shape: "M-4 3.5H4L0 -3.5Z", light: "#7d848c", dark: "#a3aab2" },
  diverged: { shape: "M-4 -3L-3 -4L0 -1L3 -4L4 -3L1 0L4 3L3 4L0 1L-3 4L-4 3L-1 0Z", light: "#5d6670", dark: "#bcc3ca" },
  step_limit: { shape: "M0 -4.5L4.5 0L0 4.5L-4.5 0Z", light: "#9aa1a8", dark: "#868e97" },
  invalid: { shape: "M-4 -1.2H4V1.2H-4Z", light: "#b9bec4", dark: "#6a727b" },
  unstable: { shape: "M3.5 0A3.5 3.5 0 1 1 -3.5 0A3.5 3.5 0 1 1 3.5 0Z", light: "#8b9299", dark: "#959da5" },
};
/** The shape and the colour of a status. */
const statusMark = (status) => {
  const { shape, light, dark } = STATUS_MARKS[status] ?? STATUS_MARKS.unsettled;
  return { shape, color: isDark() ? dark : light };
};

/** Saves a text or a blob as a file. */
const download = (name, content, type = "text/plain") => {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};

// ---- The state in the address, behind the `#`: JSON, so that it can be shared and read. ----

const stateOfAddress = () => {
  try { return JSON.parse(decodeURIComponent(location.hash.slice(1))); } catch { return null; }
};
/** Writes the state into the address: as a step that the back button undoes, or in place of the last one. */
const writeAddress = (state, isStep) => {
  const hash = "#" + encodeURIComponent(JSON.stringify(state));
  if (hash === location.hash) return;
  history[isStep ? "pushState" : "replaceState"](null, "", hash);
};

/** Calls `work` once, `delay` after the last call. */
const settled = (work, delay) => {
  let timer = 0;
  return (...given) => { clearTimeout(timer); timer = setTimeout(() => work(...given), delay); };
};
