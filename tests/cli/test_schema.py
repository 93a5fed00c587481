"""The schema of scenes compared with the examples, the faulty scenes, and the library's own option tables."""

import json
import os
import pathlib

import jsonschema
import pytest
from bad_scenes import BAD
from conftest import CLI  # noqa: F401  (fails early without the program)

pytestmark = pytest.mark.everything

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SCHEMA = json.loads((SOURCE / "examples" / "scene.schema.json").read_text())
EXAMPLES = sorted((SOURCE / "examples" / "scenes").glob("*.json"))
VALIDATOR = jsonschema.Draft202012Validator(SCHEMA)

LIBRARY = os.environ.get("HOOKE_LIBRARY", "")
LOADABLE = LIBRARY and b"__asan_init" not in pathlib.Path(LIBRARY).read_bytes()

# Faulty scenes that a schema cannot detect: combinations, existence, integers written with a point.
BEYOND_A_SCHEMA = {
    "bending-of-no-length", "between-range", "between-real", "between-same", "curve-falls",
    "curve-of-the-other-law", "curve-order", "curve-rows", "damping-of-group-count", "damping-of-group-huge",
    "density-of-no-length", "driven-pinned", "driven-range", "driven-twice", "factors-of-part", "file-missing", "file-not-hdf5", "lattice-flat",
    "lattice-huge", "lattice-of-no-length", "lattice-pinned-range", "mass-count", "mesh-corners", "mesh-crowded",
    "mesh-file-missing", "mesh-file-scene", "mesh-flat", "mesh-range", "mesh-twice", "mesh-unused", "mesh-welded",
    "name-of-group", "name-of-nothing", "name-of-part", "name-unknown", "part-index", "part-names", "part-pinned-range",
    "part-unknown", "pinned-moving", "pinned-name-unknown", "pinned-range", "pinned-real", "rest-length-coincident", "rest-scale-through-zero",
    "rope-of-no-length", "scale-times", "segments-real", "stiffness-count", "stiffness-scale-negative", "strand-flat", "strand-nearly-straight", "strand-of-no-length",
    "table-order", "table-rows", "velocity-rows",
}  # fmt: skip


def strict_json(text):
    """The value; None for a text that is no JSON or repeats a key."""

    def refuse(word):
        raise ValueError(word)

    def pairs(items):
        if len({key for key, _ in items}) != len(items):
            raise ValueError("a key twice")
        return dict(items)

    try:
        return json.loads(text.decode("utf-8"), parse_constant=refuse, object_pairs_hook=pairs)
    except ValueError:
        return None


def test_the_schema_is_one():
    jsonschema.Draft202012Validator.check_schema(SCHEMA)


def test_the_examples_are_there():
    names = {path.stem for path in EXAMPLES}
    assert names >= {
        "oscillator", "six-particles", "rope", "rope-resolution", "drag-or-damping", "cloth-16", "cloth-64", "stiff-spring",
        "cantilever", "lattice", "mesh", "curl",
    }  # fmt: skip


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_passes_schema_and_program(hooke, path):
    scene = strict_json(path.read_bytes())
    VALIDATOR.validate(scene)
    answer = hooke("check", path, "--json")
    assert (answer.code, answer.json["warnings"]) == (0, []), answer.err
    assert scene["title"] and {"step", "duration", "every"} <= set(scene["run"])


PLANE = {"shape": "plane", "point": [0, 0, 0], "normal": [0, 1, 0], "stiffness": "2 kN/m"}
BALL = {"shape": "sphere", "center": [0, 0, 0], "radius": "20cm", "stiffness": 1}
SWAYS = {"motion": "harmonic", "amplitude": [0, 1, 0], "frequency": 2}
TABLE = {"motion": "table", "time": [0, 1], "position": [[0, 0, 0], [1, 0, 0]]}


@pytest.mark.parametrize("right, obstacle", [
    (True, {**PLANE, "damping": 1, "friction": 0.3, "friction_speed": 0.01, "clearance": 0}),
    (True, {**BALL, **SWAYS, "phase": 1}), (True, {**BALL, **TABLE, "particles": [0]}),
    (True, {**BALL, "shape": "cylinder", "point": [0, 0, 0], "axis": [1, 0, 0], "center": None}),
    (False, {**PLANE, "radius": 1}), (False, {**PLANE, "normal": None}), (False, {**BALL, "normal": [0, 1, 0]}),
    (False, {**BALL, "radius": 0}), (False, {**PLANE, "stiffness": None}), (False, {**PLANE, "damping": -1}),
    (False, {**PLANE, "shape": "box"}), (False, {**PLANE, "name": "ground"}), (False, {**BALL, "amplitude": [0, 1, 0]}),
    (False, {**BALL, **SWAYS, "time": [0, 1]}), (False, {**BALL, **TABLE, "position": None}),
])
def test_obstacles_by_the_schema_and_the_program(hooke, tmp_path, right, obstacle):
    """The keys of a shape and of a motion; a key that is None here is left out."""
    scene = {"hooke": 1, "particles": {"position": [[0, 1, 0]], "mass": 1},
             "obstacles": [{key: value for key, value in obstacle.items() if value is not None}]}
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene))
    assert VALIDATOR.is_valid(scene) == right == (hooke("check", path).code == 0)


def test_bad_scenes_fail_the_schema_or_are_beyond_it():
    scenes = {name: strict_json(row[0].encode("latin1")) for name, row in BAD.items()}
    checked = {name: scene for name, scene in scenes.items() if scene is not None}
    assert len(checked) >= 70
    # numbers that Python reads as infinity or zero never reach the schema
    accepted = {name for name, scene in checked.items() if VALIDATOR.is_valid(scene)}
    assert accepted - {"huge-exponent", "tiny-exponent", "huge-integer", "nul-in-text"} == BEYOND_A_SCHEMA


# ---- the option tables ----


@pytest.mark.skipif(not LOADABLE, reason="needs a library that Python can load, without sanitizers")
def test_the_schema_is_that_of_the_tables():
    import schema

    assert schema.SCHEMA.read_text() == schema.laid_out(schema.schema()) + "\n", "python bindings/generate/schema.py writes it"


# ---- the purpose of the examples ----


def final(hooke, name, *options):
    answer = hooke("run", SOURCE / "examples" / "scenes" / f"{name}.json", "--json", "--final", *options)
    assert answer.code == 0, answer.err
    assert answer.json["status"] == "finished"
    return answer.json


@pytest.mark.parametrize("name", ["oscillator", "six-particles", "rope", "stiff-spring", "cloth-16"])
def test_example_runs(hooke, name):
    result = final(hooke, name)
    assert result["energy"]["final"] < result["energy"]["initial"]


def test_cloth_64_begins_to_run(hooke):
    assert final(hooke, "cloth-64", "--duration", "0.01")["time"] == pytest.approx(0.01, abs=1e-15)


def test_cloth_16_is_wrong_but_finite_with_forward_euler(hooke):
    forward = final(hooke, "cloth-16", "--method", "forward-euler")["final"]["position"]
    symplectic = final(hooke, "cloth-16")["final"]["position"]
    apart = max(abs(a - b) for p, q in zip(forward, symplectic) for a, b in zip(p, q))
    assert 0.005 < apart < 0.5


def test_cantilever_sinks_as_a_beam_does(hooke):
    tip = final(hooke, "cantilever")["final"]["position"][-1]
    assert -tip[1] == pytest.approx(0.1 * 9.81 / (8 * 13.6), rel=0.02)


def test_rope_resolution_tells_the_laws_apart(hooke):
    position = final(hooke, "rope-resolution")["final"]["position"]
    assert len(position) == 2 * (2 + 3 + 9 + 65)
    ends, at = [], 0
    for law in ("length", "strain"):
        for springs in (1, 2, 8, 64):
            at += springs + 1
            ends.append((law, springs, -position[at - 1][1] - 1))
    stretch = 0.1 * 9.81 / (2 * 5)  # half the weight over the stiffness, for a band of 1 m
    for law, springs, found in ends:
        if law == "strain":
            assert abs(found - stretch) < 1e-6 * stretch
        else:
            assert found == pytest.approx(springs * stretch, rel=5e-3)


def test_drag_slows_the_fall_and_damping_does_not(hooke):
    result = final(hooke, "drag-or-damping")["final"]
    speed = [-velocity[1] for velocity in result["velocity"]]
    free = 9.81 * 4
    assert speed[0] == pytest.approx(9.81 * (1 - 2.718281828459045**-4), rel=2e-3)
    assert speed[2] == pytest.approx(free, rel=1e-5)
    # both oscillations have decayed equally
    position = result["position"]
    light, heavy = (position[k + 1][0] - position[k][0] for k in (0, 2))
    assert 0.02 < light - 1 < 0.04
    assert abs(light - heavy) < 1e-6
