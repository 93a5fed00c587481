"use strict";
/* The words of an explanation, and the start of everything. */

const at = (id) => document.getElementById(id);
const capital = (text) => text[0].toUpperCase() + text.slice(1);

function writeHead() {
  writeLead("why", `Why the run by ${data.method}${data.step === null ? "" : ` with a step of ${words(data.step, 6)} s`} ended ` +
    `early: all was well until t = ${words(data.time, 6)} s, and it was noticed at ${words(data.noticed, 6)} s. ${data.date}.`);
}

function writeVerdict() {
  const box = at("verdict");
  box.append(element("p", `${capital(data.sentence)}.`, { className: "sentence" }));
  data.advice.forEach((one, k) => box.append(element("p", `${k === 0 ? "What to do" : "Or"}: ${one.change}.`)));
  if (data.command) box.append(element("pre", data.command));
  if (data.left_out) box.append(element("p", `${capital(data.left_out)}.`));
}

function writeFilm() {
  const left = picture.springs - listed.length;
  at("filmed").textContent = `${data.stride === 1 ? "Every step" : `Every ${whole(data.stride)} steps`} around the trouble, slowly. ` +
    `The picture zooms out as far as it has to, and says so. Springs to blame are red.` +
    (left > 0 ? ` ${whole(listed.length)} of ${whole(picture.springs)} springs are drawn, whole groups of them.` : "");
  at("ran").textContent = `As it ran: ${data.method}, step ${words(data.step, 5)} s`;
  at("cure").hidden = cured.length === 0;
  if (cured.length) at("would").textContent = `As advised, at the same times: ${advised.method}, step ${words(advised.step, 5)} s`;
}

function writeRates({ measured, predicted, at: from, to }) {
  const says = [];
  if (Number.isFinite(measured)) says.push(`In the ${counted(to - from, "step")} from t = ${words(data.time, 5)} s on each step ` +
    `multiplies the energy by ${words(measured, 4)}, measured.`);
  if (Number.isFinite(predicted)) says.push(`The mode that limits the step, alone and frozen at t = ${words(data.mode.time, 5)} s, ` +
    (predicted > 1 ? `predicts ${words(predicted, 4)}, the square of its growth.` : `does not grow (${words(predicted, 4)}).`));
  says.push("That of gravity is left out.");
  at("rates").textContent = says.join(" ");
}

function writeLeft() {
  at("left").textContent = growth > 1
    ? `At t = ${words(data.mode.time, 5)} s it is outside: each step multiplies its amplitude by ${words(growth, 4)}.`
    : Number.isFinite(growth) ? "At the times that were looked at it is not outside." : "Whether it is outside is not known.";
}

function writeMode() {
  at("mode").hidden = !moving && blames.length === 0;
  if (at("mode").hidden) return;
  at("pictured").textContent = moving ? `Arrows show how particles move in it, to one side and back, at t = ${words(data.mode.time, 5)} s; ` +
    `the longest is as long as one can see.${growth > 1 ? ` Each step multiplies them by ${words(growth, 4)}.` : ""}` : "The mode is not known.";
  writeBlame();
  if (moving && movers.length < particles.length)
    choice("zoom", [["all", ["whole scene"]], ["mode", ["where it moves"]]], "all", (key) => look("zoom", key));
  choice("view", Object.keys(VIEWS).map((key) => [key, [[...key].join(" ")]]), firstView(), (key) => look("view", key));
}

function writeAbout() {
  at("about-head").textContent = "The scene";
  fact("about", "particles", picture.particles ? whole(picture.particles) : "");
  fact("about", "springs", picture.springs ? whole(picture.springs) : "");
  fact("about", "cause", data.cause);
  fact("about", "limit", data.limit === null ? "" : `${words(data.limit, 6)} s`);
  fact("about", "particle", data.particle === null ? "" : String(data.particle));
}

/* ---- all of it ---- */

const looks = (data.limits || []).filter((one) => one.frequency !== null);
writeHead();
writeVerdict();
for (const id of ["film", "grows"]) at(id).hidden = ran.length === 0;
if (ran.length) {
  const found = rates();
  writeFilm();
  writeRates(found);
  drawEnergy(found);
  at("leaves").hidden = looks.length === 0 || !data.rows[0].reach;
  if (!at("leaves").hidden) {
    writeLeft();
    drawReach(looks);
  }
  startFilm();
}
at("limits").hidden = (data.limits || []).filter((one) => one.limit > 0).length < 2;
if (!at("limits").hidden) drawAlong(data.limits);
writeMode();
writeAbout();
writeMachine();
