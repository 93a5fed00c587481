"use strict";
/* Diagrams over time, with a cursor at the frame that is shown; a click or a drag on one goes to that time. */

const ENERGIES = ["total", "kinetic", "potential"];
const COLOURS = { kinetic: "#2f86c9", potential: "#e2711d" };

/* A line: `value` of each frame of a run. */
const lineOf = (label, run, value, look) => ({ label, run, pointRadius: 0, pointHitRadius: 0, showLine: true, borderWidth: 2, ...look,
  data: run.data.time.map((x, frame) => ({ x, y: value(frame) })) });

const sizesOf = (lines, kept) => lines.flatMap(({ run, data: points }) => (kept ? keptFrames(run.data).map((k) => points[k]) : points)
  .map(({ y }) => Math.abs(y)).filter((y) => y > 0 && y < Infinity));
const largest = (sizes) => sizes.reduce((most, size) => Math.max(most, size), 0);
const blewUp = (lines) => largest(sizesOf(lines, false)) > 10 * largest(sizesOf(lines, true));

/* The same for the lines of all pages beside this one, without the last frames of a run that blows up. */
function rangeOf(lines) {
  const most = largest(sizesOf(lines, true)), round = 10 ** Math.floor(Math.log10(most || 1));
  const values = lines.flatMap(({ data: points }) => points.map(({ y }) => y)).filter(Number.isFinite);
  const edge = round * [1, 2, 5, 10].find((head) => head * round >= most);
  if (most > 0 && largest(sizesOf(lines, false)) > 2 * most) return { min: -edge, max: edge };
  return { suggestedMin: values.reduce((a, b) => Math.min(a, b), Infinity), suggestedMax: values.reduce((a, b) => Math.max(a, b), -Infinity) };
}

/* Of sizes, down to a millionth of what there was before the run blew up. */
function logarithmic(lines) {
  const sizes = sizesOf(lines, false), low = Math.max(sizes.reduce((a, b) => Math.min(a, b)), 1e-6 * largest(sizesOf(lines, true)));
  const [first, end] = [Math.floor(Math.log10(low)), Math.min(308, Math.ceil(Math.log10(largest(sizes))))], every = [1, 2, 5, 10, 20, 50, 100].find((k) => end - first <= 7 * k);
  return { type: "logarithmic", min: 10 ** first, max: 10 ** end, ticks: powerTicks(every) };
}

class Diagram {
  constructor(box) {
    Object.assign(this, { box, canvas: box.querySelector("canvas"), cursor: box.querySelector(".cursor"), chart: null });
    const seek = (event) => show(frameNear(data.time, this.chart.scales.x.getValueForPixel(event.clientX -
      this.canvas.getBoundingClientRect().left)));
    this.canvas.addEventListener("pointerdown", (event) => {
      pause();
      this.canvas.setPointerCapture(event.pointerId);
      seek(event);
    });
    this.canvas.addEventListener("pointermove", (event) => event.buttons && seek(event));
  }

  draw(lines, title, scale) {
    const [first, last_] = [Math.min(...shared.map((one) => one.data.time[0])), Math.max(...shared.map((one) => one.data.time_last))];
    if (this.chart) this.chart.destroy();
    this.chart = diagram(this.canvas, lines, ["t [s]", { min: first, max: last_ > first ? last_ : undefined }], [title, scale],
      { display: lines.length > 1, labels: { color: styleOf("--ink"), usePointStyle: true, pointStyle: "line", boxHeight: 6 } },
      { onResize: () => requestAnimationFrame(() => this.moveCursor()) });
    this.moveCursor();
  }

  moveCursor() {
    if (!this.chart) return;
    const { left, top, bottom } = this.chart.chartArea;
    Object.assign(this.cursor.style, { display: "block", top: `${top}px`, height: `${bottom - top}px`,
      left: `${Math.max(left, this.chart.scales.x.getPixelForValue(data.time[shown])) - 0.75}px` });
  }
}

/* Of one run its energies, of several the total of each; their sizes, once a run has blown up. */
function drawEnergies() {
  const ink = styleOf("--ink"), keys = runs.length > 1 ? ["total"] : ENERGIES;
  const linesOf = (list, value, look) => list.flatMap((one) => keys.map((key) => lineOf(runs.length > 1 ? nameOf(one) : key, one,
    (frame) => value(one.data[key][frame]), look(one, key))));
  const all = linesOf(shared, (y) => y, () => ({})), log = blewUp(all);
  energies.draw(linesOf(runs, (y) => (log ? Math.abs(y) || null : y), (one, key) => (runs.length > 1 ? { borderColor: one.own }
    : { borderColor: COLOURS[key] || ink, borderDash: key === "total" ? [6, 4] : [] })),
  `${log ? "size of " : ""}${runs.length > 1 ? "total " : ""}energy [J]`, log ? logarithmic(all) : rangeOf(all));
}

/* A diagram for each unit of what is watched. */
function watchedDiagrams() {
  return [...new Set(data.watched.map(({ unit }) => unit))].map((unit) => {
    const box = element("div", "", { className: "diagram" });
    box.append(element("canvas"), element("div", "", { className: "cursor" }));
    at("watched").append(box);
    return [unit, new Diagram(box)];
  });
}

function drawWatched() {
  const colours = RUN_COLOURS[isDark() ? "dark" : "light"];
  for (const [unit, drawn_] of watched) {
    const some = runs.flatMap((one) => one.data.watched.filter((each) => each.unit === unit).map((each) => [one, each]));
    const lines = some.map(([one, { name, values }], k) => lineOf(runs.length > 1 ? `${name}, ${nameOf(one)}` : name, one, (frame) => values[frame],
      { borderColor: colours[k % colours.length] }));
    drawn_.draw(lines, `${lines.length > 1 ? "" : `${some[0][1].name} `}${unit && `[${unit}]`}`, rangeOf(lines));
  }
}
