"use strict";
/* The figures of the lecture, a row each: `knobs` (a range, a list of words, or both), and `draw`, which asks the library for what the
 * panels show, for the words under them, and for the `numbers` that the program, Python and C print for the knobs as they begin.
 * `drag` turns a place in the first panel into knobs. */

const { blue, orange, green, red, violet, grey } = COLOURS;
const METHODS = ["forward-euler", "symplectic-euler", "verlet", "heun", "rk4", "backward-euler", "tr-bdf2", "implicit-midpoint"];
const COLOUR_OF = { "forward-euler": red, "symplectic-euler": blue, verlet: green, heun: orange, rk4: violet };
const FIRST_ORDER = ["forward-euler", "heun", "rk4"]; // methods of x' = phi(t, x)

const range = (count) => Array.from({ length: count + 1 }, (_, k) => k);
const said = (value, digits = 3) => (Number.isFinite(value) ? Number(value.toPrecision(digits)).toString() : "beyond all numbers");
const distance = (a, b) => Math.hypot(...a.map((value, k) => value - b[k]));
const edited = (text, change) => {
  const scene = JSON.parse(text);
  change(scene);
  return JSON.stringify(scene);
};

/* What takes longer is computed once. */
const kept = new Map();
function once(key, make) {
  if (!kept.has(key)) kept.set(key, make());
  return kept.get(key);
}

function withScene(library, text, use) {
  const live = new Live(library, text);
  try {
    return use(live);
  } finally {
    live.release();
  }
}

/* The motion of a scene by its own run or another method and step: `count` frames until `until`, fewer after an explosion. */
function framesOf(library, text, until, count, { method, step, see = (live) => live.now } = {}) {
  return withScene(library, text, (live) => {
    const run = live.given, each = Math.max(1, Math.round(until / count / (step || run.step)));
    live.use(method || run.method, step || run.step);
    const frames = [see(live)];
    while (frames.length <= count && live.take(each)) frames.push(see(live));
    return Object.assign(frames, { net: live.net });
  });
}

const seen = (q, i, turn = 0.35) => [q[3 * i] + turn * q[3 * i + 2], q[3 * i + 1] + 0.2 * turn * q[3 * i + 2]];

/* The springs of a scene: blue where they are compressed, red where they are stretched, by more than `much`. */
function net({ ends, restLength, held }, q, much, wide) {
  const lots = { [blue]: [], [grey]: [], [red]: [] };
  restLength.forEach((rest, k) => {
    const [a, b] = [ends[2 * k], ends[2 * k + 1]], strain = distance(q.slice(3 * a, 3 * a + 3), q.slice(3 * b, 3 * b + 3)) / rest - 1;
    lots[strain < -much ? blue : strain > much ? red : grey].push([...seen(q, a), ...seen(q, b)]);
  });
  const pins = [...held].flatMap((is, i) => (is ? [seen(q, i)] : []));
  return [...Object.entries(lots).map(([colour, segments]) => ({ segments, colour, wide })), { dots: pins, colour: "currentColor" }];
}

const axis = (from, to, name, log = false) => ({ from, to, name, log });
const orders = (rows, colour, name) => [{ line: rows, colour, name }, { dots: rows, colour, wide: 2.2 }];
const slopeOf = ([[h, e], [g, f]]) => Math.log(e / f) / Math.log(h / g);

/* ---- particles, one after the other ---- */

const CHAIN = JSON.stringify({ hooke: 1, particles: { position: [[0, 0, 0], [1.2, 0, 0], [2.1, 0, 0], [3.3, 0, 0]],
  velocity: [[0, 1, 0], [0, 0, 0], [0, 0, 0], [0, -1, 0]], mass: [1, 2, 1, 3] },
  springs: [{ name: "chain", between: [[0, 1], [1, 2], [2, 3]], stiffness: 20, rest_length: 1 }] });

/* A step of symplectic Euler in which each particle moves before the force on the next one is computed. */
function stepInTurn(live, step, force) {
  const { library, system } = live, weight = library.doubles(library.call("system_inverse_mass", system), live.count);
  for (let i = 0; i < live.count; i++) {
    const [q, v] = ["position", "velocity"].map((what) => library.call(`state_${what}`, live.state));
    library.check("system_force", system, 0, q, v, force);
    for (let k = 3 * i; k < 3 * i + 3; k++) {
      live.velocity[k] += step * weight[i] * library.doubles(force, 3 * live.count)[k];
      live.position[k] += step * live.velocity[k];
    }
  }
}

function chain(library, step, wrong, until = 5) {
  return withScene(library, CHAIN, (live) => {
    const mass = [...library.doubles(library.call("system_inverse_mass", live.system), live.count)].map((w) => 1 / w);
    const mean = (row) => [0, 1, 2].map((axis) => mass.reduce((sum, m, i) => sum + m * row[3 * i + axis], 0) / mass.reduce((a, b) => a + b));
    const force = library.module._malloc(24 * live.count), x0 = mean(live.position), u = mean(live.velocity), rows = [];
    const energy = () => live.energy("kinetic") + live.energy("potential"), e0 = energy();
    live.use(wrong === "rk4" ? "rk4" : "symplectic-euler", step);
    for (let n = 0; n <= Math.round(until / step); n++) {
      if (n > 0) wrong === true ? stepInTurn(live, step, force) : live.take(1);
      rows.push([n * step, distance(mean(live.position), x0.map((x, k) => x + n * step * u[k])), energy() - e0]);
    }
    library.module._free(force);
    return { rows, end: [...live.position] };
  });
}

const chainErrors = (library, wrong) => once(`chain ${wrong}`, () => {
  const exact = once("chain", () => chain(library, 5e-3, "rk4").end);
  return [0.04, 0.02, 0.01, 0.005].map((step) => [step, distance(chain(library, step, wrong).end, exact)]);
});

/* ---- a plane, a step ---- */

function fieldOf({ rate, box: [left, right, low, high] }) {
  const each = (right - left) / 16, rows = [];
  for (let x = left + each / 2; x < right; x += each)
    for (let y = low + each / 2; y < high; y += each) {
      const [u, v] = rate(0, [x, y]), long = Math.hypot(u, v) || 1, share = (0.8 * each * Math.min(1, 0.4 + long / 6)) / long;
      rows.push({ arrow: [x, y, x + share * u, y + share * v], colour: grey, wide: 0.9 });
    }
  return rows;
}

const finely = (library, name) => once(name, () => {
  const { duration, exact } = PROBLEMS[name], count = 600;
  return exact ? range(count).map((k) => exact((k * duration) / count)) : pathOf(library, PROBLEMS[name], "rk4", duration / count, count);
});

const STEPS = [0.4, 0.2, 0.1, 0.05, 0.025];
const errorAtEnd = (library, name, method, h) => {
  const { duration } = PROBLEMS[name], count = Math.round(duration / h), at = (600 * count * h) / duration;
  return distance(endOf(library, PROBLEMS[name], method, h, count), PROBLEMS[name].exact ? PROBLEMS[name].exact(count * h) : finely(library, name)[Math.round(at)]);
};
/* Of one step from a quarter of the time of a known solution. */
const errorOfStep = (library, name, method, h) => {
  const { duration, exact } = PROBLEMS[name];
  return distance(endOf(library, PROBLEMS[name], method, h, 1, exact(duration / 4)), exact(duration / 4 + h));
};
const errorsOf = (library, of, name, method) => once(`${of.name} ${name} ${method}`, () => STEPS.map((h) => [h, of(library, name, method, h)]));

const rangeAround = (rows) => {
  const values = rows.map(([, value]) => value).filter((value) => value > 0 && Number.isFinite(value));
  return [Math.min(...values) / 2, Math.max(...values) * 2];
};

/* Eigenvalues of a scene at its start, the fastest of size 1. */
const modesOf = (library, text, count) => once(`modes ${text}`, () => withScene(library, text, (live) => {
  const read = (_, { modes }) => modes.map(({ omega, damping_ratio: zeta }) => [-zeta * omega, omega * Math.sqrt(Math.max(0, 1 - zeta * zeta))]);
  return measured(live, "modes", { count }, { state: live.state, read });
}));

/* ---- scenes over time ---- */

const boxOf = (frames) => [0, 1].map((side) => {
  const all = frames.flatMap(({ position }) => range(position.length / 3 - 1).map((i) => seen(position, i)[side]));
  const [low, high] = [Math.min(...all), Math.max(...all)], margin = 0.05 * (high - low);
  return [low - margin, high + margin];
});

const timed = (name, { scene, until, value = until, much = 0.05, wide, forces, columns, tell }) => ({ name,
  knobs: [{ name: "time", from: 0, to: until, value, unit: "s" }],
  draw(library, { time }, scenes) {
    const frames = once(name, () => framesOf(library, scenes[scene], until, 50)), { position: q, velocity: v } = frames[Math.round((50 * time) / until)];
    const box = boxOf(frames), marks = net(frames.net, q, much, wide), arrows = forces ? forcesOn(library, scenes[scene], q, v) : [];
    for (const [i, f] of arrows.entries()) marks.push({ arrow: [...seen(q, i), ...seen(q, i).map((x, k) => x + f[k] / 40)], colour: orange });
    const beside = (columns || [box[0]]).map((x) => ({ x: axis(...x, "x [m]"), y: axis(...box[1], "y [m]"), equal: true, marks: marks.map((mark) =>
      (mark.segments && columns ? { ...mark, segments: mark.segments.filter(([at]) => at > x[0] && at < x[1]) } : mark)) }));
    return { panels: beside, ...tell(q, arrows) };
  } });

function forcesOn(library, text, q, v) {
  return withScene(library, text, (live) => {
    live.put({ time: 0, position: q, velocity: v });
    const [at, rate] = ["position", "velocity"].map((what) => library.call(`state_${what}`, live.state));
    const all = library.filled(Float64Array, 3 * live.count, (out) => library.check("system_force", live.system, 0, at, rate, out));
    return range(live.count - 1).map((i) => [...all.slice(3 * i, 3 * i + 3)]);
  });
}

/* A spring of 20 N and 1 m from the origin to (x, y): its energy and the force on its end. */
function springAt(library, x, y) {
  const text = JSON.stringify({ hooke: 1, particles: { position: [[0, 0, 0], [x, y, 0]], mass: 1, pinned: [0] },
    springs: [{ name: "spring", between: [[0, 1]], stiffness: 20, rest_length: 1 }] });
  const force = forcesOn(library, text, new Float64Array([0, 0, 0, x, y, 0]), new Float64Array(6))[1];
  return { energy: withScene(library, text, (live) => live.energy("potential")), force };
}

const resting = (library, text) => once("rest", () => withScene(library, text, (live) => measured(live, "rest",
  { watch: range(live.count - 1).map((i) => `${i}.y`).join(",") }, { read: (_, { watched }) => watched.map(({ value }) => value) })));
/* Where the bands of rope-resolution begin among its particles, by their pieces. */
const BANDS = { 1: [79, 0], 2: [81, 2], 8: [84, 5], 64: [93, 14] };

const limitAt = (library, text) => once(`limit ${text}`, () => withScene(library, text, (live) => limitOf(live, "symplectic-euler").predicted));
const softened = (text, factor) => edited(text, ({ springs }) => springs.forEach((group) => {
  if (group.name === "stiff") group.stiffness *= factor;
}));
/* The largest distance of a particle, in the first second, from where it is without the softening. */
const priceOf = (library, text, factor) => once(`price ${factor}`, () => {
  const see = (share) => framesOf(library, softened(text, share), 1, 50, { method: "rk4", step: 5e-4 });
  const [whole, soft] = [once("unsoftened", () => see(1)), see(factor)];
  return Math.max(...whole.flatMap(({ position }, n) => range(7).map((i) =>
    distance(position.slice(3 * i, 3 * i + 3), soft[n].position.slice(3 * i, 3 * i + 3)))));
});

const FIGURES = [
  { name: "order",
    knobs: [{ name: "step", from: 0.005, to: 0.05, value: 0.01, unit: "s", log: true }],
    draw(library, { step }) {
      const [right, wrong] = [false, true].map((way) => chain(library, step, way).rows), last = wrong.at(-1);
      const both = (column) => [{ line: right.map((row) => [row[0], row[column]]), colour: blue, name: "all forces first" },
        { line: wrong.map((row) => [row[0], row[column]]), colour: red, name: "in turn" }];
      const extent = (column) => [...right, ...wrong].map((row) => row[column]), rows = [false, true].map((way) => chainErrors(library, way));
      return { numbers: [last[1], last[2], right.at(-1)[2]],
        words: `After 5 s, one particle moving after the other has carried the centre of mass ${said(last[1])} m off its line; with all forces first it ` +
          `stays there to rounding. The energies differ from the first by ${said(last[2])} J and ${said(right.at(-1)[2])} J. Both have order one: ` +
          `${rows.map((row) => slopeOf(row.slice(-2)).toFixed(2)).join(" and ")}.`,
        panels: [{ x: axis(0, 5, "t [s]"), y: axis(0, 1.4 * Math.max(...extent(1)), "centre of mass off its line [m]"), marks: both(1) },
          { x: axis(0, 5, "t [s]"), y: axis(Math.min(...extent(2)), 1.6 * Math.max(...extent(2)), "energy less the first [J]"), marks: both(2) },
          { x: axis(0.004, 0.05, "step [s]", true), y: axis(...rangeAround(rows.flat()), "error at 5 s [m]", true),
            marks: [...orders(rows[0], blue, "all forces first"), ...orders(rows[1], red, "in turn")] }] };
    } },
  { name: "phase",
    knobs: [{ name: "step", from: 0.02, to: 0.4, value: 0.1, unit: "s", log: true }, { name: "method", words: METHODS, value: "forward-euler" }],
    draw(library, { step, method }) {
      const pendulum = { start: [1, 0], force: (t, [q]) => [-9.81 * Math.sin(q)] }, count = Math.floor(4 / step + 1e-9);
      const path = pathOf(library, pendulum, method, step, count), end = path.at(-1);
      return { numbers: end, words: `${method}, ${path.length - 1} steps of ${said(step)} s: the angle is ${said(end[0])}, its rate ${said(end[1])} 1/s.`,
        panels: [{ x: axis(-2, 2, "q, the angle"), y: axis(-6, 6, "v = q' [1/s]"), marks: [
          { line: once("pendulum", () => pathOf(library, pendulum, "rk4", 0.01, 220)), colour: grey, name: "the motion" },
          { line: path, colour: blue, wide: 0.8 }, { dots: path, colour: blue, wide: 2.2, name: method }] }] };
    } },
  timed("six", { scene: "six-particles", until: 1, value: 0.4, wide: 2.4, tell: (q) => ({ numbers: [...q.slice(0, 3)],
    words: `Particle 0 is at ${[...q.slice(0, 3)].map((x) => said(x)).join(", ")} m.` }) }),
  { name: "spring",
    knobs: [{ name: "length", from: 0.4, to: 1.8, value: 1.25, unit: "m" }],
    draw(library, { length }) {
      const { energy, force: [pull] } = springAt(library, length, 0);
      return { numbers: [energy, pull], words: `The slope of the energy is ${said(-pull)} N: the force on the end is ${said(pull)} N, at ${said(energy)} J.`,
        panels: [{ x: axis(0.4, 1.8, "length [m]"), y: axis(-1, 7, "energy U [J]"), marks: [
          { line: range(70).map((k) => 0.4 + 0.02 * k).map((l) => [l, springAt(library, l, 0).energy]), colour: blue, name: "U" },
          { line: [-0.4, 0.4].map((d) => [length + d, energy - pull * d]), colour: orange, name: "its tangent" }, { dots: [[length, energy]], colour: orange, wide: 5 }] }] };
    } },
  { name: "space", drag: ([x, y]) => ({ x, y }),
    knobs: [{ name: "x", from: -1.5, to: 1.5, value: 1, unit: "m" }, { name: "y", from: -1.5, to: 1.5, value: 0.75, unit: "m" }],
    draw(library, { x, y }) {
      const [fx, fy] = springAt(library, x, y).force, circle = range(60).map((k) => [Math.cos((k * Math.PI) / 30), Math.sin((k * Math.PI) / 30)]);
      return { numbers: [fx, fy], words: `The force on the end is ${said(fx)}, ${said(fy)} N, along the spring.`,
        panels: [{ x: axis(-1.6, 1.6, "x [m]"), y: axis(-1.6, 1.6, "y [m]"), equal: true, marks: [{ line: circle, colour: grey, dashed: true, name: "at rest" },
          { segments: [[0, 0, x, y]], colour: blue, wide: 3 }, { dots: [[0, 0]], colour: "currentColor" }, { dots: [[x, y]], colour: orange, wide: 6 },
          { arrow: [x, y, x + fx / 10, y + fy / 10], colour: orange, wide: 2.5 }] }] };
    } },
  { name: "rope",
    knobs: [{ name: "pieces", words: Object.keys(BANDS), value: "8" }],
    draw(library, { pieces }, scenes) {
      const y = resting(library, scenes["rope-resolution"]), hung = BANDS[pieces].map((from) => y.slice(from, from + Number(pieces) + 1));
      const long = hung.map((band) => -1 - band.at(-1));
      return { numbers: hung.map((band) => band.at(-1)),
        words: `In ${pieces} pieces the band hangs ${said(long[0])} m longer where the stiffness is a force of the material, and ` +
          `${said(long[1])} m longer where every piece has the stiffness, in N/m, of the whole.`,
        panels: [{ x: axis(-0.4, 1.9, ""), y: axis(Math.min(-2, ...hung[1]) - 0.2, 0.9, "y [m]"), marks: hung.flatMap((band, k) => {
          const line = band.map((place) => [0.3 + k, place]), colour = [blue, red][k];
          return [{ line, colour, name: ["by strain, k (l/l\u2080 \u2212 1)", "by length, k (l \u2212 l\u2080)"][k], wide: 2 }, { dots: line, colour }];
        }) }] };
    } },
  { name: "ether",
    knobs: [{ name: "drag", from: 0, to: 3, value: 1, unit: "N s/m" }],
    draw(library, { drag }, scenes) {
      const text = edited(scenes["drag-or-damping"], (scene) => { scene.drag = drag; });
      const frames = framesOf(library, text, 4, 50), height = (i) => frames.map(({ time, position }) => [time, (position[3 * i + 1] + position[3 * i + 4]) / 2]);
      const [light, heavy] = [height(0), height(2)], end = [light.at(-1)[1], heavy.at(-1)[1]];
      const stretch = (i) => frames.map(({ time, position }) => [time, position[3 * i + 3] - position[3 * i] - 1]);
      const pair = (of) => [{ line: of(0), colour: orange, name: "in an ether" }, { line: of(2), colour: blue, name: "rusty" }];
      return { numbers: end,
        words: `After 4 s the spring in the ether has fallen ${said(-end[0])} m, and the rusty one ${said(-end[1])} m, as far as a free fall.`,
        panels: [{ x: axis(0, 4, "t [s]"), y: axis(-90, 25, "height [m]"), marks: pair(height) },
          { x: axis(0, 4, "t [s]"), y: axis(-0.25, 0.35, "longer than at rest [m]"), marks: pair(stretch) }] };
    } },
  timed("force", { scene: "six-particles", until: 1, value: 0.4, wide: 2, forces: true, tell: (q, [f]) => ({ numbers: f,
    words: `The arrows are all of the forces at this moment; on particle 0 it is ${f.map((x) => said(x)).join(", ")} N.` }) }),
  timed("cloths", { scene: "three-cloths", until: 0.5, columns: [0, 1.5, 3].map((x) => [x - 0.2, x + 1.3]), much: 0.02, wide: 0.8, tell: (q) => {
    const low = [0, 1, 2].map((k) => q[3 * (144 * k + 138) + 1]);
    return { numbers: low, words: `Structural springs, and shear, and bending: the middle of the free edge is at ${low.map((y) => said(y)).join(", ")} m.` };
  } }),
  timed("hair", { scene: "curl", until: 0.3, much: 0.01, wide: 0.8, tell: (q) => ({ numbers: [q.at(-2)],
    words: `The tip of the curl is at ${said(q.at(-2))} m.` }) }),
  { name: "blow",
    knobs: [{ name: "step", from: 0.2, to: 1.6, value: 1, unit: "ms", log: true }],
    draw(library, { step }, scenes) {
      const text = scenes["cloth-16"], limit = limitAt(library, text), bad = step > 1e3 * limit;
      const see = (live) => [live.time, live.energy("kinetic")], until = 0.3, line = framesOf(library, text, until, 100, { step: step / 1e3, see });
      return { numbers: [limit], bad, words: `A step of ${said(step)} ms is ${bad ? "above" : "below"} the limit of the cloth, ${said(1e3 * limit)} ms.`,
        panels: [{ x: axis(0, until, "t [s]"), y: axis(1e-3, 1e6, "kinetic energy [J]", true), marks: [{ line, colour: bad ? red : blue, wide: 2.2 }] }] };
    } },
  { name: "river",
    knobs: [{ name: "step", from: 0.05, to: 1, value: 0.5, unit: "s", log: true }, { name: "problem", words: Object.keys(PROBLEMS), value: "river" },
      { name: "method", words: FIRST_ORDER, value: "forward-euler" }],
    draw(library, { step, problem: name, method }) {
      const problem = PROBLEMS[name], [left, right, low, high] = problem.box, count = Math.floor(problem.duration / step + 1e-9);
      const path = pathOf(library, problem, method, step, count), rows = FIRST_ORDER.map((by) => errorsOf(library, errorAtEnd, name, by));
      const tangents = path.slice(0, -1).map((at) => [at, problem.rate(0, at)]);
      return { numbers: path.at(-1), words: `${count} steps of ${said(step)} s by ${method} end at ${path.at(-1).map((x) => said(x)).join(", ")}.`,
        panels: [{ x: axis(left, right, "x"), y: axis(low, high, "y"), equal: true,
          marks: [...fieldOf(problem), { line: finely(library, name), colour: blue, name: "the leaf" },
          ...tangents.map(([[x, y], [u, v]]) => ({ segments: [[x, y, x + 1.3 * step * u, y + 1.3 * step * v]], colour: orange, wide: 0.8 })),
          { line: path, colour: orange, name: method }, { dots: path, colour: orange }] },
        { x: axis(0.02, 0.5, "step [s]", true), y: axis(...rangeAround(rows.flat()), "error at the end", true),
          marks: rows.flatMap((row, k) => orders(row, COLOUR_OF[FIRST_ORDER[k]], `${FIRST_ORDER[k]}, order ${slopeOf(row.slice(-2)).toFixed(2)}`)) }] };
    } },
  { name: "errors",
    knobs: [{ name: "step", from: 0.025, to: 0.4, value: 0.1, unit: "s", log: true }, { name: "method", words: FIRST_ORDER, value: "forward-euler" }],
    draw(library, { step, method }) {
      const [ones, ends] = [errorOfStep, errorAtEnd].map((of) => errorsOf(library, of, "river", method)), count = Math.round(PROBLEMS.river.duration / step);
      const [one, end] = [errorOfStep, errorAtEnd].map((of) => of(library, "river", method, step)), slopes = [ones, ends].map((row) => slopeOf(row.slice(-2)));
      return { numbers: [one, end],
        words: `One step of ${said(step)} s errs by ${said(one)}, order ${slopes[0].toFixed(2)}; ${count} of them, to the end, by ${said(end)}, ` +
          `order ${slopes[1].toFixed(2)}: there are 1/step of them.`,
        panels: [{ x: axis(0.02, 0.5, "step [s]", true), y: axis(...rangeAround([...ones, ...ends]), "error", true),
          marks: [...orders(ends, blue, "at the end"), ...orders(ones, orange, "of one step"), { dots: [[step, one], [step, end]], colour: red, wide: 5 }] }] };
    } },
  { name: "plane", drag: ([re, im]) => ({ re, im }),
    knobs: [{ name: "re", from: -3.5, to: 1, value: -0.2 }, { name: "im", from: -3, to: 3, value: 0.7 }, { name: "method", words: METHODS, value: "forward-euler" }],
    draw(library, { re, im, method }, scenes) {
      const strips = once(`region ${method}`, () => regionOf(library, method, [-4.5, 2.5, 3.2])), single = FIRST_ORDER.includes(method);
      const path = pathOf(library, single ? linear([re, im]) : oscillator([re, im]), method, 1, 10), end = path.at(-1), size = Math.hypot(re, im);
      const factor = new Factor(library, method), grows = factor.at(re, im), far = Math.min(20, 1.15 * Math.max(1, ...path.flat().map(Math.abs))); // of a dt and its conjugate
      factor.release();
      const modes = modesOf(library, scenes["six-particles"], 15), most = Math.max(...modes.map((mode) => Math.hypot(...mode)));
      const points = modes.flatMap(([a, b]) => [[a, b], [a, -b]]).map((mode) => mode.map((part) => (part * size) / most));
      return { numbers: path[10] || [NaN, NaN], bad: grows > 1 + 1e-9,
        words: `A step by ${method} multiplies ${single && grows !== 1 ? "x" : "the oscillation"} by ${said(grows)} in size: ` +
          `${grows > 1 + 1e-9 ? "it grows" : "it does not grow"}. After ${path.length - 1} steps it is at ${end.map((x) => said(x)).join(", ")}.`,
        panels: [{ x: axis(-4.2, 1.6, "real part of a dt"), y: axis(-2.6, 2.6, "imaginary part"), equal: true, marks: [{ strips, colour: green },
          { line: [[-9, 0], [9, 0]], colour: grey, wide: 0.7 }, { line: [[0, -9], [0, 9]], colour: grey, wide: 0.7 }, { arrow: [-1, 0, re, im], colour: blue, wide: 2 },
          { dots: points, colour: violet, wide: 2.5, name: "modes of six particles" }, { dots: [[re, im]], colour: orange, wide: 6, edge: true }] },
        { x: axis(-far, far, single ? "real part of x\u2099" : "q\u2099"), y: axis(-far, far, single ? "imaginary part" : "v\u2099"), equal: true,
          marks: [{ line: path, colour: blue, wide: 0.8 },
          { dots: path, colour: blue, name: "x\u2080, x\u2081, ..." }, ...(single ? [{ arrow: [0, 0, ...path[1] || [0, 0]], colour: orange, wide: 2 }] : [])] }] };
    } },
  { name: "accuracy",
    knobs: [{ name: "step times frequency", from: 0.05, to: 2.2, value: 1 }, { name: "method", words: ["symplectic-euler", "verlet", "rk4", "implicit-midpoint"], value: "symplectic-euler" }],
    draw(library, { "step times frequency": step, method }) {
      const count = Math.floor(63 / step), path = pathOf(library, { start: [1, 0], force: (t, [q]) => [-q] }, method, step, count), factor = new Factor(library, method);
      const bad = factor.at(0, step) > 1 + 1e-6, line = path.map(([q], k) => [(k * step) / (2 * Math.PI), q]), end = path[count] || [NaN];
      factor.release();
      return { numbers: [end[0]], bad,
        words: `${bad ? "Unstable. " : "Stable. "}After ${count} steps, about ten periods, q is ${said(end[0])}, and should be ${said(Math.cos(count * step))}.`,
        panels: [{ x: axis(0, 10, "periods"), y: axis(-1.6, 2.2, "q"),
          marks: [{ line: range(800).map((k) => [k / 80, Math.cos((k * Math.PI) / 40)]), colour: grey, name: "exact" },
          { line, colour: bad ? red : blue, name: method }] }] };
    } },
  { name: "rule",
    knobs: [{ name: "step", from: 1e-4, to: 1, value: 1e-3, unit: "s", log: true }],
    draw(library, { step }, scenes) {
      const scales_ = modesOf(library, scenes["stiff-spring"], 18).map((mode) => 1 / Math.hypot(...mode)).sort((a, b) => a - b);
      return { numbers: [1 / scales_[0], 1 / scales_.at(-1)], bad: step > 2 * scales_[0],
        words: `The shortest time scale of the chain, 1/\u03c9, is ${said(scales_[0])} s: ${said(scales_[0] / step)} steps. ` +
          `The longest is ${said(scales_.at(-1))} s.`,
        panels: [{ x: axis(1e-4, 10, "time [s]", true), y: axis(-1, 18, "mode"),
          marks: [{ segments: scales_.map((s, k) => [1e-4, k, s, k]), colour: blue, wide: 5 },
          { line: [[step, -1], [step, 18]], colour: step > 2 * scales_[0] ? red : orange, wide: 2.5, name: "the step" }] }] };
    } },
  { name: "stiff",
    knobs: [{ name: "step", from: 0.2, to: 20, value: 2, unit: "ms", log: true }, { name: "softer", from: 0.001, to: 1, value: 0.02, log: true }],
    draw(library, { step, softer }, scenes) {
      const text = scenes["stiff-spring"], limit = limitAt(library, softened(text, softer)), bad = step > 1e3 * limit, price = priceOf(library, text, softer);
      const see = (live) => [live.time, live.position[10]], line = framesOf(library, softened(text, softer), 1, 100, { step: step / 1e3, see });
      const factors = [0.001, 0.003, 0.01, 0.025, 0.1, 0.3], prices = factors.map((factor) => [factor, priceOf(library, text, factor)]);
      return { numbers: [limit, price], bad,
        words: `With the stiff spring at ${said(100 * softer)} % the limit is ${said(1e3 * limit)} ms, and a step of ${said(step)} ms is ${bad ? "above" : "below"} it. ` +
          `The softening moves a particle by up to ${said(price)} m in 1 s.`,
        panels: [{ x: axis(0, 1, "t [s]"), y: axis(-4, 1, "height of particle 3 [m]"), marks: [{ line, colour: bad ? red : blue, wide: 2 }] },
          { x: axis(0.0008, 1.2, "stiffness of the stiff spring", true), y: axis(...rangeAround(prices), "price [m]", true),
            marks: [...orders(prices, violet, "largest change of a position"),
            { dots: [[softer, price]], colour: orange, wide: 5 }] }] };
    } },
];

const begun = ({ knobs }) => Object.fromEntries(knobs.map(({ name, value }) => [name, value]));
