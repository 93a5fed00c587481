"use strict";
/* The diagrams of a limit. */

for (const row of data.rows) row.unlimited.forEach((name) => { row[name] = "none"; });
const blames = data.blame.filter((one) => one.force === null); /* the suggestion is about a force */
const modes = Object.fromEntries(["real", "imaginary", "frequency", "decay"]
  .map((name) => [name, data.modes.map((mode) => mode[name])]));
const modeCount = data.modes.length;
const rowOf = (method) => data.rows.find((row) => row.method === method);
const POINT = "#1c2126";
const pale = (colour) => colour + "1a";

/* ---- stability ---- */

/* Steps to show: that of the scene, and the known limits. */
function findSteps() {
  const list = [];
  if (data.step !== null) list.push({ key: "scene", label: "step of the scene", step: data.step });
  for (const row of data.rows) {
    if (row.predicted > 0) list.push({ key: row.method, label: `limit of ${row.method}`, step: row.predicted });
  }
  if (list.length === 0 && data.frequency_max > 0)
    list.push({ key: "radian", label: "one radian of the fastest motion", step: 1 / data.frequency_max });
  return list;
}
const steps = findSteps();

const pairs = (flat) => Array.from({ length: flat.length / 2 }, (_, k) => ({ x: flat[2 * k], y: flat[2 * k + 1] }));

function region(method, points) {
  return { label: method, role: "region", data: points, borderColor: colourOf(method),
    backgroundColor: pale(colourOf(method)), borderWidth: 2, fill: "shape", pointRadius: 0, pointHitRadius: 0,
    pointStyle: "line", order: 3 };
}

const mirrored = (points) => [...points, ...[...points].reverse().map(({ x, y }) => ({ x, y: -y }))];
const fromOrigin = (points) => [{ x: 0, y: 0 }, ...points, { x: 0, y: 0 }];

/* Points of modes, with crosses at the edge for those outside. */
function pointsOf(list) {
  const look = { showLine: false, borderColor: POINT, backgroundColor: POINT, order: 1, data: [] };
  return [{ ...look, label: "modes of the scene", pointStyle: "circle",
    pointRadius: modeCount > 100 ? 2 : 3.2, pointHoverRadius: 6, list },
    { ...look, label: "", pointStyle: "crossRot", pointRadius: 6, pointHoverRadius: 8, pointBorderWidth: 2, list }];
}

function place(chart, { min: left, max: right }, { min: bottom, max: top }) {
  const sets = chart.data.datasets.filter((set) => set.list);
  const beyond = ({ x, y }) => x < left || x > right || y < bottom || y > top;
  if (sets.length === 0) return;
  const [inside, edge] = sets, across = (value, low, high) => Math.min(Math.max(value, low), high);
  inside.data = inside.list.filter((point) => !beyond(point));
  edge.data = edge.list.filter(beyond).map((point) =>
    ({ ...point, x: across(point.x, left, right), y: across(point.y, bottom, top) }));
}

function describeMode(item) {
  const k = item.raw.mode, frequency = modes.frequency[k], decay = modes.decay[k];
  const swing = modes.imaginary[k];
  return [`\u03bb = ${words(modes.real[k], 5)}${swing === 0 ? "" : ` \u00b1 ${words(swing, 5)} i`} 1/s`,
    `frequency ${words(frequency, 5)} rad/s, damping ${words(decay, 5)} 1/s`,
    frequency > 0 ? `${words(decay / frequency)} of critical damping` : "nothing draws it back"];
}

function drawPlane(h) {
  const list = [];
  for (let k = 0; k < modeCount; k++) {
    const x = h * modes.real[k], y = h * modes.imaginary[k];
    list.push({ x, y, mode: k });
    if (y !== 0) list.push({ x, y: -y, mode: k });
  }
  const regions = data.rows.filter((row) => row.region)
    .map((row) => region(row.method, mirrored(pairs(row.region))));
  const chart = drawEqual("plane", [...regions, ...pointsOf(list)], ["real part of h \u03bb", "imaginary part of h \u03bb"],
    { left: -3.6, right: 0.6, bottom: -3.1, top: 3.1 }, describeMode, place);
  chart.canvas.dataset.regions = regions.length;
}

function drawReach(h) {
  const list = Array.from({ length: modeCount }, (_, k) =>
    ({ x: h * modes.frequency[k], y: h * modes.decay[k], mode: k }));
  const regions = data.rows.filter((row) => row.reach)
    .map((row) => region(row.method, fromOrigin(pairs(row.reach))));
  const critical = { label: "critical damping", role: "critical", data: [{ x: 0, y: 0 }, { x: 100, y: 100 }],
    borderColor: "#6b7680", backgroundColor: "#6b7680", borderWidth: 1.5, borderDash: [7, 4], pointRadius: 0,
    pointHitRadius: 0, pointStyle: "line", order: 2 };
  const chart = drawEqual("reach", [...regions, critical, ...pointsOf(list)],
    ["h \u03c9, step times frequency", "h d, step times damping"],
    { left: -0.1, right: 3.2, bottom: -0.1, top: 3.2 }, describeMode, place);
  chart.canvas.dataset.regions = regions.length;
}

/* Prediction for a step: "stable", "grows", just at the "limit", or "open" if they leave it open. */
function judge(row, h) {
  if (row.predicted === "none") return "stable";
  if (row.predicted === null) return "open";
  if (h === row.predicted) return row.exact ? "limit" : "open";
  if (h > row.predicted) return "grows";
  return row.exact || h <= row.bound ? "stable" : "open";
}

function drawStability(key) {
  const { step } = steps.find((one) => one.key === key);
  const named = (verdict) => data.rows.filter((row) => judge(row, step) === verdict).map((row) => row.method).join(", ");
  const says = [["stable", "stable by"], ["limit", "just at the limit of"], ["open", "not decided for"],
    ["grows", "blows up by"]]
    .filter(([verdict]) => named(verdict) !== "").map(([verdict, text]) => `${text} ${named(verdict)}`);
  document.getElementById("stepped").textContent = `With h = ${words(step, 6)} s: ${says.join("; ")}.`;
  drawPlane(step);
  drawReach(step);
}

/* ---- the scene ---- */

const picture = data.picture;
const moving = picture.move.length > 0;
const MOST_ARROWS = 300, MOST_DISPLACED = 200, MOST_DOTS = 400;
const blameOf = new Map(blames.map((one) => [one.number, one]));
const topShare = blames.length > 0 ? blames[0].share : 0;
const coordinate = (particle, axis) => picture.position[3 * particle + axis];
const moveOf = (particle, axis) => (moving ? picture.move[3 * particle + axis] : 0);
const particles = picture.particle.map((_, k) => k);
const sizes = particles.map((k) => Math.hypot(moveOf(k, 0), moveOf(k, 1), moveOf(k, 2)));
const movers = particles.filter((k) => sizes[k] > 0.02).sort((a, b) => sizes[b] - sizes[a]);
const listed = springsOf(picture).map((spring) => ({ ...spring, blame: blameOf.get(spring.number) }));
const isBlamed = (spring) => spring.blame !== undefined && spring.blame.share > 0.01 * topShare;

/* From sand to red. */
function shareColour(share) {
  const t = topShare > 0 ? Math.sqrt(share / topShare) : 0, from = [232, 196, 120], to = [176, 0, 32];
  return "#" + from.map((f, i) => Math.round(f + t * (to[i] - f)).toString(16).padStart(2, "0")).join("");
}

const extentOf = (list, axis) => extentBy(list, (k) => coordinate(k, axis));
const lengthOf = (axis) => { const [low, high] = extentOf(particles, axis); return high - low; };

/* The two longest axes; where the mode hardly moves along these, the longest and the one of most motion. */
function firstView() {
  const by = (length) => [0, 1, 2].sort((a, b) => length(b) - length(a));
  const motion = (axis) => particles.reduce((sum, k) => sum + moveOf(k, axis) ** 2, 0);
  const [long, second] = by(lengthOf);
  const seen = motion(long) + motion(second), most = by(motion).find((axis) => axis !== long);
  const chosen = moving && seen < 0.1 * [0, 1, 2].reduce((sum, axis) => sum + motion(axis), 0) ? most : second;
  return viewWith(long, chosen);
}

const looking = { view: null, zoom: "all" };

const longestBlamed = () => Math.max(0, ...listed.filter(isBlamed).map(({ ends: [a, b] }) =>
  Math.hypot(...[0, 1, 2].map((axis) => coordinate(a, axis) - coordinate(b, axis)))));

/* The visible range, and the length of the longest arrow. */
function frameOf([across, up]) {
  const near = looking.zoom === "mode" ? movers.filter((k) => sizes[k] > 0.4) : particles;
  const [left, right] = extentOf(near, across), [bottom, top] = extentOf(near, up);
  const size = Math.max(right - left, top - bottom) || longestBlamed() || 1;
  const room = (looking.zoom === "mode" ? 0.35 : 0.14) * size;
  return { arrow: Math.min(0.12 * (size + room), longestBlamed() || Infinity),
    box: { left: left - room, right: right + room, bottom: bottom - room, top: top + room } };
}

/* Arrows over everything else, from the position of a particle to its displaced position in the mode. */
const arrows = {
  id: "arrows",
  afterDatasetsDraw(chart) {
    const { ctx, chartArea: { left, top, right, bottom }, scales: { x, y } } = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, right - left, bottom - top);
    ctx.clip();
    ctx.strokeStyle = ctx.fillStyle = "#0057b8";
    ctx.lineWidth = 2;
    for (const [from, to] of chart.options.arrows || []) {
      const [a, b, c, d] = [x.getPixelForValue(from.x), y.getPixelForValue(from.y), x.getPixelForValue(to.x),
        y.getPixelForValue(to.y)];
      const length = Math.hypot(c - a, d - b), head = Math.min(9, 0.6 * length);
      if (length < 1) continue;
      const ux = (c - a) / length, uy = (d - b) / length;
      ctx.beginPath();
      ctx.moveTo(a, b);
      ctx.lineTo(c - 0.7 * head * ux, d - 0.7 * head * uy);
      ctx.stroke();
      ctx.beginPath();
      ctx.moveTo(c, d);
      ctx.lineTo(c - head * ux + 0.5 * head * uy, d - head * uy - 0.5 * head * ux);
      ctx.lineTo(c - head * ux - 0.5 * head * uy, d - head * uy + 0.5 * head * ux);
      ctx.fill();
    }
    ctx.restore();
  },
};
Chart.register(arrows);

function describePlace(item) {
  const { spring, particle } = item.raw;
  if (spring && spring.blame) return describeBlame(spring.blame);
  if (particle === undefined) return "";
  const where = AXES.map((name, axis) => `${name} ${words(coordinate(particle, axis), 5)}`).join(", ");
  return [`particle ${picture.particle[particle]} at ${where} m`,
    picture.held[particle] ? "held" : `moves ${AXES.map((_, axis) => words(moveOf(particle, axis))).join(", ")}`];
}

function drawPicture() {
  const view = VIEWS[looking.view], [across, up] = view, { arrow, box } = frameOf(view);
  const at = (k) => ({ x: coordinate(k, across), y: coordinate(k, up) });
  const moved = (k) => ({ x: at(k).x + arrow * moveOf(k, across), y: at(k).y + arrow * moveOf(k, up) });
  const blamed = listed.filter(isBlamed), others = listed.filter((spring) => !isBlamed(spring));
  const displaced = listed.length > MOST_DISPLACED ? []
    : listed.filter(({ ends }) => ends.some((end) => sizes[end] > 0.02));
  const colours = blamed.flatMap(({ blame }) => Array(3).fill(shareColour(blame.share)));
  const shown = movers.slice(0, MOST_ARROWS), held = particles.filter((k) => picture.held[k]);
  const dots = (label, list, look) => ({ label, showLine: false, data: list.map((k) => ({ ...at(k), particle: k })),
    order: 1, ...look });
  const lines = [
    lineOf(others, at, { label: "springs", role: "springs", borderColor: "#8a949e", backgroundColor: "#8a949e",
      borderWidth: listed.length > MOST_DISPLACED ? 0.7 : 1.5, pointStyle: "line", order: 5 }),
    lineOf(displaced, moved, { label: "moved by the mode", role: "displaced", borderColor: "#7fb2e5",
      backgroundColor: "#7fb2e5", borderWidth: 1, borderDash: [4, 3], pointStyle: "line", order: 4 }),
    lineOf(blamed, at, { label: "springs to blame, the redder the more", role: "blamed", borderColor: "#b00020",
      backgroundColor: "#b00020", borderWidth: 4, pointStyle: "line", pointRadius: 2.5, pointHitRadius: 8,
      pointBorderColor: colours, pointBackgroundColor: colours, order: 2,
      segment: { borderColor: (context) => colours[context.p0DataIndex] } }),
    dots("particles that move", shown, { borderColor: "#0057b8", backgroundColor: "#0057b8",
      pointStyle: "circle",
      pointRadius: shown.length > 100 ? 2 : 3.5 }),
    dots("", particles.length > MOST_DOTS ? [] : particles.filter((k) => !picture.held[k] && sizes[k] <= 0.02),
      { borderColor: "#5b6770", backgroundColor: "#5b6770", pointStyle: "circle", pointRadius: 2 }),
    dots("held particles", held, { borderColor: POINT, backgroundColor: POINT, pointStyle: "rect", pointRadius: 4 }),
  ].filter((line) => line.data.length > 0);
  const chart = drawEqual("picture", lines, [`${AXES[across]} [m]`, `${AXES[up]} [m]`], box, describePlace);
  chart.options.arrows = shown.map((k) => [at(k), moved(k)]);
  chart.update("none");
  Object.assign(chart.canvas.dataset, { springs: listed.length, blamed: blamed.length, arrows: shown.length,
    view: looking.view });
}

function look(what, key) {
  looking[what] = key;
  if (looking.view !== null) drawPicture();
}
