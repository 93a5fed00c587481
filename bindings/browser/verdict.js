"use strict";
/* Words on how it goes: the step against the bound, the cause of an explosion, predictions. */

function verdict(kind, text) {
  at("verdict").className = kind;
  if (at("verdict-words").textContent !== text) at("verdict-words").textContent = text;
  document.body.dataset.verdict = kind;
}

function compare() {
  const bound = boundNow(), now = stepNow();
  if (Number.isNaN(bound) || bound === Infinity) return ["", `${method()} takes steps of ${seconds(now)}.`];
  if (bound === 0) return ["risky", `${method()} is stable at no step here: energy grows, if slowly.`];
  if (now <= bound) return ["safe", `The step ${seconds(now)} is below the safe bound, ${seconds(bound)}: certain to be stable about this state.`];
  return ["risky", `The step ${seconds(now)} is above the safe bound, ${seconds(bound)}. It may blow up.`];
}

function writeVerdict(frame) {
  at("cure").hidden = true;
  at("why-words").textContent = "";
  if (frame.slow) return verdict("blown", "The energy grows, and nothing in the scene feeds it. From here on, step by step.");
  return verdict(...compare());
}

/* Another run as a button. */
function offer(by, length) {
  if (by === method() && length === stepNow()) return; // a shorter run, say
  at("cure").hidden = false;
  at("cure").textContent = `${by === method() ? "" : `Set the method to ${by}. `}Set the step to ${seconds(length)} and start again`;
  at("cure").onclick = () => {
    at("method").value = by;
    setStep(length);
    restart();
  };
}

/* The step against the bound before the trouble; the cause itself takes LAPACK, and a moment. */
function explain(frame) {
  const bound = boundNow(), now = stepNow();
  verdict("blown", `It blew up at t = ${number(frame.diverged === null ? frame.time : frame.diverged)} s.`);
  const words = bound > 0 && now > bound ? `The step ${seconds(now)} was ${number(now / bound)} times the safe bound. ` : "";
  at("why-words").textContent = words + (predicts ? "Looking for the cause ..." : "The cause is not looked for in this build of the page, " +
    "which has no LAPACK: hooke why finds it.");
  if (bound > 0 && now > bound) offer(method(), Number((0.9 * bound).toPrecision(2)));
  if (predicts) {
    const steps = Math.ceil((frame.time - frame.trouble.first.time) / now) + 100;
    consult({ do: "why", ...sceneNow(), ...frame.trouble, steps });
  }
}

/* ---- predictions: by a worker of their own, which is ended when something else is asked ---- */

const sceneNow = () => ({ text: at("text").value, changes: changes(), method: method(), step: stepNow() });
let advisor = null, resting = 0, stateAsked = 0;

/* What was asked of another scene, method or step is not answered any more. */
function dismiss() {
  clearTimeout(resting);
  stateAsked = 0;
  if (advisor) advisor.terminate();
  advisor = null;
}

function consult(request) {
  dismiss();
  advisor = newWorker();
  advisor.onmessage = ({ data }) => {
    if (data.is === "ready") advisor.postMessage(request);
    else ADVICE[data.is](data);
    document.body.dataset.advice = data.is;
  };
}

const ADVICE = {
  limit({ predicted, exact }) {
    const share = predicted > 0 && Number.isFinite(predicted) ? shareOf(predicted) : NaN;
    markAt("limit", share);
    at("limit-words").textContent = predicted === 0 ? "Predicted: no step is stable." : predicted === Infinity
      ? "Predicted: nothing limits the step." : exact ? `Predicted limit: ${seconds(predicted)}` : `Predicted limit: ${seconds(predicted)} or less`;
    document.body.dataset.limit = predicted;
  },
  why({ claims, advised }) {
    tellClaims("why-words", claims);
    if (advised) offer(advised.method, advised.step);
  },
  error({ message }) {
    at(ended ? "why-words" : "limit-words").textContent = `Not known: ${message}`;
  },
};

/* The sentences of a measurement, as the library composed them. */
function tellClaims(id, claims) {
  at(id).replaceChildren(...claims.map(({ text }) => element("p", text)));
}

/* Half a second after the last change, at the state that is then shown. */
function predictSoon() {
  dismiss();
  markAt("limit", NaN);
  at("limit-words").textContent = predicts ? "" : "The limit itself is not predicted in this build of the page.";
  if (predicts) resting = setTimeout(() => { stateAsked = tell({ do: "state" }); }, 500);
}
