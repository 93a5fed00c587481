"use strict";
/* Surfaces and obstacles as three.js draws them. */

const SURFACE_VERTEX = `
  attribute float strain; varying float tension; varying vec3 facing; varying vec3 towards;
  void main() {
    vec4 here = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * here;
    facing = normalMatrix * normal;
    towards = -here.xyz;
    tension = strain;
  }`;
/* Light from above and from the eye, the same on both sides. */
const surfaceFragment = (shade) => `${shade}
  uniform vec3 cloth; uniform float tinted; uniform float night; uniform float opacity; varying float tension; varying vec3 facing; varying vec3 towards;
  void main() {
    vec3 n = normalize(facing);
    bool back = !gl_FrontFacing;
    if (back) n = -n;
    vec3 eye = normalize(towards), lamp = normalize(vec3(-0.3, 0.6, 0.75));
    float high = 0.5 + 0.5 * n.y, side = 0.5 + 0.5 * dot(n, lamp);
    float gleam = pow(max(0.0, dot(n, normalize(eye + lamp))), 40.0);
    vec3 base = mix(cloth, colourOf(tension), tinted);
    if (back && tinted < 0.5 && opacity == 1.0) base = mix(base, vec3(0.86, 0.78, 0.66), 0.6);
    float light = mix(0.36, 0.28, night) + 0.14 * high + 0.22 * max(0.0, dot(n, eye)) + 0.36 * side * side;
    gl_FragColor = vec4(base * light + 0.08 * gleam, opacity);
  }`;

function makeSurface(triangles, count, uniforms, shade) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", attribute(Float32Array, 3, 3 * count));
  geometry.setAttribute("normal", attribute(Float32Array, 3, 3 * count));
  geometry.setAttribute("strain", attribute(Float32Array, 1, count));
  geometry.setIndex(new THREE.BufferAttribute(triangles, 1));
  const surface = new THREE.Mesh(geometry, new THREE.ShaderMaterial({ uniforms, vertexShader: SURFACE_VERTEX,
    fragmentShader: surfaceFragment(shade), side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 2 }));
  surface.frustumCulled = false;
  return surface;
}

/* ---- obstacles ---- */

/* A little smaller than they are, so that what lies on them is seen whole; a plane is a slab. In units of the picture. */
const INSET = 0.008, SLAB = 0.03;

function makeObstacle({ shape, direction }, uniforms, shade) {
  const solid = shape === "sphere" ? new THREE.SphereGeometry(1, 64, 48) : new THREE.CylinderGeometry(1, 1, 1, 96);
  const quiet = { ...uniforms, cloth: uniforms.stone, tinted: { value: 0 }, opacity: { value: 1 } };
  const mesh = new THREE.Mesh(solid, new THREE.ShaderMaterial({ uniforms: quiet, vertexShader: SURFACE_VERTEX, fragmentShader: surfaceFragment(shade) }));
  if (shape !== "sphere") mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...direction));
  mesh.frustumCulled = false;
  return mesh;
}

const pointOf = ({ point }, frame) => new THREE.Vector3().fromArray(point, point.length > 3 ? 3 * frame : 0);

/* Spheres as wide as what is seen, or not much wider. */
const ballsOf = ({ obstacles = [] }, width) => obstacles.filter(({ shape, radius }) => shape === "sphere" && radius < 4 * (width || Infinity));

/* The box around particles and spheres at a frame. */
function boxWithBalls(data, box, frame) {
  return ballsOf(data, widthOf(box)).reduce((all, ball) => {
    const at = pointOf(ball, frame).toArray();
    return boxAround([all, [...at.map((x) => x - ball.radius), ...at.map((x) => x + ball.radius)]]);
  }, box);
}

const inUnits = (point, { centre, radius, target = [0, 0, 0] }) =>
  point.sub(new THREE.Vector3(...centre)).divideScalar(radius).add(new THREE.Vector3(...target));

/* Points all around a sphere. */
function outermostOf(ball, frame, unit) {
  const sides = [-1, 0, 1], ways = sides.flatMap((x) => sides.flatMap((y) => sides.map((z) => new THREE.Vector3(x, y, z))));
  return ways.map((way) => inUnits(pointOf(ball, frame).addScaledVector(way.normalize(), ball.radius), unit));
}

/* Places a solid; a plane or a cylinder, which have no end, about the box that is seen. */
function placeObstacle(mesh, obstacle, frame, { home, centre, radius }, unit) {
  const { shape, direction } = obstacle, along = new THREE.Vector3(...direction), middle = new THREE.Vector3(...centre);
  const point = pointOf(obstacle, frame), away = point.clone().sub(middle).dot(along);
  if (shape === "plane") point.copy(middle).addScaledVector(along, away);
  if (shape === "cylinder") point.addScaledVector(along, -away);
  const sides = [0, 1, 2].map((axis) => home[axis + 3] - home[axis]), wide = obstacle.radius / unit.radius;
  const round = Math.max(wide - INSET, wide / 2), disc = (0.62 * Math.hypot(...sides)) / radius || 1;
  const long = Math.max(1.2 * sides.reduce((sum, side, axis) => sum + side * Math.abs(direction[axis]), 0) / radius, wide);
  mesh.position.copy(inUnits(point, unit));
  if (shape === "plane") mesh.position.addScaledVector(along, -SLAB / 2 - INSET);
  mesh.scale.set(...{ sphere: [round, round, round], plane: [disc, SLAB, disc], cylinder: [round, long, round] }[shape]);
}
