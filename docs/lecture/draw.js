"use strict";
/* Draws a panel as SVG text. A panel has `x` and `y`, { from, to, name, log }, `equal` for one scale on both, and `marks`: each is one of
 * line, dots, arrow, segments and strips, with a colour. */

const COLOURS = { blue: "#3b82c4", orange: "#d9731a", green: "#2f9457", red: "#d13f3f", violet: "#8b62c9", grey: "#8a8f98" };
const SIZE = { width: 360, height: 270, left: 52, right: 12, top: 12, bottom: 40 };

const short = (value) => (Math.abs(value) >= 1e4 || (value && Math.abs(value) < 1e-3) ? value.toExponential(0).replace("e+", "e")
  : Number(value.toPrecision(3)).toString()).replace(/-/g, "\u2212");
const escaped = (text) => String(text).replace(/&/g, "&amp;").replace(/</g, "&lt;");

/* Round numbers on an axis. */
function ticks({ from, to, log }) {
  if (log) {
    const first = Math.ceil(Math.log10(from) - 1e-9), last = Math.floor(Math.log10(to) + 1e-9), each = Math.ceil((last - first) / 5) || 1;
    return Array.from({ length: Math.max(0, Math.floor((last - first) / each) + 1) }, (_, k) => 10 ** (first + k * each));
  }
  const rough = (to - from) / 5, power = 10 ** Math.floor(Math.log10(rough)), each = [1, 2, 5, 10].find((m) => m * power >= rough) * power;
  return Array.from({ length: 12 }, (_, k) => (Math.ceil(from / each) + k) * each).filter((value) => value <= to * (1 + 1e-9) + 1e-12);
}

/* From numbers to places, and back. */
function scaleOf({ from, to, log }, low, high) {
  const f = log ? Math.log10 : (value) => value, a = f(from), b = f(to);
  const scale = (value) => low + ((f(value) - a) / (b - a)) * (high - low);
  scale.back = (place) => {
    const value = a + ((place - low) / (high - low)) * (b - a);
    return log ? 10 ** value : value;
  };
  return scale;
}

/* The names of what is drawn stand above the frame. */
const topOf = ({ marks }) => SIZE.top + 14 * marks.filter(({ name }) => name).length;

function scales(panel) {
  const { width, height, left, right, bottom } = SIZE, top = topOf(panel), x = { ...panel.x }, y = { ...panel.y };
  if (panel.equal) { // the narrower range grows
    const unit = Math.max((x.to - x.from) / (width - left - right), (y.to - y.from) / (height - top - bottom));
    for (const [axis, room] of [[x, width - left - right], [y, height - top - bottom]]) {
      const more = (unit * room - (axis.to - axis.from)) / 2;
      Object.assign(axis, { from: axis.from - more, to: axis.to + more });
    }
  }
  return { x, y, top, sx: scaleOf(x, left, width - right), sy: scaleOf(y, height - bottom, top) };
}

const place = (value) => (Math.round(10 * Math.max(-2000, Math.min(2000, value))) / 10).toString();

function axes({ x, y, top, sx, sy }) {
  const { width, height, left, right, bottom } = SIZE, low = height - bottom;
  const line = (x1, y1, x2, y2) => `<line x1="${place(x1)}" y1="${place(y1)}" x2="${place(x2)}" y2="${place(y2)}" stroke="currentColor" stroke-opacity=".18"/>`;
  const text = (px, py, anchor, value, more = "") => `<text x="${place(px)}" y="${place(py)}" text-anchor="${anchor}"${more}>${escaped(value)}</text>`;
  const middle = (top + low) / 2;
  return [...ticks(x).map((v) => line(sx(v), top, sx(v), low) + text(sx(v), low + 14, "middle", short(v))),
    ...ticks(y).map((v) => line(left, sy(v), width - right, sy(v)) + text(left - 5, sy(v) + 4, "end", short(v))),
    text((left + width - right) / 2, height - 8, "middle", x.name || ""), text(13, middle, "middle", y.name || "", ` transform="rotate(-90 13 ${middle})"`)].join("");
}

const MARKS = {
  line({ line, colour, wide = 1.6, dashed }, { sx, sy }) {
    const there = line.filter(([x, y]) => Number.isFinite(sx(x)) && Number.isFinite(sy(y)));
    return there.length < 2 ? "" : `<polyline points="${there.map(([x, y]) => `${place(sx(x))},${place(sy(y))}`).join(" ")}" fill="none"
      stroke="${colour}" stroke-width="${wide}"${dashed ? ' stroke-dasharray="5 4"' : ""} stroke-linejoin="round"/>`;
  },
  dots({ dots, colour, wide = 3, edge }, { sx, sy }) {
    return dots.filter(([x, y]) => Number.isFinite(sx(x)) && Number.isFinite(sy(y))).map(([x, y]) => `<circle cx="${place(sx(x))}" cy="${place(sy(y))}" r="${wide}"
      fill="${colour}"${edge ? ' stroke="currentColor" stroke-width="1.5"' : ""}/>`).join("");
  },
  arrow({ arrow: [x0, y0, x1, y1], colour, wide = 1.4 }, { sx, sy }) {
    const [a, b, c, d] = [sx(x0), sy(y0), sx(x1), sy(y1)], long = Math.hypot(c - a, d - b);
    if (!(long > 0.5)) return "";
    const [u, v] = [(c - a) / long, (d - b) / long], head = Math.min(7, long / 2);
    const side = (s) => `${place(c - head * u + s * head * 0.45 * v)},${place(d - head * v - s * head * 0.45 * u)}`;
    return `<path d="M${place(a)},${place(b)}L${place(c)},${place(d)}M${side(1)}L${place(c)},${place(d)}L${side(-1)}" fill="none" stroke="${colour}"
      stroke-width="${wide}"/>`;
  },
  segments({ segments, colour, wide = 1.2 }, { sx, sy }) {
    const path = segments.map(([a, b, c, d]) => `M${place(sx(a))} ${place(sy(b))}L${place(sx(c))} ${place(sy(d))}`);
    return `<path d="${path.join("")}" fill="none" stroke="${colour}" stroke-width="${wide}"/>`;
  },
  strips({ strips, colour }, { sx, sy }) {
    const path = strips.map(([from, to, y, high]) => `M${place(sx(from))} ${place(sy(y + high / 2))}H${place(sx(to))}V${place(sy(y - high / 2))}H${place(sx(from))}z`);
    return `<path d="${path.join("")}" fill="${colour}" fill-opacity=".3"/>`;
  },
};

const legend = (marks) => marks.filter(({ name }) => name).map(({ name, colour, dots }, k) => `<line x1="${SIZE.left + 8}" x2="${SIZE.left + 26}"
  y1="${8 + 14 * k}" y2="${8 + 14 * k}" stroke="${colour}" stroke-width="${dots ? 5 : 2}"/><text x="${SIZE.left + 31}"
  y="${12 + 14 * k}">${escaped(name)}</text>`).join("");

function svgOf(panel, name, x = 0) {
  const scaled = scales(panel), { top } = scaled, { width, height, left, right, bottom } = SIZE, clip = `frame-${name}`;
  const marks = panel.marks.map((mark) => MARKS[Object.keys(MARKS).find((kind) => kind in mark)](mark, scaled)).join("");
  return `<svg xmlns="http://www.w3.org/2000/svg" x="${x}" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}"
    font-family="system-ui, sans-serif" font-size="11" fill="currentColor"><clipPath id="${clip}"><rect x="${left}" y="${top}"
    width="${width - left - right}" height="${height - top - bottom}"/></clipPath>${panel.bare ? "" : axes(scaled)}
    <g clip-path="url(#${clip})">${marks}</g>${legend(panel.marks)}</svg>`;
}

/* All panels side by side, as a file, whose colours follow the reader's system. */
function fileOf(panels) {
  const [width, height] = [panels.length * SIZE.width, SIZE.height];
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" width="${width}" height="${height}"><style>svg{color:#333}
@media(prefers-color-scheme:dark){svg{color:#ccc}}</style>${panels.map((panel, k) => svgOf(panel, k, k * SIZE.width)).join("\n")}</svg>\n`.replace(/\n\s+/g, "\n");
}
