"use strict";
/* A small study of a scene: a reference by rk4 in steps that are halved until its runs agree, and every method over a ladder of
 * steps. For want of another integrator the reference checks itself alone. */

const STUDY_FRAMES = 20;
const STUDY_TIME = { reference: 6000, row: 600, timed: 20 }; // [ms] at most, at most, and at least
const RUNGS = [1, 2, 4, 8]; // steps in the longest stable one
const AGREED = 1e-7, LOST = 0.02; // of the motion: no finer reference; frames from here on are not known

/* Root mean square of the distances of free particles [m]. */
function distanceOf(a, b, held) {
  let sum = 0, count = 0;
  for (let k = 0; k < held.length; k++) {
    if (held[k]) continue;
    sum += (a[3 * k] - b[3 * k]) ** 2 + (a[3 * k + 1] - b[3 * k + 1]) ** 2 + (a[3 * k + 2] - b[3 * k + 2]) ** 2;
    count++;
  }
  return count ? Math.sqrt(sum / count) : 0;
}

class Study {
  constructor(scene) {
    const duration = scene.given.duration > 0 ? scene.given.duration : 1;
    Object.assign(this, { scene, held: scene.net.held, bounds: scene.bounds, interval: duration / STUDY_FRAMES });
    this.first = scene.position.slice();
  }

  /* Positions at every frame, with `parts` steps from one to the next; without some where it blew up or took too long. */
  run(method, parts, limit) {
    const { scene, interval } = this, frames = [], from = performance.now();
    scene.reset();
    scene.use(method, interval / parts);
    const watch = new Watch(scene), late = () => performance.now() - from > limit;
    const result = (more) => ({ frames, spent: performance.now() - from, ...more });
    while (frames.length < STUDY_FRAMES) {
      for (let left = parts; left > 0; left -= 256) {
        if (!scene.take(Math.min(left, 256))) return result({ blown: true });
        if (late()) return result({ late: true });
      }
      if (watch.look(scene.energies) > GAIN.diverged) return result({ blown: true });
      frames.push(scene.position.slice());
    }
    return result({});
  }

  /* The number of steps between frames for a step of `length` at most. */
  partsFor(length) {
    return Math.max(1, Math.ceil(this.interval / length - 1e-9));
  }

  /* Of a method: its bound, or where that is 0 or not known the step of the scene. */
  longest({ place }) {
    const bound = this.bounds[place], { step } = this.scene.given;
    return bound > 0 ? Math.min(bound, this.interval) : step > 0 ? step : this.interval / 50;
  }

  refer(method) {
    const from = performance.now(), left = () => STUDY_TIME.reference - (performance.now() - from);
    let parts = this.partsFor(this.longest(method) / 2), before = null, finest = this.run("rk4", parts, left());
    while (finest.frames.length === STUDY_FRAMES && left() > 2.2 * finest.spent) {
      const finer = this.run("rk4", 2 * parts, left());
      if (finer.frames.length < STUDY_FRAMES) break;
      [before, finest, parts] = [finest, finer, 2 * parts];
      if (this.spread(before, finest) <= AGREED * this.motionOf(finest)) break;
    }
    if (before === null) throw new HookeError("rk4 in stable steps takes too long here, so no reference is known");
    const limit = LOST * this.motionOf(finest);
    const lost = finest.frames.findIndex((q, k) => distanceOf(q, before.frames[k], this.held) > limit);
    this.known = lost < 0 ? STUDY_FRAMES : lost;
    if (this.known === 0) throw new HookeError("two references part before the first frame, so no error is known");
    this.reference = finest;
    this.agreement = this.spread(before, finest);
    return { step: this.interval / parts, agreement: this.agreement, until: this.known * this.interval,
      duration: STUDY_FRAMES * this.interval, motion: this.motionOf(finest) };
  }

  motionOf({ frames }) {
    return Math.max(...frames.map((q) => distanceOf(q, this.first, this.held)));
  }

  /* The largest distance at a frame that is known. */
  spread(a, b) {
    return Math.max(...a.frames.slice(0, this.known).map((q, k) => distanceOf(q, b.frames[k], this.held)));
  }

  /* Rows from the longest step on, until one takes too long. */
  * rows({ name, ...method }) {
    const parts = this.partsFor(this.longest(method));
    for (const rung of RUNGS) {
      const run = this.run(name, rung * parts, STUDY_TIME.row), row = { method: name, step: this.interval / (rung * parts) };
      if (run.late) return;
      if (run.blown) yield { ...row, blown: true, error: NaN, seconds: NaN };
      else yield { ...row, error: this.spread(run, this.reference), seconds: this.timeOf(name, rung * parts, run.spent) / 1000 };
    }
  }

  /* Of one run [ms]: the clock of a browser is coarse, so that short runs are timed together. */
  timeOf(name, parts, spent) {
    for (let count = 1, all = spent; ; count *= 4) {
      if (all >= STUDY_TIME.timed) return all / count;
      const from = performance.now();
      for (let k = 0; k < 4 * count; k++) this.run(name, parts, STUDY_TIME.row);
      all = performance.now() - from;
    }
  }
}

/* Rows that no other row beats in both error and time; errors below what the reference knows are equal. */
function markFront(rows, agreement) {
  const size = ({ error }) => Math.max(error, agreement);
  const whole = rows.filter(({ blown }) => !blown);
  for (const row of whole) row.front = !whole.some((other) => other !== row && other.seconds <= row.seconds &&
    size(other) <= size(row) && (other.seconds < row.seconds || size(other) < size(row)));
  return rows;
}

/* Tells every row when it is there, and all of them at the end. */
function studyOf(scene, methods, tellRow) {
  const study = new Study(scene), rows = [];
  tellRow({ is: "reference", ...study.refer(methods.find(({ name }) => name === "rk4")) });
  for (const method of methods) {
    for (const row of study.rows(method)) {
      rows.push(row);
      tellRow({ is: "row", row });
    }
  }
  return { rows: markFront(rows, study.agreement) };
}
