"""Recommended runs of `run --want`, `study --want` and `needs`: they repeat, hold and know every limit."""

import json
import math
import os
import random
import re
import shlex

import pytest

pytestmark = pytest.mark.everything

# A clock that jumps: whatever is chosen by it comes out another way.
JUMPY = {**os.environ, "LD_PRELOAD": os.environ.get("HOOKE_PROCESSOR_CLOCK", ""), "HOOKE_CLOCK_TIMES": "1000000"}
TIMES = {"wall_seconds", "wall_median", "seconds", "repeats", "runs", "spread", "timed_alone", "times_less", "other_seconds"}

# One mass between two walls, pulled sideways: nothing moves along its springs, whose limit is 2/sqrt(2 k/m).
WALLS = {
    "hooke": 1,
    "particles": {"position": [[-1, 0, 0], [0, 0, 0], [1, 0, 0]], "velocity": [[0, 0, 0], [0, 0.3, 0], [0, 0, 0]],
                  "mass": 1, "pinned": [0, 2]},
    "springs": [{"between": [[0, 1], [1, 2]], "law": "length", "stiffness": 1e6}],
    "run": {"duration": 2, "every": 0.02},
}  # fmt: skip
# A stiff bar that falls beside a slow spring.
BAR = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "particles": {"position": [[0, 0, 0], [1, 0, 0], [3, 0, 0], [3, -1, 0]], "mass": 1, "pinned": [2]},
    "springs": [{"between": [[0, 1]], "law": "length", "stiffness": 1e7},
                {"between": [[2, 3]], "law": "length", "stiffness": 30}],
    "run": {"duration": 1, "every": 0.05},
}  # fmt: skip
# A pendulum, which explicit methods without damping are stable for at no step.
PENDULUM = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "particles": {"position": [[0, 0, 0], [0.8, -0.6, 0]], "mass": 1, "pinned": [0]},
    "springs": [{"between": [[0, 1]], "stiffness": 500}],
    "run": {"duration": 0.5, "every": 0.05},
}


def words_of(command):
    return shlex.split(command)[1:]


def bare(value):
    """Without times."""
    if isinstance(value, dict):
        return {key: bare(one) for key, one in value.items() if key not in TIMES}
    return [bare(one) for one in value] if isinstance(value, list) else value


def displaced(scene, extent=1e-12):
    """The free particles, as `--want` has run them: at random, a start that only rounding would tell from the exact one."""
    generator, moved = random.Random(1), json.loads(json.dumps(scene))
    particles = moved["particles"]
    for p, row in enumerate(particles["position"]):
        if p not in particles.get("pinned", []):
            particles["position"][p] = [x + extent * generator.uniform(-1, 1) for x in row]
    for group in moved["springs"]:  # rest lengths stay
        ends = [[scene["particles"]["position"][k] for k in pair] for pair in group["between"]]
        group["rest_length"] = [math.dist(*pair) for pair in ends]
    return moved


@pytest.mark.parametrize("scene, limit", [(WALLS, 2 / math.sqrt(2e6)), (BAR, 2 / math.sqrt(2e7))], ids=["walls", "bar"])
def test_what_the_start_does_not_excite_limits_the_step(hooke, write, scene, limit):
    path = write(scene)
    explicit = ["--methods", "symplectic-euler,verlet"]
    study = hooke("study", path, "--want", "1mm", "--json", *explicit).json["recommendation"]
    assert study["met"] is True and 0.3 * limit < study["step"] <= 0.9 * limit * (1 + 1e-9)
    near = write(displaced(scene), "near.json")
    command = ["near.json" if word.endswith("scene.json") else word for word in words_of(study["command"])]
    ends = [hooke(*words, "--json", "--final") for words in (words_of(study["command"]), command)]
    assert near and [end.code for end in ends] == [0, 0], ends[1].err
    here, there = (end.json["final"]["position"] for end in ends)
    assert max(map(math.dist, here, there)) < 1e-6
    run = hooke("run", path, "--method", study["method"], "--want", "1mm", "--json").json
    assert run["want"]["met"] is True and run["step"] <= 0.9 * limit * (1 + 1e-9)


@pytest.mark.parametrize("scene", [WALLS, BAR, PENDULUM], ids=["walls", "bar", "pendulum"])
def test_a_study_recommends_what_a_run_picks(hooke, write, scene):
    path = write(scene)
    study = hooke("study", path, "--want", "1mm", "--json").json["recommendation"]
    run = hooke("run", path, "--want", "1mm", "--json").json
    assert study["met"] is True and run["want"]["met"] is True
    assert [study[key] for key in ("method", "step", "rtol")] == [run.get(key) for key in ("method", "step", "rtol")]


@pytest.mark.skipif(not os.environ.get("HOOKE_PROCESSOR_CLOCK"), reason="there is no clock to preload here")
@pytest.mark.parametrize("words", [["run"], ["study", "--methods", "symplectic-euler,rk4,cvode-adams"], ["needs"]], ids=lambda words: words[0])
def test_no_clock_decides(hooke, write, words):
    path = write(PENDULUM)
    asked = [words[0], path, *words[1:], "--want", "1mm", "--json"]
    calm, jumpy = hooke(*asked), hooke(*asked, env=JUMPY)
    assert (calm.code, bare(calm.json)) == (jumpy.code, bare(jumpy.json))
    assert calm.code == 0


def test_a_want_in_a_stiff_scene_ends(hooke, write):
    """An overdamped rope that comes to rest: explicit steps would be 1e-8 s long, of 1000 s."""
    scene = {
        "hooke": 1, "dynamics": "overdamped", "drag": 1, "gravity": [0, -9.81, 0],
        "parts": [{"kind": "rope", "name": "r", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 10, "mass": 0.1,
                   "pinned": ["start", "end"], "stretch": {"stiffness": 1e6}}],
        "run": {"duration": 1000, "every": 100},
    }  # fmt: skip
    answer = hooke("run", write(scene), "--want", "1mm", "--json")
    assert answer.code == 0 and answer.json["want"]["met"] is True
    assert answer.json["force_evaluations"] < 1000
    assert answer.json["error"]["by"] == "reference" and answer.json["error"]["known_until"] == pytest.approx(1000)


def test_no_step_is_recommended_where_none_is_stable(hooke, write):
    path = write(PENDULUM)
    study = hooke("study", path, "--methods", "forward-euler", "--want", "1mm", "--json")
    assert study.code == 7 and study.json["recommendation"]["met"] is False
    assert study.json["recommendation"]["command"] is None
    run = hooke("run", path, "--method", "forward-euler", "--want", "1mm")
    assert run.code == 3 and "no step that is stable" in run.err


# A stiff column stands on its foot, held from the side by faint springs, without which it falls over.
COLUMN = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "particles": {"position": [[0, 0, 0], [0, 1, 0], [2, 1, 0], [-2, 1, 0], [0, 1, 2], [0, 1, -2]], "mass": 1,
                  "pinned": [0, 2, 3, 4, 5]},
    "springs": [{"name": "column", "between": [[0, 1]], "law": "length", "stiffness": 1e4, "damping": 20, "rest_length": 1.00981},
                {"name": "side", "between": [[1, 2], [1, 3], [1, 4], [1, 5]], "law": "length", "stiffness": 40}],
    "run": {"method": "rk4", "duration": 3, "every": 0.05},
}  # fmt: skip


def test_needs_keeps_what_only_the_exact_start_does_without(hooke, write):
    found = hooke("needs", write(COLUMN), "--want", "1mm", "--json").json
    side = next(row for row in found["rows"] if row["without"] == "side")
    assert side["needed"] is True and "displaced" in side["note"] and side["error"] > 1e-3
    assert "side" not in found["lean"]["without"]


def test_a_lean_run_keeps_clear_of_its_limit(hooke, write, tmp_path):
    scene = json.loads(json.dumps(WALLS))
    scene["particles"]["position"].append([0, 3, 0])
    scene["particles"]["velocity"].append([0, 0, 0])
    scene["springs"].append({"name": "idle", "between": [[2, 3]], "stiffness": 1e-6})
    found = hooke("needs", write(scene), "--want", "1cm", "--method", "symplectic-euler", "--json", "-o", tmp_path / "lean.json").json
    assert found["lean"]["step"] <= 0.9 * 2 / math.sqrt(2e6) * (1 + 1e-9)
    assert hooke("run", tmp_path / "lean.json", "--json").code == 0


def random_scene(seed):
    """Springs between a few particles in a box, one of them held, some stiff, some damped."""
    generator = random.Random(seed)
    count = generator.randint(3, 6)
    pairs = [[k, k + 1] for k in range(count - 1)] + [[0, count - 1]]
    return {
        "hooke": 1,
        "gravity": [0, -9.81, 0],
        "particles": {"position": [[generator.uniform(0, 1) for _ in range(3)] for _ in range(count)],
                      "mass": [10 ** generator.uniform(-2, 0) for _ in range(count)], "pinned": [0]},
        "springs": [{"between": [pair], "stiffness": 10 ** generator.uniform(1, 5), "damping": generator.choice([0, 0.05, 1])}
                    for pair in pairs],
        "run": {"duration": 0.2, "every": 0.02},
    }  # fmt: skip


@pytest.mark.parametrize("seed", range(6))
def test_recommended_commands_run_from_a_displaced_start(hooke, write, seed):
    scene = random_scene(seed)
    write(displaced(scene), "near.json")
    answer = hooke("study", write(scene), "--want", "1mm", "--json")
    command = answer.json["recommendation"]["command"]
    assert answer.code == 0, answer.json["recommendation"]["note"]
    words = words_of(re.sub(r"\S*scene\.json", "near.json", command))
    assert hooke(*words, "--json").code == 0, command
