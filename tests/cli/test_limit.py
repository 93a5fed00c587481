"""hooke limit: its predictions and measurements, its state, and its words."""

import copy
import math
import os
from pathlib import Path

import pytest
from conftest import SIX_PARTICLES, STIFF_PAIR

pytestmark = pytest.mark.everything

FIXED_STEP = ["forward-euler", "symplectic-euler", "verlet", "shardlow", "heun", "rk4", "backward-euler", "tr-bdf2",
              "implicit-midpoint"]
# Of the six particles at the start, from the spectrum of the linearised system computed independently.
LIMITS = {
    "forward-euler": 1.7768476830321846e-05,
    "symplectic-euler": 0.13162450213044632,
    "verlet": 0.1364358523405676,
    "rk4": 0.19724928576176828,
}


def rows_of(answer):
    assert answer.code == 0, answer.err
    return {row["method"]: row for row in answer.json["rows"]}


def test_an_unknown_prediction_is_no_number(hooke, write):
    scene = {"hooke": 1, "gravity": [0, -9.81, 0],
             "parts": [{"kind": "cloth", "size": [12, 12], "edges": [[1, 0, 0], [0, 0, 1]], "mass": 1,
                        "structural": {"stiffness": 50, "damping": 0.1}, "shear": {"stiffness": 20}}],
             "obstacles": [{"shape": "plane", "point": [0, 0.001, 0], "normal": [0, 1, 0], "stiffness": 100, "damping": 1}],
             "run": {"method": "verlet", "duration": 1e-3, "every": 5e-4, "step": 1e-4}}
    row = rows_of(hooke("limit", write(scene), "--methods", "verlet", "--json"))["verlet"]
    assert row["predicted"] is None and row["ratio"] is None and row["exact"] is False and "not known" in row["note"]
    assert 0 < row["bound"] < row["measured"] < 3 * row["bound"]  # by runs it is found all the same
    along = rows_of(hooke("limit", write(scene), "--along", "--methods", "verlet", "--json"))["verlet"]
    assert along["smallest"] is None and "not known at 3 of 3 frames" in along["note"]


def test_friction_limits_the_step_of_what_lies(hooke, write):
    """It is a damping of mu g/s, 39240 1/s, by which Euler's methods are stable up to 2 s/(mu g)."""
    floor = {"shape": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "stiffness": 1e5, "friction": 0.4, "friction_speed": 1e-4}
    scene = {"hooke": 1, "gravity": [0, -9.81, 0], "particles": {"position": [[0, -9.81e-5, 0]], "mass": 1}, "obstacles": [floor]}
    answer = hooke("limit", write(scene), "--predict", "--methods", "symplectic-euler", "--json")
    assert math.isclose(rows_of(answer)["symplectic-euler"]["predicted"], 2 / 39240, rel_tol=1e-6)
    assert answer.json["changes"]["sentence"] == "contact limits the step, with 100 % of the limiting mode"
    assert "contact limits the step" in hooke("limit", write(scene), "--predict").out


def test_the_scene_itself(hooke, write):
    scene = copy.deepcopy(STIFF_PAIR)
    scene["run"].update(duration=20, every=0.1)
    answer = hooke("limit", write(scene), "--nonlinear", "--methods", "symplectic-euler", "--json")
    row = rows_of(answer)["symplectic-euler"]
    assert 0.8 < row["ratio"] < 1.2


def test_at_a_frame(hooke, write, tmp_path):
    scene = write(SIX_PARTICLES)
    assert hooke("run", scene, "-o", "out.h5").code == 0
    start = rows_of(hooke("limit", scene, "--predict", "--json"))
    first = hooke("limit", scene, "--predict", "--json", "--at", "out.h5:0")
    assert first.json["time"] == 0 and rows_of(first) == start
    last = hooke("limit", scene, "--predict", "--json", "--at", "out.h5")
    assert last.json["time"] == 0.5 and last.json == hooke("limit", scene, "--predict", "--json", "--at", "out.h5:-1").json
    assert rows_of(last)["verlet"]["predicted"] != start["verlet"]["predicted"]
    assert hooke("limit", scene, "--predict", "--at", "out.h5:99").code == 3
    assert hooke("limit", scene, "--predict", "--at", "out.h5:x").code == 2
    assert hooke("limit", scene, "--predict", "--at", "missing.h5").code in (3, 5)
    (tmp_path / "out.html").write_bytes((tmp_path / "out.h5").read_bytes())
    refused = hooke("limit", scene, "--predict", "--at", "out.html:0", "--report", "out.html")
    assert refused.code == 2 and "out.html is the trajectory of --at itself" in refused.err
    assert hooke("limit", scene, "--predict", "--at", "out.h5:0").code == 0


def test_along_a_run_that_diverges(hooke, write):
    answer = hooke("limit", write(STIFF_PAIR), "--along", "--json")
    assert answer.code == 4
    assert answer.json["rows"][1]["smallest"] > 0 and "ended early" in answer.err


def claims_of(answer):
    return {claim["key"]: claim for claim in answer.json["claims"]}


@pytest.mark.parametrize("scene, of, words", [
    ("crane", "part", "verlet is stable up to a step between 0 and "),
    ("flag", "unknown", "no limit of the step of these methods is known"),
])
def test_what_is_not_known_is_no_number_and_not_nothing(hooke, scene, of, words):
    """A body has no bound; damping that verlet predicts has no limiting mode in a large scene, and limits the step."""
    path = Path(os.environ["HOOKE_SOURCE_DIR"]) / f"examples/scenes/{scene}.json"
    claim = claims_of(hooke("limit", path, "--methods", "verlet", "--predict", "--json"))["limit"]
    assert claim["of"] == of and claim["text"].startswith(f"at t = 0 s, {words}")


def test_claims(hooke, write):
    """The same words in words and in JSON; of a state, never of the run; what was asked for and not found is unknown."""
    scene = write(STIFF_PAIR)
    answer = hooke("limit", scene, "--methods", "symplectic-euler,backward-euler", "--json")
    claims, row = claims_of(answer), answer.json["rows"][0]
    assert answer.json["scene"] == scene and {claim["of"] for claim in claims.values()} == {"part"}
    assert claims["limit"]["text"] == (f"at t = 0 s, symplectic-euler is stable up to {row['predicted']:.6g} s, by runs up to "
                                       f"{row['measured']:.6g} s")
    assert claims["changes"]["text"] == f"at t = 0 s, {answer.json['changes']['sentence']}"
    assert claims["note"]["text"] == f"backward-euler at t = 0 s: {answer.json['rows'][1]['note']}"
    assert next(iter(claims)) == "limit" and claims["limit"]["by"] == "eigenvalues and runs"
    words = " ".join(hooke("limit", scene, "--methods", "symplectic-euler,backward-euler", "--predict").out.split())
    assert claims["limit"]["text"].split(", by runs")[0] in words and claims["changes"]["text"] in words
    late = hooke("limit", scene, "--methods", "symplectic-euler", "--budget", "1e-9", "--json")
    note = claims_of(late)["note"]
    assert late.json["rows"][0]["measured"] is None and (note["of"], "budget ended" in note["text"]) == ("unknown", True)
    never = claims_of(hooke("limit", scene, "--methods", "forward-euler", "--predict", "--json"))["limit"]
    assert never["text"] == "at t = 0 s, forward-euler is stable at no step"
    along = hooke("limit", write(SIX_PARTICLES), "--along", "--methods", "verlet", "--json")
    row, claim = along.json["rows"][0], along.json["claims"][0]
    assert (claim["key"], claim["of"]) == ("along", "part")
    assert f"verlet is {row['smallest']:.6g} s, at t = {row['smallest_time']:.6g} s" in claim["text"]


def test_usage(hooke, write):
    scene = write(SIX_PARTICLES)
    assert hooke("limit").code == 2
    unknown = hooke("limit", scene, "--methods", "verlot")
    assert unknown.code == 2 and "verlet" in unknown.err
    hooke("limit", scene, "--methods", "verlet", "--method", "rk4", code=2, err="--method rk4 is none of --methods verlet")
    assert hooke("limit", scene, "--methods", "verlet,rk4", "--method", "rk4", "--predict").code == 0
    assert hooke("limit", scene, "--methods", "verlet", "--method", "rk4", "--along", "--duration", "0.1").code == 0
    assert hooke("limit", scene, "--predict=perhaps").code == 2
    assert hooke("limit", scene, "--accuracy", "2").code == 2
    assert hooke("limit", "missing.json").code == 3
    shown = hooke("limit", "--help", "all").out
    for flag in ("--predict", "--nonlinear", "--at FILE:FRAME", "--along", "--budget NUMBER", "--accuracy NUMBER"):
        assert flag in shown
    bare = copy.deepcopy(SIX_PARTICLES)
    del bare["run"]["duration"]
    assert hooke("limit", write(bare), "--along").code == 2
    assert hooke("limit", write(bare), "--predict").code == 0


def test_flags_can_be_false(hooke, write):
    scene = write(STIFF_PAIR)
    row = rows_of(hooke("limit", scene, "--predict=false", "--methods", "verlet", "--json"))["verlet"]
    assert 0.98 < row["ratio"] < 1.02
