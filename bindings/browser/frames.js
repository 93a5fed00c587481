"use strict";
/* Frames in the form that the viewer draws: coordinates as 65535ths of the box around them, strains as a byte. */

const WIDEST = 65535, MIDDLE = 127, NO_STRAIN_BYTE = 255;

function boxOf(q) {
  const box = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
  for (let k = 0; k < q.length; k++) {
    if (!Number.isFinite(q[k])) continue;
    box[k % 3] = Math.min(box[k % 3], q[k]);
    box[3 + (k % 3)] = Math.max(box[3 + (k % 3)], q[k]);
  }
  return box.map((side) => (Number.isFinite(side) ? side : 0));
}

const extentOf = (box) => Math.max(box[3] - box[0], box[4] - box[1], box[5] - box[2]);

function strainOf(q, { ends, restLength }, k) {
  const a = 3 * ends[2 * k], b = 3 * ends[2 * k + 1];
  const length = Math.hypot(q[a] - q[b], q[a + 1] - q[b + 1], q[a + 2] - q[b + 2]);
  return restLength[k] > 0 ? length / restLength[k] - 1 : NaN;
}

/* The strain that 98 of 100 springs stay within, as 1, 2 or 5 times a power of ten. */
function strainScale(states, net) {
  const sizes = states.map((q) => {
    const list = Array.from(net.restLength, (_, k) => Math.abs(strainOf(q, net, k))).filter(Number.isFinite).sort((a, b) => a - b);
    return list.length ? list[Math.floor(0.98 * (list.length - 1))] : 0;
  });
  const most = Math.max(0, ...sizes);
  if (!(most > 0)) return 0.1;
  const power = 10 ** Math.floor(Math.log10(most));
  return power * [1, 2, 5, 10].find((head) => head * power >= most);
}

function packFrame(q, net, strain) {
  const box = boxOf(q), bytes = new Uint8Array(2 * q.length + net.restLength.length);
  const places = new Uint16Array(bytes.buffer, 0, q.length);
  for (let k = 0; k < q.length; k++) {
    const low = box[k % 3], span = box[3 + (k % 3)] - low, share = span > 0 ? (q[k] - low) / span : 0;
    places[k] = Math.round(WIDEST * Math.max(0, Math.min(1, Number.isFinite(share) ? share : 0)));
  }
  for (let k = 0; k < net.restLength.length; k++) {
    const value = strainOf(q, net, k);
    bytes[2 * q.length + k] = Number.isNaN(value) ? NO_STRAIN_BYTE
      : Math.max(0, Math.min(2 * MIDDLE, Math.round(MIDDLE + (MIDDLE * value) / strain)));
  }
  return { box, bytes };
}

if (typeof module === "object") module.exports = { boxOf, extentOf, packFrame, strainScale };
