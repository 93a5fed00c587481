"use strict";
/* A scene along two of its axes, from `picture` of a page: springs as lines between particles. */

const AXES = ["x", "y", "z"];
const VIEWS = { xy: [0, 1], xz: [0, 2], zy: [2, 1] };
const viewWith = (one, other) =>
  Object.keys(VIEWS).find((key) => VIEWS[key].includes(one) && VIEWS[key].includes(other));

const springsOf = (picture) =>
  picture.spring.map((number, k) => ({ number, ends: [picture.ends[2 * k], picture.ends[2 * k + 1]] }));

const VIEW_CHOICES = Object.keys(VIEWS).map((key) => [key, [[...key].join(" ")]]);

/* Along the two axes that are the longest by `lengthOf`. */
function widestView(lengthOf) {
  const [long, second] = [0, 1, 2].sort((a, b) => lengthOf(b) - lengthOf(a));
  return viewWith(long, second);
}

/* Minimum and maximum of `of`. */
const extentBy = (list, of) => list.reduce(([low, high], k) => [Math.min(low, of(k)), Math.max(high, of(k))],
  [Infinity, -Infinity]);

const spanOf = ([low, high]) => high - low;

/* The box around particles along two axes, with so much of its `size` on every side. */
function boxAround(list, coordinateOf, axes, margin, least = 1) {
  const [[left, right], [bottom, top]] = axes.map((axis) => extentBy(list, (k) => coordinateOf(k, axis)));
  const size = Math.max(right - left, top - bottom) || least, edge = margin * size;
  return { size, left: left - edge, right: right + edge, bottom: bottom - edge, top: top + edge };
}

const lineOf = (springs, at, label, colour, more) => plain(label,
  springs.flatMap((spring) => [...spring.ends.map((end) => ({ ...at(end), spring })), { x: NaN, y: NaN }]), colour,
  { spanGaps: false, ...more });

/* ---- one scale for both axes ---- */

const axisOf = (title) => linearAxis(title, { ticks: { includeBounds: false },
  grid: { color: (context) => (context.tick && context.tick.value === 0 ? EDGE : GRID) } });

/* Shows the box, and as much beside it as fits; calls `filled` when the edges are known. */
function equalScale(chart, box, filled) {
  const { width, height } = chart.chartArea;
  const unit = Math.max((box.right - box.left) / width, (box.top - box.bottom) / height);
  const x = (box.left + box.right) / 2, y = (box.bottom + box.top) / 2;
  Object.assign(chart.options.scales.x, { min: x - unit * width / 2, max: x + unit * width / 2 });
  Object.assign(chart.options.scales.y, { min: y - unit * height / 2, max: y + unit * height / 2 });
  if (filled) filled(chart, chart.options.scales.x, chart.options.scales.y);
  chart.update("none");
}

function drawEqual(id, lines, titles, box, describe, filled) {
  const chart = draw(id, lines, axisOf(titles[0]), axisOf(titles[1]), describe);
  /* the first one has reserved space for labels, so that the second one finds the remaining widths */
  equalScale(chart, box, filled);
  equalScale(chart, box, filled);
  chart.options.onResize = () => setTimeout(() => chart.ctx && equalScale(chart, box, filled));
  return chart;
}
