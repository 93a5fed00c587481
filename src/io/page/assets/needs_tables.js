"use strict";
/* The words and tables of needs, and the start of everything. */

const plural = (count, one) => `${whole(count)} ${one}${count === 1 ? "" : "s"}`;
const leftOut = data.rows.filter((row) => row.left_out);

/* ---- the head ---- */

function writeHead() {
  writeLead("needs", `What this scene needs for watched positions within ${words(want)} m over ` +
    `${words(data.duration, 6)} s, by ${data.method}${data.method_picked ? " (picked)" : ""}. ` +
    `${plural(data.runs, "run")}, ${data.date}.${data.note ? ` Warning: ${data.note}.` : ""}`);
  document.getElementById("judged").textContent = judgedAll ? "" : "Changes are those up to " +
    `${words(data.judged_until, 6)} s: beyond, small differences grow so fast that no time step keeps its error small.`;
}

function writeLean(box) {
  const faster = lean.times_less;
  const names = element("ul");
  for (const row of leftOut) names.append(element("li", row.without));
  box.append(element("h2", "What can be left out together"), names);
  box.append(element("p", `The lean scene was run: it is at most ${words(lean.error)} m off the full one, whose own error is counted in,` +
    `${judgedAll ? "" : ` up to ${words(data.judged_until, 6)} s`} with ${whole(lean.springs)} springs instead of ` +
    `${whole(full.springs)}. Within what is wanted it takes ${words(lean.wall_seconds)} s of wall time, and the full one ` +
    `${words(lean.full.wall_seconds)} s by the same method with the largest step that does ` +
    (faster >= 1 ? `(${words(faster, 2)} times less).` : `(${words(1 / faster, 2)} times more).`)));
  if (lean.other_method) box.append(element("p", `${lean.other_method} would bring the full scene there in ` +
    `${words(lean.other_seconds)} s.`));
  if (lean.note) box.append(element("p", `${lean.note}.`));
  if (data.command) box.append(element("pre", data.command));
}

function writeVerdict() {
  const box = document.getElementById("verdict");
  if (lean && leftOut.length > 0) {
    writeLean(box);
    return;
  }
  box.classList.add("none");
  if (lean && data.rows.some((row) => kindOf(row) === "unknown")) {
    box.append(element("h2", "It cannot be told what is needed"));
    return;
  }
  if (lean) {
    box.append(element("h2", "There is nothing to leave out"),
      element("p", "All that would save something is needed for what is wanted."));
    return;
  }
  if (data.parts.length > 0 && data.rows.length === 0) {
    box.append(element("h2", "What resolution it needs"), ...data.parts.map((part) => element("p", askFor(part))));
    return;
  }
  box.append(element("h2", "Not known yet"), element("p", ran
    ? "The work was ended before a lean scene was found."
    : "The work was ended before the full scene was run to its end."));
  if (data.waiting.length > 0) box.append(element("p", `Not looked at: ${data.waiting.join(", ")}.`));
}

/* Along all axes, of "cells" or "wanted". */
function cellsOf(part, what) {
  return part[what].length > 0 ? part[what].map(whole).join(" \u00d7 ") : "\u2013";
}

function askFor(part) {
  if (part.factor === null) return `${part.part}: ${part.note || "not known"}.`;
  return `${part.part}: ${cellsOf(part, "wanted")} cells; it has ${cellsOf(part, "cells")}.`;
}

/* ---- tables ---- */

const COLUMNS = [["error", "change", "[m]"], ["wall_seconds", "wall time", "[s]"], ["per_step", "a step", "[ns]"],
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
  const lines = [["nothing (the full scene)", FULL, full, ""],
    ...data.rows.map((row) => [row.without, KINDS[kindOf(row)][1], row,
      [KINDS[kindOf(row)][0], row.note].filter(Boolean).join("; ")]),
    ...(lean ? [["all that is left out (the lean scene)", LEAN, lean, "within what is wanted"],
      ["nothing, within what is wanted", FULL, lean.full, "within what is wanted"]] : [])];
  const columns = COLUMNS.filter(([what]) => lines.some(([, , row]) => what === "per_step" || (row[what] ?? null) !== null));
  writeTable("rows", lines, [["without", "", ([name, colour]) => swatched(name, colour), "word"],
    ...columns.map(([what, name, unit]) => [name, unit, ([, , row]) => numberCell(row, what)]),
    ["", "", ([, , , says]) => says, "word note"]]);
}

function writeParts() {
  writeTable("parts", data.parts, [["part", "", (part) => part.part, "word"],
    ["cells N", "", (part) => cellsOf(part, "cells")], ["N to 2N", "[m]", (part) => exact(part.change)],
    ["2N to 4N", "[m]", (part) => exact(part.change_fine)], ["order", "", (part) => exact(part.order)],
    ["left", "[m]", (part) => exact(part.error)], ["the want", "asks for", (part) => cellsOf(part, "wanted")],
    ["", "", (part) => part.note, "word note"]]);
}

function writePictured() {
  const left = picture.springs - listed.length;
  const apart = shown.map((k) => Math.hypot(...[0, 1, 2].map((axis) =>
    picture.position[3 * k + axis] - picture.lean[3 * k + axis])));
  document.getElementById("pictured").textContent = `The ${plural(shown.length, "watched particle")} ` +
    `at ${words(picture.time, 6)} s${judgedAll ? "" : ", the last frame that is judged"}, in the full scene and, of the same ` +
    `material points, in the lean one; ${words(extentBy(apart, (distance) => distance)[1])} m apart at most. ` +
    (listed.length === 0 ? "No spring is between two of them." : "Lines are springs of the full scene between them" +
      (left > 0 ? `: ${whole(listed.length)} of ${whole(picture.springs)} are drawn, ${whole(left)} are left out.` : "."));
}

function writeAbout() {
  document.getElementById("about-head").textContent = "The scene";
  fact("about", "particles", whole(data.particles));
  fact("about", "watched", whole(data.watched));
  fact("about", "springs", ran ? whole(full.springs) : "");
  fact("about", "method", data.method);
  fact("about", "step", full.step === null ? "" : `${words(full.step, 6)} s`);
  fact("about", "rtol", full.rtol === null ? "" : words(full.rtol));
  fact("about", "error of the step", full.step_error === null ? "" : `at most ${words(full.step_error)} m`);
  fact("about", "judged until", !ran ? "" : judgedAll ? `${words(data.duration, 6)} s, the whole run`
    : `${words(data.judged_until, 6)} s of ${words(data.duration, 6)} s`);
}

/* ---- whole ---- */

const show = (id, is) => { document.getElementById(id).hidden = !is; return is; };

writeHead();
writeVerdict();
writeAbout();
writeMachine();
if (show("changed", data.rows.length > 0)) drawChanges();
if (show("cost", data.rows.length > 0))
  choice("measure", Object.entries(MEASURES).map(([key, [label]]) => [key, [label]]), "wall_seconds", drawCosts);
if (show("laid", Boolean(picture) && leftOut.length > 0)) {
  writePictured();
  choice("view", Object.keys(VIEWS).map((key) => [key, [[...key].join(" ")]]), firstView(), drawPicture);
}
if (show("resolution", data.parts.length > 0)) writeParts();
if (show("all", ran && (data.rows.length > 0 || Boolean(lean)))) writeRows();
