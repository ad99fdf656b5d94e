// @ts-check
// The rows that the page contains.

import { byId } from "../shared/dom.js";
import { decodedColumn } from "./columns.js";

/** @import { ResultsData } from "../types.d.ts" */

/** @type {ResultsData} */
export const results = JSON.parse(byId("data").textContent ?? "");
export const columns = results.columns.map(decodedColumn);

const places = new Map(columns.map((column, place) => [column.name, place]));

/** The place of the column with this name; undefined if there is none. */
export const placeOf = (/** @type {string} */ name) => places.get(name);

/** The column `status`; null if there is none. */
export const statusColumn = columns.find(({ name }) => name === "status") ?? null;
/** The column `branch` of responses; null if there is none. */
export const branchColumn = results.branch === null ? null : columns[results.branch];
/** Places of the columns with numbers. */
export const numberPlaces = columns.map((_, place) => place).filter((place) => !columns[place].words);
