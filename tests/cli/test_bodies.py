"""Rigid bodies in scenes: check, run, resume and verify, the schema, and the scene written again."""

import json
from pathlib import Path

import h5py
import jsonschema
import numpy as np
import pytest

SCHEMA = Path(__file__).resolve().parents[2] / "examples/scene.schema.json"

pytestmark = pytest.mark.everything

BOARD = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "particles": {
        "position": [[0, 0, 0], [0.4, 0, 0], [0.4, 0, 0.2], [0, 0, 0.2], [0, 1, 0], [0.4, 1, 0.2]],
        "velocity": [[0, 0, 0.5], [0, 0, 0.5], [0, 0, 0.5], [0, 0, 0.5], [0, 0, 0], [0, 0, 0]],
        "mass": 0.25,
        "pinned": [4, 5],
    },
    "springs": [{"name": "ropes", "between": [[0, 4], [2, 5], [0, 2]], "stiffness": 200, "damping": 0.5}],
    "parts": [
        {"kind": "lattice", "name": "box", "origin": [2, 0, 0], "size": [2, 2, 3], "mass": 1, "rigid": True,
         "edges": [[0.2, 0, 0], [0, 0.3, 0], [0, 0, 0.4]], "structural": {"stiffness": 50}},
        {"kind": "rope", "name": "bar", "from": [5, 0, 0], "to": [6, 0.5, 0], "segments": 4, "mass": 1,
         "pinned": "start", "stretch": {"stiffness": 10}},
    ],
    "bodies": [{"name": "board", "particles": [0, 1, 2, 3]}, {"part": "bar"}],
    "run": {"method": "verlet", "step": 0.001, "duration": 0.2, "every": 0.01},
}


@pytest.fixture
def scene(tmp_path):
    path = tmp_path / "board.json"
    path.write_text(json.dumps(BOARD))
    return path


def test_check_counts_bodies(hooke, scene):
    told = hooke("check", scene, "--json").json
    assert (told["bodies"], told["springs"], told["warnings"]) == (3, 2, [])
    assert told["inside_bodies"] == 1 + 20 + 4 and told["dropped_springs"] == 0
    assert told["step_limit"]["verlet"] is None
    words = hooke("check", scene).out
    assert "bodies       3 rigid; 25 springs and other members of forces inside them dropped" in words
    assert "4 board" in words and "12 box" in words


def test_a_run_is_repeated_and_continued(hooke, scene, tmp_path):
    for method in ("verlet", "rk4", "tr-bdf2", "cvode-adams"):
        whole, parts = tmp_path / f"{method}.h5", tmp_path / f"{method}-parts.h5"
        assert hooke("run", scene, "--method", method, "--checkpoint", "0.05", "-o", whole).code == 0
        assert "agrees" in hooke("verify", whole, "--all").out
        short = ["--checkpoint", "0.05", "--duration", "0.1"]
        assert hooke("run", scene, "--method", method, *short, "-o", parts).code == 0
        with h5py.File(whole) as one, h5py.File(parts) as other:
            q = one["particles/all/position/value"][:]
            if method != "cvode-adams":  # whose first step depends on the duration
                assert np.array_equal(other["particles/all/position/value"][:], q[:11])
        for body in ([0, 1, 2, 3], range(6, 18)):  # distances stay
            for frame in (5, 20):
                before, now = (np.linalg.norm(x[body, None] - x[None, body], axis=-1) for x in (q[0], q[frame]))
                assert np.abs(now - before).max() < 1e-14 and np.abs(q[frame] - q[0])[body].max() > 1e-3


def test_measurements_say_that_they_do_not_know_bodies(hooke, scene):
    for words in (["limit"], ["needs", "--want", "1cm"], ["run", "--want", "1cm"], ["check", "--cost"]):
        told = hooke(words[0], scene, *words[1:])
        assert told.code != 0 and "rigid bodies yet" in told.err
    told = hooke("run", scene, "--method", "shardlow")
    assert told.code != 0 and "shardlow does not know rigid bodies yet" in told.err


def test_a_study_has_the_orders(hooke, scene):
    told = hooke("study", scene, "--methods", "symplectic-euler,verlet,rk4,tr-bdf2", "--duration", "0.5", "--json").json
    orders = {method: row["order"] for method, row in told["orders"].items()}
    assert orders == pytest.approx({"symplectic-euler": 1, "verlet": 2, "rk4": 4, "tr-bdf2": 2}, abs=0.15)
    refused = hooke("study", scene, "--methods", "shardlow")
    assert refused.code != 0 and "shardlow does not know rigid bodies yet" in refused.err
    named = list(hooke("study", scene, "--duration", "0.02", "--json", "--budget", "2").json["orders"])
    explicit = ["forward-euler", "symplectic-euler", "verlet", "heun", "rk4"]
    assert named == [*explicit, "backward-euler", "tr-bdf2", "implicit-midpoint"]


def test_the_schema_knows_bodies():
    schema = json.loads(SCHEMA.read_text())
    validator = jsonschema.Draft202012Validator(schema)
    assert not list(validator.iter_errors(BOARD))
    for wrong in ({"part": "bar", "particles": [0]}, {"name": "none"}, {"particles": []}, {"part": 1}):
        assert list(validator.iter_errors({**BOARD, "bodies": [wrong]}))


@pytest.mark.parametrize(
    "body, words",
    [
        ({"part": "none"}, 'bodies[1].part: there is no part "none"'),
        ({"name": "none"}, "bodies[1].particles: is required but missing"),
        ({"part": "bar", "particles": [0]}, "bodies[1].part: is given beside particles"),
        ({"particles": [["box", 0]]}, 'bodies[1]: particle 6 is already in the body "box"'),
        ({"particles": [9999]}, "bodies[1].particles[0]: there is no particle 9999"),
    ],
)
def test_a_bad_body_is_named(hooke, scene, body, words):
    scene.write_text(json.dumps({**BOARD, "bodies": [BOARD["bodies"][0], body]}))
    told = hooke("check", scene)
    assert told.code == 3 and words in told.err
