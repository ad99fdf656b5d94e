// @ts-check
// Controls of the page of results: views, columns, slices, filters.

import { byId, element } from "../shared/dom.js";
import { shortNumber } from "../shared/format.js";
import { columns, numberPlaces } from "./data.js";
import { addFilter, filterEvents, showFilters } from "./filters.js";
import { activeView, chooseMapAxes, chooseSlices, resetShown, shown, slicedParameters, sliceOf } from "./state.js";

/** @import { ResultsView } from "../types.d.ts" */

const SCALES = /** @type {const} */ (["x", "y", "color"]);
const MENUS = /** @type {const} */ (["kind", "x", "y", "by", "color", "best"]);
const VIEWS = /** @type {const} */ ([0, 1]);

/** The callback after a change: `isStep` is true if the back button undoes the change. */
export const controlEvents = { onChange: (/** @type {boolean} */ _isStep) => {} };

const changed = () => {
  showControls();
  controlEvents.onChange(true);
};

const fillMenus = () => {
  const option = (/** @type {number} */ place) => element("option", { value: String(place) }, columns[place].title);
  const all = [...columns.keys()];
  byId("x").append(...numberPlaces.map(option));
  byId("y").append(...numberPlaces.map(option));
  byId("by").append(element("option", { value: "" }, "one line"), ...all.map(option));
  byId("color").append(element("option", { value: "" }, "one colour"), ...all.map(option));
};

/** The menu of a slice. */
const sliceMenu = (/** @type {{ place: number, levels: number[] }} */ { place, levels }) => {
  const { name, title, words, factor } = columns[place];
  const text = (/** @type {number} */ level) => (words ? words[level] : shortNumber(level * factor));
  const options = levels.map((level, at) => element("option", { value: String(at) }, text(level)));
  const menu = element("select", { "data-column": name }, element("option", { value: "" }, "all"), ...options);
  menu.value = String(sliceOf(place) ?? "");
  menu.onchange = () => {
    shown.slices[place] = menu.value === "" ? null : Number(menu.value);
    controlEvents.onChange(true);
  };
  return element("label", {}, `${title} `, menu);
};

/** Hides the label of a control. */
const setHidden = (/** @type {string} */ id, /** @type {boolean} */ isHidden) => {
  const label = byId(id).parentElement;
  if (label) label.hidden = isHidden;
};

/** Shows the state of the active view in the controls. */
export const showControls = () => {
  const view = activeView();
  const isLine = view.kind === "line";
  for (const name of MENUS) byId(name).value = String(view[name] ?? "");
  for (const scale of SCALES) byId(`log-${scale}`).checked = view.log[scale];
  setHidden("by", !isLine);
  setHidden("color", isLine);
  setHidden("best", view.kind !== "scatter");
  setHidden("log-color", isLine);
  byId("two").setAttribute("aria-pressed", String(shown.two));
  byId("which").hidden = !shown.two;
  byId("charts").classList.toggle("two", shown.two);
  byId("chart-1").hidden = !shown.two;
  for (const i of VIEWS) {
    byId(`view-${i}`).setAttribute("aria-pressed", String(shown.active === i));
    byId(`chart-${i}`).classList.toggle("active", shown.two && shown.active === i);
  }
  const slices = slicedParameters.map(sliceMenu);
  byId("slices").replaceChildren(...(slices.length > 0 ? slices : ["no parameter with few values"]));
  showFilters();
};

/** Applies the choice in a menu. */
const choose = (/** @type {typeof MENUS[number]} */ name) => {
  const view = activeView();
  const { value } = byId(name);
  if (name === "kind") view.kind = /** @type {ResultsView["kind"]} */ (value);
  else if (name === "best") view.best = value;
  else if (name === "x" || name === "y") view[name] = Number(value);
  else view[name] = value === "" ? null : Number(value);
  view.zoom = { x: null, y: null };
  if (name === "kind" && view.kind === "map") chooseMapAxes(view);
  if (name === "kind" || name === "by") view.hidden = [];
  if (name !== "color" && name !== "best") chooseSlices();
  changed();
};

export const buildControls = () => {
  fillMenus();
  for (const name of MENUS) byId(name).onchange = () => choose(name);
  for (const scale of SCALES) {
    byId(`log-${scale}`).onchange = () => {
      const view = activeView();
      view.log[scale] = byId(`log-${scale}`).checked;
      view.zoom = { x: null, y: null };
      controlEvents.onChange(true);
    };
  }
  byId("add").onclick = addFilter;
  filterEvents.onChange = () => controlEvents.onChange(true);
  byId("two").onclick = () => {
    shown.two = !shown.two;
    shown.active = shown.two ? 1 : 0;
    changed();
  };
  for (const i of VIEWS) {
    byId(`view-${i}`).onclick = () => {
      shown.active = i;
      showControls();
    };
  }
  byId("controls").onsubmit = (event) => event.preventDefault();
  byId("controls").onreset = (event) => {
    event.preventDefault();
    resetShown();
    changed();
  };
};
