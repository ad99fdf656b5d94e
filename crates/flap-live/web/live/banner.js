// @ts-check
// Messages above the page, and notes on parts that show an earlier design.

import { byId } from "../shared/dom.js";

/** Messages by their reason; the reasons are in the order of display. */
const messages = { server: "", address: "", error: "", far: "" };

/**
 * Sets the message for a reason; an empty text removes it.
 *
 * @param {keyof typeof messages} reason
 * @param {string} text
 */
export const setMessage = (reason, text) => {
  messages[reason] = text;
  const all = Object.values(messages).filter(Boolean);
  byId("banner").hidden = all.length === 0;
  byId("banner").textContent = all.join(" · ");
};

/**
 * Marks a part of the page as showing an earlier design, with a note. An empty note removes the mark.
 *
 * @param {"numbers" | "motion"} part
 * @param {string} text
 */
export const setStaleNote = (part, text) => {
  byId(part).classList.toggle("old", Boolean(text));
  const note = /** @type {HTMLElement} */ (byId(part).querySelector(".old-note"));
  note.hidden = !text;
  if (note.textContent !== text) note.textContent = text;
};
