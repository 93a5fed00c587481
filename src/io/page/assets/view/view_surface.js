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
