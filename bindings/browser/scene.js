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

/* The parts of a scene, each with its first particle and their number, which its springs tell. */
function bodiesOf(scene, groups, ends, files) {
  let spring = 0;
  const ranges = new Map();
  for (const { name, size } of groups) {
    const part = name.slice(0, name.lastIndexOf(".")), range = ranges.get(part) || [Infinity, -1];
    for (let k = 2 * spring; k < 2 * (spring + size); k++) {
      range[0] = Math.min(range[0], ends[k]);
      range[1] = Math.max(range[1], ends[k]);
    }
    ranges.set(part, range);
    spring += size;
  }
  return (scene.parts || []).flatMap((part, k) => {
    const [first, last] = ranges.get(part.name || `${part.kind}${k}`) || [0, -1], count = last - first + 1;
    const triangle = part.kind === "mesh" ? part.triangles ? part.triangles.flat() : cornersOf(files[part.file] || "") : [];
    const size = part.kind === "cloth" || part.kind === "lattice" ? part.size : [count];
    const whole = part.kind === "mesh" ? triangle.length > 0 && Math.max(...triangle) === count - 1
      : size.reduce((product, side) => product * side, 1) === count;
    return whole && count > 0 ? [{ kind: part.kind, first, count, size, triangle }] : [];
  });
}

if (typeof module === "object") module.exports = { changedScene, bodiesOf };
