// @ts-check
// Filters: a column, and two bounds, each with a text field and a slider. Bounds do not cross.

import { byId, element } from "../shared/dom.js";
import { shortNumber } from "../shared/format.js";
import { typedNumber } from "../shared/typed-number.js";
import { boundAtCells } from "./columns.js";
import { columns, numberPlaces } from "./data.js";
import { activeView, saveShown, shown } from "./state.js";

/** @import { Filter } from "../types.d.ts" */

/** Steps of a slider. */
const STEPS = 1000;

export const filterEvents = {
  /** Called after a filter was removed or has another column. */
  onChange: () => {},
  /** Called while a bound moves. */
  onMove: () => {},
};

/** A filter that keeps all rows. */
const openFilter = (/** @type {number} */ place) => {
  const [low, high] = columns[place].extent ?? [0, 1];
  return { place, low, high };
};

/** Adds a filter for the measure of the active view. */
export const addFilter = () => {
  shown.filters.push(openFilter(activeView().y));
  showFilters();
  filterEvents.onChange();
  byId("filters").lastElementChild?.querySelector("select")?.focus();
};

/** The menu of a filter's column. */
const columnMenu = (/** @type {Filter} */ filter, /** @type {number} */ number) => {
  const options = numberPlaces.map((place) => element("option", { value: String(place) }, columns[place].title));
  const menu = element("select", { "aria-label": "Column of the filter" }, ...options);
  menu.value = String(filter.place);
  menu.onchange = () => {
    shown.filters[number] = openFilter(Number(menu.value));
    showFilters();
    filterEvents.onChange();
  };
  return menu;
};

const filterRow = (/** @type {Filter} */ filter, /** @type {number} */ number) => {
  const { title, unit, factor, extent } = columns[filter.place];
  const [least, most] = extent ?? [0, 1];
  const problemText = element("p", { class: "problem", role: "alert", hidden: true });
  /** @type {(() => void)[]} */
  const writers = [];
  const write = () => {
    for (const writer of writers) writer();
  };
  const set = (/** @type {"low" | "high"} */ side, /** @type {number} */ value) => {
    filter[side] = side === "low" ? Math.min(value, filter.high) : Math.max(value, filter.low);
    write();
    filterEvents.onMove();
  };
  /** The field and the slider of a bound. */
  const bound = (/** @type {"low" | "high"} */ side, /** @type {string} */ words) => {
    const label = `${title}, ${words}`;
    const field = element("input", { inputmode: "decimal", "aria-label": label });
    const range = { type: "range", min: "0", max: String(STEPS), step: "1" };
    const slider = element("input", { ...range, "aria-label": `${label}, slider` });
    writers.push(() => {
      field.value = shortNumber(filter[side] * factor);
      slider.value = String((STEPS * (filter[side] - least)) / (most - least || 1));
    });
    field.onchange = () => {
      const isEmpty = field.value.trim() === "";
      const { number: typed = null, problem = "" } = isEmpty ? {} : typedNumber(field.value, unit);
      field.setAttribute("aria-invalid", String(problem !== ""));
      problemText.textContent = problem;
      problemText.hidden = problem === "";
      if (problem !== "") return;
      if (typed === null) write();
      else set(side, boundAtCells(columns[filter.place], side, typed / factor));
      saveShown(true);
    };
    slider.oninput = () => {
      // At its ends, a slider selects exactly the smallest and the largest value.
      const at = Number(slider.value);
      const inside = least + (at / STEPS) * (most - least);
      set(side, at === 0 ? least : at === STEPS ? most : inside);
    };
    slider.onchange = () => saveShown(true);
    return { field, slider };
  };
  const [low, high] = [bound("low", "at least"), bound("high", "at most")];
  const remove = element("button", { type: "button" }, "Remove");
  remove.onclick = () => {
    shown.filters.splice(number, 1);
    showFilters();
    filterEvents.onChange();
    byId("add").focus();
  };
  write();
  const fields = element("div", { class: "bounds" }, low.field, high.field);
  const parts = [columnMenu(filter, number), fields, problemText, low.slider, high.slider, remove];
  return element("div", { class: "filter" }, ...parts);
};

export const showFilters = () => byId("filters").replaceChildren(...shown.filters.map(filterRow));
