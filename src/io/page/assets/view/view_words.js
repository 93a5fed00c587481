"use strict";
/* Numbers as words, the scale of colours, and diagrams that show and no more. */

function number(value, digits = 3) {
  const size = Math.abs(value);
  if (value === 0 || (size >= 1e-3 && size < 1e5)) return String(Number(value.toPrecision(digits)));
  return value.toExponential(digits - 1).replace(/\.?0+e/, "e");
}
const percent = (value) => `${number(100 * value)} %`;

function writeScale(palette, strain) {
  at("colours").style.background = `linear-gradient(to right, ${palette.join(", ")})`;
  at("low").textContent = `\u2212${percent(strain)}`;
  at("high").textContent = `+${percent(strain)}`;
}

/* Labels at powers of ten, of every so many-th. */
const powerTicks = (every = 1) => ({ callback: (value) => {
  const power = Math.log10(value), nearest = Math.round(power);
  return Math.abs(power - nearest) < 1e-9 && nearest % every === 0 ? value.toExponential(0) : null;
} });

/* `x` and `y`: the words of an axis, and what of it is not usual; `legend` likewise. */
function diagram(canvas, lines, x, y, legend, more) {
  const ink = styleOf("--dim"), grid = styleOf("--line");
  const axis = ([words, own]) => ({ type: "linear", title: { display: true, text: words, color: ink },
    grid: { color: grid, borderColor: grid }, ...own, ticks: { color: ink, maxRotation: 0, ...own.ticks } });
  return new Chart(canvas, { type: "scatter", data: { datasets: lines }, options: {
    animation: false, maintainAspectRatio: false, events: [], scales: { x: axis(x), y: axis(y) }, ...more,
    plugins: { tooltip: { enabled: false }, legend: { align: "end", ...legend, labels: { color: ink, ...legend.labels } } } } });
}
