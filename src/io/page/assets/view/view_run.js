"use strict";
/* A trajectory as drawn: springs as lines coloured by strain, ropes as tubes, surfaces, marked particles as points. Lengths
 * here are in units of `radius` from `centre`, so that single precision suffices. */

const MARK = { free: 0, pinned: 1, driven: 2, loose: 3 };
const THICK_BELOW = 40000; // springs; with more, lines are a pixel wide
const DOTS_BELOW = 60; // free particles that get a dot each
const NO_STRAIN = 255;
// Compressed, slack, stretched: blue to orange, told apart by eyes of every kind, dark on paper and bright in the dark.
const PALETTE = {
  light: ["#063b75", "#2f86c9", "#a7adb3", "#e2711d", "#7f2704"],
  dark: ["#b5dcff", "#3f93dd", "#67717b", "#ef8a2c", "#ffe0ad"],
};

const SHADE = `
  uniform vec3 palette[5]; uniform vec3 paper; uniform vec3 plain; uniform vec3 rope; uniform vec2 reach;
  vec3 colourOf(float strain) {
    if (strain > 0.998) return plain;
    float x = min(strain * 255.0 / 254.0, 1.0) * 4.0;
    vec3 c = mix(palette[0], palette[1], clamp(x, 0.0, 1.0));
    c = mix(c, palette[2], clamp(x - 1.0, 0.0, 1.0));
    c = mix(c, palette[3], clamp(x - 2.0, 0.0, 1.0));
    return mix(c, palette[4], clamp(x - 3.0, 0.0, 1.0));
  }
  vec3 faded(vec3 c, float depth) { return mix(c, paper, 0.5 * clamp((depth - reach.x) / (reach.y - reach.x), 0.0, 1.0)); }`;

const LINE_VERTEX = `${SHADE}
  attribute vec3 other; attribute float side; attribute float strain;
  uniform vec2 size; uniform float width; uniform float thickness; uniform float tintedLines; varying vec3 tint; varying float across_;
  void main() {
    vec4 here = modelViewMatrix * vec4(position, 1.0);
    vec4 a = projectionMatrix * here, b = projectionMatrix * modelViewMatrix * vec4(other, 1.0);
    vec2 along = (b.xy / b.w - a.xy / a.w) * size;
    float reachOf = length(along);
    vec2 across = reachOf > 0.0 ? vec2(-along.y, along.x) / reachOf : vec2(0.0);
    float wide = max(width, thickness * projectionMatrix[1][1] * size.y / a.w);
    a.xy += across * side * wide * a.w / size;
    if (thickness > 0.0 && reachOf > 0.0) a.xy -= 0.25 * along / reachOf * wide * a.w / size;
    gl_Position = a;
    across_ = side;
    tint = faded(tintedLines > 0.5 ? colourOf(strain) : rope, -here.z);
  }`;
const THIN_VERTEX = `${SHADE}
  attribute float strain; uniform float tintedLines; varying vec3 tint;
  void main() {
    vec4 here = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * here;
    tint = faded(tintedLines > 0.5 ? colourOf(strain) : rope, -here.z);
  }`;
const FLAT = "varying vec3 tint; void main() { gl_FragColor = vec4(tint, 1.0); }";
/* A tube: as bright as its round side is turned to the eye. */
const ROUND = `varying vec3 tint; varying float across_;
  void main() { gl_FragColor = vec4(tint * (0.55 + 0.5 * sqrt(max(0.0, 1.0 - across_ * across_))), 1.0); }`;

const POINT_VERTEX = `
  attribute float mark; uniform float scale; varying float kind;
  void main() {
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    gl_Position.z -= 0.002 * gl_Position.w;
    kind = mark * 255.0;
    gl_PointSize = scale * (kind < 0.5 ? 0.7 : 1.0);
  }`;
const POINT_FRAGMENT = `
  uniform vec3 ink; uniform vec3 paper; uniform vec3 driven; uniform float scale; varying float kind;
  void main() {
    vec2 at = 2.0 * gl_PointCoord - 1.0;
    bool pinned = kind > 0.5 && kind < 1.5, moved = kind > 1.5 && kind < 2.5;
    float far = pinned ? max(abs(at.x), abs(at.y)) : moved ? abs(at.x) + abs(at.y) : length(at);
    if (far > 1.0) discard;
    bool rim = scale > 8.0 && far > 1.0 - 3.2 / scale;
    gl_FragColor = vec4(moved ? (rim ? ink : driven) : pinned && rim ? paper : ink, 1.0);
  }`;

const colour = (text) => new THREE.Color(text);
const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;

function bytesOf(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text), bytes = new Uint8Array(binary.length);
  for (let k = 0; k < binary.length; k++) bytes[k] = binary.charCodeAt(k);
  return bytes;
}

/* ---- drawn objects ---- */

const attribute = (kind, size, length, normalised = false) =>
  new THREE.BufferAttribute(new kind(length), size, normalised).setUsage(THREE.DynamicDrawUsage);
const numbersTo = (count) => Uint32Array.from({ length: count }, (_, k) => k);

/* Lines as pairs of vertices, or as four that the shader moves apart. */
function makeLines(count, uniforms, tubes = false) {
  const thick = tubes || count <= THICK_BELOW, each = thick ? 4 : 2;
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", attribute(Float32Array, 3, 3 * each * count));
  geometry.setAttribute("strain", attribute(Uint8Array, 1, each * count, true));
  if (thick) {
    const side = new Float32Array(4 * count), index = new Uint32Array(6 * count);
    for (let k = 0; k < count; k++) {
      side.set([1, -1, -1, 1], 4 * k);
      index.set([0, 1, 2, 2, 1, 3].map((corner) => 4 * k + corner), 6 * k);
    }
    geometry.setAttribute("other", attribute(Float32Array, 3, 12 * count));
    geometry.setAttribute("side", new THREE.BufferAttribute(side, 1));
    geometry.setIndex(new THREE.BufferAttribute(index, 1));
  }
  const material = new THREE.ShaderMaterial({ uniforms, vertexShader: thick ? LINE_VERTEX : THIN_VERTEX, fragmentShader: tubes ? ROUND : FLAT,
    side: THREE.DoubleSide });
  const lines = thick ? new THREE.Mesh(geometry, material) : new THREE.LineSegments(geometry, material);
  lines.frustumCulled = false;
  return lines;
}

/* Every `stride`-th line of those in `order`; `tintOf` a line and its end. */
function fillLines({ geometry }, place, ends, order, stride, tintOf) {
  const { position, other, strain } = geometry.attributes, half = other ? 2 : 1; // vertices at an end
  let at = 0;
  for (let n = 0; n < order.length; n += stride) {
    for (let end = 2 * order[n]; end < 2 * order[n] + 2; end++) {
      const a = 3 * ends[end], b = 3 * ends[end ^ 1], tint = tintOf(order[n], ends[end]);
      for (const last = at + half; at < last; at++) {
        for (let axis = 0; axis < 3; axis++) {
          position.array[3 * at + axis] = place[a + axis];
          if (other) other.array[3 * at + axis] = place[b + axis];
        }
        strain.array[at] = tint;
      }
    }
  }
  geometry.setDrawRange(0, other ? 1.5 * at : at);
  for (const filled of [position, other, strain]) if (filled) filled.needsUpdate = true;
}

function makePoints(marks, uniforms, inBody) {
  const free = marks.reduce((sum, mark) => sum + (mark === MARK.free), 0);
  const held = (k) => marks[k] === MARK.pinned || marks[k] === MARK.driven;
  const list = [...marks.keys()].filter((k) => held(k) || (!inBody[k] && (marks[k] !== MARK.free || free <= DOTS_BELOW)));
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", attribute(Float32Array, 3, 3 * list.length));
  geometry.setAttribute("mark", new THREE.BufferAttribute(Uint8Array.from(list, (k) => marks[k]), 1, true));
  const points = new THREE.Points(geometry, new THREE.ShaderMaterial({ uniforms, vertexShader: POINT_VERTEX,
    fragmentShader: POINT_FRAGMENT }));
  points.frustumCulled = false;
  return { points, list };
}

/* ---- the camera's bounding box ---- */

const widthOf = (box) => Math.max(box[3] - box[0], box[4] - box[1], box[5] - box[2]);

/* Numbers of the frames; for a run that blew up, of those before that which are not much wider than the first. */
function keptFrames({ box, status, frame = [], good_frames: good }) {
  const extents = box.map(widthOf);
  const most = ["finished", "stopped", "running"].includes(status) || extents[0] === 0 ? Infinity : 8 * extents[0];
  return [...box.keys()].filter((k) => k === 0 || (extents[k] <= most && !(frame[k] >= good)));
}

function boxAround(kept) {
  const low = [0, 1, 2].map((axis) => Math.min(...kept.map((box) => box[axis])));
  const high = [0, 1, 2].map((axis) => Math.max(...kept.map((box) => box[axis + 3])));
  return [...low, ...high];
}

/* The frame whose time is nearest. */
function frameNear(times, time) {
  let low = 0, high = times.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle;
  }
  return Math.abs(times[high] - time) < Math.abs(times[low] - time) ? high : low;
}

/* Takes objects out of a scene for good. */
function release(scene, objects) {
  scene.remove(...objects);
  for (const { geometry, material } of objects) {
    geometry.dispose();
    material.dispose();
  }
}

/* What is drawn of one trajectory. */
class Run {
  constructor({ data, ends, marks, bytesOfFrame }, { home, centre, radius }) {
    Object.assign(this, { data, ends, marks, bytesOfFrame, home, centre, radius });
    this.uniforms = Object.fromEntries(Object.entries({ palette: [], paper: null, plain: null, ink: null, driven: null, cloth: null, stone: null, rope: null,
      reach: new THREE.Vector2(), size: new THREE.Vector2(), width: 1, scale: 9, thickness: 0, tinted: 0, tintedLines: 1, night: 0, opacity: 1 })
      .map(([name, value]) => [name, { value }]));
    const bodies = findBodies(data, marks.length);
    Object.assign(this, bodies, { lines: makeLines(ends.length / 2, this.uniforms) }, makePoints(marks, this.uniforms, bodies.inBody));
    this.obstacles = (data.obstacles || []).map((obstacle) => makeObstacle(obstacle, this.uniforms, SHADE));
    this.objects = [this.lines, this.points, ...this.obstacles];
    this.place = new Float32Array(3 * marks.length);
    this.makeBodies();
    this.stride = 1; // every k-th spring is drawn
    this.own = null; // the colour of this run, where several are drawn
  }

  /* Surfaces and tubes, and the springs that are drawn beside them. */
  makeBodies() {
    const { data, ends, marks, triangles, segments, inBody } = this;
    this.hasBodies = triangles.length + segments.length > 0;
    this.all = numbersTo(ends.length / 2);
    this.outside = this.all.filter((k) => !(inBody[ends[2 * k]] && inBody[ends[2 * k + 1]]));
    this.order = this.all;
    if (triangles.length) {
      this.surface = makeSurface(triangles, marks.length, this.uniforms, SHADE);
      this.objects.push(this.surface);
    }
    if (segments.length) {
      this.placeAll(this.bytesOfFrame(0), data.box[0]);
      const length = (k) => Math.hypot(...[0, 1, 2].map((axis) => this.place[3 * segments[k] + axis] - this.place[3 * segments[k + 1] + axis]));
      let sum = 0;
      for (let k = 0; k < segments.length; k += 2) sum += length(k);
      const thickness = { value: Math.min(0.02, (0.22 * sum) / (segments.length / 2)) };
      this.tubes = makeLines(segments.length / 2, { ...this.uniforms, thickness }, true);
      this.objects.push(this.tubes);
    }
    this.degree = new Float32Array(marks.length);
    for (const k of ends) this.degree[k]++;
  }

  /* "surface", "springs" or "both"; `tinted`: strain as colour. */
  setLook(look, tinted) {
    const bodies = this.hasBodies && look !== "springs";
    if (this.surface) this.surface.visible = bodies;
    if (this.tubes) this.tubes.visible = bodies;
    this.order = bodies && look === "surface" ? this.outside : this.all;
    this.uniforms.tinted.value = this.uniforms.tintedLines.value = tinted ? 1 : 0;
  }

  /* Its colour among other runs, through which they are seen. */
  setOwn(own) {
    this.own = own;
    this.uniforms.opacity.value = own ? 0.55 : 1;
    if (this.surface) Object.assign(this.surface.material, { transparent: Boolean(own), depthWrite: !own });
  }

  setSize(wide, tall, ratio) {
    const count = this.ends.length / 2;
    this.uniforms.size.value.set(wide * ratio, tall * ratio);
    this.uniforms.width.value = ratio * (count <= 300 ? 3.4 : count <= 3000 ? 2.2 : count <= 10000 ? 1.5 : 1.1);
    this.uniforms.scale.value = ratio * (this.list.length <= 100 ? 11 : 6);
  }

  paint() {
    const { uniforms } = this, palette = PALETTE[isDark() ? "dark" : "light"];
    uniforms.palette.value = palette.map(colour);
    uniforms.night.value = isDark() ? 1 : 0;
    for (const [name, stop] of [["paper", styleOf("--paper")], ["cloth", this.own || (isDark() ? "#8fb0cc" : "#a9c1d6")],
      ["stone", isDark() ? "#565b60" : "#d6d5d1"], ["rope", this.own || (isDark() ? "#a89878" : "#8a7a5c")], ["ink", styleOf("--ink")], ["plain", styleOf("--edge")],
      ["driven", isDark() ? "#ff8fd0" : "#d6409f"]]) uniforms[name].value = colour(stop);
    return palette;
  }

  /* ---- frames ---- */

  /* Some of the frames that are laid out for. */
  get someFrames() {
    const kept = keptFrames(this.data), stride = Math.ceil(kept.length / 16);
    return kept.filter((_, place) => place % stride === 0 || place === kept.length - 1);
  }

  /* Some of the particles in these frames, and what is outermost of spheres. */
  sample(frames, unit = this) {
    const stride = Math.max(1, Math.floor((this.marks.length * frames.length) / 6000)), points = [];
    for (const frame of frames) {
      this.placeAll(this.bytesOfFrame(frame), this.data.box[frame], unit);
      for (let k = 0; k < this.marks.length; k += stride) points.push(new THREE.Vector3().fromArray(this.place, 3 * k));
      for (const ball of ballsOf(this.data, widthOf(this.home))) points.push(...outermostOf(ball, frame, unit));
    }
    return points;
  }

  placeAll(bytes, box, { centre, radius, target = [0, 0, 0] } = this) {
    const { place } = this, count = place.length;
    const words = new Uint16Array(bytes.buffer, 0, count);
    const scale = [0, 1, 2].map((axis) => Math.min((box[axis + 3] / radius - box[axis] / radius) / 65535, 1e30));
    const from = [0, 1, 2].map((axis) => target[axis] + Math.max(-1e30, Math.min(1e30, (box[axis] - centre[axis]) / radius)));
    for (let k = 0; k < count; k += 3) {
      place[k] = from[0] + scale[0] * words[k];
      place[k + 1] = from[1] + scale[1] * words[k + 1];
      place[k + 2] = from[2] + scale[2] * words[k + 2];
    }
  }

  show(frame, unit) {
    const bytes = this.bytesOfFrame(frame), { place } = this;
    this.unit = unit;
    this.placeAll(bytes, this.data.box[frame], unit);
    this.obstacles.forEach((mesh, k) => placeObstacle(mesh, this.data.obstacles[k], frame, this, unit));
    const strain = bytes.subarray(2 * place.length);
    fillLines(this.lines, place, this.ends, this.order, this.stride, (k) => strain[k]);
    const points = this.points.geometry.attributes.position;
    if (this.surface && this.surface.visible) this.fillSurface(strain);
    if (this.tubes && this.tubes.visible) this.fillTubes(strain);
    this.list.forEach((k, to) => points.array.set(place.subarray(3 * k, 3 * k + 3), 3 * to));
    points.needsUpdate = true;
  }

  /* The mean strain of the springs at each particle, in bytes as they are stored. */
  meanStrains(values) {
    const { ends, degree } = this, sums = new Float32Array(degree.length);
    for (let k = 0; k < values.length; k++) {
      const value = values[k] === NO_STRAIN ? 127 : values[k];
      sums[ends[2 * k]] += value;
      sums[ends[2 * k + 1]] += value;
    }
    return sums.map((sum, k) => (degree[k] ? sum / degree[k] : 127));
  }

  fillSurface(values) {
    const { position, strain } = this.surface.geometry.attributes;
    position.array.set(this.place);
    position.needsUpdate = true;
    this.surface.geometry.computeVertexNormals();
    if (this.uniforms.tinted.value === 0) return;
    strain.array.set(this.meanStrains(values).map((value) => value / 255));
    strain.needsUpdate = true;
  }

  fillTubes(values) {
    const mean = this.meanStrains(values);
    fillLines(this.tubes, this.place, this.segments, numbersTo(this.segments.length / 2), 1, (_, end) => mean[end]);
  }
}
