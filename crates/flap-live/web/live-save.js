// Texts and pictures to save: a grid file, a device, Python, PNG, SVG.

const saving = { name: "", text: "" };

saving.ask = async (kind) => {
  if (kind === "png") return download("family.png", await family.chart.png());
  if (kind === "svg") return download("family.svg", await family.chart.svg(), "image/svg+xml");
  const along = { x: { ...state.x, n: FINE } };
  const view = kind === "device" ? {} : state.updown ? { ...along, updown: true } : { ...along, by: state.by };
  try {
    Object.assign(saving, await server.ask("save", { kind, design: state.design, ...view }));
    byId("saved").textContent = saving.text;
  } catch (error) {
    Object.assign(saving, { name: "", text: "" });
    byId("saved").textContent = [error.message, error.help].filter(Boolean).join("\n");
  }
};

saving.start = () => {
  const dialog = byId("save-dialog");
  byId("save").onclick = () => { dialog.showModal(); saving.ask("grid"); };
  for (const button of dialog.querySelectorAll("[data-kind]")) button.onclick = () => saving.ask(button.dataset.kind);
  byId("download").onclick = () => { if (saving.text) download(saving.name, saving.text); };
  byId("copy").onclick = async () => {
    await navigator.clipboard.writeText(saving.text);
    byId("copy").textContent = "Copied";
    setTimeout(() => { byId("copy").textContent = "Copy"; }, 1500);
  };
};
