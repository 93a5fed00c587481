"use strict";
/* The words and tables of a study, and the start of everything. */

/* ---- the head ---- */

function writeHead() {
  writeLead("study", "How accurate each method is for what it costs.");
  at("crosses").hidden = study.rows.every(finished);
  at("beside").hidden = study.rows.every((row) => row.timed_alone !== false);
}

/* ---- tables ---- */

const COLUMNS = [["error", "error", "[m]"],
  ["error_final", "at the end", "[m]"], ["error_max", "farthest", "[m]"], ["energy_drift", "energy drift", "[J]"],
  ["force_evaluations", "force", "evaluations"], ["steps", "steps", ""], ["linear_iterations", "solver", "iterations"],
  ["wall_seconds", "wall time", "[s]"], ["wall_median", "median", "[s]"], ["repeats", "repeats", ""]];
const COUNTS = new Set(["force_evaluations", "steps", "linear_iterations", "repeats"]);

const settingOf = (row) => exact(row.step ?? row.rtol, (row.step === null ? "rtol " : "") + words(row.step ?? row.rtol, 4));
const SETTING = ["step [s]", "or rtol", settingOf];
const classOf = (row, before) => `${row.status} ${begins(row, before)}`;

function numberCell(row, what) {
  const value = row[what], cell = exact(value, COUNTS.has(what) ? whole(value) : words(value, 4));
  if (what === "error" && row.near_floor && value !== null) cell.textContent += " \u25cb";
  if (what === "energy_drift" && row.near_energy_floor && value !== null) cell.textContent += " \u25cb";
  if (what === "wall_seconds" && row.timed_alone === false) cell.textContent += " +";
  if (what === "error_max" && want !== null && value !== null && value <= want) cell.className = "enough";
  return cell;
}

function writeRows() {
  const columns = COLUMNS.filter(([what]) => what !== "linear_iterations" || study.rows.some((row) => row[what] > 0));
  writeTable("rows", study.rows, [METHOD, SETTING,
    ...columns.map(([what, name, unit]) => [name, unit, (row) => numberCell(row, what)]),
    ["status", "", (row) => row.status, "word"]], classOf);
}

function writeOrders() {
  const fixed = (value) => (value === null ? "\u2013" : value.toFixed(2));
  writeTable("orders", Object.entries(study.orders).map(([method, order]) => ({ method, ...order })), [METHOD,
    ["observed order", "", ({ order }) => fixed(order)],
    ["95 % interval", "", ({ low, high }) => (low === null ? "\u2013" : `${fixed(low)} to ${fixed(high)}`)],
    ["theory", "", ({ theory }) => words(theory)], ["of one step", "", ({ order_step: slope }) => fixed(slope)],
    ["", "", ({ note }) => note, "word note"]]);
}

/* ---- watched quantities ---- */

const inUnit = (item) => (item.unit ? `[${item.unit}]` : "");

function errorCell(value, agreement) {
  const cell = exact(value);
  if (value !== null && value <= 10 * agreement) cell.textContent += " \u25cb";
  return cell;
}

function writeWatched() {
  const watched = study.reference.watched || [], agreement = { method: "agreement", status: "" };
  if (!reveal("watched-section", watched.length > 0)) return;
  const other = (say, before) => (row) => (row === agreement ? before : say(row));
  writeTable("watched", [agreement, ...study.rows], [["method", "", other(METHOD[2], agreement.method), "word"],
    ["step [s]", "or rtol", other(settingOf, "")], ...watched.flatMap((item, q) => [
      [item.quantity, inUnit(item), other((row) => words(row.watched[q].at_end, 6), words(item.reference_end, 6))],
      ["error", inUnit(item), other((row) => errorCell(row.watched[q].error, item.agreement), words(item.agreement, 4))]])],
  (row, before) => (before === agreement ? row.status : classOf(row, before)));
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
  if (!reveal("statistics-section", Boolean(found))) return;
  const isReference = (source) => source.method === "reference";
  const sources = found.quantities.flatMap(({ reference, methods: others }) => [reference, ...Object.values(others)]);
  writeTable("statistics", sources, [
    ["quantity", "", (one) => (isReference(one) ? `${one.quantity} ${inUnit(one)}` : ""), "word"],
    ["method", "", (one) => (isReference(one) ? one.method : METHOD[2](one)), "word"], SETTING,
    ["runs", "", (one) => whole(one.members)], ["mean", "", (one) => words(one.mean, 4)],
    ["spread", "", (one) => words(one.spread, 4)], ["bias", "", biasWords, "word note"]],
  (one) => (isReference(one) ? "first" : ""));
}

/* ---- facts ---- */

function writeReference() {
  const { method, check, agreement, energy_agreement: energy, trusted_until: trusted } = study.reference;
  at("about-head").textContent = "Reference";
  facts("about", { "made by": method, "checked by": check, "agreement [m]": agreement, "energies agree to [J]": energy,
    "trusted until [s]": trusted, "duration [s]": study.duration, frames: study.frames, runs: study.rows.length, date: study.date });
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
