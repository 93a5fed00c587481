"use strict";
/* The page: time, controls, words. */

const last = data.frames - 1;

/* ---- words ---- */

const ending = (n) => ["st", "nd", "rd"][Math.floor(n / 10) % 10 === 1 ? 3 : (n % 10) - 1] || "th";
const every = (stride) => (stride === 1 ? "every" : `every ${stride}${ending(stride)}`);

const OUTCOMES = {
  finished: "finished", stopped: "stopped early", diverged: "diverged", "step-limit": "ended at its limit of steps",
  "solver-failed": "ended, its solver having failed", failed: "failed", running: "not closed",
};
const ALERTS = {
  diverged: "The run diverged", "step-limit": "The run used up its steps", "solver-failed": "The solver of the run failed",
  failed: "The run failed", running: "The run has not been closed: it still goes on, or was killed. These are the frames so far,",
};
const shownAfter = data.frame.filter((k) => k >= data.good_frames).length;
const where = (data) => `${data.status === "running" ? "up to" : ALERTS[data.status] ? "after" : "at"} t = ${number(data.time_good, 6)} s`;

/* What happened, by what, what is shown of it, and where to see more. */
function alertOf() {
  const words = [`${ALERTS[data.status]} ${where(data)}${data.duration ? ` of ${number(data.duration, 6)} s` : ""}, by ${data.method}${accuracyOf(data)}.`];
  if (shownAfter > 0) words.push(`Frames after that, ${shownAfter} here, show how it blows up, and are no physics.`);
  if (["diverged", "step-limit", "solver-failed"].includes(data.status)) words.push(`Why, and what to do: ${data.why || `hooke why ${data.file}`}`);
  return words.join(" ");
}

function writeHead() {
  document.title = `hooke view: ${data.title}`;
  at("title").textContent = data.title;
  at("lead").textContent = [`${data.method}${accuracyOf(data)}`,
    `${OUTCOMES[data.status] || data.status} ${where(data)}`,
    counted(data.particles_there, "particle"), counted(data.springs_there, "spring")].join(" \u00b7 ");
  at("alert").hidden = !ALERTS[data.status];
  if (ALERTS[data.status]) at("alert").textContent = alertOf();
}

function writeShown() {
  const words = [data.frame_stride > 1
    ? `Shown: ${every(data.frame_stride)} of ${counted(data.frames_there, "frame")} and the last (${whole(data.frames)})`
    : `Shown: ${data.frames < data.frames_there ? `${whole(data.frames)} of ${whole(data.frames_there)} frames`
      : data.frames_there === 1 ? "the one frame that there is" : `all ${counted(data.frames_there, "frame")}`}`];
  words.push(data.spring_stride > 1
    ? `drawn: ${every(data.spring_stride)} spring of ${whole(data.springs_there)} (${whole(data.springs)})` : "all springs");
  if (data.loose_stride > 1) words.push(`${every(data.loose_stride)} of ${whole(data.loose_there)} particles without springs`);
  if (data.damaged > 0) words.push(`${counted(data.damaged, "damaged frame")} skipped`);
  words.push(`positions to 1/131,070 of the extent of their frame (at most ${number(farthest(run) / 131070)} m)`);
  if (data.by_first_frame) words.push("strain against the first frame, since the file holds no rest lengths");
  at("shown").textContent = `${words.join("; ")}.`;
  const { machine, versions } = data;
  const facts = { file: data.file, written: data.date, hooke: versions.hooke, "three.js": versions.threejs,
    "Chart.js": versions.chartjs, processor: machine.processor,
    licences: "three.js, its OrbitControls and Chart.js, which are in this page, are under the MIT licence; copyright their authors" };
  for (const [name, value] of Object.entries(facts)) if (value) at("about").append(element("dt", name), element("dd", value));
}

function writeLegend(palette) {
  writeScale(palette, data.strain);
  const beyond = [];
  if (data.strain_low < -data.strain) beyond.push(`least ${percent(data.strain_low)}`);
  if (data.strain_high > data.strain) beyond.push(`largest ${percent(data.strain_high)}`);
  at("beyond").textContent = beyond.join(", ");
  for (const name of ["pinned", "driven"]) at(name).hidden = !marks.includes(MARK[name]);
}

/* ---- axes ---- */

const AXES = [["x", "#d1495b"], ["y", "#3a9d5d"], ["z", "#3f78c9"]];
function drawAxes() {
  const space = "http://www.w3.org/2000/svg", turn = picture.camera.quaternion.clone().conjugate();
  at("axes").replaceChildren(...AXES.map(([name, stroke], axis) => {
    const to = new THREE.Vector3().setComponent(axis, 1).applyQuaternion(turn), group = document.createElementNS(space, "g");
    const line = document.createElementNS(space, "line"), text = document.createElementNS(space, "text");
    for (const [key, value] of Object.entries({ x2: 20 * to.x, y2: -20 * to.y, stroke })) line.setAttribute(key, value);
    for (const [key, value] of Object.entries({ x: 27 * to.x, y: -27 * to.y })) text.setAttribute(key, value);
    text.textContent = name;
    if (Math.hypot(to.x, to.y) > 0.25) group.append(line, text);
    return group;
  }));
}

/* ---- frames ---- */

const energies = new Diagram(at("energies")), course = new Diagram(at("course")), apart = new Diagram(at("apart-course")), watched = watchedDiagrams();
let picture = null, shown = 0, playing = false, wanted = false, turned = false, time = data.time[0], before = 0, drawn = [];

/* Draws at the next occasion, once. */
function draw() {
  turned = true;
  if (wanted || playing) return;
  wanted = true;
  requestAnimationFrame(() => {
    wanted = false;
    drawNow();
  });
}

function drawNow() {
  if (!picture) return;
  picture.draw();
  drawAxes();
}

function show(k, now = false) {
  shown = Math.max(0, Math.min(last, k));
  if (picture) picture.show(shown);
  const number_ = data.frame[shown];
  at("frame").value = shown;
  at("now").textContent = `frame ${number_} / ${data.frames_there - 1}  \u00b7  t = ${number(data.time[shown], 4)} s` +
    (number_ >= data.good_frames ? "  \u00b7  after it diverged" : "");
  writePicked();
  document.body.dataset.frame = shown;
  if (!playing) time = data.time[shown];
  for (const drawn_ of [energies, course, apart, ...watched.map(([, one]) => one)]) drawn_.moveCursor();
  if (now) drawNow();
  else draw();
  tell("time", data.time[shown]);
}

function step(by) {
  pause();
  show(shown + by);
}

/* ---- pages beside this one ---- */

let following = false;
function tell(what, value) {
  if (window.name === "beside" && !following) window.parent.tellOthers(window, what, value);
}

window.isPlaying = () => playing;
window.duration = data.time[last] - data.time[0];
window.follow = (what, value) => {
  following = true;
  if (what === "time") {
    if (playing) pause();
    show(frameNear(data.time, value));
  } else if (picture) {
    picture.setAngle(value);
  }
  following = false;
};
window.points = () => (picture ? picture.sample(picture.someFrames) : []);
window.share = (runs_) => {
  shared = runs_;
  data.strain = Math.max(...shared.map((one) => one.data.strain));
  if (picture) picture.setHome(boxAround(shared.map((one) => homeOf(one.data).home)));
  findAparts();
  dress();
  show(shown);
};
window.lead = (points) => {
  if (picture) {
    picture.look(points, picture.towards);
    tell("angle", picture.angle());
  }
  if (!matchMedia("(prefers-reduced-motion: reduce)").matches) play();
};

/* ---- playing ---- */

function writeSpeeds() {
  const pace = (data.time[last] - data.time[0]) / Math.max(3, data.frames / 30) || 1;
  const power = 10 ** Math.floor(Math.log10(pace)), near = (head) => Math.abs(Math.log(head * power / pace));
  const middle = power * [1, 2, 3, 5, 10].sort((a, b) => near(a) - near(b))[0];
  const list = [0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10].map((factor) => Number((factor * middle).toPrecision(2)));
  at("speed").append(...list.map((value) => element("option", value === 1 ? "real time" : `${number(value)} \u00d7 real time`,
    { value, selected: value === list[4] })));
}

/* If drawing does not keep up, such as without a graphics card, fewer springs are drawn while something
 * moves. */
const SLOW = 1000 / 28, WANTED = 1000 / 34, FEWEST = 5000; // [ms] for a picture; springs
let enough = 1, costs = [], costBefore = Infinity;
const middleOf = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

function thin(stride) {
  if (!picture || picture.stride === stride) return;
  picture.thin(stride);
  say(stride === 1 ? "" : `While it moves, ${every(stride)} spring is drawn, to keep up with 30 pictures a second.`);
  show(shown);
}

/* Springs that may be left out: not those that are a surface. */
const drawnAtMost = () => (picture && picture.order.length < picture.all.length ? picture.order.length : data.springs);

function keepUp(cost) {
  costs = [...costs.slice(-8), cost];
  const usual = middleOf(costs), most = Math.floor(drawnAtMost() / FEWEST);
  if (costs.length < 6 || usual <= SLOW || enough >= most || usual > 0.9 * costBefore) return; // or it did not help
  costBefore = usual;
  enough = Math.min(most, Math.ceil(enough * Math.min(2, usual / WANTED)));
  costs = [];
  thin(enough);
}

/* Frames drawn in the last second. */
function tellRate(now) {
  drawn = [...drawn.filter((then) => now - then <= 1000), now];
  const rate = (1000 * (drawn.length - 1)) / (now - drawn[0] || 1);
  if (drawn.length > 2) at("rate").textContent = `${rate.toFixed(0)} pictures/s`;
  document.body.dataset.rate = rate.toFixed(1);
}

let drew = false, ended = false; // the last frame was passed
function tick(now) {
  if (!playing) return;
  if (drew) keepUp(now - before);
  time += (Math.min(now - before, 250) / 1000) * Number(at("speed").value);
  before = now;
  if (time > data.time[last]) {
    ended = true;
    time = data.time[0];
  }
  const k = frameNear(data.time, time);
  drew = k !== shown || turned;
  turned = false;
  if (k !== shown) show(k, true);
  else if (drew) drawNow();
  if (drew) tellRate(now);
  requestAnimationFrame(tick);
}

function play() {
  if (playing || last === 0) return;
  if (shown === last) show(0);
  playing = true;
  time = data.time[shown];
  before = performance.now();
  drawn = costs = [];
  drew = false;
  thin(enough);
  at("play").textContent = "Pause";
  requestAnimationFrame(tick);
}

function pause() {
  playing = false;
  thin(1);
  at("play").textContent = "Play";
  at("rate").textContent = "";
}

const KEYS = {
  " ": () => (playing ? pause() : play()), ArrowLeft: (event) => step(event.shiftKey ? -10 : -1),
  ArrowRight: (event) => step(event.shiftKey ? 10 : 1), Home: () => step(-data.frames), End: () => step(data.frames), f: fit, F: fit,
  o: () => window.name === "beside" && window.parent.putOver(),
};

function fit() {
  if (!picture) return;
  picture.fit(shown);
  draw();
}

function listen() {
  at("play").onclick = () => (playing ? pause() : play());
  at("fit").onclick = fit;
  at("frame").max = last;
  at("frame").oninput = () => {
    pause();
    show(Number(at("frame").value));
  };
  addEventListener("keydown", (event) => {
    const own = event.key === " " ? "BUTTON SELECT SUMMARY" : "SELECT";
    if (event.ctrlKey || event.metaKey || event.altKey || own.includes(event.target.tagName) || !KEYS[event.key]) return;
    event.preventDefault();
    KEYS[event.key](event);
  });
  addEventListener("resize", () => {
    if (picture && document.body.classList.contains("bare")) picture.fitAll(); // nobody has turned it
    draw();
  });
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", dress);
}

/* ---- what is shown ---- */

function say(text) {
  at("thinned").textContent = text;
  at("thinned").hidden = text === "";
}

function relook() {
  const tinted = at("tint").checked && runs.length === 1;
  at("tint").disabled = runs.length > 1;
  at("scale").hidden = data.springs === 0 || !tinted;
  if (!picture) return;
  picture.setLook(picture.hasBodies ? at("look").value : "springs", tinted);
  show(shown);
}

function writeLooks() {
  const bodies = picture && picture.hasBodies;
  at("look-label").hidden = !bodies;
  at("tint").checked = !bodies;
  at("look").onchange = at("tint").onchange = relook;
  at("save").onchange = () => {
    const save = SAVES[at("save").value];
    at("save").value = "";
    if (picture && save) save();
  };
}

/* Colours, as light or dark as the reader's. */
function dress() {
  colourRuns();
  writeLegend(picture ? picture.paint() : PALETTE[isDark() ? "dark" : "light"]);
  drawEnergies();
  drawWatched();
  drawCourse();
  drawApart();
  draw();
}

function start() {
  const fragment = new URLSearchParams(location.hash.slice(1)), asked = fragment.get("frame"); // page.html#frame=40&bare
  document.body.classList.toggle("bare", fragment.has("bare"));
  runs = [run];
  writeHead();
  writeShown();
  writeSpeeds();
  try {
    picture = new Picture(at("picture"), run);
    picture.controls.addEventListener("change", draw);
    picture.controls.addEventListener("change", () => tell("angle", picture.angle()));
    picture.controls.addEventListener("start", () => thin(enough));
    picture.controls.addEventListener("end", () => playing || thin(1));
  } catch (trouble) {
    at("missing").hidden = false;
    at("legend").hidden = true;
  }
  writeLooks();
  listen();
  if (picture) listenToPicks();
  dress();
  relook();
  show(asked === null && picture ? firstFrame() : Number(asked) || 0, true);
  if (asked === null && picture && window.name !== "beside" && !matchMedia("(prefers-reduced-motion: reduce)").matches) play();
}

/* The one in which the most is seen, of a few. */
function firstFrame() {
  const kept = keptFrames(data), some = Math.ceil(kept.length / 24);
  return picture.fullest(kept.filter((_, place) => place % some === 0));
}

start();
