"use strict";
/* Pages of trajectories side by side, or over one another in that of the longest. Each tells this page its time and its angle,
 * and the others follow. */

const frames = JSON.parse(document.getElementById("pages").textContent).map((page) =>
  Object.assign(document.createElement("iframe"), { name: "beside", srcdoc: page }));
const others = (from) => frames.map((frame) => frame.contentWindow).filter((page) => page !== from && page.follow);
const over = document.getElementById("over");
let leader = null;

window.tellOthers = (from, what, value) => others(from).forEach((page) => page.follow(what, value));

function layOut() {
  const playing = others(null).some((page) => page.isPlaying());
  others(null).forEach((page) => page.pause());
  for (const frame of frames) frame.hidden = over.checked && frame.contentWindow !== leader;
  leader.drawOver(over.checked ? others(leader).map((page) => page.run) : []);
  if (playing) leader.play();
}

window.putOver = () => {
  over.checked = !over.checked;
  layOut();
};
over.onchange = layOut;
addEventListener("keydown", (event) => event.key === "o" && window.putOver());

/* The longest leads, once all are there. */
let awaited = frames.length;
for (const frame of frames) {
  frame.onload = () => {
    const { body } = frame.contentDocument, stage = frame.contentDocument.getElementById("stage");
    stage.style.height = `${stage.offsetHeight}px`; // however high its frame becomes, which is as high as the page
    new ResizeObserver(() => { frame.style.height = `${body.offsetHeight}px`; }).observe(body);
    if (--awaited > 0) return;
    const pages = others(null), longest = Math.max(...pages.map((page) => page.duration));
    leader = pages.find((page) => page.duration === longest);
    pages.forEach((page) => page.share(pages.map(({ run }) => run)));
    leader.lead(pages.flatMap((page) => page.points()));
    over.disabled = false;
    document.title = `hooke view: ${frames.map(({ contentDocument }) => contentDocument.title.replace("hooke view: ", "")).join(", ")}`;
    if (location.hash === "#over") window.putOver();
  };
}
document.getElementById("all").append(...frames);
