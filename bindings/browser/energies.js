"use strict";
/* The diagram of energies. */

let energies = { motion: [], gone: [] }; // `gone` since steps are taken one by one

function thinned(list) {
  return list.length <= 700 ? list : list.filter((_, k) => k % 2 === 0 || k > list.length - 40);
}

function addEnergy(frame) {
  const list = frame.slow ? "gone" : "motion", last = energies.motion[energies.motion.length - 1];
  if (frame.slow && energies.gone.length === 0 && last) energies.gone.push(last);
  if (frame.energies.motion > 0 && frame.time > 0) energies[list] = thinned([...energies[list], { x: frame.time, y: frame.energies.motion }]);
}

/* Not below a millionth of what there is: a scene at rest has an energy of rounding. */
function boundEnergies(scale) {
  const most = Math.max(0, ...energies.motion.map(({ y }) => y));
  if (most > 0) scale.min = Math.max(scale.min, 1e-6 * most);
}

function makeChart() {
  if (chart) chart.destroy();
  const line = (label, borderColor) => ({ label, data: [], borderColor, borderWidth: 2, pointRadius: 0, showLine: true });
  chart = diagram(at("energy"), [line("energy of motion and springs", "#2f86c9"), line("step by step", "#c0262d")],
    ["t [s]", { ticks: { callback: (value) => number(value, 6) } }],
    ["energy [J]", { type: "logarithmic", afterDataLimits: boundEnergies, ticks: powerTicks() }],
    { labels: { boxHeight: 0, boxWidth: 18 } });
}

let charted = 0;
function drawEnergies(now = performance.now()) {
  if (now - charted < 200) return;
  charted = now;
  chart.data.datasets[0].data = energies.motion;
  chart.data.datasets[1].data = energies.gone;
  chart.update();
}
