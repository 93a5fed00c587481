"use strict";
/* Surfaces as three.js draws them. */

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
