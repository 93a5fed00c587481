"use strict";
/* Modes that play on a picture of the scene. */

const picture = { particle: [], held: [], spring: [], ends: [], position: [], tension: [], ...data.picture };
const listed = springsOf(picture).map((spring, k) => ({ ...spring, tension: picture.tension[k] }));
const strongest = Math.max(...listed.map(({ tension }) => Math.abs(tension || 0)), 0);
const particles = picture.particle.map((_, k) => k);
/* Along x, y or z, or along one of the two axes of a view from aside. */
const ASIDE = { 3: [0.87, 0, -0.5], 4: [0.25, 0.87, 0.43] };
const along = (axis, of) => (axis < 3 ? of(axis) : ASIDE[axis].reduce((sum, part, k) => sum + part * of(k), 0));
const coordinate = (k, axis) => along(axis, (own) => picture.position[3 * k + own]);
const moveOf = (mode, k, axis) => along(axis, (own) => mode.shape[3 * picture.particle[k] + own] || 0);
const lengthOf = (axis) => spanOf(extentBy(particles, (k) => coordinate(k, axis)));
VIEWS.aside = [3, 4];
const AMPLITUDE = 0.12, PERIOD = 1600; // of the picture's size; ms
const looking = { mode: 0, view: null, running: true, chart: null, redraw: null };

const groupsOf = (mode) => [...(mode.groups || [])].filter(({ share }) => Math.abs(share) > 0.005)
  .sort((a, b) => Math.abs(b.share) - Math.abs(a.share)).slice(0, 3)
  .map(({ name, share }) => `${name} ${(100 * share).toFixed(0)} %`).join(", ");

/* "2.3 Hz", or how it grows or decays. */
const paceOf = (mode) => (mode.frequency !== null ? `${words(mode.frequency)} Hz`
  : mode.growth > 0 ? `grows by e in ${words(1 / mode.growth)} s` : `decays by e in ${words(-1 / mode.growth)} s`);

/* From grey to red where it pulls, and to blue where it pushes. */
function tensionColour(tension) {
  const part = Math.abs(tension) / strongest, to = tension < 0 ? [0, 87, 184] : [176, 0, 32];
  return `rgb(${[168, 176, 184].map((from, k) => Math.round(from + part * (to[k] - from))).join(" ")})`;
}

function describeSpring({ raw: { spring } }) {
  if (!spring || spring.tension === undefined) return "";
  return [`spring ${spring.number}, between particles ${spring.ends.map((end) => picture.particle[end]).join(" and ")}`,
    `tension ${words(spring.tension, 6)} N`];
}

/* Along the two axes in which all is, if there are such. */
function firstView() {
  const moves = (axis) => particles.some((k) => data.modes.some((mode) => Math.abs(moveOf(mode, k, axis)) > 0.02));
  const longest = Math.max(...[0, 1, 2].map(lengthOf));
  const none = [2, 1, 0].find((axis) => lengthOf(axis) < 1e-3 * longest && !moves(axis));
  return none === undefined ? "aside" : viewWith(...[0, 1, 2].filter((axis) => axis !== none));
}

function drawMode() {
  const mode = data.modes[looking.mode] || { shape: [], still: true }, axes = VIEWS[looking.view], [across, up] = axes;
  const box = boxAround(particles, coordinate, axes, 0.2), size = AMPLITUDE * box.size;
  const at = (amount) => (k) => ({ x: coordinate(k, across) + amount * moveOf(mode, k, across),
    y: coordinate(k, up) + amount * moveOf(mode, k, up) });
  const dots = (amount, list) => list.map((k) => at(amount)(k));
  const free = particles.length > 400 && listed.length ? [] : particles.filter((k) => !picture.held[k]);
  const colours = strongest > 0 ? listed.flatMap(({ tension }) => Array(3).fill(tensionColour(tension))) : null;
  const state = lineOf(listed, at(0), colours ? "at rest; red pulls, blue pushes" : "the state", "#8a949e",
    { borderWidth: colours ? 2.5 : 0.8, order: 4, role: "state", pointHitRadius: colours ? 5 : 0,
      segment: colours ? { borderColor: (context) => colours[context.p0DataIndex] } : undefined });
  const moving = lineOf(mode.still ? [] : listed, at(size), "the mode", "#0057b8", { borderWidth: listed.length > 200 ? 1 : 2, order: 2, role: "mode" });
  const places = plain("", dots(size, free), "#0057b8", { showLine: false, order: 1, pointRadius: 3, pointStyle: "circle" });
  looking.chart = drawEqual("picture", [
    state, moving, places,
    plain("held particles", dots(0, particles.filter((k) => picture.held[k])), POINT,
      { showLine: false, order: 1, pointRadius: 4, pointStyle: "rect" }),
  ].filter((line) => line.data.length > 0), axes.map((axis) => (axis < 3 ? `${AXES[axis]} [m]` : "aside [m]")), box, describeSpring);
  looking.redraw = (amount) => {
    const lines = looking.chart.data.datasets, place = at(amount * size);
    const find = (line) => lines.find(({ order, role, label }) => order === line.order && role === line.role && label === line.label);
    if (find(moving)) find(moving).data = lineOf(listed, place, "", "").data;
    if (find(places)) find(places).data = free.map(place);
    looking.chart.update("none");
    looking.chart.canvas.dataset.amount = amount;
  };
  document.getElementById("said").textContent = mode.still ? ""
    : `Mode ${looking.mode}: ${paceOf(mode)}; ${groupsOf(mode)}. It is drawn as large as is good to see.`;
  Object.assign(looking.chart.canvas.dataset, { springs: listed.length, mode: looking.mode, view: looking.view });
}

function step(now) {
  if (looking.running && looking.redraw && data.modes.length > 0) looking.redraw(Math.sin(2 * Math.PI * now / PERIOD));
  requestAnimationFrame(step);
}

function look(what, key) {
  looking[what] = key;
  if (looking.view !== null && what !== "running") drawMode();
}

function startModes() {
  const keys = data.modes.map((_, k) => [`${k}`, [`${k}`]]), rest = data.status ? [["-1", ["at rest"]]] : [];
  if (keys.length > 0) choice("mode", [...rest, ...keys], [...rest, ...keys][0][0], (key) => look("mode", Number(key)));
  choice("view", [...VIEW_CHOICES, ["aside", ["aside"]]], firstView(), (key) => look("view", key));
  if (data.modes.length > 0) choice("running", [["play", ["play"]], ["stop", ["stop"]]], "play", (key) => look("running", key === "play"));
  requestAnimationFrame(step);
}
