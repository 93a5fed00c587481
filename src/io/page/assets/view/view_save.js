"use strict";
/* What a reader may keep: the picture, a video of the frames, the frame as a model (glTF 2.0). */

function download(blob, ending) {
  const link = document.createElement("a"), name = data.file.replace(/\.[^.]*$/, "");
  link.href = URL.createObjectURL(blob);
  link.download = `${name}${ending}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function savePicture() {
  picture.draw(); // the drawing is gone once it was shown
  at("picture").toBlob((blob) => download(blob, `-${data.frame[shown]}.png`));
}

/* All frames once, at the speed that is chosen, by the browser's own recorder. */
function saveVideo() {
  if (!at("picture").captureStream || !window.MediaRecorder) {
    say("This browser records no video.");
    return;
  }
  const recorder = new MediaRecorder(at("picture").captureStream(30), { videoBitsPerSecond: 8e6 }), pieces = [];
  recorder.ondataavailable = (event) => pieces.push(event.data);
  recorder.onstop = () => {
    say("");
    download(new Blob(pieces, { type: recorder.mimeType }), ".webm");
  };
  pause();
  show(0, true);
  recorder.start();
  say("The video is being recorded; it ends with the last frame.");
  play();
  const watch = () => {
    if (playing && !ended) requestAnimationFrame(watch);
    else setTimeout(() => { recorder.stop(); pause(); }, 200);
  };
  ended = false;
  requestAnimationFrame(watch);
}

/* ---- glTF 2.0 ---- */

/* Parts of one buffer, each an accessor. */
class Buffer {
  constructor() {
    Object.assign(this, { bytes: 0, pieces: [], views: [], accessors: [] });
  }

  add(array, type, size, target, limits = false) {
    const kinds = { Float32Array: 5126, Uint32Array: 5125 }, count = array.length / size, range = {};
    if (limits) {
      const axis = (k) => Array.from({ length: count }, (_, n) => array[size * n + k]);
      const of = (pick) => Array.from({ length: size }, (_, k) => axis(k).reduce((a, b) => pick(a, b)));
      Object.assign(range, { min: of(Math.min), max: of(Math.max) });
    }
    this.views.push({ buffer: 0, byteOffset: this.bytes, byteLength: array.byteLength, target });
    this.accessors.push({ bufferView: this.views.length - 1, componentType: kinds[array.constructor.name], count, type, ...range });
    this.pieces.push(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    this.bytes += array.byteLength;
    return this.accessors.length - 1;
  }

  uri() {
    let text = "";
    for (const piece of this.pieces) {
      for (let k = 0; k < piece.length; k += 0x8000) text += String.fromCharCode(...piece.subarray(k, k + 0x8000));
    }
    return `data:application/octet-stream;base64,${btoa(text)}`;
  }
}

const PLAIN = 34962, INDEX = 34963; // targets of buffer views

function colourBytes(values) {
  const stops = PALETTE.light.map((text) => new THREE.Color(text).toArray()), tints = new Float32Array(3 * values.length);
  values.forEach((value, k) => {
    const x = Math.min(value / 254, 1) * 4, low = Math.min(3, Math.floor(x));
    for (let i = 0; i < 3; i++) tints[3 * k + i] = (stops[low][i] + (x - low) * (stops[low + 1][i] - stops[low][i])) ** 2.2;
  });
  return tints;
}

/* The frame that is shown, in metres from the middle of the scene, which `extras` has: springs as lines, surfaces shaded, strain
 * as the colour of corners, obstacles as they are drawn. */
function modelOf() {
  const buffer = new Buffer(), { place, ends, unit: { radius, centre, target = [0, 0, 0] }, triangles } = picture, meshes = [];
  const position = place.map((value, k) => (value - target[k % 3]) * radius);
  const strains = picture.bytesOfFrame(shown).subarray(2 * place.length), strain = colourBytes(picture.meanStrains(strains));
  const corners = { POSITION: buffer.add(position, "VEC3", 3, PLAIN, true), COLOR_0: buffer.add(strain, "VEC3", 3, PLAIN) };
  if (ends.length) meshes.push({ name: "springs", primitives: [{ attributes: corners, mode: 1,
    indices: buffer.add(Uint32Array.from(ends), "SCALAR", 1, INDEX), material: 0 }] });
  else meshes.push({ name: "particles", primitives: [{ attributes: corners, mode: 0, material: 0 }] });
  if (triangles.length) {
    picture.fillSurface(strains);
    const normal = picture.surface.geometry.attributes.normal.array.slice();
    for (let k = 0; k < normal.length; k += 3) if (!normal[k] && !normal[k + 1] && !normal[k + 2]) normal[k + 2] = 1;
    meshes.push({ name: "surface", primitives: [{ attributes: { ...corners, NORMAL: buffer.add(normal, "VEC3", 3, PLAIN) },
      indices: buffer.add(triangles, "SCALAR", 1, INDEX), mode: 4, material: 1 }] });
  }
  for (const obstacle of picture.obstacles) {
    obstacle.updateMatrix();
    const solid = new THREE.BufferGeometry().fromGeometry(obstacle.geometry).applyMatrix(obstacle.matrix);
    solid.normalizeNormals();
    const { position, normal } = solid.attributes, corner = position.array.map((value, k) => (value - target[k % 3]) * radius);
    meshes.push({ name: "obstacle", primitives: [{ attributes: { POSITION: buffer.add(corner, "VEC3", 3, PLAIN, true),
      NORMAL: buffer.add(normal.array, "VEC3", 3, PLAIN) }, mode: 4, material: meshes.length }] });
  }
  const material = (name) => ({ name, doubleSided: true, pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0.8 } });
  return { asset: { version: "2.0", generator: `hooke ${data.versions.hooke}` }, scene: 0, scenes: [{ nodes: meshes.map((_, k) => k) }],
    nodes: meshes.map(({ name }, mesh) => ({ name, mesh })), meshes, materials: meshes.map(({ name }) => material(name)),
    accessors: buffer.accessors, bufferViews: buffer.views, buffers: [{ byteLength: buffer.bytes, uri: buffer.uri() }],
    extras: { file: data.file, frame: data.frame[shown], time: data.time[shown], origin: centre } };
}

const saveModel = () => download(new Blob([JSON.stringify(modelOf())], { type: "model/gltf+json" }), `-${data.frame[shown]}.gltf`);
const SAVES = { picture: savePicture, video: saveVideo, model: saveModel };
