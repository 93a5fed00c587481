"use strict";
/* How far the particles of a run are from those of the first of several: lines towards where they are there, longer than the
 * distance if that is small, and the largest distance over time. Runs of other particles, and frames at other times, are not
 * compared. */

const SEEN = 0.3; // of the picture's radius: the longest line, if it is not longer by itself

/* The frame of a run at this time, unless it has none there or has diverged before. */
function frameAt({ data: { time, frame, good_frames: good } }, when) {
  const near = frameNear(time, when);
  return Math.abs(time[near] - when) <= 1e-9 * Math.abs(when) && !(frame[near] >= good) ? near : -1;
}

/* Positions in a frame [m], and how far off rounding may put one. */
function positionsIn({ data, bytesOfFrame }, frame) {
  const box = data.box[frame], steps = [0, 1, 2].map((axis) => (box[axis + 3] - box[axis]) / 65535);
  const words = new Uint16Array(bytesOfFrame(frame).buffer, 0, 3 * data.particles);
  return { at: Float64Array.from(words, (word, k) => box[k % 3] + steps[k % 3] * word), rounding: Math.hypot(...steps) / 2 };
}

/* Whether two runs have the same particles: as many, and first where they are in the other, within a tenth of its extent. */
function haveSameParticles(one, other) {
  const [{ data: a }, { data: b }] = [one, other];
  if (a.particles !== b.particles || a.particles_there !== b.particles_there || String(a.particle) !== String(b.particle)) return false;
  const [from, to] = [positionsIn(one, 0).at, positionsIn(other, 0).at], reach = widthOf(a.box[0]) / 10;
  return from.every((x, k) => Math.abs(x - to[k]) <= reach);
}

/* The distance may be this much in some of these frames, to one digit, which is not below it. */
const boundOf = (course) => `${number(1.5 * Math.max(...course.map((one) => (one ? one.far + one.rounding : 0))), 1)} m`;

class Apart {
  constructor(first, other, { uniforms, radius }) {
    const count = other.data.particles;
    Object.assign(this, { first, other, same: haveSameParticles(first, other), order: numbersTo(count), place: new Float32Array(6 * count) });
    this.ends = Uint32Array.from({ length: 2 * count }, (_, k) => (k % 2) * count + (k >> 1));
    this.course = other.data.time.map((time) => this.compare(time));
    this.largest = this.course.reduce((most, one) => (most && !(one && one.far > most.far) ? most : one), null);
    this.equal = this.largest && this.largest.far <= this.largest.rounding;
    this.longer = this.equal ? 1 : this.scale(radius);
    this.lines = makeLines(count, { ...uniforms, plain: { value: null }, width: { value: 2 }, tintedLines: { value: 1 } });
  }

  /* How many times as long as the distances lines are: 1, 2 or 5 times a power of ten. */
  scale(radius) {
    const most = (SEEN * radius) / (this.largest ? this.largest.far : 0), round = 10 ** Math.floor(Math.log10(most));
    return most > 1 && most < Infinity ? round * [5, 2, 1].find((head) => head * round <= most) : 1;
  }

  bothAt(time) {
    const { first, other, same } = this, frames = same ? [first, other].map((one) => frameAt(one, time)) : [-1];
    return frames.includes(-1) ? null : [positionsIn(first, frames[0]), positionsIn(other, frames[1])];
  }

  /* The particle that is farthest off, and how far [m]. null: there is no frame at this time. */
  compare(time, both = this.bothAt(time)) {
    if (!both) return null;
    const [from, to] = both, found = { time, far: 0, particle: 0, rounding: from.rounding + to.rounding };
    for (let k = 0; k < this.order.length; k++) {
      const far = Math.hypot(to.at[3 * k] - from.at[3 * k], to.at[3 * k + 1] - from.at[3 * k + 1], to.at[3 * k + 2] - from.at[3 * k + 2]);
      if (far > found.far) Object.assign(found, { far, particle: k });
    }
    return found;
  }

  /* Fills the lines, in this unit, and returns what to say. */
  show(time, { centre, radius, target = [0, 0, 0] }) {
    const both = this.bothAt(time), far = this.compare(time, both), { place, longer, largest } = this;
    for (let k = 0; both && k < place.length / 2; k++) {
      const here = target[k % 3] + (both[1].at[k] - centre[k % 3]) / radius;
      place[k] = here;
      place[k + place.length / 2] = here + (longer * (both[0].at[k] - both[1].at[k])) / radius;
    }
    fillLines(this.lines, place, this.ends, both ? this.order : [], 1, () => NO_STRAIN);
    const { file } = this.first.data, words = far ? [] : [`not compared with ${file}: ${this.same ? "no frame at this time" : "other particles"}`];
    if (this.equal) words.push(`${this.course.includes(null) ? "in frames of both " : ""}nowhere farther than ${boundOf(this.course)} from ${file}`);
    else if (far) words.push(`${this.words(far)} from ${file}`);
    if (largest && !this.equal) words.push(`in frames of both at most ${this.words(largest)}, at t = ${number(largest.time, 4)} s`);
    if (longer > 1) words.push(`drawn ${number(longer)} times as long`);
    return words.join("; ");
  }

  /* With the digits that rounding leaves. */
  words(found) {
    const { far, particle, rounding } = found, digits = 1 + Math.floor(Math.log10(far)) - Math.ceil(Math.log10(rounding));
    if (far <= rounding) return `at most ${boundOf([found])}`;
    return `${number(far, Math.max(1, Math.min(3, digits)))} m (particle ${particleNumber(this.other, particle)})`;
  }
}

let aparts = [];

/* Of the runs that are drawn here, those that are not the first of all. */
function findAparts() {
  const [first] = shared;
  aparts = runs.filter((one) => one.data !== first.data).map((one) => new Apart(first, one, picture || homeOf(data)));
  if (picture) picture.setApart(aparts);
}

function drawApart() {
  for (const { lines, other } of aparts) lines.material.uniforms.plain.value = colour(other.own || styleOf("--ink"));
  const known = aparts.filter(({ largest }) => largest);
  at("apart-course").hidden = known.length === 0;
  if (known.length === 0) return;
  const lines = known.map(({ other, course: found }) => lineOf(nameOf(other), other, (frame) => (found[frame] ? found[frame].far : NaN),
    { borderColor: other.own || styleOf("--ink") }));
  apart.draw(lines, "apart [m]", rangeOf(lines));
}
