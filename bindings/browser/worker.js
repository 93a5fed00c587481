"use strict";
/* The worker: opens scenes and takes their steps piece by piece, as the page asks for pictures. Before numbers grow without a
 * cause it goes back and takes the steps one by one, so that one sees how it begins. */

const BUDGET = 28; // [ms] for the steps of a piece
const GAIN = { slow: 1, diverged: 100 }; // of the energy that there was, as where runs of the library end
const WIDEST_SHOWN = 1e5; // times the extent at the start

let library = null, live = null, net = null, watch = null, pace = null, files = {};
let first = null, calm = null; // states: where this run began, and the last one before the trouble

/* ---- what a scene has of energy, and how much of it came from nowhere ---- */

class Watch {
  constructor(live) {
    this.first = live.energies;
    this.fall = 0;
    this.lenient = live.isDriven ? 1e4 : 1; // a drive adds energy
    this.extent = extentOf(boxOf(live.position));
  }

  look(now) {
    this.fall = Math.max(this.fall, Math.abs(now.gravity - this.first.gravity));
    const gain = now.motion + now.gravity - this.first.motion - this.first.gravity, there = this.first.motion + this.fall;
    if (!Number.isFinite(gain)) return Infinity;
    return there > 0 ? gain / there / this.lenient : 0;
  }
}

/* ---- opening ---- */

/* A few states of the scene's own run, for the camera and the colours. */
function preview(given) {
  const states = [live.now], duration = given.duration > 0 ? given.duration : 1;
  const from = performance.now(), steps = Math.max(1, Math.round(duration / 15 / live.step)), look = new Watch(live);
  while (states.length < 16 && performance.now() - from < 500) {
    if (!live.take(Math.min(steps, 2000)) || look.look(live.energies) > GAIN.slow) break;
    states.push(live.now);
  }
  return states;
}

function start(scene, text) {
  const parsed = JSON.parse(text);
  if (live) live.release();
  live = scene;
  live.isDriven = [...(parsed.driven || []), ...(parsed.obstacles || [])].some(({ motion }) => motion);
  return parsed;
}

/* From the state that is there on. */
function runBy(method, step) {
  live.use(method, step);
  watch = new Watch(live);
  first = live.now;
  pace = { owed: 0, slow: false, steps: 1, before: 0, cost: 0, ended: false, diverged: null, calm: 0 };
}

function open({ text, changes, method, step }) {
  const own = new Live(library, text); // so that errors are at their place in the text
  const run = own.given, by = run.method || "symplectic-euler", changed = changedScene(text, changes);
  const parsed = start(changed === text ? own : (own.release(), new Live(library, changed)), changed);
  net = live.net;
  live.use(by, run.step > 0 ? run.step : safeStep(by) || 1e-3);
  const seen = preview(run), states = seen.map(({ position }) => position);
  net.strain = strainScale(states, net);
  live.reset();
  runBy(method || by, step || live.step);
  return { is: "opened", method: method || by, step: live.step, ends: net.ends, marks: net.held, strain: net.strain,
    bodies: bodiesOf(parsed, live, files), obstacles: live.obstacles([...seen.map(({ time }) => time), 0]), gravity: parsed.gravity || [0, 0, 0],
    frames: states.map((q) => packFrame(q, net, net.strain)), bounds: live.bounds, energies: live.energies };
}

/* Half of the bound, 0 where there is none. */
function safeStep(method) {
  const row = library.methods().find(({ name }) => name === method), bound = row ? live.bounds[row.place] : NaN;
  return Number.isFinite(bound) && bound > 0 ? bound / 2 : 0;
}

/* Another text with as many particles, from the state that is there on. */
function change({ text, changes, method, step }) {
  const old = live, changed = changedScene(text, changes), scene = new Live(library, changed);
  if (scene.count === old.count) scene.put(old.now);
  start(scene, changed);
  net = { ...live.net, strain: net.strain };
  runBy(method, step);
  return { is: "bounds", bounds: live.bounds };
}

/* ---- pieces ---- */

/* As many steps as are due, fewer where they take too long; false if they overflowed. */
function takeDue(seconds) {
  pace.owed = Math.min(pace.owed + seconds / live.step, 1e6);
  let due = pace.slow ? pace.steps : Math.floor(pace.owed), taken = 0;
  const from = performance.now();
  while (due > 0 && performance.now() - from < BUDGET) {
    const few = Math.max(1, Math.min(due, pace.cost > 0 ? Math.ceil(BUDGET / pace.cost / 4) : 1));
    const begun = performance.now();
    if (!live.take(few)) return { whole: false };
    const cost = (performance.now() - begun) / few;
    pace.cost = pace.cost > 0 ? 0.8 * pace.cost + 0.2 * cost : cost;
    due -= few;
    taken += few;
  }
  pace.owed = pace.slow || due > 0 ? 0 : pace.owed - taken;
  return { whole: true, late: due > 0 };
}

/* Few steps a picture while the energy grows fast, more where it hardly does; false where they were far too many. */
function adaptSteps(motion) {
  const ratio = pace.before > 0 ? motion / pace.before : 1;
  if (pace.steps > 1 && !(ratio < 20)) {
    pace.steps = Math.max(1, pace.steps >> 2);
    return false;
  }
  pace.steps = ratio > 3 ? Math.max(1, pace.steps >> 1) : ratio < 1.4 ? Math.min(256, 2 * pace.steps) : pace.steps;
  pace.before = motion;
  return true;
}

function slowDown() {
  live.restore();
  calm = live.now;
  Object.assign(pace, { slow: true, steps: 1, owed: 0, before: live.energies.motion });
}

function follow({ whole }) {
  const gain = whole ? watch.look(live.energies) : Infinity;
  if (!pace.slow) {
    if (gain > GAIN.slow) slowDown();
    return;
  }
  if (!adaptSteps(whole ? live.energies.motion : Infinity)) {
    live.restore();
    return;
  }
  if (gain > GAIN.diverged && pace.diverged === null) pace.diverged = live.time;
  pace.ended = !whole || extentOf(boxOf(live.position)) > WIDEST_SHOWN * watch.extent;
  pace.calm = gain < 0.5 ? pace.calm + 1 : 0;
  if (pace.calm > 30) pace.slow = false;
}

function piece({ seconds }) {
  if (pace.ended) return null;
  live.keep();
  const done = takeDue(seconds), { slow, diverged, ended } = (follow(done), pace);
  return { is: "frame", ...packFrame(live.position, net, net.strain), time: live.time, energies: live.energies, bounds: live.bounds,
    obstacles: live.obstacles([live.time]), slow, diverged, ended, trouble: ended ? { first, last: calm } : null, late: Boolean(done.late) };
}

/* ---- messages ---- */

const ANSWERS = {
  open, change, piece,
  state: () => ({ is: "state", state: live.now }),
  /* Of a worker that takes no steps. */
  limit({ text, changes, method, state }) {
    const other = new Live(library, changedScene(text, changes));
    if (state.position.length === 3 * other.count) other.put(state);
    return { is: "limit", ...limitOf(other, method) };
  },
  why({ text, changes, ...asked }) {
    return { is: "why", ...whyOf(new Live(library, changedScene(text, changes)), asked) };
  },
  study({ text, changes }) {
    return { is: "studied", ...studyOf(new Live(library, changedScene(text, changes))) };
  },
  use({ method, step }) {
    runBy(method, step);
    return { is: "bounds", bounds: live.bounds };
  },
  restart({ method, step }) {
    live.reset();
    runBy(method, step);
    return { is: "restarted", ...packFrame(live.position, net, net.strain), time: 0, energies: live.energies, bounds: live.bounds,
      obstacles: live.obstacles([0]) };
  },
};

function answer({ data }) {
  let reply;
  try {
    reply = ANSWERS[data.do](data);
  } catch (trouble) {
    reply = { is: "error", message: trouble.message, wrong: trouble instanceof HookeError };
  }
  if (reply) postMessage({ ...reply, to: data.number });
}

async function ready({ data }) {
  const module = await createHooke({ wasmBinary: data.wasm, print() {}, printErr() {} });
  files = data.files;
  for (const [name, text] of Object.entries(files)) module.FS.writeFile(`/${name}`, text);
  library = new Library(module);
  onmessage = answer;
  postMessage({ is: "ready", methods: library.methods(), version: library.text(library.call("version")),
    lapack: library.text(library.call("build_fact", "lapack")) });
}

onmessage = ready;
