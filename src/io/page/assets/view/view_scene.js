"use strict";
/* The picture: a trajectory, others over it, and a camera that turns. */

/* What is seen of a run: of one that blew up, the frames that are not much wider than the first. */
const homeOf = (data) => around(boxAround(keptFrames(data).map((k) => boxWithBalls(data, data.box[k], k))));

function around(home) {
  return { home, centre: [0, 1, 2].map((axis) => home[axis] / 2 + home[axis + 3] / 2),
    radius: Math.max(...[0, 1, 2].map((axis) => home[axis + 3] / 2 - home[axis] / 2)) || 1 };
}

class Picture extends Run {
  constructor(canvas, run) {
    const { home, centre, radius } = homeOf(run.data);
    super(run, { home, centre, radius });
    Object.assign(this, { canvas, others: [], aparts: [] });
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: run.ends.length / 2 <= THICK_BELOW });
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(32, 1, 0.01, 1000);
    this.scene.add(...this.objects);
    this.setUp();
  }

  /* Lays it out for another box. */
  setHome(home) {
    const before_ = this.radius;
    Object.assign(this, around(home));
    if (this.tubes) this.tubes.material.uniforms.thickness.value *= before_ / this.radius;
  }

  get runs() {
    return [this, ...this.others];
  }

  /* Draws these runs over its own; without any, its own alone. */
  drawOver(runs) {
    for (const run of this.others) release(this.scene, run.objects);
    this.others = runs.map((run) => new Run(run, this));
    for (const run of this.others) this.scene.add(...run.objects);
    this.home = boxAround([this.data, ...runs.map(({ data }) => data)].map((data) => homeOf(data).home));
    this.sized = "";
  }

  setApart(aparts) {
    for (const { lines } of this.aparts) release(this.scene, [lines]);
    this.aparts = aparts;
    for (const { lines } of aparts) this.scene.add(lines);
  }

  setUp() {
    const frames = this.someFrames, { gravity } = this.data, pull = Math.max(...gravity.map(Math.abs));
    const up = pull > 0 ? gravity.findIndex((value) => Math.abs(value) === pull) : 1;
    this.up = up;
    this.camera.up.set(0, 0, 0).setComponent(up, gravity[up] > 0 ? -1 : 1);
    this.controls = new THREE.OrbitControls(this.camera, this.canvas);
    this.controls.enableKeys = false; // arrows step frames
    this.look(this.sample(frames), this.directionOf(this.home, frames));
  }

  /* What is flat is looked at from its front, all else from a corner and above. */
  directionOf(box, frames) {
    const extent = [0, 1, 2].map((axis) => box[axis + 3] - box[axis]);
    const [side, front] = [[1, 2], [0, 2], [0, 1]][this.up];
    const towards = new THREE.Vector3();
    const thin = [front, side].find((axis) => extent[axis] <= 0.02 * this.radius);
    if (thin !== undefined) return towards.setComponent(thin, thin === front || this.up !== 1 ? 1 : -1);
    const corners = [[1, 0.62], [1, -0.62], [0.62, 1], [0.62, -1]].flatMap(([a, b]) => [0.25, 0.45, 0.7].map((high) =>
      new THREE.Vector3().setComponent(front, a).setComponent(side, b)
        .setComponent(this.up, high * this.camera.up.getComponent(this.up)).normalize()));
    const points = this.sample(frames), spread = corners.map((corner) => this.spreadOf(points, corner));
    return corners[spread.reduce((best, value, k) => (value > 1.05 * spread[best] ? k : best), 1)];
  }

  /* How much of the picture plane these points take along a direction: the root of the determinant of their covariance. */
  spreadOf(points, towards) {
    const right = new THREE.Vector3().crossVectors(this.camera.up, towards).normalize();
    const above = new THREE.Vector3().crossVectors(towards, right), sums = [0, 0, 0, 0, 0];
    for (const point of points) {
      const x = point.dot(right), y = point.dot(above);
      [x, y, x * x, x * y, y * y].forEach((value, k) => { sums[k] += value / points.length; });
    }
    const [x, y, xx, xy, yy] = sums;
    return Math.sqrt(Math.max(0, (xx - x * x) * (yy - y * y) - (xy - x * y) ** 2));
  }

  /* The frame of these in which the most is seen from where the camera is. */
  fullest(frames) {
    const { towards } = this, spread = frames.map((frame) => this.spreadOf(this.sample([frame]), towards));
    return frames[spread.reduce((best, value, k) => (value > 1.1 * spread[best] ? k : best), 0)];
  }

  sample(frames, unit = this) {
    return [...super.sample(frames, unit), ...this.others.flatMap((run) => run.sample(frames.map((frame) => this.frameOf(run, frame)), unit))];
  }

  /* The frame of another run at the time of this one's. */
  frameOf(run, frame) {
    return frameNear(run.data.time, this.data.time[frame]);
  }

  /* Looks along `towards` at these points, from the smallest distance that shows all. */
  look(points, towards) {
    this.resize();
    const target = new THREE.Box3().setFromPoints(points).getCenter(new THREE.Vector3());
    const right = new THREE.Vector3().crossVectors(this.camera.up, towards).normalize();
    const above = new THREE.Vector3().crossVectors(towards, right);
    const tall = 0.86 * Math.tan((this.camera.fov * Math.PI) / 360), wide = tall * this.camera.aspect;
    let distance = 8;
    for (let round = 0; round < 4; round++) {
      const seen = points.map((point) => point.clone().sub(target)).map((at) => [at.dot(right), at.dot(above), at.dot(towards)]);
      distance = Math.max(0.1, ...seen.map(([x, y, z]) => z + Math.max(Math.abs(x) / wide, Math.abs(y) / tall)));
      for (const [axis, way] of [right, above].entries()) {
        const shares = seen.map((at) => at[axis] / Math.max(distance - at[2], 1e-3 * distance));
        target.addScaledVector(way, (distance * (Math.min(...shares) + Math.max(...shares))) / 2);
      }
    }
    this.distance = distance;
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(towards, distance);
    this.camera.far = 100 * Math.max(distance, 1);
    this.camera.near = this.camera.far / 1e5;
    this.camera.updateProjectionMatrix();
    this.controls.update();
  }

  /* Where it is seen from. */
  angle() {
    const { camera: { position, near, far }, controls: { target } } = this;
    return { position: position.toArray(), target: target.toArray(), near, far };
  }

  setAngle({ position, target, near, far }) {
    this.camera.position.fromArray(position);
    this.controls.target.fromArray(target);
    Object.assign(this.camera, { near, far }).updateProjectionMatrix();
    this.controls.update();
  }

  get towards() {
    return this.camera.position.clone().sub(this.controls.target).normalize();
  }

  fit(frame) {
    this.look(this.sample([frame], this.unit), this.towards);
  }

  /* To all that the runs are laid out for. */
  fitAll() {
    this.look(this.runs.flatMap((run) => Run.prototype.sample.call(run, run.someFrames)), this.towards);
  }

  resize() {
    const { clientWidth: wide, clientHeight: tall } = this.canvas, ratio = Math.min(devicePixelRatio || 1, 2);
    const size = `${Math.floor(wide * ratio)} x ${Math.floor(tall * ratio)}`;
    if (!wide || !tall || size === this.sized) return;
    this.sized = size;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(wide, tall, false);
    this.camera.aspect = wide / tall;
    this.camera.updateProjectionMatrix();
    for (const run of this.runs) run.setSize(wide, tall, ratio);
  }

  paint() {
    const palette = super.paint();
    for (const run of this.others) run.paint();
    this.renderer.setClearColor(this.uniforms.paper.value);
    return palette;
  }

  setLook(look, tinted) {
    super.setLook(look, tinted);
    for (const run of this.others) run.setLook(look, tinted);
  }

  thin(stride) {
    for (const run of this.runs) run.stride = stride;
  }

  /* Where a box is drawn. One much wider than what was seen, as after a blow-up, is made smaller, until all of it is seen. */
  unitOf(box) {
    const width = widthOf(box) / widthOf(this.home), half = [0, 1, 2].map((axis) => box[axis + 3] / 2 - box[axis] / 2);
    at("zoomed").textContent = width > 1.6 ? `${number(width, 2)} times as wide as before; the picture zooms out` : "";
    if (!(width > 1.6)) return this;
    const tall = (this.camera.fov * Math.PI) / 360, wide = Math.atan(this.camera.aspect * Math.tan(tall));
    return { centre: half.map((side, axis) => box[axis] + side), target: this.controls.target.toArray(),
      radius: Math.hypot(...half) / (this.distance * Math.sin(Math.min(tall, wide))) };
  }

  show(frame) {
    const { runs } = this, frames = runs.map((run) => (run === this ? frame : this.frameOf(run, frame)));
    const unit = this.unitOf(boxAround(runs.map(({ data }, k) => data.box[frames[k]])));
    runs.forEach((run, k) => Run.prototype.show.call(run, frames[k], unit));
    const items = this.aparts.map((one) => itemOf(one.show(this.data.time[frame], unit), one.other.own));
    at("apart")?.replaceChildren(...items); // pages of one run have no such list
  }

  draw() {
    this.resize();
    const distance = this.camera.position.distanceTo(this.controls.target);
    const deep = widthOf(this.home) / this.radius;
    for (const run of this.runs) run.uniforms.reach.value.set(distance - 0.25 * deep, distance + 1.6 * deep);
    this.renderer.render(this.scene, this.camera);
  }
}
