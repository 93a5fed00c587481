"use strict";
/* The steps of a run that blew up, beside the same with the advised change; energies; the mode that leaves the region. */

const ran = data.frames || [], advised = data.advised || {}, cured = advised.frames || [];
const last = data.last || 0; // frame that is within all bounds still
const RED = "#c8102e", SURFACE = "#7fb2e544", stepOf = (frame) => Math.round((frame.time - ran[last].time) / data.step);

/* ---- where things are ---- */

const placeOf = (frame, k, axis) => frame.position[3 * k + axis];

function boxOf(frame) {
  return [0, 1, 2].map((axis) => extentBy(particles, (k) => placeOf(frame, k, axis)));
}

const home = ran.length ? boxOf(ran[0]) : [];
const sizeOf = (box) => Math.max(...box.map(spanOf));
const homeSize = sizeOf(home) || longestBlamed() || 1;
const middle = home.map(([low, high]) => (low + high) / 2);

/* How far from the middle anything has been so far, along each axis: the picture never zooms in again. */
function reaches(frames) {
  let most = [0, 0, 0];
  return frames.map((frame) => {
    most = most.map((far, axis) => particles.reduce((so, k) => Math.max(so, Math.abs(placeOf(frame, k, axis) - middle[axis])), far));
    return most;
  });
}
const zoom = { bad: reaches(ran), good: reaches(cured) };

/* ---- a frame ---- */

const firstAxes = () => widestView((axis) => Math.max(...ran.slice(0, last + 1).map((frame) => spanOf(boxOf(frame)[axis]))));

/* Parts as surfaces, behind their springs. Their triangles turn one way, so that folds leave no holes. */
const { triangles } = findBodies(picture, particles.length);

function fillSurfaces(ctx, at) {
  ctx.fillStyle = SURFACE;
  ctx.beginPath();
  for (let k = 0; k < triangles.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((corner) => at(triangles[k + corner]));
    const turned = (b[0] - a[0]) * (c[1] - a[1]) < (b[1] - a[1]) * (c[0] - a[0]);
    ctx.moveTo(...a);
    ctx.lineTo(...(turned ? c : b));
    ctx.lineTo(...(turned ? b : c));
    ctx.closePath();
  }
  ctx.fill();
}

let shown = 0, playing = true, axes = "xy", before = 0;

/* Returns how many times it has zoomed out. */
function paint(id, frame, reach, beyond) {
  const canvas = at(id), ctx = canvas.getContext("2d"), ratio = devicePixelRatio || 1;
  const wide = canvas.clientWidth, tall = canvas.clientHeight;
  if (canvas.width !== Math.round(wide * ratio) || canvas.height !== Math.round(tall * ratio))
    Object.assign(canvas, { width: Math.round(wide * ratio), height: Math.round(tall * ratio) });
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  ctx.clearRect(0, 0, wide, tall);
  canvas.classList.toggle("beyond", beyond);
  if (!frame) return 1;
  const [across, up] = VIEWS[axes];
  const spans = [across, up].map((axis) => Math.max(spanOf(home[axis]), 0.25 * homeSize));
  const near = Math.min((0.84 * wide) / spans[0], (0.84 * tall) / spans[1]);
  const unit = Math.min(near, (0.47 * wide) / reach[across], (0.47 * tall) / reach[up]);
  const pixel = (k) => [wide / 2 + unit * (placeOf(frame, k, across) - middle[across]),
    tall / 2 - unit * (placeOf(frame, k, up) - middle[up])];
  fillSurfaces(ctx, pixel);
  ctx.lineCap = "round";
  for (const [list, colour, width] of [[listed.filter((one) => !isBlamed(one)), EDGE, listed.length > 300 ? 0.8 : 1.6],
    [listed.filter(isBlamed), RED, listed.length > 300 ? 1.6 : 3]]) {
    ctx.strokeStyle = colour;
    ctx.lineWidth = width;
    ctx.beginPath();
    for (const { ends: [a, b] } of list) {
      ctx.moveTo(...pixel(a));
      ctx.lineTo(...pixel(b));
    }
    ctx.stroke();
  }
  const dot = particles.length > 400 ? 1 : particles.length > 60 ? 2 : 3.5;
  ctx.fillStyle = INK;
  for (const k of particles) {
    const [x, y] = pixel(k);
    if (picture.held[k]) ctx.fillRect(x - dot, y - dot, 2 * dot, 2 * dot);
    else if (particles.length <= 800 || particles.length > listed.length) {
      ctx.beginPath();
      ctx.arc(x, y, dot, 0, 7);
      ctx.fill();
    }
  }
  ruler(ctx, wide, tall, unit);
  return near / unit;
}

/* A length of 1, 2 or 5 times a power of ten. */
function ruler(ctx, wide, tall, unit) {
  const most = (0.25 * wide) / unit, decade = 10 ** Math.floor(Math.log10(most));
  const length = decade * [5, 2, 1].find((head) => head * decade <= most);
  ctx.strokeStyle = ctx.fillStyle = INK;
  ctx.lineWidth = 2;
  ctx.beginPath();
  ctx.moveTo(12, tall - 12);
  ctx.lineTo(12 + length * unit, tall - 12);
  ctx.stroke();
  ctx.font = "13px system-ui, sans-serif";
  ctx.fillText(`${words(length)} m`, 12, tall - 18);
}

const scaleWords = (factor) => (factor < 1.005 ? "scale 1 : 1" : `zoomed out 1 : ${words(factor, 3)}, so that all of it is seen`);

function show(k) {
  shown = Math.max(0, Math.min(ran.length - 1, k));
  const frame = ran[shown], step = stepOf(frame), beyond = shown > last;
  const factor = paint("bad", frame, zoom.bad[shown], beyond);
  at("bad-scale").textContent = `${scaleWords(factor)}${beyond ? "; no physics any more" : ""}`;
  if (cured.length) {
    const near = Math.min(shown, cured.length - 1);
    at("good-scale").textContent = scaleWords(paint("good", cured[near], zoom.good[near], false));
  }
  at("frame").value = shown;
  at("now").textContent = `t = ${words(frame.time, 5)} s, ` + (step === 0 ? "the last step within bounds"
    : `${counted(Math.abs(step), "step")} ${step < 0 ? "before" : "after"} the last one within bounds`);
  document.body.dataset.frame = shown;
  if (chart) chart.draw();
}

/* Eight steps a second, so that one can follow; a rest at both ends. */
function tick(now) {
  const wait = shown === ran.length - 1 ? 1500 : shown === 0 ? 700 : 125;
  if (playing && now - before >= wait) {
    before = now;
    show(shown === ran.length - 1 ? 0 : shown + 1);
  }
  requestAnimationFrame(tick);
}

function play(on) {
  playing = on;
  at("play").textContent = on ? "Pause" : "Play";
}

function startFilm() {
  const slider = at("frame");
  slider.max = ran.length - 1;
  slider.oninput = () => { play(false); show(Number(slider.value)); };
  at("play").onclick = () => play(!playing);
  addEventListener("keydown", (event) => {
    if (event.target.tagName === "BUTTON" || ![" ", "ArrowLeft", "ArrowRight"].includes(event.key)) return;
    event.preventDefault();
    if (event.key === " ") play(!playing);
    else { play(false); show(shown + (event.key === "ArrowLeft" ? -1 : 1)); }
  });
  addEventListener("resize", () => show(shown));
  choice("views", VIEW_CHOICES, moving ? firstView() : firstAxes(), (key) => { axes = key; show(shown); });
  const fragment = new URLSearchParams(location.hash.slice(1)), frame = Number(fragment.get("frame")); // why.html#frame=40&bare
  document.body.classList.toggle("bare", fragment.has("bare"));
  if (fragment.has("frame")) play(false);
  show(frame || 0);
  requestAnimationFrame(tick);
}

/* ---- energy ---- */

let chart = null;

/* The growth of the mode that is drawn, in a step: every word and line has it from here. */
const growth = data.mode && data.mode.growth !== null ? data.mode.growth : NaN;

/* Growth of the energy per step: as measured after the last step within bounds, and as that mode has it. */
function rates() {
  const { value, last: at } = data.energy, to = Math.min(value.length - 1, at + 20);
  const measured = to > at && value[at] > 0 ? (value[to] / value[at]) ** (1 / (to - at)) : NaN;
  return { at, to, measured, predicted: growth ** 2 };
}

/* A vertical line at the frame that is shown. */
const cursor = {
  id: "cursor",
  afterDatasetsDraw(drawn) {
    if (!drawn.options.cursor) return;
    const { ctx, chartArea: { top, bottom }, scales: { x } } = drawn, at = x.getPixelForValue(ran[shown].time);
    ctx.save();
    ctx.strokeStyle = INK;
    ctx.beginPath();
    ctx.moveTo(at, top);
    ctx.lineTo(at, bottom);
    ctx.stroke();
    ctx.restore();
  },
};
Chart.register(cursor);

const timeAxis = (min, max) => linearAxis("time [s]", { min, max, ticks: { maxRotation: 0 } });
const course = (label, points, colour, more) => plain(label, points, colour, { pointHitRadius: 4, ...more });

function drawEnergy({ at, predicted }) {
  const { value } = data.energy, timeAt = (k) => data.time + (k - at) * data.step;
  const points = value.map((y, k) => ({ x: timeAt(k), y })).filter(({ y }) => y > 0 && Number.isFinite(y));
  const lines = [course("as it ran", points, RED)];
  if (cured.length) lines.push(course(`with the advised ${advised.method === data.method ? "step" : "method"}`,
    cured.map((frame) => ({ x: frame.time, y: frame.energy })).filter(({ y }) => y > 0), "#00875f"));
  if (predicted > 1 && value[at] > 0) {
    const ends_ = [-Math.log(1e6) / Math.log(predicted), value.length - 1 - at].map((k) => Math.max(-at, k));
    lines.push(course("growth that the mode predicts", ends_.map((k) => ({ x: timeAt(at + k), y: value[at] * predicted ** k })),
      "#7a5195", { borderDash: [6, 4] }));
  }
  const from = Math.min(ran[0].time, timeAt(Math.max(0, at - 20)));
  const until = Math.min(timeAt(value.length - 1), ran[ran.length - 1].time + 2 * data.step);
  const seen = points.filter(({ x }) => x >= from && x <= until);
  chart = draw("energy", lines, timeAxis(from, until), logAxis("energy [J]", ends(seen.map(({ y }) => y))),
    (item) => `t = ${words(item.raw.x, 5)} s: ${words(item.raw.y, 4)} J`);
  chart.options.cursor = true;
}

/* ---- the mode and the region ---- */

function drawReach(looks) {
  const points = looks.map((look) => ({ x: data.step * look.frequency, y: data.step * look.decay, look }));
  const far = (name) => Math.max(...points.map((point) => point[name]));
  const path = { label: "the mode that limits, over time", data: points, borderColor: RED, backgroundColor: RED, borderWidth: 1.5,
    pointRadius: points.map(({ look }) => (data.mode && look.time === data.mode.time ? 6 : 3)), pointStyle: "circle", order: 1 };
  const within = region(`${data.method} is stable within`, fromOrigin(pairs(data.rows[0].reach)), "#00875f");
  drawEqual("reach", [within, path], ["h \u03c9, step times frequency", "h d, step times damping"],
    { left: -0.1, right: Math.max(3, 1.15 * far("x")), bottom: -0.1, top: Math.max(1.2, 1.15 * far("y")) },
    (item) => (item.raw.look ? [`t = ${words(item.raw.look.time, 5)} s`, `${words(item.raw.look.frequency, 4)} rad/s, damping ` +
      `${words(item.raw.look.decay, 4)} 1/s`, `each step multiplies it by ${words(item.raw.look.growth, 4)}`] : ""));
}

function drawAlong(looks) {
  const points = looks.filter((look) => look.limit > 0).map((look) => ({ x: look.time, y: look.limit }));
  const low = looks[0].time, high = Math.max(looks[looks.length - 1].time, low + data.step);
  const range = ends([...points.map(({ y }) => y), data.step]);
  draw("along", [course("largest stable step", points, "#00875f", { pointRadius: 3, pointStyle: "circle" }),
    course("step of the run", [low, high].map((x) => ({ x, y: data.step })), RED, { borderDash: [6, 4] })],
  timeAxis(low, high), logAxis("step [s]", range), (item) => `t = ${words(item.raw.x, 5)} s: ${words(item.raw.y, 5)} s`);
}
