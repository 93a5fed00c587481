"""Runs that people asked about in public, with right answers that were computed without hooke: the printed error holds,
and is not far above the true one. The same for the ends of the example scenes."""

import functools
import json
import subprocess
from pathlib import Path

import pytest
from conftest import CLI, LONG
from printed import ABOVE, complaints, covers, farthest
from wants import ENDS, at_end

pytestmark = pytest.mark.everything

CASES = Path(__file__).resolve().parents[1] / "data/cases"
RIGHT = json.loads((CASES / "right.json").read_text())
RUNS = [pytest.param(case, run, id=f"{case['scene']} {run['options']}".strip().replace(" ", "_"))
        for case in RIGHT for run in case.get("runs", [])]  # fmt: skip
EXAMPLES = sorted(name for name, end in ENDS.items() if end.scene.parent.name == "scenes" and end.scene.parents[1].name == "examples")


@pytest.fixture(scope="module")
def finished():
    """Runs a case, once."""

    @functools.cache
    def call(scene, options):
        words = [CLI, "run", str(CASES / f"{scene}.json"), "--json", "--final", *options.split()]
        return json.loads(subprocess.run(words, capture_output=True, text=True, timeout=240, check=True).stdout)

    return call


@pytest.mark.parametrize(("case", "run"), RUNS)
def test_case(finished, case, run):
    """The end is right to within the printed error, and that is of the size of the largest error at a frame."""
    value = finished(case["scene"], run["options"])
    found = [value["final"]["position"][int(particle)] for particle in case["right"]]
    end = farthest(found, case["right"].values())
    same = 2.0 if value["method"].startswith("cvode") else 1.01  # the steps of CVODE depend on its version
    assert end <= same * run["error"] + case["known"]
    assert covers(value["error"], end, case["known"]), f"{value['error']}, but is {end:.3g} m off"
    assert not complaints(value["error"], run["error"], run.get("above", ABOVE))


def test_most_cases_are_known(finished):
    """An error that is not known claims nothing, so most have to be known."""
    printed = [finished(case["scene"], run["options"])["error"]["estimate"] for case, run in (one.values for one in RUNS)]
    assert sum(figure is not None for figure in printed) >= 0.85 * len(printed)


@pytest.mark.parametrize("case", [case for case in RIGHT if "frequencies" in case], ids=lambda case: case["scene"])
def test_frequencies(hooke, case):
    """Of a scene where it begins [rad/s]; of a cloth the largest one."""
    value = hooke("limit", CASES / f"{case['scene']}.json", "--predict", "--json").json
    right, found = case["frequencies"], sorted(mode["frequency"] for mode in value["modes"])
    assert value["frequency_max"] == pytest.approx(right[-1], rel=case["known"])
    assert len(right) == 1 or found == pytest.approx(right, rel=case["known"])


@pytest.mark.check
@LONG
@pytest.mark.parametrize("name", EXAMPLES)
def test_example(hooke, name):
    """As it is run without options."""
    end = ENDS[name]
    answer = hooke("run", end.scene, "--json", "--final")
    assert answer.code == 0 and at_end(answer.json["time"], end.data["time"]), answer.err
    truth = [end.data["position"][3 * k : 3 * k + 3] for k in end.data["free"]]
    error = farthest([answer.json["final"]["position"][k] for k in end.data["free"]], truth)
    assert not complaints(answer.json["error"], error)
    assert covers(answer.json["error"], error), f"{answer.json['error']}, but is {error:.3g} m off"


def test_examples_are_there():
    assert len(EXAMPLES) >= 12
