"""Writes the playground as one page: `python bindings/browser/make_page.py build/release build/playground`, from the
pages and libraries of scripts of a native build and the WebAssembly of the preset playground."""

from __future__ import annotations

import base64
import html
import json
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
SCENES = HERE.parent.parent / "examples" / "scenes"
WORKER = ["scene.js", "frames.js", "live.js", "advice.js", "worker.js"]


def read(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def data() -> str:
    scenes = {path.stem: read(path) for path in sorted(SCENES.glob("*.json"))}
    files = {path.name: read(path) for path in sorted(SCENES.glob("*.obj"))}
    return json.dumps({"scenes": scenes, "files": files})


def main(native: Path, built: Path) -> Path:
    def part(name: str) -> str:
        if name == "data":
            text = data()
        elif name == "licences":
            text = "\n\n".join(html.escape(read(path)) for path in sorted(built.glob("sources/*/LICENSE")))
        elif name == "wasm":
            return base64.b64encode((built / "hooke.wasm").read_bytes()).decode("ascii")
        elif name == "worker":
            text = "\n".join([read(built / "hooke.js"), *(read(HERE / script) for script in WORKER)])
        else:
            own = HERE / name
            text = read(own if own.exists() else native / "share" / "hooke" / name)
        return re.sub(r"</(?=script)", r"<\\/", text)

    page = re.sub(r"\{\{([\w.]+)\}\}", lambda mark: part(mark[1]), read(HERE / "playground.html"))
    out = built / "live.html"
    out.write_text(page, encoding="utf-8")
    return out


if __name__ == "__main__":
    print(main(Path(sys.argv[1]), Path(sys.argv[2])))
