"""The demo that `make demo` runs."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import CLI, METHODS

ROOT = Path(__file__).resolve().parents[2]
LIBRARY = Path(CLI).resolve().parent / "libhooke.so"

pytestmark = [
    pytest.mark.everything,
    pytest.mark.skipif(os.environ.get("HOOKE_PRESET") != "release", reason="the Python package runs with release"),
]


def test_demo_prints_the_table_and_draws_the_picture(tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(LIBRARY.parent / "python"), "HOOKE_LIBRARY": str(LIBRARY)}
    command = [sys.executable, ROOT / "examples/demo.py", CLI, tmp_path]
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    for method in METHODS:
        assert f"\n{method} " in done.stdout
    order = re.search(r"^off by at most: (.*) mm$", done.stdout, re.M)[1].split(" mm, ")
    errors = {word.split()[0]: float(word.split()[1]) for word in order}
    assert set(errors) == set(METHODS) and list(errors.values()) == sorted(errors.values())
    assert errors["rk4"] < 0.01 and errors["cvode-bdf"] < 0.01 and errors["verlet"] < 0.65
    assert all(5 < errors[method] < 35 for method in errors if method.endswith("euler"))
    assert (tmp_path / "cloth-16.h5").stat().st_size > 1e6
    picture = (tmp_path / "cloth-16.png").read_bytes()
    assert picture.startswith(b"\x89PNG") and len(picture) > 50_000
