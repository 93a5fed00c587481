"use strict";
/* Bodies of a scene as surfaces and as lines of particles: which particles are corners of which triangles. Numbers are places
 * among the particles that are shown; a body of which one is left out is drawn as springs. */

/* Two triangles for each cell of a grid of `wide` columns; `at` gives the particle of (column, row). */
function gridTriangles(wide, tall, at) {
  const list = [];
  for (let r = 0; r + 1 < tall; r++) {
    for (let c = 0; c + 1 < wide; c++) {
      list.push(at(c, r), at(c + 1, r), at(c + 1, r + 1), at(c, r), at(c + 1, r + 1), at(c, r + 1));
    }
  }
  return list;
}

/* The six sides of a lattice. */
function latticeTriangles([nx, ny, nz], first) {
  const at = (i, j, k) => first + (k * ny + j) * nx + i;
  const turned = (list) => list.map((_, n) => list[n - (n % 3) + 2 - (n % 3)]); // so that all look outwards
  return [turned(gridTriangles(nx, ny, (i, j) => at(i, j, 0))), gridTriangles(nx, ny, (i, j) => at(i, j, nz - 1)),
    gridTriangles(nx, nz, (i, k) => at(i, 0, k)), turned(gridTriangles(nx, nz, (i, k) => at(i, ny - 1, k))),
    turned(gridTriangles(ny, nz, (j, k) => at(0, j, k))), gridTriangles(ny, nz, (j, k) => at(nx - 1, j, k))].flat();
}

function trianglesOf({ kind, first, size, triangle }) {
  if (kind === "cloth") return gridTriangles(size[0], size[1], (c, r) => first + r * size[0] + c);
  if (kind === "lattice") return latticeTriangles(size, first);
  return kind === "mesh" ? triangle.map((corner) => first + corner) : [];
}

/* A rope is a line of particles; a strand is one, too, whatever stiffens it. */
const isLine = (kind) => kind === "rope" || kind === "strand";

function findBodies(data, count) {
  const placeOf = new Map((data.particle || []).map((number, place) => [number, place]));
  const place = (number) => (data.particle ? placeOf.get(number) : number);
  const triangles = [], segments = [], inBody = new Uint8Array(count);
  for (const body of data.bodies || []) {
    const corners = trianglesOf(body).map(place);
    const line = isLine(body.kind) ? Array.from({ length: 2 * (body.count - 1) }, (_, k) => place(body.first + Math.ceil(k / 2))) : [];
    if ([...corners, ...line].some((k) => k === undefined) || corners.length + line.length === 0) continue;
    for (const k of corners) triangles.push(k);
    for (const k of line) segments.push(k);
    for (let k = 0; k < body.count; k++) {
      const there = place(body.first + k);
      if (there !== undefined) inBody[there] = 1;
    }
  }
  return { triangles: Uint32Array.from(triangles), segments: Uint32Array.from(segments), inBody };
}

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

/* Normals of particles: the sum of those of their triangles, each as long as twice its area. */
function fillNormals(normal, place, triangles) {
  normal.fill(0);
  for (let k = 0; k < triangles.length; k += 3) {
    const a = 3 * triangles[k], b = 3 * triangles[k + 1], c = 3 * triangles[k + 2];
    const ux = place[b] - place[a], uy = place[b + 1] - place[a + 1], uz = place[b + 2] - place[a + 2];
    const vx = place[c] - place[a], vy = place[c + 1] - place[a + 1], vz = place[c + 2] - place[a + 2];
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    for (const corner of [a, b, c]) {
      normal[corner] += x;
      normal[corner + 1] += y;
      normal[corner + 2] += z;
    }
  }
}
