"use strict";
/* A mode on the scene, with the springs to blame: as arrows on springs, and as a table. */

const blames = data.blame.filter((one) => one.force === null); /* words tell of a force */
const picture = { particle: [], held: [], spring: [], ends: [], position: [], move: [], springs: 0, particles: 0,
  ...data.picture, ...data.mode };
const moving = picture.move.length > 0;
const MOST_ARROWS = 300, MOST_DISPLACED = 200, MOST_DOTS = 400;
const blameOf = new Map(blames.map((one) => [one.number, one]));
const topShare = blames.length > 0 ? blames[0].share : 0;
const coordinate = (particle, axis) => picture.position[3 * particle + axis];
const moveOf = (particle, axis) => (moving ? picture.move[3 * particle + axis] : 0);
const particles = picture.particle.map((_, k) => k);
const sizes = particles.map((k) => Math.hypot(moveOf(k, 0), moveOf(k, 1), moveOf(k, 2)));
const movers = particles.filter((k) => sizes[k] > 0.02).sort((a, b) => sizes[b] - sizes[a]);
const listed = springsOf(picture).map((spring) => ({ ...spring, blame: blameOf.get(spring.number) }));
const isBlamed = (spring) => spring.blame !== undefined && spring.blame.share > 0.01 * topShare;

/* From sand to red. */
function shareColour(share) {
  const t = topShare > 0 ? Math.sqrt(share / topShare) : 0, from = [232, 196, 120], to = [176, 0, 32];
  return "#" + from.map((f, i) => Math.round(f + t * (to[i] - f)).toString(16).padStart(2, "0")).join("");
}

const lengthOf = (axis) => spanOf(extentBy(particles, (k) => coordinate(k, axis)));

/* The two longest axes; where the mode hardly moves along these, the longest and the one of most motion. */
function firstView() {
  const by = (length) => [0, 1, 2].sort((a, b) => length(b) - length(a));
  const motion = (axis) => particles.reduce((sum, k) => sum + moveOf(k, axis) ** 2, 0);
  const [long, second] = by(lengthOf);
  const seen = motion(long) + motion(second), most = by(motion).find((axis) => axis !== long);
  const chosen = moving && seen < 0.1 * [0, 1, 2].reduce((sum, axis) => sum + motion(axis), 0) ? most : second;
  return viewWith(long, chosen);
}

const looking = { view: null, zoom: "all" };

const longestBlamed = () => Math.max(0, ...listed.filter(isBlamed).map(({ ends: [a, b] }) =>
  Math.hypot(...[0, 1, 2].map((axis) => coordinate(a, axis) - coordinate(b, axis)))));

/* What is to be seen, and how long the longest arrow is. */
function frameOf(axes) {
  const [near, margin] = looking.zoom === "mode" ? [movers.filter((k) => sizes[k] > 0.4), 0.35] : [particles, 0.14];
  const box = boxAround(near, coordinate, axes, margin, longestBlamed() || 1);
  return { box, arrow: Math.min(0.12 * (box.size + margin * box.size), longestBlamed() || Infinity) };
}

/* Arrows over everything else, from where a particle is to where the mode takes it. */
const arrows = {
  id: "arrows",
  afterDatasetsDraw(chart) {
    const { ctx, chartArea: { left, top, right, bottom }, scales: { x, y } } = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, right - left, bottom - top);
    ctx.clip();
    ctx.strokeStyle = ctx.fillStyle = "#0057b8";
    ctx.lineWidth = 2;
    for (const [from, to] of chart.options.arrows || []) {
      const [a, b, c, d] = [x.getPixelForValue(from.x), y.getPixelForValue(from.y), x.getPixelForValue(to.x),
        y.getPixelForValue(to.y)];
      const length = Math.hypot(c - a, d - b), head = Math.min(9, 0.6 * length);
      if (length < 1) continue;
      const ux = (c - a) / length, uy = (d - b) / length;
      ctx.beginPath();
      ctx.moveTo(a, b);
      ctx.lineTo(c - 0.7 * head * ux, d - 0.7 * head * uy);
      ctx.stroke();
      ctx.beginPath();
      ctx.moveTo(c, d);
      ctx.lineTo(c - head * ux + 0.5 * head * uy, d - head * uy - 0.5 * head * ux);
      ctx.lineTo(c - head * ux - 0.5 * head * uy, d - head * uy + 0.5 * head * ux);
      ctx.fill();
    }
    ctx.restore();
  },
};
Chart.register(arrows);

function describePlace(item) {
  const { spring, particle } = item.raw;
  if (spring && spring.blame) return describeBlame(spring.blame);
  if (particle === undefined) return "";
  const where = AXES.map((name, axis) => `${name} ${words(coordinate(particle, axis), 5)}`).join(", ");
  return [`particle ${picture.particle[particle]} at ${where} m`,
    picture.held[particle] ? "held" : `moves ${AXES.map((_, axis) => words(moveOf(particle, axis))).join(", ")}`];
}

function drawPicture() {
  const view = VIEWS[looking.view], [across, up] = view, { arrow, box } = frameOf(view);
  const at = (k) => ({ x: coordinate(k, across), y: coordinate(k, up) });
  const moved = (k) => ({ x: at(k).x + arrow * moveOf(k, across), y: at(k).y + arrow * moveOf(k, up) });
  const blamed = listed.filter(isBlamed), others = listed.filter((spring) => !isBlamed(spring));
  const displaced = listed.length > MOST_DISPLACED ? []
    : listed.filter(({ ends }) => ends.some((end) => sizes[end] > 0.02));
  const colours = blamed.flatMap(({ blame }) => Array(3).fill(shareColour(blame.share)));
  const shown = movers.slice(0, MOST_ARROWS), held = particles.filter((k) => picture.held[k]);
  const dots = (label, list, colour, pointRadius, pointStyle = "circle") => plain(label,
    list.map((k) => ({ ...at(k), particle: k })), colour,
    { showLine: false, order: 1, borderWidth: 1, pointHitRadius: 1, pointRadius, pointStyle });
  const lines = [
    lineOf(others, at, "springs", "#8a949e", { role: "springs", borderWidth: listed.length > MOST_DISPLACED ? 0.7 : 1.5, order: 5 }),
    lineOf(displaced, moved, "moved by the mode", "#7fb2e5", { role: "displaced", borderWidth: 1, borderDash: [4, 3], order: 4 }),
    lineOf(blamed, at, "springs to blame, the redder the more", "#b00020", { role: "blamed", borderWidth: 4, pointRadius: 2.5,
      pointHitRadius: 8, pointBorderColor: colours, pointBackgroundColor: colours, order: 2,
      segment: { borderColor: (context) => colours[context.p0DataIndex] } }),
    dots("particles that move", shown, "#0057b8", shown.length > 100 ? 2 : 3.5),
    dots("", particles.length > MOST_DOTS && particles.length <= listed.length ? [] : particles.filter((k) => !picture.held[k] && sizes[k] <= 0.02),
      "#5b6770", 2),
    dots("held particles", held, POINT, 4, "rect"),
  ].filter((line) => line.data.length > 0);
  const chart = drawEqual("picture", lines, [`${AXES[across]} [m]`, `${AXES[up]} [m]`], box, describePlace);
  chart.options.arrows = shown.map((k) => [at(k), moved(k)]);
  chart.update("none");
  Object.assign(chart.canvas.dataset, { springs: listed.length, blamed: blamed.length, arrows: shown.length,
    view: looking.view });
}

function look(what, key) {
  looking[what] = key;
  if (looking.view !== null) drawPicture();
}

function startPicture() {
  if (moving && movers.length < particles.length)
    choice("zoom", [["all", ["whole scene"]], ["mode", ["where it moves"]]], "all", (key) => look("zoom", key));
  choice("view", VIEW_CHOICES, firstView(), (key) => look("view", key));
}

/* ---- regions of stability ---- */

const pairs = (flat) => Array.from({ length: flat.length / 2 }, (_, k) => ({ x: flat[2 * k], y: flat[2 * k + 1] }));
const fromOrigin = (points) => [{ x: 0, y: 0 }, ...points, { x: 0, y: 0 }];

function region(label, points, colour = colourOf(label)) {
  return plain(label, points, colour, { role: "region", backgroundColor: `${colour}1a`, fill: "shape", order: 3 });
}

/* ---- the table ---- */

const MOST_BLAMED = 12;
const percent = (share) =>
  (share < 5e-5 ? "under 0.01 %" : `${(100 * share).toFixed(share < 0.0995 ? 2 : 1)} %`);
const groupOf = (blame) => (blame.group ? `group ${blame.group}` : "no group");

const describeBlame = (one) =>
  [`spring ${one.number}, between particles ${one.first} and ${one.second}`, `${groupOf(one)}, ${percent(one.share)}`];

function writeBlame() {
  writeTable("blame", blames.slice(0, MOST_BLAMED), [
    ["to blame", "", (one) => swatched(`spring ${one.number}`, shareColour(one.share)), "word"],
    ["between particles", "", (one) => `${one.first} and ${one.second}`], ["group", "", (one) => one.group, "word"],
    ["share of the mode", "", (one) => exact(one.share, percent(one.share))]]);
  if (blames.length <= MOST_BLAMED) return;
  const line = element("tr");
  line.append(element("td", "and others with less", { className: "word note", colSpan: 4 }));
  document.querySelector("#blame tbody").append(line);
}

/* What of the scene is drawn, as facts. */
function writePicture() {
  if (picture.particles) facts("about", { particles: picture.particles, springs: picture.springs, "springs drawn": listed.length,
    "springs left out": picture.springs - listed.length, "particles drawn that move": movers.length });
  const shares = new Map();
  for (const one of blames) shares.set(groupOf(one), (shares.get(groupOf(one)) || 0) + one.share);
  for (const [group, share] of shares) if (share > 0.001) fact("about", `mode in ${group}`, percent(share));
}
