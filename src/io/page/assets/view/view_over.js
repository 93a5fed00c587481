"use strict";
/* Several runs over one another: the other pages' runs are drawn in this one. */

/* Told apart by eyes of every kind, on paper and in the dark. */
const RUN_COLOURS = {
  light: ["#0072b2", "#d55e00", "#009e73", "#b4458e", "#b88a00", "#2aa1c9", "#7a5195", "#5b6770"],
  dark: ["#56b4e9", "#f08a3c", "#2fc79a", "#e28fc4", "#e6c24a", "#8fd3ee", "#b79ad6", "#a3adb8"],
};

let runs = []; // this page's first
let shared = [run]; // whose axes are the same
const accuracyOf = (data) => (data.step !== undefined ? `, step ${number(data.step, 6)} s` : data.rtol !== undefined ? `, rtol ${number(data.rtol, 6)}` : "");
const nameOf = ({ data }) => `${data.file}: ${data.method}${accuracyOf(data)}`;

function endOf(one) {
  const { status, time_last: end } = one;
  if (ALERTS[status]) return `, ${OUTCOMES[status]} ${where(one)}`;
  return end < data.time_last ? `, until t = ${number(end, 4)} s` : "";
}

/* Words after a square of the run's colour, if it has one. */
function itemOf(words, own) {
  const item = element("li", words);
  if (own) item.prepend(Object.assign(element("i"), { style: `background: ${own}` }));
  return item;
}

function writeRuns() {
  at("runs").replaceChildren(...(runs.length > 1 ? runs : []).map((one) => itemOf(nameOf(one) + endOf(one.data), one.own)));
}

/* Of several, each has a colour of its own. */
function colourRuns() {
  const colours = RUN_COLOURS[isDark() ? "dark" : "light"];
  runs.forEach((one, k) => {
    one.own = runs.length > 1 ? colours[k] : null;
    if (picture) picture.runs[k].setOwn(one.own);
  });
  writeRuns();
}

/* Draws these runs over this page's; without any, this page's alone. */
window.drawOver = (others) => {
  runs = [run, ...others.map((other) => ({ ...other }))];
  document.body.classList.toggle("over", runs.length > 1);
  pick(null);
  if (picture) {
    picture.drawOver(runs.slice(1));
    picture.fitAll();
  }
  findAparts();
  dress();
  relook();
};
