"""The first programs of README.md and of the Fortran page print digits that are right: the run that they make has an error
that is small against them, as the text says."""

import os
import re
from pathlib import Path

import pytest

pytestmark = pytest.mark.everything

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
ROPE = ["--from", "0,0,0", "--to", "1,0,0", "--segments", "24", "--mass", "0.25", "--pinned", "start", "--stretch.stiffness", "200",
        "--stretch.damping", "0.05", "--gravity", "0,-9.81,0", "--step", "1e-3", "--duration", "2"]  # fmt: skip
C = (r'"method", "(.*?)"', r'"step", ([\d.e-]+)\)')
FORTRAN = (r'"method", "(.*?)"', r'"step", ([\d.e-]+)_hooke_real\)')


@pytest.mark.parametrize("page, start, words", [("README.md", "```c\n", C), ("docs/fortran.md", "```fortran\n", FORTRAN)])
def test_the_first_program_is_right(hooke, page, start, words):
    before, program = (ROOT / page).read_text().split(start, 1)
    told = float(re.search(r"right to ([\d.]+) mm", before[before.rindex("rope of 250 g") :])[1]) * 1e-3
    program = program.split("```", 1)[0]
    method, step = (re.search(word, program)[1] for word in words)
    for number in ("24", "0.25", "200", "0.05", "-9.81"):
        assert number in program
    assert hooke("make", "rope", *ROPE, "-o", "rope.json").code == 0
    error = hooke("run", "rope.json", "--method", method, "--step", step, "--json").json["error"]
    assert error["estimate"] <= told <= 0.5e-3, error  # three digits of a metre are printed


def test_the_first_cloth_is_as_right_as_the_quickstart_says(hooke):
    text = (ROOT / "docs/quickstart.md").read_text()
    command = re.search(r"hooke (make cloth --size 32x32 .*?) -o cloth.json", text)[1]
    told = float(re.search(r"the cloth of 1 m is off by more than ([\d.]+) mm", text)[1])
    assert hooke(*re.sub(r"'", "", command).split(), "-o", "cloth.json").code == 0
    assert 0.5 * told < 1e3 * hooke("run", "cloth.json", "--json").json["error"]["estimate"] <= told
