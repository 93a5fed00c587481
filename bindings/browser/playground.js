"use strict";
/* The page: what it asks the worker, in which the library runs, for one frame after another, and what the reader does. Numbers are in SI
 * units. */

const { scenes, files } = JSON.parse(at("data").textContent);
const FIRST = "cloth-16";
const KNOBS = ["stiffness", "damping", "mass"]; // factors, by tenths of a power of ten
const SLOW_FRAME = 140; // [ms] between frames while it blows up

let worker = null, methods = [], scene = null, picture = null, chart = null, bounds = [];
let playing = true, asked = false, ended = null, before = 0, stepRange = [1e-5, 1e-1], tested = null;
let predicts = false; // the build has LAPACK

/* ---- the worker ---- */

function newWorker() {
  const made = new Worker(URL.createObjectURL(new Blob([at("worker").textContent], { type: "text/javascript" })));
  made.postMessage({ wasm: bytesOf(at("wasm").textContent).buffer, files });
  return made;
}

let number_ = 0, expected = 0;
function tell(request) {
  number_ += 1;
  worker.postMessage({ ...request, number: number_ });
  return number_;
}

/* Asks for the next frame, unless one is on its way. */
function ask() {
  if (!playing || asked || ended || !scene) return;
  asked = true;
  requestAnimationFrame((now) => {
    const passed = Math.min(Math.max(now - before, 0), 100) / 1000;
    before = now;
    expected = tell({ do: "piece", seconds: passed * Number(at("speed").value) });
  });
}

function onFrame(frame) {
  asked = false;
  take(frame);
  addEnergy(frame);
  drawEnergies(frame.ended ? Infinity : performance.now());
  if (frame.ended) {
    ended = frame;
    at("play").disabled = true;
    explain(frame);
  } else {
    writeVerdict(frame);
    if (frame.slow) setTimeout(ask, SLOW_FRAME);
    else ask();
  }
}

function onOpened(opened) {
  const low = opened.bounds.filter((value) => value > 0 && Number.isFinite(value)), usual = Math.min(...low, opened.step);
  stepRange = [usual / 20, Math.max(...low.filter((value) => value < 50 * usual), opened.step) * 8];
  at("method").value = opened.method;
  setStep(opened.step);
  if (!gravityMoved) at("gravity").value = Math.round(10 * Math.hypot(...opened.gravity));
  bounds = opened.bounds;
  makePicture(opened);
  begin(opened);
}

function begin(state) {
  ended = null;
  at("play").disabled = false;
  asked = false;
  energies = { motion: [], gone: [] };
  addEnergy({ time: 0, energies: state.energies, slow: false });
  charted = 0;
  drawEnergies();
  before = performance.now();
  at("play").textContent = playing ? "Pause" : "Play";
  markBound();
  writeKnobs();
  writeVerdict({ slow: false });
  predictSoon();
  ask();
}

const HEARD = {
  ready({ methods: list, version, lapack }) {
    methods = list;
    predicts = lapack !== "";
    at("method").append(...list.map(({ name, summary }) => element("option", name, { value: name, title: summary })));
    at("about").textContent = `hooke ${version} as WebAssembly${lapack ? ", with LAPACK" : ""}; drawn with three.js and Chart.js (MIT licence). ` +
      "Methods with a fixed step give the same bits here as natively. Nothing is sent anywhere.";
    readLink(location.hash).then((linked) => openScene(linked || { text: scenes[at("scenes").value] }));
  },
  opened(reply) {
    showTrouble(null);
    onOpened(reply);
  },
  bounds(reply) {
    bounds = reply.bounds;
    markBound();
    if (!ended) writeVerdict({ slow: false });
  },
  restarted(reply) {
    take(reply);
    begin(reply);
  },
  frame: onFrame,
  state: ({ state, to }) => to === stateAsked && consult({ do: "limit", ...sceneNow(), state }),
  error({ message, wrong }) {
    asked = false;
    if (wrong) {
      showTrouble(message);
      ask(); // what runs goes on
    } else verdict("blown", `This page failed: ${message}`);
  },
};

/* A frame that was asked for before something changed is of no use. */
function hear({ data }) {
  if (data.is === "frame" && data.to !== expected) return;
  HEARD[data.is](data);
  document.body.dataset.heard = data.is;
}

/* ---- what the reader does ---- */

function openScene({ text, changes: given, method: by, step: length }) {
  at("text").value = text;
  numberLines(0);
  for (const name of KNOBS) at(name).value = given ? Math.round(10 * Math.log10(given[name])) : 0;
  gravityMoved = Boolean(given) && given.gravity !== null;
  if (gravityMoved) at("gravity").value = 10 * given.gravity;
  expected = 0;
  dismiss();
  dropStudy();
  tell({ do: "open", text, changes: changes(), method: by, step: length });
}

function reopen() {
  gravityMoved = false;
  openScene({ text: at("text").value });
}

function restart() {
  expected = 0;
  tell({ do: "restart", method: method(), step: stepNow() });
}

/* While it runs, from where it is on; after an explosion, from the start. */
function alter(request) {
  writeKnobs();
  markBound();
  if (!scene) return;
  expected = 0;
  asked = false;
  tell({ ...request, method: method(), step: stepNow() });
  predictSoon();
  return ended ? restart() : ask();
}

async function copyLink() {
  const fragment = await writeLink(sceneNow());
  const address = `${location.href.replace(/#.*/, "")}#${fragment}`;
  history.replaceState(null, "", `#${fragment}`);
  at("linked").textContent = "The address of this page now holds the scene.";
  if (navigator.clipboard) navigator.clipboard.writeText(address).then(() => { at("linked").textContent = "Copied."; }, () => {});
}

function writeSliders() {
  let text;
  try {
    text = JSON.parse(changedScene(at("text").value, changes()));
  } catch (trouble) {
    return; // the editor says what is wrong
  }
  text.run = { ...text.run, method: method(), step: stepNow() };
  for (const name of ["every", "checkpoint"]) delete text.run[name];
  openScene({ text: JSON.stringify(text, null, 2) });
}

function togglePlay() {
  playing = !playing;
  at("play").textContent = playing ? "Pause" : "Play";
  before = performance.now();
  ask();
}

function listen() {
  const [, asked] = location.hash.match(/^#open=([\w-]+)$/) || [], first = Object.keys(scenes).includes(asked) ? asked : FIRST;
  at("play").onclick = togglePlay;
  at("again").onclick = restart;
  at("fit").onclick = () => picture && (picture.fit(scene.live), picture.draw());
  at("tint").onchange = dress;
  at("method").onchange = () => alter({ do: "use" });
  at("step").oninput = () => {
    tested = null;
    alter({ do: "use" });
  };
  for (const name of [...KNOBS, "gravity"]) {
    at(name).oninput = () => {
      gravityMoved = gravityMoved || name === "gravity";
      dropStudy();
      alter({ do: "change", text: at("text").value, changes: changes() });
    };
  }
  at("scenes").append(...Object.keys(scenes).map((name) => element("option", name, { value: name,
    title: JSON.parse(scenes[name]).title || name, selected: name === first })));
  at("scenes").onchange = () => {
    gravityMoved = false;
    openScene({ text: scenes[at("scenes").value] });
  };
  at("study-begin").onclick = beginStudy;
  at("link").onclick = copyLink;
  at("write").onclick = writeSliders;
  listenToText(reopen);
  addEventListener("resize", () => picture && picture.draw());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    if (picture) picture.paint();
    makeChart();
    drawFront();
    dress();
  });
}

function startUp() {
  document.body.classList.toggle("front", location.hash === "#front");
  playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  makeChart();
  listen();
  worker = newWorker();
  worker.onmessage = hear;
}

startUp();
