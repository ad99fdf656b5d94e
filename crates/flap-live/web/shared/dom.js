// @ts-check
// Elements of the page.

/** @import { PageElements } from "../types.d.ts" */

/**
 * The element with this id. The pages' HTML contains all of them.
 *
 * @template {string} I
 * @param {I} id
 * @returns {I extends keyof PageElements ? PageElements[I] : HTMLElement}
 */
export const byId = (id) => /** @type {any} */ (document.getElementById(id));

/**
 * A new element with attributes and contents. Contents are text or nodes, never markup.
 *
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} name
 * @param {Record<string, string | number | boolean>} attributes
 * @param {(string | Node)[]} contents
 * @returns {HTMLElementTagNameMap[K]}
 */
export const element = (name, attributes = {}, ...contents) => {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key in made && typeof value !== "string") Object.assign(made, { [key]: value });
    else made.setAttribute(key, String(value));
  }
  made.append(...contents);
  return made;
};

/**
 * A new element of SVG.
 *
 * @param {string} name
 * @param {Record<string, string | number>} attributes
 * @param {(string | Node)[]} contents
 */
export const svgElement = (name, attributes = {}, ...contents) => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  made.append(...contents);
  return made;
};

/**
 * Saves a text or a blob as a file.
 *
 * @param {string} name
 * @param {string | Blob} content
 */
export const download = (name, content, type = "text/plain") => {
  const blob = content instanceof Blob ? content : new Blob([content], { type });
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
};
