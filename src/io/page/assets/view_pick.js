"use strict";
/* A click on a particle or on a spring shows its numbers, now and over time. */

const NEAR = { particle: 12, spring: 7 }; // pixels
let picked = null; // { spring } or { particle }, places among those shown

/* Where a particle is in the picture [pixels], and how far from the eye. */
function projector() {
  const { clientWidth: wide, clientHeight: tall } = at("picture"), point = new THREE.Vector3();
  return (k) => {
    point.fromArray(picture.place, 3 * k).project(picture.camera);
    return [(0.5 + 0.5 * point.x) * wide, (0.5 - 0.5 * point.y) * tall, point.z];
  };
}

function pickAt(x, y) {
  const where = projector(), seen = Array.from({ length: picture.marks.length }, (_, k) => where(k));
  let best = null, least = NEAR.particle;
  seen.forEach(([a, b, z], k) => {
    const far = Math.hypot(a - x, b - y) + z;
    if (z < 1 && far < least) [best, least] = [{ particle: k }, far];
  });
  if (best) return best;
  least = NEAR.spring;
  for (let k = 0; k < picture.ends.length; k += 2) {
    const [a, b] = [seen[picture.ends[k]], seen[picture.ends[k + 1]]], dx = b[0] - a[0], dy = b[1] - a[1];
    const t = Math.max(0, Math.min(1, ((x - a[0]) * dx + (y - a[1]) * dy) / (dx * dx + dy * dy || 1)));
    const far = Math.hypot(a[0] + t * dx - x, a[1] + t * dy - y) + Math.min(a[2], b[2]);
    if (far < least) [best, least] = [{ spring: k / 2 }, far];
  }
  return best;
}

const particleNumber = (k) => (data.particle ? data.particle[k] : k);
const springNumber = (k) => k * data.spring_stride;

function groupOf(spring) {
  let first = 0;
  for (const group of data.groups || []) {
    if (spring < first + group.count) return group;
    first += group.count;
  }
  return null;
}

/* The byte of a spring in a frame, without decoding all of it. */
function strainByte(frame, spring) {
  const at_ = 6 * data.particles + spring, from = 4 * Math.floor(at_ / 3);
  return atob(frameText.substr(frame * frameLength + from, 4)).charCodeAt(at_ % 3);
}
const strainAt = (frame, spring) => {
  const byte = strainByte(frame, spring);
  return byte === NO_STRAIN ? NaN : ((byte - 127) / 127) * data.strain;
};

/* A line over time, with a mark at the frame that is shown. */
function sparkline(values) {
  const space = "http://www.w3.org/2000/svg", svg = document.createElementNS(space, "svg");
  const low = Math.min(...values), high = Math.max(...values), span = high - low || 1;
  const xOf = (k) => (200 * (data.time[k] - data.time[0])) / (data.time[last] - data.time[0] || 1);
  const path = document.createElementNS(space, "path"), mark = document.createElementNS(space, "path");
  svg.setAttribute("viewBox", "0 0 200 40");
  svg.setAttribute("preserveAspectRatio", "none");
  path.setAttribute("d", values.map((value, k) => `${k ? "L" : "M"}${xOf(k).toFixed(1)},${(38 - (36 * (value - low)) / span).toFixed(1)}`).join(""));
  mark.setAttribute("d", `M${xOf(shown)},0V40`);
  for (const [line, stroke] of [[path, "#e2711d"], [mark, "var(--ink)"]]) {
    for (const [key, value] of Object.entries({ fill: "none", stroke, "vector-effect": "non-scaling-stroke" })) line.setAttribute(key, value);
    svg.append(line);
  }
  return svg;
}

function positionOf(k) {
  return [0, 1, 2].map((axis) => picture.centre[axis] + picture.radius * picture.place[3 * k + axis]);
}

const MARK_WORDS = { 0: "", 1: ", pinned", 2: ", driven", 3: ", without springs" };

function describeParticle(k) {
  return [element("p", `particle ${particleNumber(k)}${MARK_WORDS[picture.marks[k]]}`),
    element("p", positionOf(k).map((value, axis) => `${"xyz"[axis]} ${number(value, 5)}`).join(", ") + " m")];
}

function describeSpring(k) {
  const spring = springNumber(k), group = groupOf(spring), strain = strainAt(shown, k);
  const lines = [element("p", `spring ${spring}, between particles ${[0, 1].map((end) => particleNumber(picture.ends[2 * k + end])).join(" and ")}` +
    (group && group.name ? `, group ${group.name}` : ""))];
  if (!Number.isFinite(strain)) return [...lines, element("p", "without a rest length")];
  const full = Math.abs(strain) >= data.strain * 0.999 ? (strain > 0 ? " or more" : " or less") : "";
  const force = group && group.stiffness !== null && group.rest_length !== null ? group.stiffness * group.rest_length * strain : NaN;
  lines.push(element("p", `strain ${percent(strain)}${full}` + (Number.isFinite(force) ? `, elastic tension ${number(force)} N${full}` : "")));
  if (data.frames > 1 && data.frames <= 4000) {
    const values = data.time.map((_, frame) => strainAt(frame, k));
    lines.push(sparkline(values), element("p", `strain over time, ${percent(Math.min(...values))} to ${percent(Math.max(...values))}`));
  }
  return lines;
}

function writePicked() {
  at("picked").hidden = picked === null;
  if (picked) at("picked").replaceChildren(...(picked.spring === undefined ? describeParticle(picked.particle) : describeSpring(picked.spring)));
}

function listenToPicks() {
  let from = null;
  at("picture").addEventListener("pointerdown", (event) => { from = [event.offsetX, event.offsetY]; });
  at("picture").addEventListener("click", (event) => {
    if (from && Math.hypot(event.offsetX - from[0], event.offsetY - from[1]) > 4) return; // it was a turn
    picked = pickAt(event.offsetX, event.offsetY);
    writePicked();
  });
}
