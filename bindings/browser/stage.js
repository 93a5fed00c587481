"use strict";
/* The picture, drawn by the viewer. */

/* The viewer's data: the frames of the preview, by which the camera is set, and last the live one. */
function makePicture(opened) {
  const canvas = at("picture"), fresh = canvas.cloneNode();
  if (picture) picture.renderer.dispose();
  for (const side of ["width", "height"]) fresh.removeAttribute(side); // which the picture sets, and what depends on it
  canvas.replaceWith(fresh);
  const frames = [...opened.frames, opened.frames[0]];
  scene = { box: frames.map(({ box }) => box), status: "running", gravity: opened.gravity, bodies: opened.bodies,
    obstacles: opened.obstacles, live: frames.length - 1,
    bytes: frames.map(({ bytes }) => bytes) };
  picture = null;
  try {
    picture = new Picture(fresh, { data: scene, ends: opened.ends, marks: opened.marks, bytesOfFrame: (k) => scene.bytes[k] });
  } catch (trouble) {
    at("missing").hidden = false;
    return;
  }
  const palette = picture.paint();
  picture.controls.addEventListener("change", () => picture.draw());
  writeScale(palette, opened.strain);
  if (!opened.bodies.length) at("tint").checked = true;
  dress();
}

function dress() {
  at("scale").hidden = !at("tint").checked;
  if (picture) picture.setLook("surface", at("tint").checked);
  drawFrame();
}

/* Looks from further away, at all frames of the preview and this one, where it goes beyond what was seen. */
function widen(box) {
  const margin = 0.05 * widthOf(picture.home), beyond = [0, 1, 2].some((axis) =>
    box[axis] < picture.home[axis] - margin || box[axis + 3] > picture.home[axis + 3] + margin);
  if (!beyond) return;
  picture.home = boxAround([picture.home, box]);
  picture.look(picture.sample([...scene.box.keys()]), picture.towards);
}

function drawFrame(blown = false) {
  if (!picture) return;
  if (!blown) widen(scene.box[scene.live]);
  picture.show(scene.live);
  picture.draw();
}

function take(frame) {
  scene.box[scene.live] = frame.box;
  scene.bytes[scene.live] = frame.bytes;
  scene.obstacles.forEach(({ point }, k) => point.splice(3 * scene.live, 3, ...frame.obstacles[k].point));
  drawFrame(Boolean(frame.slow));
  if (!frame.slow) bounds = frame.bounds;
  markBound();
  at("now").textContent = `t = ${number(frame.time, 4)} s${frame.late ? ", slower than asked for" : ""}`;
  document.body.dataset.time = frame.time;
}
