// @ts-check
// Texts and pictures to save: a grid file, a device, Python, PNG, SVG.

import { byId, download } from "../shared/dom.js";
import { FINE, family } from "./family.js";
import { request, ServerError } from "./server.js";
import { state } from "./state.js";

/** The text in the dialog and the name of its file; empty if the server has refused it. */
const saved = { name: "", text: "" };

/** Shows a text to save. */
const showText = async (/** @type {string} */ kind) => {
  const x = { ...state.x, n: FINE };
  const response = state.updown ? { x, updown: true } : { x, by: state.by };
  try {
    const view = kind === "device" ? {} : response;
    const answer = await request("save", { kind, design: state.design, ...view });
    if (!answer) return;
    Object.assign(saved, answer);
    byId("saved").textContent = saved.text;
  } catch (error) {
    if (!(error instanceof ServerError)) throw error;
    Object.assign(saved, { name: "", text: "" });
    byId("saved").textContent = error.text("\n");
  }
};

const save = async (/** @type {string | undefined} */ kind = "grid") => {
  if (kind === "png") download("family.png", await family.chart.png());
  else if (kind === "svg") download("family.svg", await family.chart.svg(), "image/svg+xml");
  else await showText(kind);
};

export const startSaving = () => {
  const dialog = byId("save-dialog");
  byId("save").onclick = () => {
    dialog.showModal();
    save("grid");
  };
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (dialog.querySelectorAll("[data-kind]"))) {
    button.onclick = () => save(button.dataset.kind);
  }
  byId("download").onclick = () => {
    if (saved.text) download(saved.name, saved.text);
  };
  byId("copy").onclick = async () => {
    if (!saved.text) return;
    await navigator.clipboard.writeText(saved.text);
    byId("copy").textContent = "Copied";
    setTimeout(() => {
      byId("copy").textContent = "Copy";
    }, 1500);
  };
};
