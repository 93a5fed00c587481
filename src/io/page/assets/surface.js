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
