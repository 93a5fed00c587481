"""What `run --want`, `study --want` and `needs` recommend: clear of stability limits, from a displaced start as well,
the same from all of them, and whatever a clock says."""

import copy
import json
import math
import os
import random
import re
import shlex

import pytest

pytestmark = pytest.mark.everything

WANT = 1e-3
STABLE = 0.9 * (1 + 1e-9)  # of the limit, at most


def displaced(scene, particle, velocity=1e-12):
    """At a velocity [m/s] along x."""
    scene = copy.deepcopy(scene)
    scene["particles"].setdefault("velocity", [[0, 0, 0] for _ in scene["particles"]["position"]])[particle][0] += velocity
    return scene


def scene_of(positions, pinned, springs, run, **more):
    return {"hooke": 1, "particles": {"position": positions, "mass": 1, "pinned": pinned}, "springs": springs, "run": run, **more}


# A mass between two walls, pulled sideways: its exact motion never excites the springs along their length.
WALLS = scene_of([[-1, 0, 0], [0, 0, 0], [1, 0, 0]], [0, 2],
                 [{"between": [[0, 1], [1, 2]], "law": "length", "stiffness": 1e6, "rest_length": 1}], {"duration": 2, "every": 0.02})  # fmt: skip
WALLS["particles"]["velocity"] = [[0, 0, 0], [0, 0.3, 0], [0, 0, 0]]
WALLS_LIMIT = 2 / math.sqrt(2e6)

# A stiff bar falls beside a slow spring.
BAR = scene_of([[0, 0, 0], [1, 0, 0], [3, 0, 0], [3, -1, 0]], [2],
               [{"name": "bar", "between": [[0, 1]], "law": "length", "stiffness": 1e7, "rest_length": 1},
                {"name": "slow", "between": [[2, 3]], "law": "length", "stiffness": 20, "rest_length": 1}],
               {"duration": 1, "every": 0.02}, gravity=[0, -9.81, 0])  # fmt: skip


def settings(value):
    return {key: value[key] for key in ("method", "step", "rtol", "atol") if value.get(key) is not None}


def words_of(command):
    return shlex.split(command)[1:]


def final(answer):
    assert answer.code == 0, answer.err
    assert answer.json["status"] == "finished"
    return answer.json["final"]["position"]


def apart(a, b):
    return max(math.dist(x, y) for x, y in zip(a, b))


def options(chosen):
    return [word for name, value in settings(chosen).items() for word in ("--" + name, str(value))]


def holds_from(hooke, write, scene, moved, chosen, want=WANT):
    """The recommended run stays within the want from a displaced start."""
    words = [*options(chosen), "--json", "--final", "--no-estimate"]
    straight, beside = (
        final(hooke("run", write(one, name), *words)) for one, name in ((scene, "it.json"), (moved, "moved.json"))
    )
    assert apart(straight, beside) <= want


@pytest.mark.parametrize("methods", [[], ["symplectic-euler"], ["rk4"]], ids=str)
@pytest.mark.parametrize("scene, particle", [(WALLS, 1), (BAR, 0)], ids=["walls", "bar"])
def test_a_run_is_clear_of_a_limit_that_its_start_does_not_show(hooke, write, scene, particle, methods):
    name = write(scene)
    run = hooke("run", name, "--want", WANT, "--json", *[word for method in methods for word in ("--method", method)])
    assert run.code == 0, run.err
    chosen = run.json
    if "step" in chosen:
        limits = {row["method"]: row["predicted"] for row in hooke("limit", name, "--predict", "--json").json["rows"]}
        assert chosen["step"] <= STABLE * limits[chosen["method"]]
    if scene is WALLS and chosen["method"] == "symplectic-euler":
        assert 0.3 * WALLS_LIMIT < chosen["step"] <= STABLE * WALLS_LIMIT
    holds_from(hooke, write, scene, displaced(scene, particle), chosen)


@pytest.mark.parametrize("scene", [WALLS, BAR], ids=["walls", "bar"])
def test_a_study_recommends_what_a_run_picks(hooke, write, scene):
    """With few rows and a small budget: neither takes part in the choice."""
    name = write(scene)
    picked = settings(hooke("run", name, "--want", WANT, "--json").json)
    study = hooke("study", name, "--want", WANT, "--json", "--tolerances", "1e-3", "--steps", "1e-3")
    assert study.code == 0, study.err
    recommended = study.json["recommendation"]
    assert recommended["met"] is True and recommended["until"] == scene["run"]["duration"]
    assert recommended["wall_median"] >= recommended["wall_seconds"] > 0
    assert settings(recommended) == picked
    again = hooke(*words_of(recommended["command"]), "--json").json
    assert settings(again) == picked and again["force_evaluations"] == recommended["force_evaluations"]


def test_a_rope_that_comes_to_rest_is_cheap(hooke, write):
    """Its explicit limit is 2.5e-8 of its time: what creeps takes no steps of that."""
    rope = {"hooke": 1, "gravity": [0, -9.81, 0], "dynamics": "overdamped", "drag": 1,
            "parts": [{"kind": "rope", "name": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 10, "mass": 0.1,
                       "pinned": ["start", "end"], "stretch": {"stiffness": 1e6}}],
            "run": {"duration": 1000, "every": 100}}  # fmt: skip
    answer = hooke("run", write(rope), "--want", "1mm", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["want"]["met"] is True
    assert 0 < answer.json["force_evaluations"] < 1000
    assert answer.json["want"]["seconds"] < 10  # [s]; 0.05 on an idle machine


@pytest.mark.parametrize("verb, option", [("run", "--method"), ("study", "--methods")])
def test_a_method_that_is_never_stable_is_not_recommended(hooke, write, verb, option):
    spring = {"between": [[0, 1]], "law": "length", "stiffness": 100, "rest_length": 1}
    name = write(scene_of([[0, 0, 0], [1.1, 0, 0]], [0], [spring], {"duration": 10, "every": 0.1}))
    answer = hooke(verb, name, option, "forward-euler", "--want", "1mm")
    assert answer.code == 7, answer.err
    said = " ".join((answer.out + answer.err).split())
    assert re.search("no step that is stable here|no run of these methods is clear of its stability limit", said)
    assert "hooke run " not in answer.out


# ---- needs ----

# A column of three masses on a foot, held from four sides, which its own weight would fold.
POINTS = [[0, 0, 0], *[[x, y, z] for x, z in [(0, 0), (-1, 0), (1, 0), (0, 1), (0, -1)] for y in (1, 2, 3)]]
COLUMN = scene_of(POINTS, [0, *range(4, 16)],
                  [{"name": "column", "between": [[0, 1], [1, 2], [2, 3]], "stiffness": 5000},
                   {"name": "side", "between": [[k, 3 * side + k] for side in (1, 2, 3, 4) for k in (1, 2, 3)], "stiffness": 200}],
                  {"duration": 3, "every": 0.05}, gravity=[0, -9.81, 0], drag=0.5)  # fmt: skip


def test_what_holds_a_column_upright_is_needed(hooke, write):
    """The exact start is in balance without its sides, too."""
    answer = hooke("needs", write(COLUMN), "--want", "1cm", "--json", "-o", "lean.json")
    assert answer.code == 0, answer.err
    side = next(row for row in answer.json["rows"] if row["without"] == "side")
    assert side["needed"] is True and side["error"] > 1 and "displaced" in side["note"]
    alone = copy.deepcopy(COLUMN)
    alone["springs"].pop()
    words = ["--step", 1e-3, "--method", "verlet", "--json", "--final", "--no-estimate"]
    straight = [final(hooke("run", write(one), *words))[1:4] for one in (COLUMN, alone)]
    assert apart(*straight) < 1e-2, "the exact start does not show what the sides hold"
    assert apart(straight[1], final(hooke("run", write(displaced(alone, 2, 1e-4)), *words))[1:4]) > 1


def limits_along(hooke, path):
    """The least limit of each method at any frame."""
    return {row["method"]: row["smallest"] for row in hooke("limit", path, "--along", "--predict", "--json").json["rows"]}


@pytest.mark.parametrize("scene, want", [(WALLS, "1mm"), (BAR, "1mm"), (COLUMN, "1cm")], ids=["walls", "bar", "column"])
def test_a_lean_run_is_clear_of_its_limit(hooke, write, tmp_path, scene, want):
    for method in ("symplectic-euler", "verlet", "rk4"):
        answer = hooke("needs", write(scene), "--want", want, "--method", method, "-o", "lean.json")
        assert answer.code == 0, answer.err
        lean = json.loads((tmp_path / "lean.json").read_text())
        assert lean["run"]["method"] == method
        assert lean["run"]["step"] <= STABLE * limits_along(hooke, "lean.json")[method], method
        assert hooke("run", "lean.json").code == 0


# ---- random scenes ----


def random_scene(seed):
    """Six particles, of which one is pinned, in a tree and a few springs more; some are stiff."""
    draw = random.Random(seed)
    position = [[draw.uniform(-1, 1) for _ in range(3)] for _ in range(6)]
    pairs = {(draw.randrange(k), k) for k in range(1, 6)} | {tuple(sorted(draw.sample(range(6), 2))) for _ in range(4)}
    springs = [{"between": [list(pair)], "law": "length", "stiffness": 10 ** draw.uniform(1, 5), "damping": draw.choice([0, 0.5]),
                "rest_scale": draw.choice([1, 1, 0.95])} for pair in sorted(pairs)]  # fmt: skip
    return scene_of(position, [0], springs, {"duration": 0.4, "every": 0.02}, gravity=[0, -9.81, 0])


def moved_by_rounding(scene):
    extent = math.dist(*[[fold(p[a] for p in scene["particles"]["position"]) for a in range(3)] for fold in (min, max)])
    scene, draw = copy.deepcopy(scene), random.Random(1)
    for point in scene["particles"]["position"]:
        point[:] = [x + draw.choice([-1, 1]) * 1e-12 * extent for x in point]
    return scene


@pytest.mark.check
@pytest.mark.parametrize("seed", range(3))
def test_recommended_runs_end_from_a_displaced_start(hooke, write, tmp_path, seed):
    scene = random_scene(seed)
    name, moved = write(scene), write(moved_by_rounding(scene), "moved.json")
    run = hooke("run", name, "--want", "1cm", "--json")
    assert run.code == 0, run.err
    study = hooke(
        "study", name, "--want", "1cm", "--json", "--tolerances", "1e-3", "--steps", "1e-3", "--methods", "rk4,cvode-adams"
    )
    assert study.code == 0, study.err
    for chosen in (run.json, study.json["recommendation"]):
        assert hooke("run", moved, *options(chosen), "--no-estimate").code == 0
    assert hooke("needs", name, "--want", "1cm", "--method", "verlet", "-o", "lean.json").code == 0
    lean = json.loads((tmp_path / "lean.json").read_text())
    assert hooke("run", write(moved_by_rounding(lean), "moved.json"), "--no-estimate").code == 0


# ---- clocks ----

# and how often runs are repeated for their time
TIMES = {"runs", "spread", "wall_seconds", "wall_median", "seconds", "repeats", "times_less", "other_seconds", "step_nanoseconds"}
JUMPING = os.environ.get("HOOKE_JUMPING_CLOCK")


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(one) for key, one in value.items() if key not in TIMES}
    return [without_times(one) for one in value] if isinstance(value, list) else value


# Velocities reverse at each step, which a look at the first steps tells.
DAMPED = scene_of([[0, 0, 0], [1.01, 0, 0], [2, 0, 0]], [0],
                  [{"between": [[0, 1], [1, 2]], "law": "length", "stiffness": 1, "rest_length": 1, "damping": 10}],
                  {"method": "symplectic-euler", "step": 0.0625, "duration": 20, "every": 0.125})  # fmt: skip
DAMPED["particles"]["velocity"] = [[0, 0, 0], [0.5, 0, 0], [0, 0, 0]]
RUN = ("run", "--want", "1mm", "--final")
STUDY = ("study", "--want", "1mm", "--methods", "verlet,rk4,cvode-adams", "--tolerances", "1e-3", "--steps", "2e-3,1e-3")
NEEDS = ("needs", "--want", "1cm")
MARGIN = ("stability", "stiffness", "start")


@pytest.mark.skipif(not JUMPING, reason="nothing can be loaded before this program")
@pytest.mark.parametrize(
    "scene, words", [(DAMPED, ("run",)), *((scene, words) for scene in (WALLS, random_scene(1)) for words in (RUN, STUDY, NEEDS))]
)
@pytest.mark.check
def test_no_answer_depends_on_a_clock(hooke, write, scene, words):
    """On one that jumps 1000 s ahead at every reading. The margin of a study has a limited time."""
    verb, *rest = words
    found = []
    for environment in ({}, {"LD_PRELOAD": JUMPING}):
        answer = hooke(verb, write(scene), *rest, "--json", env={**os.environ, **environment})
        assert answer.code == 0, answer.err
        value = answer.json
        if verb == "study":
            value["recommendation"].update(margin=None, note=None)
            value["claims"] = [claim for claim in value["claims"] if claim["key"] not in MARGIN]
        value["claims"] = [claim for claim in value["claims"] if claim["by"] != "clock"]
        found.append((value, answer))
    assert without_times(found[0][0]) == without_times(found[1][0])
    assert found[0][1].out != found[1][1].out, "the clock is not used at all"
