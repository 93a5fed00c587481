"use strict";
/* What the library measures of a scene: the predicted limit of a method, why a run blew up, and a study. It takes longer than a
 * frame, and is for a worker of its own. HookeError where the build lacks what it needs. */

/* Runs a measurement with these options of its kind, and reads its handle and its document. */
function measured(live, kind, given, { run = 0, state = 0, create, read = (made, found) => found }) {
  const { library } = live, options = library.make("options_create", kind);
  let made = 0;
  try {
    for (const [name, value] of Object.entries(given)) library.check("options_set_text", options, name, String(value));
    made = create ? create(options) : library.make("measurement_create", kind, live.system, run, options);
    library.check("measurement_run", made, state);
    return read(made, JSON.parse(library.text(library.call("measurement_json", made, 0, -1n))));
  } finally {
    library.call("measurement_destroy", made);
    library.call("options_destroy", options);
  }
}

/* The largest stable step [s] at the state of `live`; not `exact`: it lies between the safe step and this one. */
function limitOf(live, method) {
  const read = (limit) => {
    const number = (column) => live.library.call("measurement_number", limit, "rows", 0n, column);
    return { predicted: number("predicted"), exact: number("exact") === 1 };
  };
  return measured(live, "limit", { methods: method, predict: true }, { state: live.state, read });
}

const FRAME = 10; // steps; advised steps are whole parts of a frame

/* Explains a run of `steps` steps from the state `first` on that was still good at `last`, both as { time, position, velocity }. */
function whyOf(live, { method, step, steps, first, last }) {
  const { library } = live, run = live.runOptions(method, step, Math.ceil(steps / FRAME) * FRAME * step, FRAME * step), made = [];
  const stateOf = (from) => {
    live.put(from);
    const state = library.make("state_create", live.system);
    made.push(state);
    library.check("state_copy", live.state, state);
    return state;
  };
  const create = (options) => library.make("why_create_kept", live.system, run, stateOf(first), stateOf(last), options);
  const read = (why, { claims = [], sentence, advice: [best] }) => {
    const told = claims.length ? claims : [{ text: sentence }];
    if (best) told.push({ text: `Advice: ${best.change}` });
    if (!best || !best.option) return { claims: told }; // it is the scene that should change
    library.check("why_advice_apply", why, 0n, run);
    return { claims: told,
      advised: { method: library.text(library.call("options_text", run, "method")), step: library.call("options_number", run, "step") } };
  };
  try {
    return measured(live, "why", { budget: 20 }, { create, read });
  } finally {
    made.forEach((state) => library.call("state_destroy", state));
    library.call("options_destroy", run);
  }
}

/* Of every method, at 20 frames. */
function studyOf(live) {
  const duration = live.given.duration > 0 ? live.given.duration : 1;
  const run = live.runOptions("rk4", duration / 20, duration, duration / 20);
  try {
    return measured(live, "study", { budget: 10 }, { run });
  } finally {
    live.library.call("options_destroy", run);
  }
}

if (typeof module === "object") module.exports = { limitOf, studyOf, whyOf };
