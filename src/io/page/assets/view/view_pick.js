"use strict";
/* A click on a particle or on a spring shows its numbers, now and over time. */

const NEAR = { particle: 12, spring: 7 }; // pixels
let picked = null; // { of, spring } or { of, particle }: the number of the run, and the place among those shown

/* Where a particle is in the picture [pixels], and how far from the eye. */
function projector(drawn = picture) {
  const { clientWidth: wide, clientHeight: tall } = at("picture"), point = new THREE.Vector3();
  return (k) => {
    point.fromArray(drawn.place, 3 * k).project(picture.camera);
    return [(0.5 + 0.5 * point.x) * wide, (0.5 - 0.5 * point.y) * tall, point.z];
  };
}

/* The nearest of one run within reach, and how near: particles before springs. */
function nearestOf(drawn, of, x, y) {
  const where = projector(drawn), seen = Array.from({ length: drawn.marks.length }, (_, k) => where(k));
  let best = null, least = NEAR.particle;
  seen.forEach(([a, b, z], k) => {
    const far = Math.hypot(a - x, b - y) + z;
    if (z < 1 && far < least) [best, least] = [{ of, particle: k }, far];
  });
  if (best) return [best, least];
  least = NEAR.spring;
  for (let k = 0; k < drawn.ends.length; k += 2) {
    const [a, b] = [seen[drawn.ends[k]], seen[drawn.ends[k + 1]]], dx = b[0] - a[0], dy = b[1] - a[1];
    const t = Math.max(0, Math.min(1, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1)));
    const far = Math.hypot(a[0] + t * dx - x, a[1] + t * dy - y) + Math.min(a[2], b[2]);
    if (far < least) [best, least] = [{ of, spring: k / 2 }, far];
  }
  return [best, best ? least : Infinity];
}

function pickAt(x, y) {
  const found = picture.runs.map((drawn, of) => nearestOf(drawn, of, x, y));
  return found.reduce((a, b) => (b[1] < a[1] ? b : a))[0];
}

/* ---- numbers, and places among those shown ---- */

const particleNumber = ({ data: { particle } }, k) => (particle ? particle[k] : k);
const springNumber = ({ data: { spring_stride: stride } }, k) => k * stride;
const particlePlace = ({ data: { particle, particles } }, number_) => (particle ? particle.indexOf(number_) : number_ < particles ? number_ : -1);
const springPlace = ({ data: { spring_stride: stride, springs } }, number_) =>
  (number_ % stride === 0 && number_ / stride < springs ? number_ / stride : -1);

function groupOf({ data: { groups } }, spring) {
  let first = 0;
  for (const group of groups || []) {
    if (spring < first + group.count) return group;
    first += group.count;
  }
  return null;
}

/* ---- what is known of a particle or a spring in a frame ---- */

const strainOf = (of, frame, k) => (of.rest[k] > 0 ? of.elongation(frame, k) / of.rest[k] : NaN);

/* Of the spring's stiffness; what its damping adds takes velocities, which a page does not have. */
function tensionOf(of, frame, k) {
  if (!of.stiffness) return NaN;
  const group = groupOf(of, springNumber(of, k)), elongation = of.elongation(frame, k);
  return group && group.pull_only && elongation <= 0 ? 0 : of.stiffness[k] * elongation;
}

const farthest = ({ data: { box } }) => Math.max(...box.map(widthOf));
const rounding = () => `to ${number(100 * ROUNDING, 1)} %`;
const QUANTITIES = {
  spring: [
    { name: "elastic tension", unit: "N", of: tensionOf, known: () => `each ${rounding()}, without what damping adds` },
    { name: "strain", unit: "", percents: true, of: strainOf, known: () => `each ${rounding()}` },
    { name: "length", unit: "m", of: (of, frame, k) => of.rest[k] + of.elongation(frame, k),
      known: () => `what it has beyond the rest length ${rounding()}` },
  ],
  particle: [..."xyz"].map((name, axis) => ({ name, unit: "m", of: (of, frame, k) => of.coordinate(frame, k, axis),
    known: (of) => `each to ${number(farthest(of) / 131070)} m or better` })),
};

const kindOf = ({ spring }) => (spring === undefined ? "particle" : "spring");

/* The same spring or particle of each run that has it. */
function placesOf({ of, ...there }) {
  const kind = kindOf(there), [numberOf, placeOf] = kind === "spring" ? [springNumber, springPlace] : [particleNumber, particlePlace];
  const number_ = numberOf(runs[of], there[kind]);
  return runs.map((one) => ({ one, k: placeOf(one, number_) })).filter(({ k }) => k >= 0);
}

/* ---- words and diagram ---- */

const MARK_WORDS = { 0: "", 1: ", pinned", 2: ", driven", 3: ", without springs" };

function positionOf(k, drawn = picture) {
  const { centre, radius, target = [0, 0, 0] } = drawn.unit;
  return [0, 1, 2].map((axis) => centre[axis] + radius * (drawn.place[3 * k + axis] - target[axis]));
}

function describeParticle({ of, particle: k }) {
  const drawn = picture.runs[of];
  return [`particle ${particleNumber(drawn, k)}${MARK_WORDS[drawn.marks[k]]}`,
    positionOf(k, drawn).map((value, axis) => `${"xyz"[axis]} ${number(value, 5)}`).join(", ") + " m"];
}

function describeSpring({ of, spring: k }) {
  const one = runs[of], frame = frameNear(one.data.time, data.time[shown]), spring = springNumber(one, k), group = groupOf(one, spring);
  const strain = strainOf(one, frame, k), tension = tensionOf(one, frame, k);
  return [`spring ${spring}, between particles ${[0, 1].map((end) => particleNumber(one, one.ends[2 * k + end])).join(" and ")}` +
    (group && group.name ? `, group ${group.name}` : ""),
  Number.isNaN(strain) ? "without a rest length" : `strain ${percent(strain)}`,
  Number.isNaN(tension) ? "tension not known: the file does not hold its scene, or no rest lengths" : `elastic tension ${number(tension)} N`];
}

function writePicked() {
  if (!picked || !picture) return;
  const lines = kindOf(picked) === "spring" ? describeSpring(picked) : describeParticle(picked);
  at("picked").replaceChildren(...(runs.length > 1 ? [nameOf(runs[picked.of])] : []).concat(lines).map((line) => element("p", line)));
}

function drawCourse() {
  if (!picked) return;
  const quantity = QUANTITIES[kindOf(picked)].find(({ name }) => name === at("quantity").value), ink = styleOf("--ink");
  const lines = placesOf(picked).map(({ one, k }) => lineOf(nameOf(one), one, (frame) => quantity.of(one, frame, k), { borderColor: one.own || ink }));
  course.draw(lines, `${quantity.name}${quantity.unit && ` [${quantity.unit}]`}`,
    { ...rangeOf(lines), ticks: quantity.percents ? { callback: percent } : {} });
  const met = lines.flatMap((line) => line.data.map(({ y }) => y)), say_ = quantity.percents ? percent : (value) => `${number(value)} ${quantity.unit}`;
  at("quantity-words").textContent = `${say_(met.reduce((a, b) => Math.min(a, b)))} to ${say_(met.reduce((a, b) => Math.max(a, b)))}; ${quantity.known(runs[picked.of])}`;
}

function pick(what) {
  picked = what;
  at("picked").hidden = at("picked-course").hidden = what === null;
  if (what === null) return;
  const { of, ...there } = what, kind = kindOf(there), before_ = at("quantity").value;
  const known = QUANTITIES[kind].filter((quantity) => !Number.isNaN(quantity.of(runs[of], 0, there[kind])));
  at("quantity").replaceChildren(...known.map(({ name }) => element("option", name, { value: name, selected: name === before_ })));
  writePicked();
  drawCourse();
}

function listenToPicks() {
  let from = null;
  at("picture").addEventListener("pointerdown", (event) => { from = [event.offsetX, event.offsetY]; });
  at("picture").addEventListener("click", (event) => {
    if (from && Math.hypot(event.offsetX - from[0], event.offsetY - from[1]) > 4) return; // it was a turn
    pick(pickAt(event.offsetX, event.offsetY));
  });
  at("quantity").onchange = drawCourse;
}
