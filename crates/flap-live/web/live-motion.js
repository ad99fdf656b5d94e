// The motion over a cycle: the wing from above and from its tip, and its signals over time.

const SAMPLES = 120;
/** Seconds that a cycle takes on the screen at full speed. */
const CYCLE = 0.6;
/** Charts of signals: those whose names begin so. */
const SIGNALS = [["Angles", "°", ["stroke_deg", "pitch_deg"]], ["Forces", "mN", ["lift_mn", "drag_mn"]],
  ["Power", "mW", ["power_mw"]], ["Current", "mA", ["current_ma", "current_1_ma", "current_2_ma"]]];

const hasMotion = opened.can.motion && !isVehicle;

const motion = { answer: null, charts: [], share: 0, last: 0, isPlaying: true, design: {} };

/** Asks for the motion of a design; `title` says which. */
motion.ask = async (design, title) => {
  if (!hasMotion) return;
  try {
    const answer = await server.ask("motion", { design, samples: SAMPLES });
    if (!answer) return;
    Object.assign(motion, { answer, design, signals: null });
    byId("motion-of").textContent = title;
    markOld("motion", "");
    motion.showSignals();
  } catch (error) {
    if (error.status === 0) return;
    const last = error.parameter ? "possible design" : "design with a settled motion";
    markOld("motion", motion.answer ? `This is the last ${last}.` : `There is no ${last} yet.`);
  }
};

/** A column of the motion by name; null if it has none. */
const signal = (name) => {
  const { columns, rows } = motion.answer, place = columns.indexOf(name);
  return place < 0 ? null : rows.map((row) => row[place]);
};

motion.showSignals = () => {
  const time = signal("time_s"), period = time[time.length - 1];
  const x = time.map((value) => value / period);
  motion.signals = Object.fromEntries(["stroke_deg", "pitch_deg", "lift_mn", "drag_mn"].map((name) => [name, signal(name)]));
  const shown = SIGNALS.map(([name, unit, columns]) => [name, unit, columns.filter((column) => signal(column) !== null)]).filter(([, , columns]) => columns.length > 0);
  if (motion.charts.length !== shown.length) {
    for (const chart of motion.charts) chart.destroy();
    byId("series").replaceChildren();
    byId("series").dataset.count = String(shown.length);
    motion.charts = shown.map(([name]) => {
      const place = element("div");
      byId("series").append(place);
      return new Chart(place, { height: 150, name });
    });
  }
  shown.forEach(([name, unit, columns], i) => motion.charts[i].draw({
    x: { label: "cycle", unit: "", log: false }, y: { label: name, unit, log: false },
    lines: columns.map((column, j) => ({ key: column, name: columns.length > 1 ? column.replace(/_(deg|mn|mw|ma)$/, "").replace(/_/g, " ") : "", color: FEW_COLOURS[j], x, y: signal(column), width: 1.5 })),
  }));
  motion.trails = trailing(motion.signals);
};

/** 1 if the pitch is positive while the stroke rises, else -1: the trailing edge follows the leading edge. */
const trailing = ({ stroke_deg: stroke, pitch_deg: pitch }) => {
  let sum = 0;
  for (let i = 1; i < stroke.length; i++) sum += pitch[i] * (stroke[i] - stroke[i - 1]);
  return sum < 0 ? -1 : 1;
};

/** A canvas with one unit per pixel of the page. */
const penOf = (canvas) => {
  const ratio = window.devicePixelRatio || 1, [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio)) { canvas.width = Math.round(width * ratio); canvas.height = Math.round(height * ratio); }
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return { pen, width, height };
};

const arrow = (pen, x, y, dx, dy, color) => {
  const size = Math.hypot(dx, dy);
  if (size < 3) return;
  const [ux, uy] = [dx / size, dy / size];
  pen.strokeStyle = pen.fillStyle = color;
  pen.lineWidth = 2.5;
  pen.beginPath(); pen.moveTo(x, y); pen.lineTo(x + dx, y + dy); pen.stroke();
  pen.beginPath(); pen.moveTo(x + dx + 4 * ux, y + dy + 4 * uy);
  pen.lineTo(x + dx - 6 * ux - 4 * uy, y + dy - 6 * uy + 4 * ux); pen.lineTo(x + dx - 6 * ux + 4 * uy, y + dy - 6 * uy - 4 * ux); pen.fill();
};

/** The values of the signals at a share of the cycle. */
const instant = (share) => {
  const place = share * SAMPLES, low = Math.min(Math.floor(place), SAMPLES - 1), part = place - low;
  const at = (list) => (list ? list[low] * (1 - part) + list[low + 1] * part : 0);
  return Object.fromEntries(Object.entries(motion.signals).map(([name, list]) => [name, at(list)]));
};

const paintAbove = (now, wing) => {
  const { pen, width, height } = penOf(byId("above"));
  const scale = Math.min(width * 0.8, height * 0.95) / (wing.length + wing.offset) * 0.62;
  const [rootX, rootY] = [width / 2, height * 0.9];
  const angle = now.stroke_deg * Math.PI / 180, lean = Math.sin(now.pitch_deg * Math.PI / 180) * motion.trails;
  const [alongX, alongY] = [Math.sin(angle), -Math.cos(angle)];
  const all = motion.signals.stroke_deg, reach = (wing.length + wing.offset) * scale;
  const [least, most] = [Math.min(...all), Math.max(...all)].map((degrees) => (degrees - 90) * Math.PI / 180);
  pen.fillStyle = styleColour("--panel");
  pen.beginPath(); pen.moveTo(rootX, rootY); pen.arc(rootX, rootY, reach, least, most); pen.fill();
  pen.beginPath();
  outline(wing).forEach(([span, chord], i) => {
    // The chord seen from above is its share across the stroke plane.
    const across = chord * lean * scale;
    const [x, y] = [rootX + span * scale * alongX - across * alongY, rootY + span * scale * alongY + across * alongX];
    if (i) pen.lineTo(x, y); else pen.moveTo(x, y);
  });
  pen.closePath();
  pen.globalAlpha = 0.35; pen.fillStyle = styleColour("--accent"); pen.fill(); pen.globalAlpha = 1;
  pen.strokeStyle = styleColour("--accent"); pen.lineWidth = 1.5; pen.stroke();
  pen.strokeStyle = styleColour("--ink"); pen.lineWidth = 2.5;
  pen.beginPath(); pen.moveTo(rootX, rootY); pen.lineTo(rootX + reach * alongX, rootY + reach * alongY); pen.stroke();
  caption("above-caption", `from above · stroke ${now.stroke_deg.toFixed(0)}°`);
};

/** Writes below a picture, if it is something new. */
const caption = (id, words) => { if (byId(id).textContent !== words) byId(id).textContent = words; };

const paintTip = (now, wing) => {
  const { pen, width, height } = penOf(byId("tip-view"));
  const all = motion.signals.stroke_deg, widest = Math.max(...all.map(Math.abs), 1);
  const x = width / 2 + (now.stroke_deg / widest) * width * 0.33, y = height * 0.36;
  const size = height * 0.34, lean = now.pitch_deg * Math.PI / 180;
  const [endX, endY] = [x - Math.sin(lean) * motion.trails * size, y + Math.cos(lean) * size];
  pen.strokeStyle = styleColour("--line"); pen.lineWidth = 1;
  pen.beginPath(); pen.moveTo(width * 0.12, y); pen.lineTo(width * 0.88, y); pen.stroke();
  pen.strokeStyle = styleColour("--accent"); pen.lineWidth = 4; pen.lineCap = "round";
  pen.beginPath(); pen.moveTo(x, y); pen.lineTo(endX, endY); pen.stroke();
  pen.fillStyle = styleColour("--ink"); pen.beginPath(); pen.arc(x, y, 5, 0, 7); pen.fill();
  const forces = ["lift_mn", "drag_mn"].map((name) => motion.signals[name] ?? [0]);
  const strongest = Math.max(...forces.flat().map(Math.abs), 1e-9);
  const [middleX, middleY] = [(x + endX) / 2, (y + endY) / 2], unit = height * 0.42 / strongest;
  arrow(pen, middleX, middleY, 0, -now.lift_mn * unit, "#009e73");
  if (motion.signals.drag_mn) arrow(pen, middleX, middleY, now.drag_mn * unit * dragSign(), 0, "#d55e00");
  caption("tip-caption", `from the tip · pitch ${now.pitch_deg.toFixed(0)}°`);
};

/** The sign with which drag points against the motion. */
const dragSign = () => {
  const { stroke_deg: stroke, drag_mn: drag } = motion.signals;
  let sum = 0;
  for (let i = 1; i < stroke.length; i++) sum += drag[i] * (stroke[i] - stroke[i - 1]);
  return sum > 0 ? -1 : 1;
};

motion.frame = (now) => {
  const passed = Math.min(now - motion.last, 100);
  motion.last = now;
  if (motion.answer && motion.signals) {
    if (motion.isPlaying) motion.share = (motion.share + passed / 1000 * Number(byId("speed").value) / CYCLE) % 1;
    const values = instant(motion.share), wing = wingShape(motion.design) ?? { length: 1, offset: 0, chord: () => 0.25, axis: 0.25 };
    paintAbove(values, wing);
    paintTip(values, wing);
    for (const chart of motion.charts) chart.setTime(motion.share);
  }
  requestAnimationFrame(motion.frame);
};

motion.start = () => {
  if (!hasMotion) {
    byId("motion").classList.add("without");
    byId("motion-of").textContent = `There is no single motion to show${isVehicle ? ": the numbers are those of several wings" : ""}.`;
    return;
  }
  const button = byId("play");
  const show = () => { button.textContent = motion.isPlaying ? "Pause" : "Play"; };
  motion.isPlaying = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  button.onclick = () => { motion.isPlaying = !motion.isPlaying; show(); };
  show();
  requestAnimationFrame(motion.frame);
};
