"use strict";
/* The library's study as a table: it runs in a worker of its own, while the scene is at rest. */

let student = null, studied = null, studyChart = null;

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

/* Errors below what the reference knows are equal. */
const sizeOf = ({ error }) => Math.max(error, studied.reference.agreement);

/* Rows that no other row beats in both error and time. */
function markFront(rows) {
  for (const row of rows) row.front = !rows.some((other) => other.wall_seconds <= row.wall_seconds && sizeOf(other) <= sizeOf(row) &&
    (other.wall_seconds < row.wall_seconds || sizeOf(other) < sizeOf(row)));
}

function writeRow(row) {
  const line = element("tr", "", { className: row.front ? "front" : "" }), use = element("button", "run it");
  const error = row.error === null ? row.status : row.error < studied.reference.agreement
    ? `below ${number(studied.reference.agreement, 2)} m` : `${number(row.error)} m`;
  for (const text of [row.front ? "\u25cf" : "", row.method, seconds(row.step), error, row.error === null ? "" : seconds(row.wall_seconds), ""])
    line.insertCell().textContent = text;
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
  const judged = studied ? studied.rows.filter(({ error }) => error !== null) : [];
  if (!judged.length) return;
  const points = (rows) => rows.map((row) => ({ x: row.wall_seconds, y: sizeOf(row) })).sort((a, b) => a.x - b.x);
  const logarithmic = { type: "logarithmic", ticks: powerTicks() };
  studyChart = diagram(at("study-front"), [
    { label: "front", data: points(judged.filter(({ front }) => front)), showLine: true, borderColor: "#14863c", backgroundColor: "#14863c", borderWidth: 2 },
    { label: "other runs", data: points(judged.filter(({ front }) => !front)), backgroundColor: styleOf("--dim"), pointRadius: 2.5 },
  ], ["time [s]", logarithmic], ["error [m]", logarithmic], { labels: { boxWidth: 12, boxHeight: 6 } });
}

/* The front first, by error; what was not judged last. */
function showStudy(study) {
  const rank = ({ front, error }) => (front ? 2 : error !== null ? 1 : 0);
  studied = study;
  markFront(study.rows.filter(({ error }) => error !== null));
  study.rows.sort((a, b) => rank(b) - rank(a) || b.error - a.error);
  tellClaims("study-words", study.claims);
  at("study-result").hidden = false;
  at("study-rows").tBodies[0].replaceChildren(...study.rows.map(writeRow));
  drawFront();
}

function hearStudy({ data }) {
  if (data.is === "ready") return student.postMessage({ do: "study", text: at("text").value, changes: changes() });
  if (data.is === "studied") showStudy(data);
  else at("study-words").textContent = `No study: ${data.message}`;
  student.terminate();
  student = null;
  at("study-begin").disabled = false;
  return document.body.dataset.study = data.is === "studied" ? "done" : "failed";
}

function beginStudy() {
  dropStudy();
  if (playing) togglePlay(); // it would take part of the processor
  at("study-begin").disabled = true;
  at("study-words").textContent = "The study runs: it takes up to ten seconds ...";
  document.body.dataset.study = "runs";
  student = newWorker();
  student.onmessage = hearStudy;
}
