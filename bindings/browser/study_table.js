"use strict";
/* The small study as a table: it runs in a worker of its own, while the scene is at rest. */

let student = null, studied = null, studyChart = null;
const cellsOf = (...texts) => texts.map((text) => Object.assign(document.createElement("td"), { textContent: text }));

/* Of another scene it says nothing. */
function dropStudy() {
  if (student) student.terminate();
  student = studied = null;
  at("study-words").textContent = "";
  at("study-result").hidden = true;
  at("study-begin").disabled = false;
  document.body.dataset.study = "";
  drawFront();
}

function writeRow(row) {
  const line = document.createElement("tr"), use = Object.assign(document.createElement("button"), { textContent: "run it" });
  const error = row.blown ? "blew up" : row.error < studied.agreement ? `below ${number(studied.agreement, 2)} m` : `${number(row.error)} m`;
  line.className = row.front ? "front" : "";
  line.append(...cellsOf(row.front ? "\u25cf" : "", row.method, seconds(row.step), error, row.blown ? "" : seconds(row.seconds)), document.createElement("td"));
  if (row.front) line.lastChild.append(use);
  use.onclick = () => {
    at("method").value = row.method;
    setStep(row.step);
    restart();
    if (!playing) togglePlay();
  };
  return line;
}

/* Error against time, both by powers of ten; a line through the front. */
function drawFront() {
  if (studyChart) studyChart.destroy();
  studyChart = null;
  if (!studied || !studied.rows.some(({ blown }) => !blown)) return;
  const ink = styleOf("--dim"), grid = styleOf("--line"), points = (rows) => rows.filter(({ blown }) => !blown)
    .map((row) => ({ x: row.seconds, y: Math.max(row.error, studied.agreement) })).sort((a, b) => a.x - b.x);
  const axis = (title) => ({ type: "logarithmic", title: { display: true, text: title, color: ink }, grid: { color: grid, borderColor: grid },
    ticks: { color: ink, maxRotation: 0, callback: (value) => (Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-9 ? value.toExponential(0) : null) } });
  studyChart = new Chart(at("study-front"), { type: "scatter", data: { datasets: [
    { label: "front", data: points(studied.rows.filter(({ front }) => front)), showLine: true, borderColor: "#14863c", backgroundColor: "#14863c", borderWidth: 2 },
    { label: "other runs", data: points(studied.rows.filter(({ front }) => !front)), backgroundColor: ink, pointRadius: 2.5 }] },
  options: { animation: false, maintainAspectRatio: false, events: [], scales: { x: axis("time [s]"), y: axis("error [m]") },
    plugins: { tooltip: { enabled: false }, legend: { align: "end", labels: { color: ink, boxWidth: 12, boxHeight: 6 } } } } });
}

function showRows() {
  at("study-result").hidden = false;
  at("study-rows").tBodies[0].replaceChildren(...studied.rows.map(writeRow));
}

const STUDY_HEARD = {
  reference({ step, agreement, until, duration, motion }) {
    studied = { rows: [], agreement };
    at("study-words").textContent = `Reference: rk4 in steps of ${seconds(step)}; its two finest runs are within ${number(agreement, 2)} m of ` +
      `each other, in a motion of ${number(motion, 2)} m` + (until < duration * (1 - 1e-9)
      ? `, until t = ${number(until)} s. Later they part, and errors are those up to then.` : ".");
  },
  row({ row }) {
    studied.rows.push(row);
    showRows();
  },
  /* The front first, by error. */
  studied({ rows }) {
    studied.rows = [...rows].sort((a, b) => Boolean(b.front) - Boolean(a.front) || Boolean(a.blown) - Boolean(b.blown) || b.error - a.error);
    showRows();
    drawFront();
    endStudy("done");
  },
  error({ message }) {
    at("study-words").textContent = `No study: ${message}`;
    endStudy("failed");
  },
};

function endStudy(how) {
  student.terminate();
  student = null;
  at("study-begin").disabled = false;
  document.body.dataset.study = how;
}

function beginStudy() {
  dropStudy();
  if (playing) togglePlay(); // it would take part of the processor
  at("study-begin").disabled = true;
  at("study-words").textContent = "The reference is being computed ...";
  document.body.dataset.study = "runs";
  student = newWorker();
  student.onmessage = ({ data }) => {
    if (data.is === "ready") student.postMessage({ do: "study", text: at("text").value, changes: changes() });
    else STUDY_HEARD[data.is](data);
  };
}
