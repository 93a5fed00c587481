"""Writes the pages of the site; those of the references are generated: python docs/make_reference.py BUILD

BUILD is a build folder with the library and the program, such as build/release; the pages are in BUILD/docs, those of the
references in BUILD/docs/reference. The C reference comes from the headers, the Fortran one from the modules, the Python
one from docstrings, that of scenes from the option tables and the schema, that of the command line from --help.
"""

from __future__ import annotations

import importlib.util
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "docs/generate"))

import headers  # noqa: E402
import measurements  # noqa: E402
import modules  # noqa: E402
import package  # noqa: E402
import program  # noqa: E402
import scenes  # noqa: E402


def pages(build: Path) -> dict[str, str]:
    if not importlib.util.find_spec("hooke"):
        sys.path.insert(0, str(build / "python"))
    return {
        "scene": scenes.page(ROOT),
        "command-line": program.page(str(build / "hooke")),
        "c": headers.page(ROOT),
        "fortran": modules.page(ROOT, build / "fortran"),
        "python": package.page(),
        "measurements": measurements.page(),
    }


def write(build: Path, folder: Path) -> None:
    """Writes all pages of the site."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs", folder, ignore=shutil.ignore_patterns("*.py", "*.json", "*.txt", "generate"))
    (folder / "reference").mkdir()
    for name, text in pages(build).items():
        (folder / f"reference/{name}.md").write_text(text, "utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write(Path(sys.argv[1]).resolve(), Path(sys.argv[1]).resolve() / "docs")
