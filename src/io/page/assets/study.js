"use strict";
/* The diagrams of a study. */

const study = data;
const floor = study.reference.agreement;
const recommended = study.recommendation && study.recommendation.error_unit === "m" ? study.recommendation : null;
const want = recommended ? recommended.want : null;
/* As far as errors are known: where they are not known to the end, `met` is null. */
const meets = recommended !== null && recommended.met !== false && recommended.error !== null;
study.rows.forEach((row, k) => Object.assign(row, study.curves[k]));

const setting = (row) => (row.step !== null ? `step ${words(row.step, 4)} s` : `rtol ${words(row.rtol)}`);

const rowsOf = (method) => study.rows.filter((row) => row.method === method);
/* What is wanted is held against the largest distance of a particle, which is the error of a recommendation. */
const errorOf = (row) => row.error_max ?? row.error;
const finished = (row) => row.status === "finished" && row.error !== null;

/* ---- lines ---- */

const level = (label, value, colour, range) => plain(label, range.map((x) => ({ x, y: value })), colour,
  { borderWidth: 1.5, borderDash: [7, 4], order: 5 });

const levels = (range) => [["floor of the reference", floor, "#6b7680"], ["wanted", want, "#14633c"]].filter(([, value]) => value > 0)
  .map(([name, value, colour]) => level(`${name}, ${words(value)} m`, value, colour, range));

/* The error axis of some rows. Runs without an error stand at its upper edge, one row of crosses for each method. */
function errorAxis(rows) {
  const [low, high] = ends([...rows.filter(finished), recommended || {}].map(errorOf).concat(floor, want));
  const lost = methods.filter((method) => rows.some((row) => row.method === method && !finished(row)));
  const apart = (high / low) ** 0.035;
  const range = [low, high * apart ** lost.length];
  return { range, edge: (method) => range[1] / apart ** lost.indexOf(method) };
}

/* A marked line of a method over `range`; points outside are drawn at the near end. */
function curve(method, rows, what, range, edge) {
  const across = (value) => Math.min(Math.max(value, range[0]), range[1]);
  const colour = colourOf(method);
  const lost = rows.map((row) => !finished(row));
  return {
    label: method,
    data: rows.map((row, k) => ({ x: across(row[what]), y: lost[k] ? edge(method) : errorOf(row), row })),
    borderColor: colour, backgroundColor: colour, borderWidth: 2, clip: 9,
    segment: { borderColor: (at) => (lost[at.p0DataIndex] || lost[at.p1DataIndex] ? "transparent" : undefined) },
    pointStyle: lost.map((is) => (is ? "crossRot" : markOf(method))),
    pointRadius: lost.map((is) => (is ? 7 : 5)), pointHoverRadius: 8,
    pointBorderWidth: lost.map((is) => (is ? 2.5 : 2)), pointBorderColor: colour,
    pointBackgroundColor: rows.map((row) => (row.near_floor ? PAPER : colour)),
  };
}

/* ---- error against cost and step ---- */

function describeRow(item) {
  const row = item.raw.row;
  if (!row) return "";
  return [setting(row), finished(row) ? `error ${words(errorOf(row))} m` : row.status,
    `wall time ${words(row.wall_seconds)} s`, `${whole(row.force_evaluations)} force evaluations`];
}

const COSTS = { wall_seconds: ["wall time", "wall time [s]"],
  force_evaluations: ["force evaluations", "force evaluations"] };

function drawCost(what) {
  const across = ends([...study.rows.filter(finished), recommended || {}].map((row) => row[what]));
  const up = errorAxis(study.rows);
  const lines = methods.map((method) => curve(method, rowsOf(method), what, across, up.edge));
  if (recommended && recommended.error !== null) {
    const row = { ...recommended, status: "finished" };
    lines.push({ label: meets ? "recommended" : "closest", role: "star", showLine: false,
      data: [{ x: row[what], y: row.error, row }], pointStyle: "star", pointRadius: 11, pointHoverRadius: 12,
      pointBorderWidth: 2, borderColor: "#111", backgroundColor: "#111", order: -1, clip: 12 });
  }
  draw("work-precision", [...lines, ...levels(across)], logAxis(COSTS[what][1], across),
    logAxis("error [m]", up.range), describeRow);
}

/* Through the finest point clear of the floor, with the slope of the order. */
function slopeLine(method, rows) {
  const order = study.orders[method];
  const clear = rows.filter((row) => finished(row) && !row.near_floor && errorOf(row) > 0);
  if (!order || order.order === null || clear.length < 2) return [];
  const from = clear[clear.length - 1], to = clear[0].step;
  const at = (x) => ({ x, y: errorOf(from) * (x / from.step) ** order.order });
  return [plain("", [at(from.step / 1.4), at(to)], colourOf(method), { role: "slope", borderWidth: 1.5, borderDash: [3, 4] })];
}

/* Errors of one step, as a thin line. */
const stepLine = (method, rows) => plain("", rows.filter((row) => row.error_step > 0).map((row) => ({ x: row.step, y: row.error_step })),
  colourOf(method), { role: "step", borderWidth: 1, pointRadius: 2 });

function drawConvergence() {
  const fixed = study.rows.filter((row) => row.step !== null);
  at("convergence").closest("section").hidden = fixed.length === 0;
  if (fixed.length === 0) return;
  const across = ends(fixed.map((row) => row.step));
  const up = errorAxis(fixed);
  const names = methods.filter((method) => fixed.some((row) => row.method === method));
  const lines = names.flatMap((method) => [curve(method, rowsOf(method), "step", across, up.edge),
    ...slopeLine(method, rowsOf(method)), stepLine(method, rowsOf(method))]);
  up.range[0] = Math.min(up.range[0], ...fixed.map((row) => row.error_step).filter((error) => error > 0));
  const chart = draw("convergence", [...lines, ...levels(across)], logAxis("step [s]", across),
    logAxis("error [m]", up.range), describeRow);
  chart.canvas.dataset.slopes = lines.filter((line) => line.role === "slope").length;
}

/* ---- over time ---- */

const PICKS = {
  enough: ["just enough",
    "Of each method the coarsest run whose error is at most what is wanted; its finest one where none is."],
  coarse: ["coarsest", "Of each method the coarsest run that finished."],
  middle: ["middle", "Of each method the middle one of its runs that finished."],
  fine: ["finest", "Of each method the finest run that finished."],
};

function pick(method, how) {
  const rows = rowsOf(method).filter(finished);
  if (how === "coarse") return rows[0];
  if (how === "middle") return rows[Math.floor((rows.length - 1) / 2)];
  const enough = how === "enough" ? rows.find((row) => errorOf(row) <= want) : undefined;
  return enough || rows[rows.length - 1];
}

function drawTimes(how) {
  at("picked").textContent = PICKS[how][1] +
    " Left the error, right how far the energy is from that of the reference; point at a line for its step or " +
    "tolerance." +
    (want === null ? "" : " The dashed line is what is wanted.");
  const rows = methods.map((method) => pick(method, how)).filter((row) => row !== undefined);
  const lines = (what) => rows.map((row) => plain(row.method,
    study.time.map((x, k) => ({ x, y: row[what][k] > 0 ? row[what][k] : NaN, row })), colourOf(row.method),
    { borderWidth: 1.8, pointRadius: 0.5, pointHoverRadius: 4, pointHitRadius: 6 }));
  const draws = (id, what, title, extra) => {
    const list = lines(what);
    const seen = list.flatMap((line) => line.data.map((point) => point.y)).filter((y) => y > 0);
    const high = Math.max(...seen, ...extra), low = Math.max(Math.min(...seen), high * 1e-16);
    const unnamed = what === "error_max_at" ? levels(study.time).map((line) => ({ ...line, label: "" })) : [];
    draw(id, [...list, ...unnamed],
      linearAxis("time [s]", { min: Math.min(0, ...study.time), max: Math.max(...study.time) }), logAxis(title, ends([low, high])),
      (item) => [setting(item.raw.row), `t = ${words(item.raw.x)} s: ${words(item.raw.y)}`]);
  };
  draws("error-over-time", "error_max_at", "error [m]", want === null ? [] : [want]);
  draws("energy-over-time", "energy_drift_at", "|E \u2212 E of the reference| [J]", []);
}
