"use strict";
/* Pages of trajectories side by side. Each tells this page its time and its angle, and the others follow. */

const frames = JSON.parse(document.getElementById("pages").textContent).map((page) =>
  Object.assign(document.createElement("iframe"), { name: "beside", srcdoc: page }));
const others = (from) => frames.map((frame) => frame.contentWindow).filter((page) => page !== from && page.follow);

window.tellOthers = (from, what, value) => others(from).forEach((page) => page.follow(what, value));

/* The longest leads, once all are there. */
let awaited = frames.length;
for (const frame of frames) {
  frame.onload = () => {
    if (--awaited > 0) return;
    const pages = others(null), longest = Math.max(...pages.map((page) => page.duration));
    pages.find((page) => page.duration === longest).lead();
    document.title = `hooke view: ${frames.map(({ contentDocument }) => contentDocument.title.replace("hooke view: ", "")).join(", ")}`;
  };
}
document.body.append(...frames);
