"use strict";
/* The page: sliders, picture, energies, words. The library runs in a worker, which is asked for one frame after another. Numbers are
 * in SI units; text is set as text, never as markup. */

const { scenes, files } = JSON.parse(at("data").textContent);
const FIRST = "cloth-16";
const KNOBS = ["stiffness", "damping", "mass"]; // factors, by tenths of a power of ten
const SLOW_FRAME = 140; // [ms] between frames while it blows up

let worker = null, methods = [], scene = null, picture = null, chart = null, bounds = [];
let playing = true, asked = false, ended = null, before = 0, stepRange = [1e-5, 1e-1], tested = null;
let predicts = false; // the build has LAPACK

/* ---- numbers as words ---- */

function number(value, digits = 3) {
  const size = Math.abs(value);
  if (value === 0 || (size >= 1e-3 && size < 1e5)) return String(Number(value.toPrecision(digits)));
  return value.toExponential(digits - 1).replace(/\.?0+e/, "e");
}
const seconds = (value) => (value >= 1 ? `${number(value)} s` : value >= 1e-3 ? `${number(1e3 * value)} ms` : `${number(1e6 * value)} \u00b5s`);

/* ---- sliders ---- */

const method = () => at("method").value;
const step = () => Number((stepRange[0] * (stepRange[1] / stepRange[0]) ** (at("step").value / 1000)).toPrecision(2));
const shareOf = (value) => Math.log(value / stepRange[0]) / Math.log(stepRange[1] / stepRange[0]);
const factor = (name) => Number((10 ** (at(name).value / 10)).toPrecision(2));
let gravityMoved = false;
const gravity = () => (gravityMoved ? at("gravity").value / 10 : null);
const changes = () => ({ stiffness: factor("stiffness"), damping: factor("damping"), mass: factor("mass"), gravity: gravity() });

function setStep(value) {
  at("step").value = Math.round(1000 * shareOf(value));
  tested = value;
}

/* The step as it was set, exactly, until the slider moves. */
const stepNow = () => (tested === null ? step() : tested);

function writeKnobs() {
  at("step-out").textContent = seconds(stepNow());
  for (const name of KNOBS) at(`${name}-out`).textContent = factor(name) === 1 ? "as in the scene" : `\u00d7 ${number(factor(name))}`;
  at("gravity-out").textContent = `${number(at("gravity").value / 10)} m/s\u00b2`;
}

const boundNow = () => {
  const row = methods.find(({ name }) => name === method());
  return row ? bounds[row.place] : NaN;
};

function markAt(id, share) {
  at(id).hidden = !(share >= 0 && share <= 1);
  at(id).style.left = `calc(8px + ${share} * (100% - 16px))`;
}

/* The safe step of the method as a mark on the slider. */
function markBound() {
  const bound = boundNow();
  markAt("bound", bound > 0 && Number.isFinite(bound) ? shareOf(bound) : NaN);
  at("bound-words").textContent = Number.isNaN(bound) ? "No bound is known for this method." : bound === 0
    ? "This method is stable at no step here." : bound === Infinity ? "Nothing limits the step of this method."
      : `Safe up to ${seconds(bound)} (a bound; the limit may be larger)`;
  document.body.dataset.bound = bound;
}

/* ---- words on how it goes ---- */

function verdict(kind, text) {
  at("verdict").className = kind;
  if (at("verdict-words").textContent !== text) at("verdict-words").textContent = text;
  document.body.dataset.verdict = kind;
}

function compare() {
  const bound = boundNow(), now = stepNow();
  if (Number.isNaN(bound) || bound === Infinity) return ["", `${method()} takes steps of ${seconds(now)}.`];
  if (bound === 0) return ["risky", `${method()} is stable at no step here: energy grows, if slowly.`];
  if (now <= bound) return ["safe", `The step ${seconds(now)} is below the safe bound, ${seconds(bound)}: certain to be stable about this state.`];
  return ["risky", `The step ${seconds(now)} is above the safe bound, ${seconds(bound)}. It may blow up.`];
}

function writeVerdict(frame) {
  at("cure").hidden = true;
  at("why-words").textContent = "";
  if (frame.slow) return verdict("blown", "The energy grows, and nothing in the scene feeds it. From here on, step by step.");
  return verdict(...compare());
}

/* Another run as a button. */
function offer(by, length) {
  if (by === method() && length === stepNow()) return; // a shorter run, say
  at("cure").hidden = false;
  at("cure").textContent = `${by === method() ? "" : `Set the method to ${by}. `}Set the step to ${seconds(length)} and start again`;
  at("cure").onclick = () => {
    at("method").value = by;
    setStep(length);
    restart();
  };
}

/* The step against the bound before the trouble; the cause itself takes LAPACK, and a moment. */
function explain(frame) {
  const bound = boundNow(), now = stepNow();
  verdict("blown", `It blew up at t = ${number(frame.diverged === null ? frame.time : frame.diverged)} s.`);
  const words = bound > 0 && now > bound ? `The step ${seconds(now)} was ${number(now / bound)} times the safe bound. ` : "";
  at("why-words").textContent = words + (predicts ? "Looking for the cause ..." : "The cause is not looked for in this build of the page, " +
    "which has no LAPACK: hooke why finds it.");
  if (bound > 0 && now > bound) offer(method(), Number((0.9 * bound).toPrecision(2)));
  if (predicts) {
    const steps = Math.ceil((frame.time - frame.trouble.first.time) / now) + 100;
    consult({ do: "why", ...sceneNow(), ...frame.trouble, steps });
  }
}

/* ---- predictions: by a worker of their own, which is ended when something else is asked ---- */

const sceneNow = () => ({ text: at("text").value, changes: changes(), method: method(), step: stepNow() });
let advisor = null, resting = 0, stateAsked = 0;

/* What was asked of another scene, method or step is not answered any more. */
function dismiss() {
  clearTimeout(resting);
  stateAsked = 0;
  if (advisor) advisor.terminate();
  advisor = null;
}

function consult(request) {
  dismiss();
  advisor = newWorker();
  advisor.onmessage = ({ data }) => {
    if (data.is === "ready") advisor.postMessage(request);
    else ADVICE[data.is](data);
    document.body.dataset.advice = data.is;
  };
}

const ADVICE = {
  limit({ predicted, exact }) {
    const share = predicted > 0 && Number.isFinite(predicted) ? shareOf(predicted) : NaN;
    markAt("limit", share);
    at("limit-words").textContent = predicted === 0 ? "Predicted: no step is stable." : predicted === Infinity
      ? "Predicted: nothing limits the step." : exact ? `Predicted limit: ${seconds(predicted)}` : `Predicted limit: ${seconds(predicted)} or less`;
    document.body.dataset.limit = predicted;
  },
  why({ sentence, change, advised }) {
    at("why-words").textContent = [sentence.replace(/^the run diverged: t/, "T"), change && `Advice: ${change}`].filter(Boolean).join("\n");
    if (advised) offer(advised.method, advised.step);
  },
  error({ message }) {
    at(ended ? "why-words" : "limit-words").textContent = `Not known: ${message}`;
  },
};

/* Half a second after the last change, at the state that is then shown. */
function predictSoon() {
  dismiss();
  markAt("limit", NaN);
  at("limit-words").textContent = predicts ? "" : "The limit itself is not predicted in this build of the page.";
  if (predicts) resting = setTimeout(() => { stateAsked = tell({ do: "state" }); }, 500);
}

/* ---- energies ---- */

let energies = { motion: [], gone: [] }; // `gone` since steps are taken one by one

function thinned(list) {
  return list.length <= 700 ? list : list.filter((_, k) => k % 2 === 0 || k > list.length - 40);
}

function addEnergy(frame) {
  const list = frame.slow ? "gone" : "motion", last = energies.motion[energies.motion.length - 1];
  if (frame.slow && energies.gone.length === 0 && last) energies.gone.push(last);
  if (frame.energies.motion > 0 && frame.time > 0) energies[list] = thinned([...energies[list], { x: frame.time, y: frame.energies.motion }]);
}

/* Not below a millionth of what there is: a scene at rest has an energy of rounding. */
function boundEnergies(scale) {
  const most = Math.max(0, ...energies.motion.map(({ y }) => y));
  if (most > 0) scale.min = Math.max(scale.min, 1e-6 * most);
}

function makeChart() {
  const ink = styleOf("--dim"), grid = styleOf("--line");
  if (chart) chart.destroy();
  const axis = (title, more) => ({ title: { display: true, text: title, color: ink }, grid: { color: grid, borderColor: grid },
    ...more, ticks: { color: ink, maxRotation: 0, ...more.ticks } });
  const line = (label, borderColor) => ({ label, data: [], borderColor, borderWidth: 2, pointRadius: 0, showLine: true });
  chart = new Chart(at("energy"), { type: "scatter", data: { datasets: [line("energy of motion and springs", "#2f86c9"), line("step by step", "#c0262d")] },
    options: { animation: false, maintainAspectRatio: false, events: [],
      scales: { x: axis("t [s]", { type: "linear", ticks: { callback: (value) => number(value, 6) } }),
        y: axis("energy [J]", { type: "logarithmic", afterDataLimits: boundEnergies, ticks: { callback: (value) => (Math.abs(Math.log10(value) % 1) < 1e-9 ? value.toExponential(0) : null) } }) },
      plugins: { tooltip: { enabled: false }, legend: { align: "end", labels: { color: ink, boxHeight: 0, boxWidth: 18 } } } } });
}

let charted = 0;
function drawEnergies(now = performance.now()) {
  if (now - charted < 200) return;
  charted = now;
  chart.data.datasets[0].data = energies.motion;
  chart.data.datasets[1].data = energies.gone;
  chart.update();
}

/* ---- the picture ---- */

/* The viewer's data: the frames of the preview, by which the camera is set, and last the live one. */
function makePicture(opened) {
  const canvas = at("picture"), fresh = canvas.cloneNode();
  if (picture) picture.renderer.dispose();
  for (const side of ["width", "height"]) fresh.removeAttribute(side); // which the picture sets, and what depends on it
  canvas.replaceWith(fresh);
  const frames = [...opened.frames, opened.frames[0]];
  scene = { box: frames.map(({ box }) => box), status: "running", gravity: opened.gravity, bodies: opened.bodies, live: frames.length - 1,
    bytes: frames.map(({ bytes }) => bytes) };
  picture = null;
  try {
    picture = new Picture(fresh, { data: scene, ends: opened.ends, marks: opened.marks, bytesOfFrame: (k) => scene.bytes[k] });
  } catch (trouble) {
    at("missing").hidden = false;
    return;
  }
  const palette = picture.paint();
  picture.controls.addEventListener("change", () => picture.draw());
  at("colours").style.background = `linear-gradient(to right, ${palette.join(", ")})`;
  at("low").textContent = `\u2212${number(100 * opened.strain)} %`;
  at("high").textContent = `+${number(100 * opened.strain)} %`;
  if (!opened.bodies.length) at("tint").checked = true;
  dress();
}

function dress() {
  at("scale").hidden = !at("tint").checked;
  if (picture) picture.setLook("surface", at("tint").checked);
  drawFrame();
}

const widthOf = (box) => Math.max(box[3] - box[0], box[4] - box[1], box[5] - box[2]);

/* Looks from further away, at all frames of the preview and this one, where it goes beyond what was seen. */
function widen(box) {
  const margin = 0.05 * widthOf(picture.home), beyond = [0, 1, 2].some((axis) =>
    box[axis] < picture.home[axis] - margin || box[axis + 3] > picture.home[axis + 3] + margin);
  if (!beyond) return;
  picture.home = boxAround([picture.home, box]);
  picture.look([...scene.box.keys()], picture.camera.position.clone().sub(picture.controls.target).normalize());
}

function drawFrame(blown = false) {
  if (!picture) return;
  const box = scene.box[scene.live], width = widthOf(box) / widthOf(picture.home), wide = blown && width > 1.6;
  if (!blown) widen(box);
  picture.show(scene.live);
  if (wide) picture.fit(scene.live);
  at("zoomed").textContent = wide ? `${number(width, 2)} times as wide as before; the picture zooms out` : "";
  picture.draw();
}

function take(frame) {
  scene.box[scene.live] = frame.box;
  scene.bytes[scene.live] = frame.bytes;
  drawFrame(Boolean(frame.slow));
  if (!frame.slow) bounds = frame.bounds;
  markBound();
  at("now").textContent = `t = ${number(frame.time, 4)} s${frame.late ? ", slower than asked for" : ""}`;
  document.body.dataset.time = frame.time;
}

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
    at("method").append(...list.map(({ name, summary }) => Object.assign(document.createElement("option"), { value: name, textContent: name, title: summary })));
    at("about").textContent = `hooke ${version} as WebAssembly, with jansson${lapack ? " and LAPACK" : ""}; drawn with three.js and Chart.js (MIT licence). ` +
      "Methods with a fixed step give the same bits here as natively. Nothing is sent anywhere.";
    readLink(location.hash).then((linked) => openScene(linked || { text: scenes[FIRST] }));
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
      alter({ do: "change", text: at("text").value, changes: changes() });
    };
  }
  at("scenes").append(...Object.keys(scenes).map((name) => Object.assign(document.createElement("option"), { value: name, textContent: name,
    title: JSON.parse(scenes[name]).title || name, selected: name === FIRST })));
  at("scenes").onchange = () => {
    gravityMoved = false;
    openScene({ text: scenes[at("scenes").value] });
  };
  at("link").onclick = copyLink;
  at("write").onclick = writeSliders;
  listenToText(reopen);
  addEventListener("resize", () => picture && picture.draw());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    if (picture) picture.paint();
    makeChart();
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
