"""The notebooks: their pages, of cells that run in order; their code is typed, and they are kept without outputs."""

import json
import os
import re
import subprocess
import sys

import pytest
from pages import BUILD, ROOT

sys.path.insert(0, str(ROOT / "docs/generate"))
import notebooks

FOLDER = ROOT / "examples/notebooks"
QUICK = ("own-force", "which-method")
NAMES = sorted(path.stem for path in FOLDER.glob("*.ipynb"))


def tension(printed):
    """By the catenary, and by hooke."""
    return [float(number) for number in re.findall(r"(\d+) N by", printed)]


#: What the printed lines of a notebook say, which no bound of its own holds.
SAID = {
    "why-springs-explode": lambda printed: "diverged at" in printed and "finished with a step of" in printed,
    "which-method": lambda printed: "within the wanted 0.001 m" in printed and len(set(re.findall("-> ([a-z0-9-]+)", printed))) == 3,
    "mooring-line": lambda printed: tension(printed)[1] == pytest.approx(tension(printed)[0], rel=0.01),
    "own-force": lambda printed: 11 < float(re.search("ratio ([0-9.]+)", printed)[1]) < 21,
    "sweep-with-pandas": lambda printed: re.search(r"diverged +\d", printed) and re.search(r"finished +\d", printed),
}


@pytest.mark.parametrize("name", [name if name in QUICK else pytest.param(name, marks=pytest.mark.check) for name in NAMES])
def test_a_notebook_runs(name, tmp_path):
    pytest.importorskip("matplotlib")
    if name == "sweep-with-pandas":
        pytest.importorskip("pandas")
    page = notebooks.page(FOLDER / f"{name}.ipynb", tmp_path)
    assert SAID[name](page), page
    shown = re.findall('src="../([^"]*)"', page)
    assert shown and all((tmp_path / file).stat().st_size > 5000 for file in shown)


def test_they_are_kept_without_outputs():
    assert set(NAMES) == set(SAID)
    for name in NAMES:
        document = json.loads((FOLDER / f"{name}.ipynb").read_text())
        code = [cell for cell in document["cells"] if cell["cell_type"] == "code"]
        assert all(cell["outputs"] == [] and cell["execution_count"] is None for cell in code)


@pytest.mark.check
def test_their_code_is_typed(tmp_path):
    pytest.importorskip("mypy")
    for name in NAMES:
        (tmp_path / f"{name.replace('-', '_')}.py").write_text(notebooks.code(FOLDER / f"{name}.ipynb"))
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file", ROOT / "pyproject.toml", *tmp_path.glob("*.py")]
    environment = {**os.environ, "MYPYPATH": str(BUILD / "python")}
    checked = subprocess.run([*command, "--cache-dir", BUILD / "mypy"], env=environment, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr
