"use strict";
/* The tables of needs, and the start of everything. */

const leftOut = data.rows.filter((row) => row.left_out);

/* Along all axes, of "cells" or "wanted". */
function cellsOf(part, what) {
  return part[what].length > 0 ? part[what].map(whole).join(" \u00d7 ") : "\u2013";
}

/* ---- tables ---- */

const COLUMNS = [["error", "change", UNIT], ["wall_seconds", "wall time", "[s]"], ["per_step", "a step", "[ns]"],
  ["step_limit", "stable", "[s]"], ["step", "step", "[s]"], ["rtol", "rtol", ""], ["steps", "steps", ""],
  ["force_evaluations", "force", "evaluations"], ["springs", "springs", ""], ["particles", "particles", ""]];
const COUNTS = new Set(["steps", "force_evaluations", "springs", "particles"]);

function numberCell(row, what) {
  const value = what === "per_step" ? perStep(row) : row[what] ?? null;
  const cell = exact(value, value === "none" ? "none" : COUNTS.has(what) ? whole(value) : words(value, 4));
  if (what === "error" && value !== null && value <= want) cell.className = "enough";
  return cell;
}

function writeRows() {
  const note = (kind, row) => (KINDS[kind] ? [KINDS[kind][0], row.note].filter(Boolean).join("; ") : row === full ? "" : "within what is wanted");
  const columns = COLUMNS.filter(([what]) => runs.some(([, , row]) => what === "per_step" || (row[what] ?? null) !== null));
  writeTable("rows", runs, [["without", "", ([name, kind]) => swatched(name, COST_KINDS[kind][1]), "word"],
    ...columns.map(([what, name, unit]) => [name, unit, ([, , row]) => numberCell(row, what)]),
    ["", "", ([, kind, row]) => note(kind, row), "word note"]]);
}

function writeParts() {
  writeTable("parts", data.parts, [["part", "", (part) => part.part, "word"],
    ["cells N", "", (part) => cellsOf(part, "cells")], ["N to 2N", UNIT, (part) => exact(part.change)],
    ["2N to 4N", UNIT, (part) => exact(part.change_fine)], ["order", "", (part) => exact(part.order)],
    ["left", UNIT, (part) => exact(part.error)], ["the want", "asks for", (part) => cellsOf(part, "wanted")],
    ["", "", (part) => part.note, "word note"]]);
}

function writePictured() {
  const apart = shown.map((k) => Math.hypot(...[0, 1, 2].map((axis) =>
    picture.position[3 * k + axis] - picture.lean[3 * k + axis])));
  facts("about", { "drawn at [s]": picture.time, "apart there": `${words(extentBy(apart, (distance) => distance)[1])} m at most`,
    "springs drawn": `${whole(listed.length)} of ${whole(picture.springs)} between watched particles` });
}

function writeAbout() {
  at("about-head").textContent = "The scene";
  facts("about", { [`wanted ${UNIT}`]: want, particles: data.particles, watched: data.watched, springs: ran ? full.springs : "",
    method: data.method, "step [s]": full.step, rtol: full.rtol === null ? "" : words(full.rtol), "duration [s]": data.duration,
    "judged until [s]": ran ? data.judged_until : "", runs: data.runs, date: data.date });
}

/* ---- whole ---- */

writeLead("needs", "What this scene needs for the wanted error.");
writeAbout();
writeMachine();
if (reveal("changed", data.rows.length > 0)) drawChanges();
if (reveal("cost", data.rows.length > 0))
  choice("measure", Object.entries(MEASURES).map(([key, [label]]) => [key, [label]]), "wall_seconds", drawCosts);
if (reveal("laid", Boolean(picture) && leftOut.length > 0)) {
  writePictured();
  choice("view", VIEW_CHOICES, firstView(), drawPicture);
}
if (reveal("resolution", data.parts.length > 0)) writeParts();
if (reveal("all", ran && (data.rows.length > 0 || Boolean(lean)))) writeRows();
