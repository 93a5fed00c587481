"use strict";
/* A scene's text with other masses, stiffness, damping and gravity, and what it says of its bodies. */

const SCALED = { stiffness: ["stiffness", "bending"], damping: ["damping", "damping_ratio"], mass: ["mass", "density"] };

/* A number, numbers, or a text with a unit ("200 g"), times a factor. */
function times(value, factor) {
  if (typeof value === "number") return value * factor;
  if (Array.isArray(value)) return value.map((item) => times(item, factor));
  const [, number, unit] = (typeof value === "string" && value.match(/^\s*([-+.\deE]*\d)(.*)$/)) || [];
  return number === undefined ? value : `${Number(number) * factor}${unit}`;
}

function scaleKeys(value, factors) {
  if (value === null || typeof value !== "object") return value;
  if (Array.isArray(value)) return value.map((item) => scaleKeys(item, factors));
  return Object.fromEntries(Object.entries(value).map(([key, item]) => {
    const kind = Object.keys(SCALED).find((name) => SCALED[name].includes(key));
    const isNumbers = kind && (typeof item !== "object" || (Array.isArray(item) && item.every((one) => typeof one === "number")));
    return [key, isNumbers ? times(item, factors[kind]) : scaleKeys(item, factors)];
  }));
}

/* `changes`: factors of `stiffness`, `damping` and `mass`, and the size of gravity [m/s^2] or null for the scene's own.
 * Without any the text stays as it is. */
function changedScene(text, changes) {
  const { gravity, ...factors } = changes;
  if (gravity === null && Object.values(factors).every((factor) => factor === 1)) return text;
  const scene = scaleKeys(JSON.parse(text), factors);
  if (gravity !== null) {
    const old = Array.isArray(scene.gravity) ? scene.gravity : [0, 0, 0], size = Math.hypot(...old);
    scene.gravity = size > 0 ? old.map((value) => (value / size) * gravity) : [0, -gravity, 0];
  }
  return JSON.stringify(scene, null, 2);
}

/* ---- bodies, for the surfaces of the picture ---- */

const cornersOf = (text) => [...text.matchAll(/^f\s+(.*)$/gm)].flatMap(([, list]) => {
  const corners = list.trim().split(/\s+/).map((corner) => parseInt(corner, 10) - 1);
  return corners.slice(2).flatMap((_, k) => [corners[0], corners[k + 1], corners[k + 2]]);
});

/* The parts of a scene, each with its first particle and their number, as the library counts them. */
function bodiesOf(scene, live, files) {
  return (scene.parts || []).map((part, k) => {
    const countOf = (what) => live.partCount(part.name || `${part.kind}${k}`, what);
    const triangle = part.kind !== "mesh" ? [] : part.triangles ? part.triangles.flat() : cornersOf(files[part.file]);
    return { kind: part.kind, first: countOf("before"), count: countOf("particles"), size: part.size, triangle };
  });
}

if (typeof module === "object") module.exports = { changedScene, bodiesOf };
