"""Rigid bodies in scenes: check, run, resume and verify, the schema, and the scene written again."""

import json
from pathlib import Path

import h5py
import jsonschema
import numpy as np
import pytest
from conftest import LONG

SCHEMA = Path(__file__).resolve().parents[2] / "examples/scene.schema.json"

pytestmark = pytest.mark.everything

BOARD = json.loads((Path(__file__).resolve().parents[1] / "data/board.json").read_text())


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


def positions(hooke, scene, path, *options):
    assert hooke("run", scene, "-o", path, *options).code == 0
    with h5py.File(path) as file:
        return file["particles/all/position/value"][:]


def distance(one, other):
    """The largest of a particle at any frame."""
    return np.sqrt(((one - other) ** 2).sum(axis=2)).max()


@pytest.mark.check
@LONG
@pytest.mark.parametrize("method", [None, "verlet", "symplectic-euler", "cvode-bdf"])
def test_a_wanted_error_is_kept(hooke, scene, tmp_path, method):
    fine = positions(hooke, scene, tmp_path / "fine.h5", "--method", "rk4", "--step", "1e-5")
    free = np.abs(fine - fine[0]).max(axis=(0, 2)) > 0
    for want in (1e-3, 1e-5):
        options = ["--want", repr(want), *(["--method", method] if method else [])]
        told = hooke("run", scene, *options, "-o", tmp_path / "run.h5", "--json")
        with h5py.File(tmp_path / "run.h5") as file:
            found = distance(file["particles/all/position/value"][:, free], fine[:, free])
        assert told.code == 0 and told.json["want"]["wanted"] == want, told.err
        told = told.json["error"]["estimate"]  # against a reference that is good for a tenth of the want
        assert 1e-8 < found <= told <= want and told <= found + 0.1 * want


def test_needs_takes_bodies(hooke, scene, tmp_path):
    told = hooke("needs", scene, "--want", "3mm", "-o", tmp_path / "lean.json", "--json").json
    rows = {row["without"]: row for row in told["rows"]}
    assert rows["ropes"]["needed"] and rows["gravity"]["needed"] and not rows["damping"]["needed"]
    assert "would lose particles" in rows["half the resolution of bar"]["note"]
    assert not [name for name in rows if name.startswith("deformation")]  # all parts are bodies already
    assert told["lean"]["without"] == ["damping", "half the resolution of box"]
    full = positions(hooke, scene, tmp_path / "full.h5", "--method", "rk4", "--step", "1e-5")
    lean = positions(hooke, tmp_path / "lean.json", tmp_path / "lean.h5")
    board = slice(0, 4)  # the first particles of the lean scene, too
    assert 1e-4 < distance(full[:, board], lean[:, board]) < 3e-3
    scene.write_text(json.dumps({**BOARD, "parts": [{**BOARD["parts"][0], "rigid": False}, BOARD["parts"][1]]}))
    names = [row["without"] for row in hooke("needs", scene, "--want", "1mm", "--json").json["rows"]]
    assert [name for name in names if name.startswith("deformation")] == ["deformation of box"]


def test_cost_takes_bodies(hooke, scene):
    told = hooke("check", scene, "--cost", "--json").json["cost"]
    assert told["nanoseconds"] > 0 and [row["ingredient"] for row in told["rows"]] == ["ropes", "damping", "gravity"]
    assert all(row["nanoseconds"] >= 0 and row["memory_bytes"] >= 0 for row in told["rows"])
    limit = hooke("limit", scene, "--methods", "verlet", "--predict", "--json").json["rows"][0]["predicted"]
    assert told["step_limit"] == pytest.approx(limit, rel=1e-3)


@pytest.mark.check
@LONG
def test_an_ensemble_starts_bodies_elsewhere(hooke, tmp_path):
    """A bar that hangs from a bar, of which nobody can tell for long where they are, keeps its energy."""
    linkage = {
        "hooke": 1,
        "gravity": [0, -9.81, 0],
        "particles": {
            "position": [[0, 0, 0], [0.6, 0.05, 0], [0.3, 0.1, 0.05], [0.62, 0.05, 0], [1.1, 0.3, 0.1], [0.9, 0.1, -0.1]],
            "mass": 0.5, "pinned": [0]},
        "bodies": [{"particles": [0, 1, 2]}, {"particles": [3, 4, 5]}],
        "springs": [{"between": [[1, 3]], "stiffness": 200}],
        "run": {"method": "rk4", "duration": 5, "every": 0.05},
    }
    (tmp_path / "linkage.json").write_text(json.dumps(linkage))
    words = ["--methods", "rk4", "--steps", "1ms", "--want", "1e-7m", "--ensemble", "3", "--budget", "20s", "--json"]
    found = hooke("study", tmp_path / "linkage.json", *words).json["statistics"]
    (energy,) = [quantity["reference"] for quantity in found["quantities"] if quantity["quantity"] == "energy"]
    start = 0.5 * 9.81 * (0.05 + 0.1 + 0.05 + 0.3 + 0.1)
    assert energy["members"] >= 2 and energy["failed"] == 0
    assert energy["mean"] == pytest.approx(start, rel=1e-6) and 1e-10 < energy["spread"] < 1e-6


def test_what_does_not_know_bodies_says_so(hooke, scene):
    told = hooke("run", scene, "--method", "shardlow")
    assert told.code != 0 and "shardlow does not know rigid bodies yet" in told.err


def test_limit_and_why_know_bodies(hooke, scene):
    told = hooke("limit", scene, "--methods", "symplectic-euler,verlet,rk4", "--json").json
    assert [row["ratio"] for row in told["rows"]] == pytest.approx([1, 1, 1], abs=1e-3)
    assert [row["bound"] for row in told["rows"]] == [None] * 3
    assert told["tipping"] == 1  # the bar, which begins above its pin
    assert {one["group"] for one in told["blame"]} == {"ropes"}
    words = hooke("limit", scene, "--predict").out
    assert "rigid bodies tipped over by gravity or tensions: 1;" in " ".join(words.split()) and "shardlow" not in words
    stiff = {**BOARD["springs"][0], "stiffness": 2e5}
    scene.write_text(json.dumps({**BOARD, "springs": [stiff]}))
    limit = hooke("limit", scene, "--methods", "verlet", "--predict", "--json").json["rows"][0]["predicted"]
    blown = hooke("run", scene, "--step", "0.0025", "--duration", "5", "--every", "0.1")
    assert blown.code == 4
    assert "group ropes" in hooke("why", scene, "--step", "0.0025", "--duration", "5", "--every", "0.1").out
    said = float(blown.err.split("is above ")[1].split(" s,")[0])
    assert said == pytest.approx(limit, rel=0.01) and said < 0.0025


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


@pytest.mark.parametrize("size, runs", [(2.0**-300, False), (2.0**-120, True), (2.0**120, True), (2.0**300, False)])
def test_a_body_has_a_size_to_calculate_with(hooke, write, size, runs):
    """The motion has no scale of length; where the sixth powers of a body's size are no numbers, it is refused."""
    rows = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 1, 0], [3, 0, 1]]
    scene = {
        "hooke": 1,
        "gravity": [0, -9.81 * size, 0],
        "particles": {"position": [[size * x for x in row] for row in rows], "mass": 1, "pinned": [0]},
        "bodies": [{"particles": [1, 2, 3, 4]}],
        "springs": [{"between": [[0, 1]], "law": "length", "stiffness": 100}],
        "run": {"method": "rk4", "step": 0.01, "duration": 1, "every": 0.1},
    }
    answer = hooke("run", write(scene), "--json", "--final", "--no-estimate")
    if not runs:
        assert answer.code == 3 and "radius of gyration" in answer.err and "1e-50 to 1e+50 m" in answer.err
        return
    one = hooke("run", write(scene | {"gravity": [0, -9.81, 0], "particles": {"position": rows, "mass": 1, "pinned": [0]}}, "one.json"),
                "--json", "--final", "--no-estimate")  # fmt: skip
    for here, there in zip(answer.json["final"]["position"], one.json["final"]["position"]):
        assert [x / size for x in here] == pytest.approx(there, rel=1e-9, abs=1e-9)
