"use strict";
/* Common parts of all pages: numbers as words, colours of methods, diagrams by Chart.js, tables. The data are
 * those of the element #data, in SI units. */

const data = JSON.parse(at("data").textContent);
const methods = [...new Set(data.rows.map((row) => row.method))];

/* ---- numbers as words ---- */

const RAISED = { "-": "\u207b", 0: "\u2070", 1: "\u00b9", 2: "\u00b2", 3: "\u00b3", 4: "\u2074", 5: "\u2075",
  6: "\u2076", 7: "\u2077", 8: "\u2078", 9: "\u2079" };
const power = (exponent) => "10" + [...String(exponent)].map((c) => RAISED[c]).join("");

function words(value, digits = 3) {
  if (value === null || value === undefined) return "\u2013";
  const size = Math.abs(value);
  if (value === 0 || (size >= 1e-3 && size < 1e6)) return String(Number(value.toPrecision(digits)));
  const [head, exponent] = value.toExponential(digits - 1).split("e");
  return (Number(head) === 1 ? "" : `${Number(head)}\u00b7`) + power(Number(exponent));
}

/* ---- appearance of methods ---- */

const COLOURS = ["#0072b2", "#d55e00", "#00875f", "#c2408f", "#7a5195", "#b8860b", "#2aa1c9", "#8b3a3a", "#5b6770",
  "#3d7a1f"];
const MARKS = ["circle", "rect", "triangle", "rectRot"];
const colourOf = (method) => COLOURS[methods.indexOf(method) % COLOURS.length];
const markOf = (method) => MARKS[methods.indexOf(method) % MARKS.length];

/* ---- charts ---- */

/* Light or dark, as the reader has it; a page is drawn anew where that changes. */
const [INK, PAPER, EDGE, GRID, GRID_MAJOR] = ["--ink", "--paper", "--edge", "--grid", "--grid-major"].map(styleOf);
const POINT = INK;
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => location.reload());

Chart.defaults.animation = false;
Chart.defaults.maintainAspectRatio = false;
Chart.defaults.font.family = 'system-ui, "DejaVu Sans", sans-serif';
Chart.defaults.font.size = 13;
Chart.defaults.color = INK;

/* Records in the element what Chart.js has drawn, for tests. */
const tell = {
  id: "tell",
  afterDraw(chart) {
    const { left, right, top, bottom } = chart.chartArea;
    const lines = chart.data.datasets.map((line, k) => (line.role !== undefined || line.pointRadius === 0 || !chart.isDatasetVisible(k) ? []
      : chart.getDatasetMeta(k).data.filter((point) => !point.skip))).filter((points) => points.length > 0);
    const count = (is) => lines.flat().filter(is).length;
    Object.assign(chart.canvas.dataset, { across: chart.options.scales.x.title.text, lines: lines.length, points: lines.flat().length,
      outside: count(({ x, y }) => x < left - 1 || x > right + 1 || y < top - 1 || y > bottom + 1),
      crosses: count(({ options }) => options.pointStyle === "crossRot"),
      hollow: count(({ options }) => options.backgroundColor === PAPER) });
  },
};

/* A line without marks. */
const plain = (label, points, colour, more) => ({ label, data: points, borderColor: colour, backgroundColor: colour, borderWidth: 2,
  pointRadius: 0, pointHitRadius: 0, pointStyle: "line", ...more });

function legendLabels(chart) {
  return Chart.defaults.plugins.legend.labels.generateLabels(chart).map((label) => {
    const line = chart.data.datasets[label.datasetIndex];
    const pointed = Array.isArray(line.pointStyle);
    return { ...label, pointStyle: pointed ? markOf(line.label) : line.pointStyle, fillStyle: line.backgroundColor,
      strokeStyle: line.borderColor, lineWidth: 2 };
  });
}

function draw(id, lines, x, y, describe) {
  const canvas = at(id);
  const old = Chart.getChart(canvas);
  if (old) old.destroy();
  return new Chart(canvas, {
    type: "scatter",
    data: { datasets: lines.map((line) => ({ showLine: true, ...line })) },
    plugins: [tell],
    options: {
      scales: { x, y },
      layout: { padding: { top: 4, right: 12 } },
      interaction: { mode: "nearest", intersect: true },
      plugins: {
        legend: { position: "bottom", labels: { usePointStyle: true, boxHeight: 8, padding: 14,
          generateLabels: legendLabels, filter: (label) => label.text !== "" } },
        tooltip: { callbacks: { title: (items) => items[0].dataset.label, label: describe } },
      },
    },
  });
}

/* Buttons of which one is pressed, `first` initially; calls `show` with its key. */
function choice(id, options, first, show) {
  const box = at(id);
  const press = (key) => {
    for (const button of box.children) button.setAttribute("aria-pressed", String(button.dataset.key === key));
    show(key);
  };
  for (const [key, [label]] of options) {
    const button = element("button", label, { onclick: () => press(key) });
    button.dataset.key = key;
    box.append(button);
  }
  press(first);
}

/* ---- axes ---- */

const linearAxis = (title, more) => ({ type: "linear", title: { display: true, text: title }, grid: { color: GRID }, ...more });

/* The ends of a logarithmic axis, with a margin around the values. */
function ends(values) {
  const seen = values.filter((value) => value > 0 && value < Infinity);
  if (seen.length === 0) return [0.1, 10];
  return [Math.min(...seen) / 1.6, Math.max(...seen) * 1.6];
}

/* Powers of ten are labelled; 2 and 5 as well on a short axis. */
function ticks([low, high]) {
  const decades = Math.log10(high / low);
  const every = Math.ceil(decades / 12);
  const list = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); e++) {
    for (let digit = 1; digit <= 9; digit++) {
      const value = digit * 10 ** e;
      if (value < low || value > high || (digit > 1 && decades > 7) || (decades > 20 && e % every !== 0)) continue;
      const bare = digit === 1 ? e % every === 0 : decades < 2 && (digit === 2 || digit === 5);
      const head = digit > 1 ? `${digit}\u00b7` : "";
      list.push({ value, major: digit === 1, label: bare ? head + power(e) : "" });
    }
  }
  return list;
}

function logAxis(title, range) {
  return {
    type: "logarithmic", min: range[0], max: range[1],
    title: { display: true, text: title },
    afterBuildTicks: (axis) => { axis.ticks = ticks(range); },
    ticks: { autoSkip: false, maxRotation: 0, callback: (value, k, all) => all[k].label },
    grid: { color: (context) => (context.tick && context.tick.major ? GRID_MAJOR : GRID) },
  };
}

/* ---- words and tables ---- */

/* Returns whether it is shown. */
function reveal(id, is) {
  at(id).hidden = !is;
  return is;
}

function fact(list, name, value) {
  if (value === null || value === undefined || value === "") return;
  at(list).append(element("dt", name), element("dd", value));
}

/* By their names, those of numbers with their units; whole numbers have none. */
function facts(list, values) {
  for (const [key, value] of Object.entries(values)) {
    const [, name, unit] = key.match(/^(.*?)(?: \[(.*)\])?$/);
    fact(list, name, typeof value !== "number" ? value : unit ? `${words(value, 6)} ${unit}` : whole(value));
  }
}

/* The head of the page: its title, the line below it, and what the results say. */
function writeLead(kind, lead) {
  document.title = `hooke ${kind}: ${data.scene}`;
  at("scene").textContent = data.scene;
  at("lead").textContent = lead;
  const box = at("claims"), claims = data.claims || [];
  reveal("claims", claims.length > 0);
  for (const claim of claims) {
    const line = element("p", claim.text, { className: claim.of });
    line.dataset.key = claim.key;
    box.append(line);
  }
  if (data.command && !data.advice && claims.length > 0) box.append(element("pre", data.command));
}

/* A name beside its colour. */
function swatched(name, colour) {
  const cell = element("td", undefined, { className: "word" });
  const swatch = element("span", undefined, { className: "swatch" });
  swatch.style.background = colour;
  cell.append(swatch, name);
  return cell;
}

const exact = (value, text = words(value, 4)) =>
  element("td", text, { title: typeof value === "number" ? String(value) : "" });

/* Columns have a name, a unit, what makes a text or a cell of a row, and a class. The lines of a method begin
 * with one of the class "first". */
const METHOD = ["method", "", ({ method }) => swatched(method, colourOf(method)), "word"];
const begins = (row, before) => (before && before.method !== row.method ? "first" : "");

function writeTable(id, rows, columns, classOf = () => "") {
  if (rows.length === 0) return;
  const line = (className, cells) => {
    const row = element("tr", undefined, { className });
    row.append(...cells);
    return row;
  };
  const head = element("thead"), body = element("tbody");
  head.append(line("", columns.map(([name, unit, , className = ""]) => {
    const cell = element("th", name, { className });
    if (unit) cell.append(element("br"), element("small", unit));
    return cell;
  })));
  body.append(...rows.map((row, k) => line(classOf(row, rows[k - 1]), columns.map(([, , say, className = ""]) => {
    const said = say(row);
    return said instanceof Node ? said : element("td", said, { className });
  }))));
  at(id).append(head, body);
}

const FACTS = { sundials: "SUNDIALS", cholmod: "CHOLMOD", blas: "BLAS", lapack: "LAPACK", gsl: "GSL",
  hdf5: "HDF5", chartjs: "Chart.js", threejs: "three.js" };

function writeMachine() {
  for (const [key, value] of Object.entries({ ...data.machine, ...data.versions })) fact("machine", FACTS[key] || key, value);
}
