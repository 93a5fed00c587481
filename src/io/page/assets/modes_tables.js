"use strict";
/* The words and the table of modes, and the start of everything. */

const COLUMNS = [["omega", "omega", "[rad/s]"], ["frequency", "frequency", "[Hz]"], ["growth", "growth", "[1/s]"],
  ["damping_ratio", "damping ratio", ""]];

function writeModes() {
  const cell = (value) => exact(value, words(value, 6));
  const shown = COLUMNS.filter(([what]) => data.modes.some((mode) => mode[what] !== null));
  const masses = AXES.map((axis, k) => [`mass along ${axis}`, "[kg]", (mode) => cell(mode.effective_mass[k] ?? null)]);
  writeTable("modes", data.modes, [["mode", "", (mode) => String(data.modes.indexOf(mode))],
    ...shown.map(([what, name, unit]) => [name, unit, (mode) => cell(mode[what])]), ...masses,
    ["stiffness", "", groupsOf, "word"]]);
}

function writeTensions() {
  const most = [...listed].sort((a, b) => Math.abs(b.tension) - Math.abs(a.tension)).slice(0, 12);
  writeTable("tensions", most, [["spring", "", ({ number }) => String(number)],
    ["between particles", "", ({ ends }) => ends.map((end) => picture.particle[end]).join(" and ")],
    ["tension", "[N]", ({ tension }) => exact(tension, words(tension, 6))]]);
}

if (data.status) writeLead("rest", `Where all forces of the scene are in equilibrium, or the search ended. ${data.date}.`);
else writeLead("modes", `Small free motions about one state, and how they are damped. ${data.date}.`);
writeModes();
if (data.status && data.modes.length === 0) at("shown").textContent = "The scene at rest";
if (reveal("pulls", strongest > 0)) writeTensions();
reveal("listed", data.modes.length > 0 || !data.status);
at("about-head").textContent = "The scene";
for (const { quantity, value, unit } of data.watched || []) fact("about", quantity, value === null ? null : `${words(value, 6)} ${unit}`);
facts("about", { "time [s]": data.time, "modes without stiffness": data.zero_modes, translations: data.translations,
  rotations: data.rotations, mechanisms: data.mechanisms, "all modes": data.unknowns, "force left [N]": data.residual,
  "largest force of a spring [N]": data.largest_force,
  "the farthest particle has moved [m]": data.moved, particles: picture.particles, springs: picture.springs });
writeMachine();
if (reveal("play", data.modes.length > 0 && particles.length > 0)) startModes();
