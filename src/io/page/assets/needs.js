"use strict";
/* The diagrams of needs. */

const { full, lean, want } = data, UNIT = `[${data.error_unit}]`;
for (const cost of [full, ...data.rows, ...(lean ? [lean, lean.full] : [])])
  if (cost.unlimited) cost.step_limit = "none";
const ran = full.wall_seconds !== null;

const NEEDED = "#c2410c", LEFT_OUT = "#1b7f4d", KEPT = "#8fc9a8", FULL = "#5b6770", LEAN = "#0057b8";

/* Kind of a row: needed, left out of the lean scene, neither, or unknown. */
const KINDS = { needed: ["needed", NEEDED], left_out: ["not needed, and left out", LEFT_OUT],
  kept: ["not needed, but kept", KEPT], unknown: ["not known", "#a9b1b8"] };
const kindOf = (row) => (row.needed === null ? "unknown" : row.needed ? "needed" : row.left_out ? "left_out"
  : "kept");
const perStep = (cost) => (cost.steps > 0 ? 1e9 * cost.wall_seconds / cost.steps : null);

/* All that was run: what is left out, its kind, its costs. */
const runs = [["nothing (the full scene)", "full", full], ...data.rows.map((row) => [row.without, kindOf(row), row]),
  ...(lean ? [["all that is left out (the lean scene)", "lean", lean], ["nothing, within what is wanted", "full", lean.full]] : [])];

/* ---- bars ---- */

/* A line across at a given value. */
function drawMark({ ctx, chartArea: { left, top, right, bottom }, scales: { x } }, mark) {
  const at = x.getPixelForValue(mark.value);
  ctx.strokeStyle = ctx.fillStyle = mark.colour;
  ctx.lineWidth = 1.5;
  ctx.setLineDash([7, 4]);
  ctx.beginPath();
  ctx.moveTo(at, top);
  ctx.lineTo(at, bottom);
  ctx.stroke();
  ctx.textAlign = at > (left + right) / 2 ? "right" : "left";
  ctx.fillText(mark.text, at, top - 8);
}

/* Label of a bar, at its end. */
function drawWords(ctx, words, x, y) {
  ctx.fillStyle = "rgba(255, 255, 255, 0.85)";
  ctx.fillRect(x - 2, y - 8, ctx.measureText(words).width + 4, 16);
  ctx.fillStyle = INK;
  ctx.fillText(words, x, y);
}

const barWords = {
  id: "words",
  afterDatasetsDraw(chart) {
    const { ctx, chartArea: { right } } = chart;
    ctx.save();
    ctx.font = "12px system-ui, DejaVu Sans, sans-serif";
    ctx.textBaseline = "middle";
    if (chart.options.mark) drawMark(chart, chart.options.mark);
    ctx.textAlign = "left";
    chart.data.datasets.forEach((set, k) => chart.getDatasetMeta(k).data.forEach((bar, i) => {
      if (set.data[i] !== null) drawWords(ctx, set.bars[i].text, Math.min(bar.x + 6, right - 60), bar.y);
    }));
    ctx.restore();
  },
};

/* `bars` have label, value (null: to the far end), text, kind and lines for the tooltip. */
function drawBars(id, bars, kinds, axis, mark) {
  const canvas = at(id), old = Chart.getChart(canvas);
  if (old) old.destroy();
  canvas.parentElement.style.height = `${28 * bars.length + 130}px`;
  const across = (value) => (value === null ? axis.max : Math.min(Math.max(value, axis.min), axis.max));
  const sets = Object.entries(kinds).filter(([kind]) => bars.some((bar) => bar.kind === kind))
    .map(([kind, [label, colour]]) => ({ label, backgroundColor: colour, grouped: false, barPercentage: 0.8, bars,
      data: bars.map((bar) => (bar.kind === kind ? across(bar.value) : null)) }));
  new Chart(canvas, {
    type: "bar",
    data: { labels: bars.map((bar) => bar.label), datasets: sets },
    plugins: [barWords],
    options: {
      indexAxis: "y", mark,
      scales: { x: axis, y: { grid: { display: false }, ticks: { autoSkip: false } } },
      layout: { padding: { top: 18, right: 12 } },
      plugins: {
        legend: { position: "bottom", onClick: null, labels: { boxHeight: 10, boxWidth: 18, padding: 14 } },
        tooltip: { callbacks: { title: (items) => bars[items[0].dataIndex].label,
          label: (item) => bars[item.dataIndex].lines } },
      },
    },
  });
  Object.assign(canvas.dataset, { bars: bars.length, mark: mark ? mark.value : "" });
  for (const kind of Object.keys(kinds)) canvas.dataset[kind] = bars.filter((bar) => bar.kind === kind).length;
}

/* Space to the right for the label of the longest bar. */
function logRange(values) {
  const [low, high] = ends(values);
  return [low, high * (high / low) ** 0.12];
}

/* ---- changes ---- */

const changeText = (row) => (row.error === null ? "not run" : `${words(row.error)} m`);

function drawChanges() {
  const size = (row) => (row.error === null ? Infinity : row.error);
  const rows = [...data.rows].sort((a, b) => size(b) - size(a));
  const range = logRange([want, want / 10, ...rows.map((row) => row.error)].filter((value) => value === null
    || value > want * 1e-9));
  const bars = rows.map((row) => ({ label: row.without, value: row.error, text: changeText(row), kind: kindOf(row),
    lines: [`change ${changeText(row)}, ${KINDS[kindOf(row)][0]}`, ...(row.note ? [row.note] : [])] }));
  drawBars("changes", bars, KINDS, logAxis(`change of what is watched ${UNIT}`, range),
    { value: want, text: `wanted: ${words(want)} ${data.error_unit}`, colour: INK });
}

/* ---- costs ---- */

const step = (value) => (value === "none" ? "none" : `${words(value)} s`);
const MEASURES = {
  wall_seconds: ["wall time", "wall time [s]", (cost) => cost.wall_seconds, (value) => `${words(value)} s`],
  per_step: ["time of a step", "time of a step [ns]", perStep, (value) => `${words(value)} ns`],
  force_evaluations: ["force evaluations", "force evaluations", (cost) => cost.force_evaluations, whole],
  step_limit: ["largest stable step", "largest stable step [s]", (cost) => cost.step_limit, step],
};
const COST_KINDS = { full: ["the full scene", FULL], ...KINDS, lean: ["the lean scene", LEAN] };

/* Linear from 0 unless that would hide the small ones. */
function costAxis(title, values) {
  const high = Math.max(...values), low = Math.min(...values);
  if (high > 30 * low) return logAxis(title, logRange(values));
  return linearAxis(title, { min: 0, max: 1.18 * high, ticks: { includeBounds: false } });
}

function drawCosts(key) {
  const [, title, of, text] = MEASURES[key];
  const timed = runs.filter(([, , cost]) => cost === full || cost.wall_seconds !== null);
  const bars = timed.map(([label, kind, cost]) => ({ label, kind, value: of(cost) === "none" ? null : of(cost),
    text: text(of(cost)), lines: [`${words(cost.wall_seconds)} s in ${whole(cost.steps)} steps`,
      `${whole(cost.springs)} springs, ${whole(cost.particles)} particles`] }));
  const values = bars.map((bar) => bar.value).filter((value) => value > 0);
  if (values.length === 0) values.push(1);
  drawBars("costs", bars, COST_KINDS, costAxis(title, values),
    bars[0].value === null ? null : { value: bars[0].value, text: "the full scene", colour: FULL });
}

/* ---- the lean scene over the full one ---- */

const picture = data.picture;
const listed = picture ? springsOf(picture) : [];
const shown = picture ? picture.particle.map((_, k) => k) : [];
const placed = (flat, [across, up]) => (k) => ({ x: flat[3 * k + across], y: flat[3 * k + up] });
const MANY = 400;

const firstView = () => widestView((axis) => spanOf(extentBy(shown, (k) => picture.position[3 * k + axis])));

function layer(label, flat, view, colour, width, order) {
  const at = placed(flat, view);
  if (listed.length === 0)
    return plain(label, shown.map(at), colour, { order, borderWidth: 1, showLine: false, pointStyle: "circle", pointRadius: width });
  return lineOf(listed, at, label, colour, { order, role: "springs", borderWidth: width });
}

function drawPicture(key) {
  const view = VIEWS[key], all = [...shown, ...shown.map((k) => k + shown.length)];
  const both = [...picture.position, ...picture.lean];
  const box = boxAround(all, (k, axis) => both[3 * k + axis], view, 0.05), many = listed.length > MANY;
  const chart = drawEqual("picture", [
    layer("the full scene", picture.position, view, "#7fb2e5", many ? 2 : 4, 3),
    layer("the lean scene", picture.lean, view, "#b00020", many ? 0.7 : 1.5, 2),
  ], view.map((axis) => `${AXES[axis]} [m]`), box, () => "");
  Object.assign(chart.canvas.dataset, { springs: listed.length, particles: shown.length, view: key });
}
