"""Writes what docs/lecture.md plays, build/playground/lecture.js, from the WebAssembly there: python docs/make_lecture.py
build/playground

With the word `pictures` it also draws the figures as they begin, docs/images/lecture-NAME.svg, with node: the page without
WebAssembly shows them.
"""

from __future__ import annotations

import base64
import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
OWN = ROOT / "docs/lecture"
SCRIPTS = [
    *(ROOT / "bindings/browser" / name for name in ("scene.js", "live.js", "advice.js")),
    *(OWN / name for name in ("problems.js", "draw.js", "figures.js", "page.js")),
]
ASK = """
createHooke({ wasmBinary: Buffer.from(WASM, "base64"), print() {}, printErr() {} }).then((made) => {
  const library = new Library(made);
  process.stdout.write(JSON.stringify(%s));
});
"""
DRAWN = """Object.fromEntries(FIGURES.map((row) => [row.name, row.draw(library, begun(row), SCENES)])
    .map(([name, { panels, ...rest }]) => [name, { ...rest, file: fileOf(panels) }]))"""


def script(built: Path, end: str = "") -> str:
    """The library, the scenes that figures name, and the scripts, as one that begins when it is loaded."""
    sources = [path.read_text("utf-8") for path in SCRIPTS]
    named = set(re.findall(r'(?:scenes\["|scene: ")([\w-]+)"', sources[-2]))
    scenes = {name: (ROOT / f"examples/scenes/{name}.json").read_text("utf-8") for name in sorted(named)}
    wasm = base64.b64encode((built / "hooke.wasm").read_bytes()).decode("ascii")
    parts = [(built / "hooke.js").read_text("utf-8"), f'const WASM = "{wasm}", SCENES = {json.dumps(scenes)};', *sources]
    return "(() => {\n" + "\n".join([*parts, end]) + "\n})();\n"


def ask(built: Path, expression: str) -> Any:
    """The value of an expression of the scripts, under node."""
    done = subprocess.run(["node", "-"], input=script(built, ASK % expression), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


def main(built: Path, *words: str) -> None:
    (built / "lecture.js").write_text(script(built), "utf-8")
    if "pictures" in words:
        for name, figure in ask(built, DRAWN).items():
            (ROOT / f"docs/images/lecture-{name}.svg").write_text(figure["file"], "utf-8")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), *sys.argv[2:])
