"use strict";
/* The words and tables of a limit, and the start of everything. */

/* ---- the words of the diagrams ---- */

function writeUnbounded() {
  const names = data.rows.filter((row) => !row.reach && row.predicted === "none").map((row) => row.method);
  if (names.length === 0) return;
  at("unbounded").textContent = `No line: ${names.join(", ")}, which no eigenvalue limits.`;
}

/* ---- tables ---- */

const COLUMNS = [["bound", "safe bound", "[s]"], ["predicted", "predicted", "[s]"], ["measured", "measured", "[s]"],
  ["ratio", "measured /", "predicted"], ["steps_run", "steps run", ""], ["smallest", "smallest met", "[s]"],
  ["smallest_time", "at time", "[s]"]];
const STEPS = new Set(["bound", "predicted", "measured", "smallest"]);

function stepCell(row, what) {
  const value = row[what], isStep = STEPS.has(what);
  return exact(value, value === "none" ? "none" : isStep && value === 0 ? "no step"
    : what === "steps_run" ? whole(value) : words(value, 6));
}

function writeRows() {
  const columns = COLUMNS.filter(([what]) => data.rows.some((row) => row[what] !== null));
  writeTable("rows", data.rows, [METHOD, ...columns.map(([what, name, unit]) => [name, unit, (row) => stepCell(row, what)])]);
}

function writeAbout() {
  at("about-head").textContent = "The scene";
  facts("about", { "time [s]": data.time, "fastest motion [rad/s]": data.frequency_max, "fastest damping [1/s]": data.rate_max,
    method: data.method, "step [s]": data.step, "limiting mode of": data.blamed });
  fact("about", "eigenvalues", data.rows.every((row) => row.exact) ? `${whole(modeCount)} known, of each pair one`
    : `${whole(modeCount)} known, those of the fastest modes`);
  writePicture();
}

/* ---- whole ---- */

writeLead("limit", `How large a step each method can take before it blows up, for the scene frozen at one time. ${data.date}.`);
writeUnbounded();
writeBlame();
writeRows();
writeAbout();
writeMachine();
if (reveal("stability", modeCount > 0 && steps.length > 0)) {
  const first = steps.find((one) => one.key === "scene") || steps.find((one) => one.key === data.blamed) || steps[0];
  choice("step", steps.map((one) => [one.key, [one.label]]), first.key, drawStability);
}
if (reveal("mode", listed.length > 0)) startPicture();
