"use strict";
/* A scene that runs in pieces, over the library as WebAssembly. Numbers are in SI units. */

class HookeError extends Error {}

/* The public functions by their names; a status that is a failure is thrown, with the library's message. */
class Library {
  constructor(module) {
    this.module = module;
    this.out = module._malloc(64);
  }

  text(pointer) {
    return pointer ? this.module.UTF8ToString(pointer) : null;
  }

  /* Texts are copied for the call, whole numbers in `args` are those of C: BigInt for int64_t. */
  call(name, ...args) {
    const made = [], { module } = this;
    const given = args.map((value) => {
      if (typeof value !== "string") return value;
      const size = module.lengthBytesUTF8(value) + 1, pointer = module._malloc(size);
      module.stringToUTF8(value, pointer, size);
      made.push(pointer);
      return pointer;
    });
    const result = module[`_hooke_${name}`](...given);
    made.forEach((pointer) => module._free(pointer));
    return result;
  }

  check(name, ...args) {
    const status = this.call(name, ...args);
    if (status < 0) throw new HookeError(this.text(this.call("last_error")));
    return status;
  }

  /* What a function writes into its last argument. */
  make(name, ...args) {
    this.module.HEAPU32[this.out >> 2] = 0;
    this.check(name, ...args, this.out);
    return this.module.HEAPU32[this.out >> 2];
  }

  doubles(pointer, count) {
    return new Float64Array(this.module.HEAPF64.buffer, pointer, count);
  }

  /* Calls `fill` with the address of an array of the kind and returns a copy of the array. */
  filled(kind, count, fill) {
    const pointer = this.module._malloc(Math.max(1, count) * kind.BYTES_PER_ELEMENT);
    try {
      fill(pointer);
      return new kind(this.module.HEAPU8.buffer, pointer, count).slice();
    } finally {
      this.module._free(pointer);
    }
  }

  /* The methods with a fixed step that this build has. */
  methods() {
    const list = [];
    for (let k = 0n, name; (name = this.text(this.call("method_name", k))) !== null; k++) {
      if (this.call("method_is_built", name) === 1 && this.call("method_is_adaptive", name) === 0)
        list.push({ name, summary: this.text(this.call("method_summary", name)), place: Number(k) });
    }
    return list;
  }
}

class Live {
  /* HookeError for a scene that is wrong: "scene:line:column: what is wrong". */
  constructor(library, text) {
    Object.assign(this, { library, scene: 0, state: 0, kept: 0, integrator: 0 });
    const bytes = library.module.lengthBytesUTF8(text);
    try {
      this.scene = library.make("scene_parse", text, BigInt(bytes), "scene", "/", 0);
      library.check("scene_commit", this.scene);
      this.system = library.call("scene_system", this.scene);
      this.state = library.make("state_create", this.system);
      this.kept = library.make("state_create", this.system);
      this.count = Number(library.call("system_particle_count", this.system));
      this.springs = Number(library.call("system_count", this.system, "springs"));
    } catch (trouble) {
      this.release();
      throw trouble;
    }
  }

  release() {
    const { library } = this;
    library.call("integrator_destroy", this.integrator);
    library.call("state_destroy", this.state);
    library.call("state_destroy", this.kept);
    library.call("scene_destroy", this.scene);
    Object.assign(this, { scene: 0, state: 0, kept: 0, integrator: 0 });
  }

  /* What the scene itself says. */
  get given() {
    const { library } = this, run = library.call("scene_run_options", this.scene);
    const number = (name) => library.call("options_number", run, name);
    return { method: library.text(library.call("options_text", run, "method")), step: number("step"), duration: number("duration"),
      title: library.text(library.call("scene_text", this.scene, "title")) };
  }

  /* Options of a run by this method with this step [s], which the caller destroys; without frames and an end unless given [s]. */
  runOptions(method, step, duration, every) {
    const { library } = this, options = library.make("options_copy", library.call("scene_run_options", this.scene));
    for (const name of ["every", "duration", "checkpoint"]) library.check("options_unset", options, name);
    library.check("options_set_text", options, "method", method);
    for (const [name, value] of Object.entries({ step, duration, every }))
      if (value) library.check("options_set_number", options, name, value);
    return options;
  }

  /* From the state that is there on. */
  use(method, step) {
    const { library } = this, options = this.runOptions(method, step);
    try {
      const integrator = library.make("integrator_create", this.system, options);
      library.call("integrator_destroy", this.integrator);
      this.integrator = integrator;
      this.step = step;
      library.check("integrator_step", integrator, this.state, 0n);
    } finally {
      library.call("options_destroy", options);
    }
  }

  /* Takes steps. False where numbers have overflowed or a solver gave up; the state is then the last good one. */
  take(steps) {
    const status = this.library.call("integrator_step", this.integrator, this.state, BigInt(steps));
    return status === 0;
  }

  /* To where the scene begins; use() has to follow. */
  reset() {
    const first = this.library.make("state_create", this.system);
    this.library.check("state_copy", first, this.state);
    this.library.call("state_destroy", first);
  }

  keep() {
    this.library.check("state_copy", this.state, this.kept);
  }

  restore() {
    this.library.check("state_copy", this.kept, this.state);
    this.library.check("integrator_step", this.integrator, this.state, 0n);
  }

  /* A copy of the state, and back. */
  get now() {
    return { time: this.time, position: this.position.slice(), velocity: this.velocity.slice() };
  }
  put({ time, position, velocity }) {
    this.position.set(position);
    this.velocity.set(velocity);
    this.library.call("state_set_time", this.state, time);
  }

  get time() {
    return this.library.call("state_time", this.state);
  }
  get position() {
    return this.library.doubles(this.library.call("state_position", this.state), 3 * this.count);
  }
  get velocity() {
    return this.library.doubles(this.library.call("state_velocity", this.state), 3 * this.count);
  }

  energy(what) {
    const { library } = this;
    return library.call("system_energy_at", this.system, what, this.time, library.call("state_position", this.state),
      library.call("state_velocity", this.state));
  }

  /* Of motion and of all that is elastic, and of gravity [J]. */
  get energies() {
    const gravity = this.energy("gravity");
    return { motion: this.energy("kinetic") + (this.energy("potential") - gravity), gravity };
  }

  /* The safe step of every method at the state, in the order of the library. */
  get bounds() {
    const { library } = this, count = Number(library.call("method_count"));
    return library.filled(Float64Array, count, (pointer) =>
      library.check("step_bound", this.system, 0, library.call("state_position", this.state), pointer));
  }

  /* Ends and rest lengths of the springs, and which particles are held. */
  get net() {
    const { library, system, springs } = this;
    let restLength;
    const ends = library.filled(BigInt64Array, 2 * springs, (pointer) => {
      restLength = library.filled(Float64Array, springs, (rest) =>
        library.check("system_members", system, "springs", pointer, 0, 0, rest));
    });
    const weight = library.doubles(library.call("system_inverse_mass", system), this.count);
    return { ends: Uint32Array.from(ends, Number), restLength, held: Uint8Array.from(weight, (w) => (w === 0 ? 1 : 0)) };
  }

  /* Shape, direction and radius of each obstacle, and its points at these times, one after the other. */
  obstacles(times) {
    const { library, system } = this, list = [];
    for (let k = 0n, shape; (shape = library.text(library.call("system_obstacle_shape", system, k))) !== null; k++) {
      const places = times.map((time) => library.filled(Float64Array, 7, (pointer) =>
        library.check("system_obstacle_place", system, k, time, pointer)));
      list.push({ shape, direction: [...places[0].slice(3, 6)], radius: places[0][6], point: places.flatMap((place) => [...place.slice(0, 3)]) });
    }
    return list;
  }

  /* Of a part: its "particles", or those "before" it. */
  partCount(part, what) {
    return Number(this.library.call("system_part_count", this.system, part, what));
  }
}

if (typeof module === "object") module.exports = { HookeError, Library, Live };
