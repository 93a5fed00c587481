"use strict";
/* The words of an explanation, and the start of everything. */

function writeAdvice() {
  at("advice").hidden = data.advice.length === 0;
  for (const { change, command } of data.advice) {
    at("advice").append(element("p", change));
    if (command) at("advice").append(element("pre", command));
  }
}

function writeFilm() {
  at("ran").textContent = `As it ran: ${data.method}, step ${words(data.step, 5)} s`;
  at("cure").hidden = cured.length === 0;
  if (cured.length) at("would").textContent = `As advised, at the same times: ${advised.method}, step ${words(advised.step, 5)} s`;
}

/* Growth in a step: of the energy, as measured and as the mode has it, and of that mode. */
function writeGrowth({ measured, predicted, at: from, to }) {
  const known = (value) => (Number.isFinite(value) ? `${words(value, 4)} times` : "");
  fact("rates", "energy in a step, measured", known(measured));
  fact("rates", "over", Number.isFinite(measured) ? `${counted(to - from, "step")} from t = ${words(data.time, 5)} s on` : "");
  fact("rates", "energy, by the mode that limits", known(predicted));
  fact("left", "its amplitude in a step", known(growth) || "not known");
  if (data.mode) fact("left", "frozen at", `t = ${words(data.mode.time, 5)} s`);
}

function writeMode() {
  if (!reveal("mode", moving || blames.length > 0)) return;
  at("pictured").hidden = !moving;
  writeBlame();
  startPicture();
}

function writeAbout() {
  at("about-head").textContent = "The run";
  facts("about", { cause: data.cause, method: data.method, "step [s]": data.step, "limit [s]": data.limit, "well until [s]": data.time,
    "noticed [s]": data.noticed, particle: data.particle === null ? "" : String(data.particle),
    "steps from frame to frame": data.stride });
  writePicture();
}

/* ---- all of it ---- */

const looks = (data.limits || []).filter((one) => one.frequency !== null);
writeLead("why", `Why the run ended early, and what to do. ${data.date}.`);
writeAdvice();
for (const id of ["film", "grows"]) at(id).hidden = ran.length === 0;
if (ran.length) {
  const found = rates();
  writeFilm();
  writeGrowth(found);
  drawEnergy(found);
  if (reveal("leaves", looks.length > 0 && Boolean(data.rows[0].reach))) drawReach(looks);
  startFilm();
}
if (reveal("limits", (data.limits || []).filter((one) => one.limit > 0).length > 1)) drawAlong(data.limits);
writeMode();
writeAbout();
writeMachine();
