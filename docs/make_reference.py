"""Writes the pages of docs/reference from the sources: python docs/make_reference.py BUILD [--check]

BUILD is a build folder with the library and the program, such as build/release. The C reference comes from the headers,
the Fortran one from the modules, the Python one from docstrings, that of scenes from the option tables and the schema,
that of the command line from --help, that of measurements from the tables of their columns. With --check nothing is
written; pages that are out of date are named.
"""

from __future__ import annotations

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "docs/generate"), str(ROOT / "bindings/python/src")]

import headers  # noqa: E402
import measurements  # noqa: E402
import modules  # noqa: E402
import package  # noqa: E402
import program  # noqa: E402
import scenes  # noqa: E402


def pages(build: Path) -> dict[str, str]:
    os.environ.setdefault("HOOKE_LIBRARY", str(build / "libhooke.so"))  # for `import hooke`
    return {
        "scene": scenes.page(ROOT),
        "command-line": program.page(str(build / "hooke")),
        "c": headers.page(ROOT),
        "fortran": modules.page(ROOT),
        "python": package.page(),
        "measurements": measurements.page(),
    }


def main(build: Path, check: bool) -> int:
    late = []
    for name, text in pages(build.resolve()).items():
        path = ROOT / f"docs/reference/{name}.md"
        if not text or (path.exists() and path.read_text("utf-8") == text):
            continue
        late.append(str(path.relative_to(ROOT)))
        if not check:
            path.write_text(text, "utf-8")
    if check and late:
        print("out of date:", *late, "\npython docs/make_reference.py", build, "writes them again")
    return 1 if check and late else 0


if __name__ == "__main__":
    words = [w for w in sys.argv[1:] if w != "--check"]
    if len(words) != 1:
        sys.exit(__doc__)
    sys.exit(main(Path(words[0]), "--check" in sys.argv))
