"use strict";
/* Problems of a few numbers over the library as WebAssembly: x' = phi(t, x), and q'' = f(t, q, v). */

class Motion {
  /* `problem` has `rate(t, x)` or `force(t, q, v)`, which return an array, and `start`: x, or q and v one after the other. */
  constructor(library, problem, method, step, start = problem.start) {
    Object.assign(this, { library, state: 0, integrator: 0, order: problem.rate ? 1 : 2 });
    this.size = start.length / this.order;
    const name = this.order === 1 ? "first_order" : "second_order", n = BigInt(this.size), options = library.make("options_create", "run");
    this.callback = problem.rate ? this.enter("ijdiii", (t, x, out) => this.put(out, problem.rate(t, this.row(x))))
      : this.enter("ijdiiii", (t, q, v, out) => this.put(out, problem.force(t, this.row(q), this.row(v))));
    this.one = library.module._malloc(8);
    library.doubles(this.one, 1)[0] = 1;
    try {
      library.check("options_set_text", options, "method", method);
      library.check("options_set_number", options, "step", step);
      library.check("options_set_number", options, "newton_tolerance", 1e-12);
      this.integrator = library.make(`integrator_create_${name}`, n, this.callback, 0, ...(problem.rate ? [] : [0, 1n, this.one]), options);
      this.state = library.make(`state_create_${name}`, n);
      this.x = start;
    } catch (trouble) {
      this.release();
      throw trouble;
    } finally {
      library.call("options_destroy", options);
    }
  }

  enter(signature, call) {
    return this.library.module.addFunction((n, t, ...rows) => (call(t, ...rows), 0), signature);
  }
  row(pointer) {
    return this.library.doubles(pointer, this.size);
  }
  put(pointer, values) {
    this.row(pointer).set(values);
  }

  get rows() {
    return ["position", "velocity"].slice(0, this.order).map((what) => this.row(this.library.call(`state_${what}`, this.state)));
  }
  get x() {
    return this.rows.flatMap((row) => [...row]);
  }
  set x(values) {
    this.rows.forEach((row, k) => row.set(values.slice(k * this.size, (k + 1) * this.size)));
    this.library.call("state_set_time", this.state, 0);
  }

  /* False where numbers have overflowed or a solver gave up. */
  take(steps) {
    return this.library.call("integrator_step", this.integrator, this.state, BigInt(steps)) === 0;
  }

  release() {
    this.library.call("integrator_destroy", this.integrator);
    this.library.call("state_destroy", this.state);
    this.library.module._free(this.one);
    this.library.module.removeFunction(this.callback);
  }
}

/* The states after 0, 1, ... `count` steps, fewer where they overflow. */
function pathOf(library, problem, method, step, count, start = problem.start) {
  const motion = new Motion(library, problem, method, step, start), path = [[...start]];
  while (path.length <= count && motion.take(1)) path.push(motion.x);
  motion.release();
  return path;
}

const endOf = (library, problem, method, step, count, start) => {
  const motion = new Motion(library, problem, method, step, start), whole = motion.take(count), x = motion.x;
  motion.release();
  return whole ? x : x.map(() => NaN);
};

/* Problems of two components. The exact solution is known of the first two: in the river the distance from the middle, y = sin x,
 * decays like exp(-t/2) while the leaf drifts at speed 1. */
const PROBLEMS = {
  river: { start: [0, 1], duration: 6, box: [-0.5, 7, -2, 2], rate: (t, [x, y]) => [1, Math.cos(x) - (y - Math.sin(x)) / 2],
    exact: (t) => [t, Math.sin(t) + Math.exp(-t / 2)] },
  linear: { start: [1, 0], duration: 6, box: [-2, 2, -2, 2], rate: (t, [x, y]) => [-0.2 * x - 2 * y, 2 * x - 0.2 * y],
    exact: (t) => [Math.cos(2 * t), Math.sin(2 * t)].map((part) => Math.exp(-0.2 * t) * part) },
  "van-der-pol": { start: [0.5, 0], duration: 6, box: [-3, 3, -3, 3], rate: (t, [x, y]) => [y, (1 - x * x) * y - x] },
};

/* x' = a x with a complex, and the oscillator whose motions are those of a and its conjugate. */
const linear = ([re, im]) => ({ start: [1, 0], rate: (t, [x, y]) => [re * x - im * y, im * x + re * y] });
const oscillator = ([re, im]) => ({ start: [1, 0], force: (t, [q], [v]) => [2 * re * v - (re * re + im * im) * q] });

/* The largest factor of a step of 1 on the oscillator of z = a dt: the spectral radius of its matrix, from one step of
 * each of two states. `set` changes z. */
class Factor {
  constructor(library, method) {
    this.z = [0, 0];
    this.motion = new Motion(library, { start: [1, 0], force: (t, q, v) => oscillator(this.z).force(t, q, v) }, method, 1);
  }
  at(re, im) {
    this.z = [re, im];
    const [[a, c], [b, d]] = [[1, 0], [0, 1]].map((start) => {
      this.motion.x = start;
      return this.motion.take(1) ? this.motion.x : [NaN, NaN];
    });
    const half = (a + d) / 2, root = half * half - (a * d - b * c);
    return root < 0 ? Math.sqrt(a * d - b * c) : Math.abs(half) + Math.sqrt(root);
  }
  release() {
    this.motion.release();
  }
}

/* Where `f` changes its sign between a and b. */
function bisect(f, a, b) {
  const first = f(a) > 0;
  for (let k = 0; k < 30; k++) {
    const middle = (a + b) / 2;
    if (f(middle) > 0 === first) a = middle;
    else b = middle;
  }
  return (a + b) / 2;
}

/* The largest |z| up to which a method is stable along the angle [rad]; Infinity beyond 8. */
function edgeOf(library, method, angle) {
  const factor = new Factor(library, method), beyond = (r) => factor.at(r * Math.cos(angle), r * Math.sin(angle)) - 1 - 1e-9;
  let r = 0.05;
  while (r < 8 && !(beyond(r) > 0)) r += 0.05;
  const edge = r < 8 ? bisect(beyond, r - 0.05, r) : Infinity;
  factor.release();
  return edge;
}

/* The stable intervals [from, to, y] of rows of the plane, symmetric about the real axis. */
function regionOf(library, method, [left, right, top], cell = 0.1) {
  const factor = new Factor(library, method), strips = [], height = cell / 2;
  for (let y = height / 2; y < top; y += height) {
    const beyond = (x) => (factor.at(x, y) > 1 + 1e-9 ? 1 : -1);
    for (let x = left, was = beyond(left), from = left; x < right; x += cell) {
      const next = Math.min(x + cell, right), now = beyond(next), edge = now === was ? next : bisect(beyond, x, next);
      if (was < 0 && (now > 0 || next === right)) strips.push([from, edge, y]);
      if (now < 0 && was > 0) from = edge;
      was = now;
    }
  }
  factor.release();
  return strips.flatMap(([a, b, y]) => [[a, b, y], [a, b, -y]]).map((strip) => [...strip, height]);
}
