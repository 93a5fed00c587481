/* Runs scenes by the library as WebAssembly under node: `node run_scenes.js hooke.js scene.json ... < runs`, where `runs` is
 * [{scene, method, step, pieces}]; prints the final state of each as hexadecimal digits, and the time of all its steps [s]. */
"use strict";
const fs = require("fs"), path = require("path");
const browser = path.join(__dirname, "../../bindings/browser");
const { Library, Live } = require(path.join(browser, "live.js"));

async function main(script) {
  const wasmBinary = fs.readFileSync(script.replace(/\.js$/, ".wasm"));
  const module = await require(path.resolve(script))({ wasmBinary, print() {}, printErr() {} });
  const library = new Library(module), scenes = path.join(__dirname, "../../examples/scenes");
  module.FS.writeFile("/ball.obj", fs.readFileSync(path.join(scenes, "ball.obj"), "utf8"));
  const results = JSON.parse(fs.readFileSync(0, "utf8")).map(({ scene, method, step, pieces }) => {
    const live = new Live(library, fs.readFileSync(path.join(scenes, scene), "utf8"));
    live.use(method, step);
    const from = process.hrtime.bigint();
    const whole = pieces.every((steps) => live.take(steps));
    const seconds = Number(process.hrtime.bigint() - from) / 1e9;
    const state = Buffer.concat([live.position, live.velocity].map((part) => Buffer.from(part.slice().buffer)));
    live.release();
    return { whole, seconds, state: state.toString("hex") };
  });
  process.stdout.write(JSON.stringify({ methods: library.methods().map(({ name }) => name), results }));
}

main(process.argv[2]);
