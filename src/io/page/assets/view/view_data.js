"use strict";
/* A trajectory as its page holds it, in SI units: numbers in #data, ends and marks in #fixed, frames in #frames, in texts of one
 * length. */

const floatsOf = (text) => new Float32Array(bytesOf(text).buffer);
const ROUNDING = 2 ** -8; // of elongations, relative: they are the upper halves of floats

function readRun() {
  const data = JSON.parse(at("data").textContent), fixed = bytesOf(at("fixed").textContent);
  const springs = data.springs, first = 6 * data.particles; // bytes of a frame before those of springs
  const ends = new Uint32Array(fixed.buffer, 0, 2 * springs), marks = fixed.subarray(8 * springs);
  const rest = floatsOf(data.rest_length), stiffness = data.stiffness && !data.by_first_frame ? floatsOf(data.stiffness) : null;
  const text = at("frames").textContent, length = text.length / data.frames;
  const words = new Uint32Array(Math.max(1, springs)), values = new Float32Array(words.buffer);
  const tints = Float64Array.from(rest, (rest_) => (rest_ > 0 ? 127 / rest_ : NaN));

  /* A number of 16 bits, without decoding the rest of its frame. */
  function wordAt(frame, place) {
    const from = 4 * Math.floor(place / 3), bytes = atob(text.slice(frame * length + from, frame * length + Math.min(from + 8, length)));
    return bytes.charCodeAt(place % 3) | (bytes.charCodeAt((place % 3) + 1) << 8);
  }

  function elongation(frame, spring) {
    words[0] = wordAt(frame, first + 2 * spring) << 16;
    return values[0];
  }

  function coordinate(frame, particle, axis) {
    const low = data.box[frame][axis], high = data.box[frame][axis + 3];
    return low + (high - low) * (wordAt(frame, 6 * particle + 2 * axis) / 65535);
  }

  /* Coordinates as they are, then a byte for the strain of each spring, on the scale of colours. */
  function bytesOfFrame(frame) {
    const bytes = bytesOf(text.slice(frame * length, (frame + 1) * length)), halves = new Uint16Array(bytes.buffer, first, springs);
    for (let k = 0; k < springs; k++) words[k] = halves[k] << 16;
    for (let k = 0; k < springs; k++) {
      const place = values[k] * (tints[k] / data.strain);
      bytes[first + k] = place !== place ? NO_STRAIN : Math.max(0, Math.min(254.5, 127.5 + place)); // NaN without a rest length
    }
    return bytes.subarray(0, first + springs);
  }

  return { data, ends, marks, rest, stiffness, elongation, coordinate, bytesOfFrame };
}

const run = readRun(), { data, marks } = run;
window.run = run; // for pages beside this one
