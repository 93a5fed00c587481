"use strict";
/* The diagrams of a limit. */

for (const row of data.rows) row.unlimited.forEach((name) => { row[name] = "none"; });
const modeCount = data.modes.length;

/* ---- stability ---- */

/* Steps to show: that of the scene, and the known limits. */
const steps = [{ key: "scene", label: "step of the scene", step: data.step },
  ...data.rows.map(({ method, predicted }) => ({ key: method, label: `limit of ${method}`, step: predicted })),
].filter(({ step }) => step > 0);
if (steps.length === 0 && data.frequency_max > 0)
  steps.push({ key: "radian", label: "one radian of the fastest motion", step: 1 / data.frequency_max });

const mirrored = (points) => [...points, ...[...points].reverse().map(({ x, y }) => ({ x, y: -y }))];

/* Points of modes, with crosses at the edge for those outside. */
function pointsOf(list) {
  const dots = (label, pointStyle, pointRadius, more) => plain(label, [], POINT,
    { showLine: false, order: 1, borderWidth: 1, pointHitRadius: 1, pointStyle, pointRadius, list, ...more });
  return [dots("modes of the scene", "circle", modeCount > 100 ? 2 : 3.2, { pointHoverRadius: 6 }),
    dots("", "crossRot", 6, { pointHoverRadius: 8, pointBorderWidth: 2 })];
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
  const { real, imaginary, frequency, decay } = item.raw.mode;
  return [`\u03bb = ${words(real, 5)}${imaginary === 0 ? "" : ` \u00b1 ${words(imaginary, 5)} i`} 1/s`,
    `frequency ${words(frequency, 5)} rad/s, damping ${words(decay, 5)} 1/s`,
    frequency > 0 ? `${words(decay / frequency)} of critical damping` : "nothing draws it back"];
}

/* Modes on the regions of the methods that have one under `key`. */
function drawModes(id, key, outline, list, more, titles, box) {
  const regions = data.rows.filter((row) => row[key]).map((row) => region(row.method, outline(pairs(row[key]))));
  const chart = drawEqual(id, [...regions, ...more, ...pointsOf(list)], titles, box, describeMode, place);
  chart.canvas.dataset.regions = regions.length;
}

function drawPlane(h) {
  const list = data.modes.flatMap((mode) => (mode.imaginary === 0 ? [1] : [1, -1]).map((sign) =>
    ({ x: h * mode.real, y: sign * h * mode.imaginary, mode })));
  drawModes("plane", "region", mirrored, list, [], [`real part of h \u03bb, h = ${words(h, 6)} s`, "imaginary part of h \u03bb"],
    { left: -3.6, right: 0.6, bottom: -3.1, top: 3.1 });
}

function drawReach(h) {
  const list = data.modes.map((mode) => ({ x: h * mode.frequency, y: h * mode.decay, mode }));
  const critical = plain("critical damping", [{ x: 0, y: 0 }, { x: 100, y: 100 }], "#6b7680",
    { role: "critical", borderWidth: 1.5, borderDash: [7, 4], order: 2 });
  const titles = [`h \u03c9, step times frequency, h = ${words(h, 6)} s`, "h d, step times damping"];
  drawModes("reach", "reach", fromOrigin, list, [critical], titles, { left: -0.1, right: 3.2, bottom: -0.1, top: 3.2 });
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
  at("stepped").textContent = `With that step: ${says.join("; ")}.`;
  drawPlane(step);
  drawReach(step);
}
