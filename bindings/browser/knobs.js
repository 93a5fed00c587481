"use strict";
/* Sliders, the method, and the marks of what is safe. */

const seconds = (value) => (value >= 1 ? `${number(value)} s` : value >= 1e-3 ? `${number(1e3 * value)} ms` : `${number(1e6 * value)} \u00b5s`);

const method = () => at("method").value;
const step = () => Number((stepRange[0] * (stepRange[1] / stepRange[0]) ** (at("step").value / 1000)).toPrecision(2));
const shareOf = (value) => Math.log(value / stepRange[0]) / Math.log(stepRange[1] / stepRange[0]);
const factor = (name) => Number((10 ** (at(name).value / 10)).toPrecision(2));
let gravityMoved = false;
const gravity = () => (gravityMoved ? at("gravity").value / 10 : null);
const changes = () => ({ stiffness: factor("stiffness"), damping: factor("damping"), mass: factor("mass"), gravity: gravity() });

function setStep(value) {
  at("step").value = Math.round(1000 * shareOf(value));
  tested = value;
}

/* The step as it was set, exactly, until the slider moves. */
const stepNow = () => (tested === null ? step() : tested);

function writeKnobs() {
  at("step-out").textContent = seconds(stepNow());
  for (const name of KNOBS) at(`${name}-out`).textContent = factor(name) === 1 ? "as in the scene" : `\u00d7 ${number(factor(name))}`;
  at("gravity-out").textContent = `${number(at("gravity").value / 10)} m/s\u00b2`;
}

const boundNow = () => {
  const row = methods.find(({ name }) => name === method());
  return row ? bounds[row.place] : NaN;
};

function markAt(id, share) {
  at(id).hidden = !(share >= 0 && share <= 1);
  at(id).style.left = `calc(8px + ${share} * (100% - 16px))`;
}

/* The safe step of the method as a mark on the slider. */
function markBound() {
  const bound = boundNow();
  markAt("bound", bound > 0 && Number.isFinite(bound) ? shareOf(bound) : NaN);
  at("bound-words").textContent = Number.isNaN(bound) ? "No bound is known for this method." : bound === 0
    ? "This method is stable at no step here." : bound === Infinity ? "Nothing limits the step of this method."
      : `Safe up to ${seconds(bound)} (a bound; the limit may be larger)`;
  document.body.dataset.bound = bound;
}
