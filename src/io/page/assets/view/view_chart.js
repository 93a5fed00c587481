"use strict";
/* Diagrams over time, with a cursor at the frame that is shown; a click or a drag on one goes to that time. */

const ENERGIES = ["total", "kinetic", "potential"];
const COLOURS = { kinetic: "#2f86c9", potential: "#e2711d" };

/* A line: `value` of each frame of a run. */
const lineOf = (label, run, value, look) => ({ label, run, pointRadius: 0, pointHitRadius: 0, showLine: true, borderWidth: 2, ...look,
  data: run.data.time.map((x, frame) => ({ x, y: value(frame) })) });

const largestOf = (points) => points.reduce((most, { y }) => (Number.isFinite(y) ? Math.max(most, Math.abs(y)) : most), 0);
const largest = (lines, kept) => Math.max(0, ...lines.map(({ run, data: points }) =>
  largestOf(kept ? keptFrames(run.data).map((k) => points[k]) : points)));

/* The range of the lines, without the last frames of a run that blows up. */
function rangeOf(lines) {
  const most = largest(lines, true), all = largest(lines, false);
  if (!(most > 0) || all <= 2 * most) return {};
  const power = 10 ** Math.floor(Math.log10(most)), round = power * [1, 2, 5, 10].find((head) => head * power >= most);
  return { min: -round, max: round };
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

  draw(lines, title, percents = false) {
    const ink = styleOf("--ink"), grid = styleOf("--line"), text = styleOf("--dim"), last_ = Math.max(...lines.map(({ run }) => run.data.time_last));
    if (this.chart) this.chart.destroy();
    const axis = (words, more, ticks) => ({ type: "linear", title: { display: true, text: words, color: text }, ticks: { color: text,
      maxRotation: 0, ...ticks }, grid: { color: grid, borderColor: grid }, ...more });
    this.chart = new Chart(this.canvas, {
      type: "scatter", data: { datasets: lines },
      options: {
        animation: false, maintainAspectRatio: false, events: [],
        scales: { x: axis("t [s]", { min: data.time[0], max: last_ > data.time[0] ? last_ : undefined }),
          y: axis(title, rangeOf(lines), percents ? { callback: percent } : {}) },
        plugins: { tooltip: { enabled: false }, legend: { display: lines.length > 1, align: "end", labels: { color: ink,
          usePointStyle: true, pointStyle: "line", boxHeight: 6 } } },
        onResize: () => requestAnimationFrame(() => this.moveCursor()),
      },
    });
    this.moveCursor();
  }

  moveCursor() {
    if (!this.chart) return;
    const { left, top, bottom } = this.chart.chartArea;
    Object.assign(this.cursor.style, { display: "block", top: `${top}px`, height: `${bottom - top}px`,
      left: `${Math.max(left, this.chart.scales.x.getPixelForValue(data.time[shown])) - 0.75}px` });
  }
}

/* Of one run its energies, of several the total of each. */
function drawEnergies() {
  const ink = styleOf("--ink"), lines = runs.length > 1
    ? runs.map((run) => lineOf(nameOf(run), run, (frame) => run.data.total[frame], { borderColor: run.own }))
    : ENERGIES.map((key) => lineOf(key, run, (frame) => data[key][frame], { borderColor: COLOURS[key] || ink, borderDash: key === "total" ? [6, 4] : [] }));
  energies.draw(lines, runs.length > 1 ? "total energy [J]" : "energy [J]");
  const clipped = rangeOf(lines).max !== undefined;
  at("clipped").hidden = !clipped;
  if (clipped) at("clipped").textContent = `Energies reach ${number(largest(lines, false))} J, beyond the edge of the diagram.`;
}
