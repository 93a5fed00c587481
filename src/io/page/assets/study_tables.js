"use strict";
/* The words and tables of a study, and the start of everything. */

/* ---- the head ---- */

function writeHead() {
  writeLead("study", "How accurate each method is for what it costs.");
  document.getElementById("crosses").hidden = study.rows.every(finished);
  document.getElementById("beside").hidden = study.rows.every((row) => row.timed_alone !== false);
}

/* ---- tables ---- */

const COLUMNS = [["setting", "step [s]", "or rtol"], ["error", "error", "[m]"],
  ["error_final", "at the end", "[m]"], ["error_max", "farthest", "[m]"], ["energy_drift", "energy drift", "[J]"],
  ["force_evaluations", "force", "evaluations"], ["steps", "steps", ""], ["linear_iterations", "solver", "iterations"],
  ["wall_seconds", "wall time", "[s]"], ["wall_median", "median", "[s]"], ["repeats", "repeats", ""]];
const COUNTS = new Set(["force_evaluations", "steps", "linear_iterations", "repeats"]);

function numberCell(row, what) {
  const value = what === "setting" ? row.step ?? row.rtol : row[what];
  const name = what === "setting" && row.step === null ? "rtol " : "";
  const cell = element("td", COUNTS.has(what) ? whole(value) : name + words(value, 4));
  if (value !== null) cell.title = String(value);
  if (what === "error" && row.near_floor && value !== null) cell.textContent += " \u25cb";
  if (what === "energy_drift" && row.near_energy_floor && value !== null) cell.textContent += " \u25cb";
  if (what === "wall_seconds" && row.timed_alone === false) cell.textContent += " +";
  if (what === "error_max" && want !== null && value !== null && value <= want) cell.className = "enough";
  return cell;
}

/* The first line of each method has a rule above. */
const lineOfRun = (row, k) => row.status + (k > 0 && row.method !== study.rows[k - 1].method ? " first" : "");

function writeRows() {
  const columns = COLUMNS.filter(([what]) =>
    what !== "linear_iterations" || study.rows.some((row) => row[what] > 0));
  writeTable("rows", [["", "method", "", "word"], ...columns, ["", "status", "", "word"]], study.rows, (row) =>
    [methodCell(row.method), ...columns.map(([what]) => numberCell(row, what)), wordCell(row.status)], lineOfRun);
}

function writeOrders() {
  const orders = Object.entries(study.orders);
  if (orders.length === 0) return;
  writeTable("orders", [["", "method", "", "word"], ["", "observed order"], ["", "95 % interval"], ["", "theory"],
    ["", "", "", "word"]], orders, ([method, order]) => [methodCell(method),
    element("td", order.order === null ? "\u2013" : order.order.toFixed(2)),
    element("td", order.low === null ? "\u2013" : `${order.low.toFixed(2)} to ${order.high.toFixed(2)}`),
    element("td", words(order.theory)), noteCell(order.note)]);
}

/* ---- watched quantities ---- */

const inUnit = (item) => (item.unit ? `[${item.unit}]` : "");

function errorCell(value, agreement) {
  const cell = element("td", words(value, 4));
  if (value === null) return cell;
  cell.title = String(value);
  if (value <= 10 * agreement) cell.textContent += " \u25cb";
  return cell;
}

function writeWatched() {
  const watched = study.reference.watched || [];
  document.getElementById("watched-section").hidden = watched.length === 0;
  if (watched.length === 0) return;
  writeTable("watched", [["", "method", "", "word"], ["", "step [s]", "or rtol"],
    ...watched.map((item) => ["", item.quantity, inUnit(item)])], [null, ...study.rows], (row) => (row === null
    ? [wordCell("agreement"), element("td", ""), ...watched.map((item) => element("td", words(item.agreement, 4)))]
    : [methodCell(row.method), numberCell(row, "setting"),
      ...watched.map((item, q) => errorCell(row.watched[q].error, item.agreement))]),
  (row, k) => (row === null ? "" : lineOfRun(row, k - 1)));
}

/* ---- statistics ---- */

/* A bias below two standard errors is compatible with chance. */
function biasWords(source) {
  if (source.method === "reference") return "";
  if (source.failed > 0) return "unknown: a run did not come to its end";
  if (source.bias === null) return "unknown";
  return Math.abs(source.bias) < 2 ? `none seen (${source.bias.toFixed(1)})` : `${words(source.bias)} standard errors`;
}

function writeStatistics() {
  const found = study.statistics;
  document.getElementById("statistics-section").hidden = !found;
  if (!found) return;
  const sources = found.quantities.flatMap(({ quantity, reference, methods: others }) =>
    [reference, ...Object.values(others)].map((source, k) => ({ ...source, title: k === 0 ? `${quantity} ${inUnit(source)}` : "" })));
  writeTable("statistics", [["", "quantity", "", "word"], ["", "method", "", "word"], ["", "step [s]", "or rtol"],
    ["", "runs"], ["", "mean"], ["", "spread"], ["", "bias", "", "word"]], sources, (source) => [wordCell(source.title),
    source.method === "reference" ? wordCell(source.method) : methodCell(source.method), numberCell(source, "setting"),
    element("td", whole(source.members)), element("td", words(source.mean, 4)), element("td", words(source.spread, 4)),
    noteCell(biasWords(source))], ({ title }) => (title ? "first" : ""));
}

/* ---- facts ---- */

function writeReference() {
  const { method, check, agreement, energy_agreement: energy } = study.reference;
  const inUnits = (value, unit) => (value === null ? "" : `${words(value, 6)} ${unit}`);
  document.getElementById("about-head").textContent = "Reference";
  fact("about", "made by", method);
  fact("about", "checked by", check);
  fact("about", "agreement", inUnits(agreement, "m"));
  fact("about", "energies agree to", inUnits(energy, "J"));
  fact("about", "trusted until", inUnits(trusted, "s"));
  fact("about", "duration", inUnits(duration, "s"));
  fact("about", "frames", whole(study.frames));
  fact("about", "runs", whole(study.rows.length));
  fact("about", "date", study.date);
}

/* ---- whole ---- */

writeHead();
writeRows();
writeOrders();
writeWatched();
writeStatistics();
writeReference();
writeMachine();
choice("cost", Object.entries(COSTS), "wall_seconds", drawCost);
drawConvergence();
choice("pick", Object.entries(PICKS).filter(([key]) => key !== "enough" || want !== null),
  want === null ? "middle" : "enough", drawTimes);
