"use strict";
/* The predicted limit of a method, and why a run blew up: what takes longer than a frame, for a worker of its own. HookeError where
 * the build has no LAPACK. */

/* The largest stable step [s] at the state of `live`; not `exact`: it lies between the safe step and this one. */
function limitOf(live, method) {
  const { library } = live, options = library.make("options_create", "limit");
  let limit = 0;
  try {
    library.check("options_set_text", options, "methods", method);
    library.check("options_set_number", options, "predict", 1);
    limit = library.make("measurement_create", "limit", live.system, 0, options);
    library.check("measurement_run", limit, live.state);
    const number = (column) => library.call("measurement_number", limit, "rows", 0n, column);
    return { predicted: number("predicted"), exact: number("exact") === 1 };
  } finally {
    library.call("measurement_destroy", limit);
    library.call("options_destroy", options);
  }
}

const PATIENCE = 20; // [s] for a cause
const FRAME = 10; // steps; advised steps are whole parts of a frame

/* Explains a run of `steps` steps from the state `first` on that was still good at `last`, both as { time, position, velocity }. */
function whyOf(live, { method, step, steps, first, last }) {
  const { library } = live, run = live.runOptions(method, step), options = library.make("options_create", "why"), made = [];
  let why = 0;
  const stateOf = (from) => {
    live.put(from);
    const state = library.make("state_create", live.system);
    made.push(state);
    library.check("state_copy", live.state, state);
    return state;
  };
  try {
    library.check("options_set_number", run, "duration", Math.ceil(steps / FRAME) * FRAME * step);
    library.check("options_set_number", run, "every", FRAME * step);
    library.check("options_set_number", options, "budget", PATIENCE);
    why = library.make("why_create_kept", live.system, run, stateOf(first), stateOf(last), options);
    library.check("measurement_run", why, 0);
    const text = (table, column) => library.text(library.call("measurement_text", why, table, 0n, column));
    const found = { sentence: text("why", "sentence"), change: text("advice", "change"), advised: null };
    if (text("advice", "option")) { // else it is the scene that should change
      library.check("why_advice_apply", why, 0n, run);
      found.advised = { method: library.text(library.call("options_text", run, "method")), step: library.call("options_number", run, "step") };
    }
    return found;
  } finally {
    library.call("measurement_destroy", why);
    made.forEach((state) => library.call("state_destroy", state));
    library.call("options_destroy", options);
    library.call("options_destroy", run);
  }
}

if (typeof module === "object") module.exports = { limitOf, whyOf };
