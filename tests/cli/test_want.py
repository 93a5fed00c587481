"""hooke run --want and hooke study --want, and the estimated error of a plain run, compared with ends by
extrapolation in long double (tests/data/wants.json, made by tests/long/make_wants.py); `make test-long PART=want`
tests more."""

import math
import shlex
import time
from pathlib import Path

import h5py
import pytest
from wants import ENDS, WANTS, complaints, cost, estimate_complaints, is_of_the_end, study_complaints

pytestmark = pytest.mark.everything

ROPE = str(Path(__file__).parents[2] / "examples/scenes/rope.json")
SCENES = ["six-particles", "rope", "stiff-spring", "mesh", "cloth-damped", "cantilever", "cloth-gentle", "pendulum", "cable", "swung-rope"]
ASKED = ["1cm", "1mm"]
# The examples with one want here, since `make test-long PART=want` studies them with every one.
STUDIED = [("six-particles", "1mm"), ("rope", "1cm"),
           *((name, asked) for name in ("pendulum", "cable", "swung-rope") for asked in ASKED)]
DEARER = 4.0  # maximum cost of a pick over the cheapest of a fine ladder of all methods, in evaluations and solves


@pytest.mark.check
@pytest.mark.parametrize("asked", ASKED)
@pytest.mark.parametrize("name", SCENES)
def test_a_run_keeps_its_want(hooke, name, asked):
    end = ENDS[name]
    answer = hooke("run", end.scene, "--want", asked, "--json", "--final")
    assert answer.code == 0, answer.err
    value = answer.json
    assert complaints(answer.code, value, True, end.error(value), WANTS[asked]) == []
    assert value["want"]["wanted"] == WANTS[asked]
    assert cost(value["method"], value["force_evaluations"]) <= DEARER * end.best(asked), value["method"]


@pytest.mark.check
@pytest.mark.parametrize("name, asked", STUDIED)
def test_a_study_keeps_its_want(hooke, name, asked):
    end = ENDS[name]
    answer = hooke("study", end.scene, "--want", asked, "--json", "--budget", "10s")
    assert answer.code == 0, answer.err
    value = answer.json
    again = hooke(*shlex.split(value["recommendation"]["command"])[1:], "--json", "--final")
    error = end.error(again.json) if again.code == 0 else math.nan
    assert study_complaints(answer.code, value, again.code, error, WANTS[asked]) == []


@pytest.mark.check
@pytest.mark.parametrize("name", [name for name, end in ENDS.items() if end.data["scene"].startswith("examples/")])
def test_a_plain_run_says_its_error(hooke, name):
    end = ENDS[name]
    answer = hooke("run", end.scene, "--json", "--final")
    assert answer.code == 0, answer.err
    value = answer.json
    assert {"estimate", "rms", "known_until", "by"} <= set(value["error"])
    assert value["error"]["by"] in (None, "half-step", "tolerance", "reference", "other-method")
    assert (value["error"]["estimate"] is None) == (value["error"]["reason"] is not None)
    assert estimate_complaints(value, end.error(value)) == []


def test_a_want_is_not_met_by_what_is_known_of_a_part(hooke, write):
    """A pendulum of two pieces is chaotic: its beginning is within the want, and nobody knows the rest."""
    particles = {"position": [[0, 0, 0], [1, 0.1, 0], [2, 0.3, 0]], "mass": 1, "pinned": [0]}
    springs = {"between": [[0, 1], [1, 2]], "law": "length", "stiffness": 200, "rest_length": "initial"}
    scene = write({"hooke": 1, "gravity": [0, -9.81, 0], "particles": particles, "springs": [springs]}, duration=20, every=0.1)
    answer = hooke("run", scene, "--want", "1cm", "--method", "rk4", "--json")
    error = answer.json["error"]
    assert error["estimate"] <= 1e-2 and error["known_until"] < 19, "the case"
    assert (answer.code, answer.json["want"]["met"]) == (7, None)


def in_status(path):
    with h5py.File(path) as file:
        return file["hooke/status"].asstr()[()]


def in_file(path):
    """The error of a run in its file, in the form of --json."""
    with h5py.File(path) as file:
        numbers = file["hooke/error"]
        found = dict(zip(numbers.attrs["numbers"], [None if math.isnan(x) else x for x in numbers[:].tolist()]))
        by, reason = (file[f"hooke/error_{name}"].asstr()[()] for name in ("by", "reason"))
        met = None if found["met"] is None else found["met"] == 1
        return {"wanted": found.pop("wanted"), "met": met}, {**found, "met": met, "by": by or None, "reason": reason or None}


@pytest.mark.parametrize("words", [(), ("--want", "1mm"), ("--want", "1nm"), ("--no-estimate",)], ids=" ".join)
def test_the_file_has_the_error(hooke, words, tmp_path):
    value = hooke("run", ENDS["six-particles"].scene, "--duration", "0.5", "-o", "out.h5", "--json", *words).json
    want, error = in_file(tmp_path / "out.h5")
    told = value.get("error", dict.fromkeys(["estimate", "rms", "known_until", "by", "energy_rise", "heat_excess", "reason"]))
    piece = value.get("last_piece", {})
    assert error == {"met": want["met"], "last_piece": piece.get("error"), "last_from": piece.get("from"), **told}
    assert want == {name: value.get("want", {}).get(name) for name in ["wanted", "met"]}
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["hooke/status"][()] == b"finished"
    assert hooke("verify", "out.h5").code == 0


def test_a_run_that_is_killed_while_its_error_is_looked_into_is_whole(hooke, start, tmp_path):
    """Its outcome is in the file before."""
    process = start("run", ENDS["six-particles"].scene, "--step", "1e-6", "--every", "0.05", "-o", "out.h5")
    while not (tmp_path / "out.h5").exists() or in_status(tmp_path / "out.h5") == "running":
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    process.kill()
    process.communicate()
    assert in_status(tmp_path / "out.h5") == "finished"
    assert in_file(tmp_path / "out.h5")[1]["by"] in (None, "half-step", "other-method")
    assert hooke("verify", "out.h5").code == 0


def test_every_example_is_there():
    examples = {path.stem for path in ENDS["rope"].scene.parent.glob("*.json")}
    # the end of cloth-64 takes minutes and is in `make test-long`, and three-cloths is the cloth of the tutorial thrice; the independent solution of all ends has inertia, and
    # neither bodies nor obstacles nor wind
    assert examples - set(ENDS) == {"ball-under-cloth", "buoy", "cloth-64", "crane", "flag", "mooring", "three-cloths", "tissue"}


def test_most_plain_runs_know_their_error(hooke):
    """An estimate that says that nothing is known is none."""
    names = ["six-particles", "oscillator", "drag-or-damping", "mesh", "cloth-gentle"]
    assert [name for name in names if not is_of_the_end(hooke("run", ENDS[name].scene, "--json").json)] == []


# ---- the judge, on wrong answers ----


def answer_of(met, estimate=2e-3, until=1.0, by="half-step"):
    return {"time": 1.0, "want": {"wanted": 1e-3, "met": met}, "error": {"estimate": estimate, "known_until": until, "by": by}}


@pytest.mark.parametrize(
    ("code", "value", "known", "error", "count"),
    [
        (0, answer_of(True, 9.5e-4), True, 9e-4, 0),
        (7, answer_of(False, 3.5e-3), True, 3e-3, 0),
        (7, answer_of(None, None, None), False, math.nan, 0),
        (0, answer_of(True, 9e-4), True, 1.1e-3, 2),  # misses it, and says too little
        (0, answer_of(True, 1e-4), True, 9e-4, 1),  # an estimate that is too small
        (7, answer_of(False, 9e-3), True, 2e-3, 0),  # at a frame before the end
        (7, answer_of(False, 1e-3, 0.5), True, 9e-3, 0),  # known until an earlier time alone
        (0, answer_of(None, 9e-4), True, 9e-4, 1),  # exit code and key differ
        (7, answer_of(True, 9e-4), True, 9e-4, 1),
        (0, answer_of(True, 9e-4), False, 9e-4, 1),  # unknown
        (0, answer_of(True, 9e-4), None, math.nan, 0),  # the solution took too long
        (4, answer_of(True), True, 9e-4, 1),
        (0, {"time": 1.0}, True, 9e-4, 1),  # says nothing at all
    ],
)
def test_the_judge(code, value, known, error, count):
    assert len(complaints(code, value, known, error, 1e-3)) == count


@pytest.mark.parametrize(
    ("estimate", "until", "by", "count"),
    [(1e-3, 1.0, "half-step", 0), (9e-3, 1.0, "half-step", 0), (0.99e-3, 1.0, "other-method", 1), (3e-4, 1.0, "half-step", 1),
     (3e-4, 0.5, "tolerance", 0), (None, None, None, 0)],
)  # fmt: skip
def test_the_judge_of_estimates(estimate, until, by, count):
    assert len(estimate_complaints(answer_of(None, estimate, until, by), 1e-3)) == count


def study_of(met, until=1.0):
    return {"duration": 1.0, "reference": {"trusted_until": until}, "recommendation": {"met": met}}


def test_the_judge_of_studies():
    met, none = study_of(True), study_of(False)
    assert study_complaints(0, met, 0, 9e-4, 1e-3) == []
    assert study_complaints(7, none, None, math.nan, 1e-3) == []
    assert study_complaints(7, study_of(None, 0.5), 0, 9e-3, 1e-3) == []  # known until an earlier time alone
    assert len(study_complaints(0, study_of(True, 0.5), 0, 9e-4, 1e-3)) == 1
    assert len(study_complaints(0, met, 0, 1.1e-3, 1e-3)) == 1
    assert len(study_complaints(0, met, 0, 9e-4, 1e-3, known=False)) == 1
    assert len(study_complaints(0, met, 4, math.nan, 1e-3)) == 1
    assert len(study_complaints(0, none, None, math.nan, 1e-3)) == 1


@pytest.mark.parametrize("duration", ["0.137", "1.111"])
def test_runs_of_any_length(hooke, duration):
    """Of which no number of steps between two frames is a divisor."""
    assert hooke("run", ROPE, "--want", "1mm", "--duration", duration, "--every", "0.02").code == 0


def test_motion_between_a_hundred_frames_counts(hooke, write, tmp_path):
    """An oscillator whose period is a hundredth of the run."""
    omega = 100 * math.pi
    spring = {"between": [[0, 1]], "stiffness": omega**2, "law": "length", "rest_length": 1}
    scene = write({"hooke": 1, "particles": {"position": [[0, 0, 0], [1.1, 0, 0]], "mass": [1, 1], "pinned": [0]},
                   "springs": [{"name": "s", **spring}]}, duration=2, every=0.002)  # fmt: skip
    answer = hooke("run", scene, "--want", "1mm", "--method", "verlet", "-o", "out.h5", "--json")
    with h5py.File(tmp_path / "out.h5") as file:
        step, values = file["particles/all/position/time"], file["particles/all/position/value"][:, 1, 0]
        off = max(abs(x - 1 - 0.1 * math.cos(omega * t)) for t, x in zip(step, values))
    assert answer.code == 0 and 1e-5 < off <= answer.json["error"]["estimate"] < 1e-3
    answer = hooke("run", scene, "--want", "1mm", "--method", "verlet", "--every", "0.0005", "--json")
    assert answer.code == 0 and " at 1001 of 4001 frames (" in answer.json["claims"][0]["text"]


def test_damping_is_explicit_only_where_dampers_may_turn(hooke, write, tmp_path):
    """Two perpendicular dampers that turn until they act together."""
    particles = {"position": [[-1, 0, 0], [0, -1, 0], [0, 0, 0]], "mass": [1, 1, 1], "pinned": [0, 1]}
    dampers = {"name": "s", "between": [[0, 2], [1, 2]], "stiffness": 1, "damping": 50, "law": "length"}
    scene = {"hooke": 1, "gravity": [20, 20, 0], "particles": particles, "springs": [dampers]}
    answer = hooke("run", write(scene, method="verlet", step=0.03, duration=6, every=0.3), "--json")
    assert answer.code == 0 and answer.json["status"] == "finished"
