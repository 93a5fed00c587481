/* Runs scenes by the library as WebAssembly under node: `node run_scenes.js hooke.js < runs`, where `runs` is
 * [{scene, method, step, pieces, limit}]; prints the final state of each as hexadecimal digits, the processor time of its steps [s], and the
 * predicted limit of the method at the start where `limit` asks for it, null without LAPACK. */
"use strict";
const fs = require("fs"), path = require("path");
const browser = path.join(__dirname, "../../bindings/browser");
const { Library, Live } = require(path.join(browser, "live.js")), { limitOf } = require(path.join(browser, "advice.js"));

async function main(script) {
  const wasmBinary = fs.readFileSync(script.replace(/\.js$/, ".wasm"));
  const module = await require(path.resolve(script))({ wasmBinary, print() {}, printErr() {} });
  const library = new Library(module), scenes = path.join(__dirname, "../../examples/scenes");
  module.FS.writeFile("/ball.obj", fs.readFileSync(path.join(scenes, "ball.obj"), "utf8"));
  const predicts = library.text(library.call("build_fact", "lapack")) !== "";
  const results = JSON.parse(fs.readFileSync(0, "utf8")).map(({ scene, method, step, pieces, limit: asked }) => {
    const live = new Live(library, fs.readFileSync(path.join(scenes, scene), "utf8"));
    const limit = predicts && asked ? limitOf(live, method) : null;
    live.use(method, step);
    const from = process.cpuUsage();
    const whole = pieces.every((steps) => live.take(steps));
    const seconds = process.cpuUsage(from).user / 1e6;
    const state = Buffer.concat([live.position, live.velocity].map((part) => Buffer.from(part.slice().buffer)));
    live.release();
    return { whole, seconds, limit, state: state.toString("hex") };
  });
  process.stdout.write(JSON.stringify({ methods: library.methods().map(({ name }) => name), results }));
}

main(process.argv[2]);
