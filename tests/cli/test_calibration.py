"""The error that a run prints, on a dozen of the random runs of `make calibration`, whose true positions are kept."""

import json
import subprocess
import sys
from pathlib import Path

import h5py
import pytest
from conftest import CLI
from printed import ABOVE, complaints, covers, farthest

pytestmark = pytest.mark.everything

ROOT = Path(__file__).resolve().parents[2]
RUNS = json.loads((ROOT / "tests/data/calibration.json").read_text())  # by tests/long/make_calibration.py


@pytest.fixture(scope="module")
def judged(tmp_path_factory):
    """The printed error and the true largest one of each run."""
    folder, found = tmp_path_factory.mktemp("calibration"), []
    for run in RUNS:
        (folder / "scene.json").write_text(json.dumps(run["scene"]))
        words = [CLI, "run", "scene.json", "-o", "run.h5", "--json", *run["options"].split()]
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=240, check=True)
        with h5py.File(folder / "run.h5") as file:
            frames = file["particles/all/position/value"][1:][:, run["free"]].tolist()
        true = max(farthest(frame, right) for frame, right in zip(frames, run["positions"], strict=True))
        found.append((json.loads(done.stdout)["error"], true))
    return found


@pytest.mark.parametrize("number", range(len(RUNS)), ids=[f"{run['kind']}-{run['seed']}".replace(" ", "-") for run in RUNS])
def test_printed_error(judged, number):
    printed, true = judged[number]
    assert true > 1e-9
    assert not complaints(printed, true, ABOVE)


def test_printed_errors_together(judged):
    known = [(printed, true) for printed, true in judged if printed["estimate"] is not None]
    assert len(known) >= len(RUNS) - 2
    assert sum(covers(*one) for one in known) >= len(known) - 1


def test_planted():
    right, low, high, mute = ({"estimate": figure, "reason": None} for figure in (1.5, 0.3, 20.0, None))
    assert not complaints(right, 1.0, ABOVE) and covers(right, 1.0)
    assert complaints(low, 1.0) and not covers(low, 1.0)
    assert complaints(high, 1.0, ABOVE) and not complaints(high, 1.0)
    assert complaints(mute, 1.0) and not complaints(mute | {"reason": "chaotic"}, 1.0)


# ---- the program that makes and counts them ----


@pytest.fixture
def calibrate(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "tests/long"))
    import calibrate

    yield calibrate
    for name in ("calibrate", "calibration_scenes", "truth"):
        sys.modules.pop(name, None)


def test_seeds_give_these_runs(calibrate):
    for run in RUNS:
        one = calibrate.scene_of(run["seed"] // calibrate.PER_SCENE)
        assert json.loads(json.dumps(one.scene)) == run["scene"]
        assert " ".join(calibrate.options_of(run["seed"], one)) == run["options"]


def test_counting(calibrate, tmp_path):
    low, high = calibrate.wilson(5, 10)
    assert abs(low - 0.2366) < 1e-4 and abs(high - 0.7634) < 1e-4  # tables of the interval
    assert calibrate.median([1.0, 2.0, 30.0])[0] == 2.0
    assert sum(calibrate.histogram([{"figure": 0.5, "true": 1.0}, {"figure": None, "true": 1.0}])) == 1
    rows = [{"seed": k, "method": "rk4", "kind": "net", "by": "half-step", "figure": figure, "true": 1.0}
            for k, figure in enumerate([2.0, 1.0, 0.5, 0.1, None])]  # fmt: skip
    found = calibrate.summary(rows)
    assert (found["runs"], found["covered"][0], found["low"][0], found["unknown"][0]) == (5, 0.5, 0.25, 0.2)
    assert [row["seed"] for row in rows if row["figure"] is not None and calibrate.is_low(row)] == [3]
    cut = tmp_path / "runs.jsonl"
    cut.write_text(json.dumps(rows[:2]) + "\n" + json.dumps(rows[2:])[:-9])
    assert sorted(calibrate.read_rows(cut)) == [0, 1]
