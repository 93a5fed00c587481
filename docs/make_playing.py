"""Makes the pages that play in the pages of the site, and those of notebooks, after docs/make_reference.py: python
docs/make_playing.py BUILD

A page of the site has the comment `<!-- plays NAME.html: TITLE -->` after the console block whose commands make it. Here
they run with the program of BUILD, and the page goes to BUILD/docs/playing, from where conf.py takes it. Notebooks run with
the package of BUILD, and are the pages BUILD/docs/notebooks.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "docs/generate"))

import notebooks  # noqa: E402

MARK = re.compile(r"```console\n((?:(?!```).)*)```\n\n<!-- plays ([^\s#]+\.html)", re.DOTALL)
NOT_BUILT = 6


def make(program: Path, commands: str, folder: Path) -> bool:
    """Runs the commands of a block; False if the build has no pages."""
    for command, code in re.findall(r"^\$ hooke (.*?)(?: # exit (\d+))?$", commands, re.MULTILINE):
        done = subprocess.run([program, *shlex.split(command)], cwd=folder, capture_output=True, text=True)
        if done.returncode == NOT_BUILT:
            return False
        if done.returncode != int(code or 0):
            raise RuntimeError(f"hooke {command}: {done.stdout}{done.stderr}")
    return True


def write(build: Path, site: Path) -> list[str]:
    """Writes all of them to the folder `playing` of the site, and returns their names."""
    made, playing = [], site / "playing"
    playing.mkdir(exist_ok=True)
    for page in sorted((ROOT / "docs").rglob("*.md")):
        for commands, name in MARK.findall(page.read_text("utf-8")):
            with tempfile.TemporaryDirectory() as place:
                os.symlink(ROOT / "examples", Path(place, "examples"))
                if make(build / "hooke", commands, Path(place)):
                    shutil.copyfile(Path(place, name), playing / name)
                    made.append(name)
    return made


def write_notebooks(build: Path, site: Path) -> None:
    """Writes the pages of all notebooks."""
    if not importlib.util.find_spec("hooke"):
        sys.path.insert(0, str(build / "python"))
    (site / "notebooks").mkdir(exist_ok=True)
    for path in sorted((ROOT / "examples/notebooks").glob("*.ipynb")):
        (site / f"notebooks/{path.stem}.md").write_text(notebooks.page(path, site / "playing"), "utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    write(Path(sys.argv[1]).resolve(), Path(sys.argv[1]).resolve() / "docs")
    write_notebooks(Path(sys.argv[1]).resolve(), Path(sys.argv[1]).resolve() / "docs")
