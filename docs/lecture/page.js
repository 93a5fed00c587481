"use strict";
/* Puts a figure that moves in the place of every picture `lecture-NAME.svg` of a page, once it comes into view. */

function sliderOf(knob) {
  const { name, from, to, value, log, whole, words } = knob, f = log ? Math.log : (x) => x, back = log ? Math.exp : (x) => x;
  const input = document.createElement(words ? "select" : "input"), label = document.createElement("label"), output = document.createElement("output");
  if (words) words.forEach((word) => input.add(new Option(word, word, word === value, word === value)));
  else Object.assign(input, { type: "range", min: 0, max: whole ? to - from : 1000, step: 1 });
  const share = whole ? to - from : 1000;
  const slider = {
    label, input,
    get value() {
      if (words) return input.value;
      const x = back(f(from) + (input.value / share) * (f(to) - f(from)));
      return slider.exact ?? (whole ? Math.round(x) : Number(x.toPrecision(3)));
    },
    set value(x) {
      slider.exact = words ? undefined : Math.min(to, Math.max(from, x)); // as it was set, until it is moved
      input.value = words ? x : Math.round((share * (f(slider.exact) - f(from))) / (f(to) - f(from)));
    },
    tell: () => { output.textContent = words ? "" : `${said(slider.value)} ${knob.unit || ""}`; },
  };
  slider.value = value;
  label.append(`${name} `, input, output);
  return slider;
}

function putFigure(library, scenes, row, picture) {
  const figure = document.createElement("div"), show = document.createElement("div"), words = document.createElement("p");
  const sliders = Object.fromEntries(row.knobs.map((knob) => [knob.name, sliderOf(knob)]));
  figure.className = "lecture";
  figure.id = `figure-${row.name}`;
  let shown = null, due = false;
  const draw = () => {
    due = false;
    Object.values(sliders).forEach((slider) => slider.tell());
    shown = row.draw(library, Object.fromEntries(Object.entries(sliders).map(([name, slider]) => [name, slider.value])), scenes);
    show.innerHTML = shown.panels.map((panel, k) => svgOf(panel, `${row.name}${k}`)).join("");
    words.textContent = shown.words;
    figure.classList.toggle("bad", Boolean(shown.bad));
  };
  const soon = () => {
    if (!due) requestAnimationFrame(draw);
    due = true;
  };
  for (const slider of Object.values(sliders)) slider.input.oninput = () => {
    slider.exact = undefined;
    soon();
  };
  if (row.drag) {
    const follow = ({ clientX, clientY, buttons, target }) => {
      if (!buttons || show.firstChild !== target.closest("svg")) return;
      const box = show.firstChild.getBoundingClientRect(), { sx, sy } = scales(shown.panels[0]), unit = SIZE.width / box.width;
      const moved = row.drag([sx.back((clientX - box.left) * unit), sy.back((clientY - box.top) * unit)]);
      for (const [name, value] of Object.entries(moved)) sliders[name].value = Number(value.toPrecision(3));
      soon();
    };
    show.onpointerdown = show.onpointermove = follow;
    show.classList.add("drag");
  }
  figure.append(show, ...Object.values(sliders).map(({ label }) => label), words);
  draw();
  picture.replaceWith(figure);
}

async function begin() {
  const wasmBinary = Uint8Array.from(atob(WASM), (letter) => letter.charCodeAt(0));
  const library = new Library(await createHooke({ wasmBinary, print() {}, printErr() {} }));
  const near = new IntersectionObserver((entries) => entries.filter((entry) => entry.isIntersecting).forEach(({ target }) => {
    near.unobserve(target);
    const name = target.src.match(/lecture-([a-z]+)\.svg/)[1];
    setTimeout(putFigure, 0, library, SCENES, FIGURES.find((row) => row.name === name), target); // one is seen before the next
  }), { rootMargin: "200px" });
  document.querySelectorAll('img[src*="lecture-"]').forEach((picture) => near.observe(picture));
}

if (typeof document === "object") begin(); // not under node
