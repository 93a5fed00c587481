"""Cost of an explanation: time, memory, and a signal, for a cloth of 256 x 256 that diverged at 1.05 times the limit;
the outcome and the trajectory come first."""

import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import h5py
import pytest
from conftest import CLI
from pages import DRAWS

pytestmark = pytest.mark.everything

SIZE, BUDGET = 256, 2.0
LIMIT = 2.6075272e-5  # of symplectic Euler, by `hooke limit`
STEP = 1.05 * LIMIT
RUN = ["--step", repr(STEP), "--every", repr(10 * STEP), "--duration", repr(1000 * STEP)]


@pytest.fixture
def cloth(hooke, tmp_path):
    families = [word for name in ("structural", "shear", "bend") for word in (f"--{name}.stiffness", "50")]
    made = hooke("make", "cloth", "--edges", "1,0,0;0,0,1", "--size", f"{SIZE}x{SIZE}", "--mass", "1", "--pinned", "top-corners",
                 *families, "--gravity", "0,-9.81,0", "--method", "symplectic-euler", "-o", "cloth.json")  # fmt: skip
    assert made.code == 0, made.err
    return tmp_path


def measured(folder, *more):
    """Words on standard error, seconds and kilobytes of a run."""
    begun = time.monotonic()
    process = subprocess.Popen(
        [CLI, "run", "cloth.json", *RUN, *more], cwd=folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    out, err = process.stdout.read(), process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 4 and "time reached" in out, err
    return err, time.monotonic() - begun, usage.ru_maxrss


def test_an_explanation_keeps_its_budget(cloth):
    short, run_seconds, run_size = measured(cloth, "--no-why")
    long, seconds, size = measured(cloth)
    assert "the run diverged" in short and "largest stable" not in short and "try: a smaller step" in short
    assert "is above the largest stable one of symplectic-euler" in long and "  # a step of " in long
    assert ", which is between " in long.splitlines()[0] and len(long.splitlines()) == 4
    assert seconds - run_seconds < 1.5 * BUDGET
    assert size < 1.5 * run_size


@pytest.mark.parametrize("stop", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_an_explanation_and_loses_nothing(cloth, hooke, start, stop):
    process = start("run", "cloth.json", *RUN, "-o", "out.h5", text=True)
    lines = []
    for line in process.stdout:
        lines.append(line)
        if line.startswith("output"):
            break
    process.send_signal(stop)
    sent = time.monotonic()
    _, err = process.communicate(timeout=60)
    assert time.monotonic() - sent < 1.0
    assert process.returncode == 4 and "the run diverged" in err
    with h5py.File(cloth / "out.h5") as file:
        times = file["/particles/all/position/time"][:]
    assert f"\nkept: {len(times)} frames up to t = {times[-1]:.6g} s in out.h5\n" in err and len(times) > 1
    assert any(line.startswith("time reached") for line in lines)
    assert "is not looked into further" in err
    why = hooke("why", "out.h5", "--budget", "5s", "--json")
    assert why.code == 0 and why.json["cause"] == "step-above-limit"


def test_why_has_a_budget_too(cloth, hooke):
    begun = time.monotonic()
    answer = hooke("why", "cloth.json", *RUN, "--budget", "1ms", "--json")
    assert answer.code == 0 and time.monotonic() - begun < 3.0
    assert answer.json["cause"] == "unknown" and "time was short" in answer.json["left_out"]
    assert hooke("why", "cloth.json", *RUN, "--budget", "1 kg").code == 2


def undated(page):
    """The page without the minute at which it was made, which two pages need not share."""
    text, found = re.subn(r'"date":"[-0-9]{10} [0-9:]{5} UTC"', "", page)
    assert found == 1
    return text


@pytest.mark.skipif("HOOKE_PROCESSOR_CLOCK" not in os.environ, reason="no clock to load before the program")
@pytest.mark.parametrize("kind, words", [("cloth-16", ["--step", "10ms"]), ("curl", ["--step", "20ms", "--every", "0.1"]),
                                         ("collapsing", []), ("gaining-strand", []), ("cvode-cable", [])])  # fmt: skip
def test_no_clock_decides(hooke, tmp_path, kind, words):
    """A clock that runs a million times too fast, as on a machine with a million other programs, changes no byte of an
    explanation; it does of one that is given a budget, which is wall time."""
    (found,) = [path for folder in ("examples/scenes", "tests/cli/scenes/exploding")
                for path in [Path(os.environ["HOOKE_SOURCE_DIR"]) / folder / f"{kind}.json"] if path.exists()]  # fmt: skip
    shutil.copy(found, tmp_path / "scene.json")
    racing = {**os.environ, "LD_PRELOAD": os.environ["HOOKE_PROCESSOR_CLOCK"], "HOOKE_CLOCK_TIMES": "1000000"}
    pages = []
    for more in ([], ["--json"], *([["--json", "--report", "page.html"]] if DRAWS else [])):
        usual = hooke("why", "scene.json", *words, *more)
        pages += [undated(page.read_text()) for page in tmp_path.glob("page.html")]
        raced = hooke("why", "scene.json", *words, *more, env=racing)
        pages += [undated(page.read_text()) for page in tmp_path.glob("page.html")]
        assert usual.code == 0 and (usual.out, usual.err) == (raced.out, raced.err)
    assert len(set(pages)) == DRAWS
    assert "time was short" in hooke("why", "scene.json", *words, "--budget", "10s", env=racing).out


def test_a_command_to_type_has_no_want_beside_a_step(hooke):
    """For any pick of --want."""
    scene = Path(os.environ["HOOKE_SOURCE_DIR"]) / "examples/scenes/mesh.json"
    answer = hooke("run", scene, "--want", "1mm", "--quiet")
    commands = [line for line in answer.err.splitlines() if line.startswith("try: hooke run ")]
    assert commands or answer.code != 4
    assert not any("--want" in line for line in commands if "--step" in line or "--rtol" in line)


def test_springs_that_began_without_direction_are_told_of(hooke, write):
    scene = {
        "hooke": 1,
        "gravity": [0, -9.81, 0],
        "particles": {"position": [[0, 0, 0], [0, 0, 0], [1, 0, 0]], "mass": 1, "pinned": [0]},
        "springs": [{"between": [[0, 1], [1, 2]], "law": "length", "stiffness": 100, "rest_length": 1}],
        "run": {"method": "symplectic-euler", "step": 1e-3, "duration": 0.1},
    }
    answer = hooke("run", write(scene))
    assert answer.code == 0 and "1 springs or contacts began without a direction" in answer.err
    assert "began" not in hooke("run", write(scene), "--quiet").err
