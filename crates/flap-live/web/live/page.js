// @ts-check
// The live page: its start, and the work after each change.

import { readAddress } from "../shared/address.js";
import { debounced } from "../shared/debounce.js";
import { byId } from "../shared/dom.js";
import { roundedNumber } from "../shared/format.js";
import { axisEvents, buildAxisControls, showAxisControls } from "./axis-controls.js";
import { setMessage } from "./banner.js";
import { areNumbersShown, requestNumbers } from "./design-numbers.js";
import {
  createFamilyChart,
  family,
  isFamilyFine,
  paintFamily,
  redrawFamily,
  requestCoarse,
  requestFine,
  showReadout,
} from "./family.js";
import { requestMotion, showMoment, startMotion } from "./motion.js";
import { opened } from "./opened.js";
import { buildPanel, panelEvents, showPanel } from "./panel.js";
import { addPin, showPins } from "./pins.js";
import { startSaving } from "./save-dialog.js";
import { connection } from "./server.js";
import { applyState, foreignPresetWarning, saveState, state } from "./state.js";
import { drawWing } from "./wing.js";

/** @import { Design, Mark } from "../types.d.ts" */

/** Times without a change, in milliseconds, after which the page is refined: while a slider moves, and after a change. */
const SLIDER_REST = 150;
const CHANGE_REST = 20;
/** Time that the pointer stays at a mark before its motion is shown, in milliseconds. */
const MARK_REST = 60;

/** Computes the fine family, the numbers and the motion of a design that rests. */
const refine = () => {
  if (family.isBusy) {
    refineLater();
    return;
  }
  saveState(true);
  requestFine();
  requestNumbers().then(() => {
    drawWing();
    showPins();
    if (family.answer) paintFamily();
  });
  requestMotion(state.design, "of the design");
};
const refineLater = debounced(refine, SLIDER_REST);
const refineSoon = debounced(refine, CHANGE_REST);

/** Draws a coarse family at once, and refines the page when the design rests. */
const update = (/** @type {boolean} */ isDone) => {
  drawWing();
  if (!state.updown) requestCoarse();
  if (isDone) refineSoon();
  else refineLater();
};

/** Shows the motion at a mark, or of the design if there is none. */
const showMarkMotion = debounced((/** @type {Mark | null} */ mark) => {
  if (!mark) {
    requestMotion(state.design, "of the design");
    return;
  }
  if (mark.row.status !== "periodic" || !family.answer) return;
  const { x, by } = family.answer.request;
  /** @type {Design} */
  const design = { ...family.answer.request.design, [x.name]: mark.row.x };
  if (by && mark.row.by !== null) design[by.name] = mark.row.by;
  const place = `at ${roundedNumber(mark.x, 5)} ${family.axes.x.unit}`;
  requestMotion(design, mark.name ? `${place}, ${mark.name}` : place, mark.row.begin);
}, MARK_REST);

/** Applies the state in the address, after a reload or the back button. */
const restore = () => {
  const found = readAddress();
  setMessage("address", foreignPresetWarning(found));
  applyState(found);
  showPanel();
  showAxisControls();
  showPins();
  update(true);
  // A foreign address may differ from the address of its state: refine() would add a step.
  saveState(false);
};

const showHeading = () => {
  // The heading may be the path of a file. Only the file's name is shown.
  const name = opened.title.split(/[\\/]/).pop() ?? "";
  Object.assign(byId("title"), { textContent: name, title: opened.title });
  document.title = name;
  const { doc, model, preset, version } = opened;
  byId("about").textContent = `${doc} · model ${model}, preset ${preset} · flap ${version}`;
};

const listen = () => {
  panelEvents.onChange = update;
  panelEvents.onRelease = refineSoon;
  axisEvents.onChange = () => update(true);
  axisEvents.onScale = () => {
    redrawFamily();
    saveState(true);
  };
  axisEvents.onUpDown = () => {
    family.earlier = [];
    refine();
  };
  connection.onLost = () => {
    const text = "The server does not answer. The page keeps its results and continues when the server is back.";
    setMessage("server", text);
  };
  connection.onReplaced = () =>
    setMessage("server", "Another server is running now: open the address that it printed.");
  connection.onRestored = () => {
    setMessage("server", "");
    update(true);
  };
  byId("pin").onclick = () => {
    addPin();
    saveState(true);
  };
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(".skip button"))) {
    button.onclick = () => {
      const target = document.querySelector(button.dataset.to ?? "");
      if (target instanceof HTMLElement) target.focus();
    };
  }
  addEventListener("popstate", restore);
};

const start = () => {
  showHeading();
  buildPanel();
  buildAxisControls();
  createFamilyChart({
    onPoint: (mark) => {
      showReadout(mark);
      showMarkMotion(mark);
    },
    onView: (view) => {
      state.view = view;
      saveState(true);
    },
    onHidden: (groups) => {
      state.hidden = groups;
      saveState(true);
    },
  });
  listen();
  byId("all").open = window.matchMedia("(min-width: 1181px)").matches;
  startSaving();
  startMotion();
  restore();
};

start();

window.flapTestHook = {
  charts: [family.chart],
  /** True if the picture and the numbers belong to the current design. */
  isSettled: () => isFamilyFine() && areNumbersShown(),
  /** The rows in the picture: { columns, rows }. */
  rows: () => family.answer,
  showMoment,
};
