"use strict";
/* The words and tables of a study, and the start of everything. */

/* ---- the head ---- */

function writeHead() {
  writeLead("study",
    `How accurate each method is for what it costs, over ${words(duration, 6)} s. ` +
    `${study.rows.length} runs of ${methods.length} methods, ${study.date}.` +
    (wholeRun ? "" : ` The two integrators of the reference agree up to ${words(trusted, 6)} s: ` +
      "all errors are those up to there.") +
    (study.budget_spent ? " The time that the study was given ran out." : ""));
  document.getElementById("crosses").hidden = study.rows.every(finished);
  document.getElementById("beside").hidden = study.rows.every((row) => row.timed_alone !== false);
}

/* The margin under small changes of the scene. */
function change(words_of, holds, error) {
  if (holds === null) return `${words_of}: not known in the time of the study`;
  if (error === null) return `${words_of}: no longer, a run did not come to its end or was not judged`;
  return `${words_of}: ${holds ? "still at most that" : "no longer"}, its error is ${words(error)} m then`;
}

function writeMargin(box) {
  const margin = recommended.margin, share = margin.limit_share;
  box.append(element("p",
    `Margin: the error is between ${words(margin.error_low)} and ${words(margin.error_high)} m` +
    (share > 0 ? `; the step is ${words(share, 2)} of the largest stable one at the start` : "") + ". " +
    change("Stiffness 10 % more or less", margin.holds_stiffness, margin.error_stiffness) + ". " +
    change("All started faster or slower along (1, 1, 1) by 10 % of the largest speed",
      margin.holds_start, margin.error_start) + "."));
}

function writeRecommendation() {
  const box = document.getElementById("recommendation");
  box.append(element("h2", !recommended || meets ? "Recommendation" : "Nothing meets what is wanted"));
  if (!recommended) {
    box.classList.add("none");
    box.append(element("p", "None was asked for. Say how large an error you can live with, such as --want 1mm."));
    return;
  }
  box.classList.add(meets ? "met" : "unmet");
  if (recommended.note) box.append(element("p", recommended.note + "."));
  if (recommended.method) {
    const cost = `it takes ${words(recommended.wall_seconds)} s of wall time and ` +
      `${whole(recommended.force_evaluations)} force evaluations.`;
    const choice = `${recommended.method} with ${setting(recommended)}`;
    const limit = `${words(want)} m${wholeRun ? "" : ` up to ${words(trusted, 6)} s`}`;
    const error = `its error is ${words(recommended.error)} m, and ${cost}`;
    box.append(element("p", meets
      ? `For an error of at most ${limit} take ${choice}: it was run, ${error}`
      : `Wanted: ${limit}. The closest is ${choice}: ${error}`));
  }
  if (meets) writeMargin(box);
  if (study.command) box.append(element("pre", study.command));
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
    ["theory", "", ({ theory }) => words(theory)], ["", "", ({ note }) => note, "word note"]]);
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
  document.getElementById("watched-section").hidden = watched.length === 0;
  if (watched.length === 0) return;
  const other = (say, before) => (row) => (row === agreement ? before : say(row));
  writeTable("watched", [agreement, ...study.rows], [["method", "", other(METHOD[2], agreement.method), "word"],
    ["step [s]", "or rtol", other(settingOf, "")], ...watched.map((item, q) => [item.quantity, inUnit(item),
      other((row) => errorCell(row.watched[q].error, item.agreement), words(item.agreement, 4))])],
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
  document.getElementById("statistics-section").hidden = !found;
  if (!found) return;
  document.getElementById("statistics-words").textContent =
    `Means over ${words(found.from, 6)} s to ${words(found.until, 6)} s, where positions cannot be computed; of ` +
    `${found.members} runs of each method, whose starts differ by noise of ${words(found.noise)} m. Spread: the ` +
    "standard deviation of the runs. Bias: the difference from the mean of the reference, in standard errors of it; " +
    "below 2 none is seen, and where there is none, one figure in twenty is above, more with few runs.";
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
  document.getElementById("about-head").textContent = "Reference";
  const { method, check, agreement, growth, growth_seen: seen, growth_probability: sure, displacements, ended } = study.reference;
  const why = { rounding: "rounding keeps the two apart after that", parted: "the two part after that" }[ended]
    || "the time was too short to know more";
  fact("about", "made by", method);
  fact("about", "checked by", check);
  fact("about", "agreement", agreement === null ? ""
    : `${words(agreement)} m, the floor: no error below it means anything`);
  fact("about", "trusted until", trusted === null ? "" : `${words(trusted, 6)} s, ` +
    (wholeRun ? "the whole run" : `of ${words(duration, 6)} s: ${why}, and errors are judged up to there`));
  fact("about", "energies agree to", study.reference.energy_agreement === null ? ""
    : `${words(study.reference.energy_agreement)} J, the floor of energy drift`);
  fact("about", "growth", seen === null ? "" : growth === null
    ? `${words(seen)} times, what a random displacement of the start grows; others may grow more`
    : `at most ${words(growth)} times${sure < 1 ? ` (with a probability of 1 - 1e-${displacements})` : ""}, of a small ` +
      `displacement of the start; ${sure < 1 ? "random ones grow" : "that of one coordinate at most"} ${words(seen)} times`);
  fact("about", "frames", whole(study.frames));
}

/* ---- whole ---- */

writeHead();
writeRecommendation();
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
