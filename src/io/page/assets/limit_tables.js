"use strict";
/* The words and tables of a limit, and the start of everything. */

/* ---- the head ---- */

function writeHead() {
  writeLead("limit", `How large a step each method can take before it blows up, for the scene frozen as it is at ` +
    `t = ${words(data.time, 6)} s. The fastest motion has ${words(data.frequency_max, 6)} rad/s, the fastest damping ` +
    `${words(data.rate_max, 6)} 1/s, ${data.date}.` + (data.clamped === 0 ? ""
    : ` ${whole(data.clamped)} of the springs are compressed; what pushes their ends sideways is growth by physics, ` +
      "and left out.") + (data.tipping === 0 ? ""
    : ` ${whole(data.tipping)} of the rigid bodies are tipped over by gravity or tensions; that is growth by physics, ` +
      "too."));
}

/* Shares of the springs of each group, the largest first. */
function groupShares() {
  const sums = new Map();
  for (const one of blames) sums.set(groupOf(one), (sums.get(groupOf(one)) || 0) + one.share);
  return [...sums].sort((a, b) => b[1] - a[1]).filter(([, share]) => share > 0.001)
    .map(([group, share]) => `${percent(share)} in ${group}`).join(", ");
}

function writeVerdict() {
  const box = document.getElementById("verdict"), row = data.blamed && rowOf(data.blamed);
  box.append(element("h2", "What limits the step"));
  if (!row) {
    box.classList.add("none");
    box.append(element("p", "Nothing does, for these methods."));
    return;
  }
  box.append(element("p", row.predicted > 0
    ? `${row.method} is stable up to ${words(row.predicted, 6)} s` +
      (row.measured > 0 ? `, and was measured to be so up to ${words(row.measured, 6)} s.` : ", as predicted.")
    : `${row.method} is stable at no step.`));
  if (blames.reduce((sum, one) => sum + one.share, 0) > 0.9)
    box.append(element("p", `The mode that limits it has its force from springs: ${groupShares()}.`));
  const sentence = data.changes && data.changes.sentence;
  if (sentence) box.append(element("p", sentence[0].toUpperCase() + sentence.slice(1) + "."));
}

/* ---- the words of the diagrams ---- */

function writeUnbounded() {
  const names = data.rows.filter((row) => !row.reach && row.predicted === "none").map((row) => row.method);
  if (names.length === 0) return;
  document.getElementById("unbounded").textContent = `No line: ${names.join(", ")}, which no eigenvalue limits.`;
}

function writePictured() {
  const left = picture.springs - listed.length;
  const say = [];
  if (moving) say.push(`The mode that limits ${data.blamed}: arrows show how particles move in it, to one side and back.`);
  say.push(left > 0
    ? `${whole(listed.length)} of ${whole(picture.springs)} springs are drawn, whole groups with all that are to blame; ` +
      `${whole(left)} are left out.`
    : picture.springs === 1 ? "There is one spring." : `All ${whole(picture.springs)} springs are drawn.`);
  if (movers.length > MOST_ARROWS)
    say.push(`Arrows are at the ${MOST_ARROWS} that move the most, of ${whole(movers.length)} drawn that move.`);
  document.getElementById("pictured").textContent = say.join(" ");
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
  writeTable("rows", data.rows, [METHOD, ...columns.map(([what, name, unit]) => [name, unit, (row) => stepCell(row, what)]),
    ["", "", (row) => row.note, "word note"]]);
}

function writeAbout() {
  document.getElementById("about-head").textContent = "The scene";
  fact("about", "particles", whole(picture.particles));
  fact("about", "springs", whole(picture.springs));
  fact("about", "method", data.method);
  fact("about", "step", data.step === null ? "" : `${words(data.step, 6)} s`);
  fact("about", "eigenvalues", data.rows.every((row) => row.exact) ? `${whole(modeCount)} known, of each pair one`
    : `${whole(modeCount)} known, those of the fastest modes`);
}

/* ---- whole ---- */

writeHead();
writeVerdict();
writeUnbounded();
writePictured();
writeBlame();
writeRows();
writeAbout();
writeMachine();
document.getElementById("stability").hidden = modeCount === 0 || steps.length === 0;
if (modeCount > 0 && steps.length > 0) {
  const first = steps.find((one) => one.key === "scene") || steps.find((one) => one.key === data.blamed) || steps[0];
  choice("step", steps.map((one) => [one.key, [one.label]]), first.key, drawStability);
}
document.getElementById("mode").hidden = listed.length === 0;
if (listed.length > 0) {
  if (moving && movers.length < particles.length)
    choice("zoom", [["all", ["whole scene"]], ["mode", ["where it moves"]]], "all", (key) => look("zoom", key));
  choice("view", Object.entries(VIEWS).map(([key]) => [key, [[...key].join(" ")]]), firstView(),
    (key) => look("view", key));
}
