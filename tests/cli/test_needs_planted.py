"""Scenes with a planted ingredient that does nothing, and one that matters: `hooke needs` distinguishes them."""

import json

import h5py
import numpy as np
import pytest
from planted_scenes import SCENES

pytestmark = pytest.mark.everything

# scene: want [m], watched particles, unneeded, needed
PLANTED = {
    "flat-cloth": (2e-4, None, ["cloth.bend", "cloth.shear"], ["cloth.structural", "gravity"]),
    "only-falls": (1e-3, None, ["rope.stretch", "rope.bend", "damping"], ["gravity"]),
    "far-away": (1e-3, "rope", ["curtain", "curtain.structural", "curtain.shear", "half the resolution of curtain"],
                 ["rope.stretch", "gravity"]),
    "faint-drag": (1e-3, None, ["drag"], ["rod", "gravity"]),
    "short-beat": (5e-3, None, ["gravity"], ["pair"]),
    "taut-chain": (1e-3, None, ["resistance to compression"], ["rope.stretch", "gravity"]),
    "idle-net": (5e-3, None, ["7 springs that never pass"], ["net", "gravity"]),
    "pinned-marks": (2e-3, None, ["3 particles that touch nothing"], ["rod", "gravity"]),
    "smooth-rope": (1e-3, None, ["half the resolution of rope"], ["rope.stretch", "gravity"]),
    "damped-mass": (1e-3, None, ["drag"], ["damper", "damping"]),
    "shaken-rope": (1e-3, "rope", ["rope.bend", "twin"], ["rope.stretch", "damping"]),
    "free-sheet": (1e-3, "0-24", ["u", "v", "damping", "drag"], []),
    "hung-plate": (2e-3, None, ["deformation of plate", "half the resolution of plate"],
                   ["hangers", "plate.shear", "gravity"]),
    "pinned-cloth": (5e-3, None, ["195 springs that never pass"], ["cloth.structural", "cloth.shear", "gravity"]),
}


# Shapes of the grids of particles compared after halving the resolution, in the full scene.
GRIDS = {"flat-cloth": (7, 7), "only-falls": (17,), "smooth-rope": (41,), "taut-chain": (11,)}


def rows_called(rows, name):
    """A part has half its resolution, or less where that does."""
    coarser, _, part = name.partition("the resolution")
    if coarser == "half ":
        return [row for row in rows if row["kind"] == "resolution" and row["without"].endswith(part)]
    return [row for row in rows if row["without"] == name or row["without"].startswith(name + " ")]


def find(hooke, write, name, *options):
    want, watch, _, _ = PLANTED[name]
    watching = ["--watch", watch] if watch else []
    answer = hooke("needs", write(SCENES[name]), "--want", repr(want), *watching, *options, "--json")
    assert answer.code == 0, answer.err
    return answer.json


@pytest.mark.check
@pytest.mark.parametrize("name", sorted(PLANTED))
def test_what_does_nothing_is_found_and_what_counts_is_kept(hooke, write, name):
    want, _, unneeded, needed = PLANTED[name]
    found = find(hooke, write, name)
    for expected, ingredients in ((False, unneeded), (True, needed)):
        for ingredient in ingredients:
            rows = rows_called(found["rows"], ingredient)
            assert len(rows) == 1, (ingredient, [row["without"] for row in found["rows"]])
            assert rows[0]["needed"] is expected, rows[0]
            assert (rows[0]["error"] > want) is expected
    assert not set(needed) & set(found["lean"]["without"])
    assert found["lean"]["error"] <= want
    assert found["lean"]["springs"] <= found["full"]["springs"]


def positions(hooke, scene, path, *options):
    answer = hooke("run", scene, "-o", path, *options)
    assert answer.code == 0, answer.err
    with h5py.File(path) as file:
        return file["particles/all/position/value"][:]


def refined(coarse, grid):
    """Frames of a coarser grid, linear between its points, at those of `grid`."""
    cells = [(round((size - 1) * n / (grid[0] - 1))) for n in range(1, grid[0]) for size in grid]
    sizes = [[max(1, one) + 1 for one in cells[k : k + len(grid)]] for k in range(0, len(cells), len(grid))]
    values = coarse.reshape(len(coarse), *next(size for size in sizes if np.prod(size) == coarse.shape[1]), 3)
    for axis, size in enumerate(grid, 1):
        at = np.linspace(0, values.shape[axis] - 1, size)
        low = np.minimum(at.astype(int), values.shape[axis] - 2)
        part = (at - low).reshape([-1 if k == axis else 1 for k in range(values.ndim)])
        values = (1 - part) * values.take(low, axis) + part * values.take(low + 1, axis)
    return values


WITHIN = [pytest.param("flat-cloth", marks=pytest.mark.check),
          *("damped-mass", "free-sheet", "only-falls", "smooth-rope", "taut-chain")]


@pytest.mark.parametrize("name", WITHIN)
def test_the_lean_scene_is_within_the_want_of_a_full_run_made_apart(hooke, write, tmp_path, name):
    found = find(hooke, write, name, "-o", tmp_path / "lean.json")
    fine = ("--method", "rk4", "--step", repr(found["full"]["step"] / 8))
    full = positions(hooke, tmp_path / "scene.json", tmp_path / "full.h5", *fine)
    lean = positions(hooke, tmp_path / "lean.json", tmp_path / "lean.h5")
    if lean.shape != full.shape:
        lean = refined(lean, GRIDS[name]).reshape(full.shape)
    error = np.sqrt(((full - lean) ** 2).sum(axis=2)).max()
    assert error <= PLANTED[name][0]
    assert error == pytest.approx(found["lean"]["error"], rel=0.5, abs=0.2 * PLANTED[name][0])


@pytest.mark.check
def test_a_lean_scene_keeps_its_parts(hooke, write, tmp_path):
    """The 76 springs that do nothing save less than writing the part spring by spring costs the reader."""
    found = find(hooke, write, "flat-cloth", "-o", tmp_path / "lean.json")
    full, lean = (json.loads((tmp_path / name).read_text()) for name in ("scene.json", "lean.json"))
    assert found["lean"]["without"] == ["cloth.shear", "cloth.bend"] and found["lean"]["note"] == ""
    (expected,) = full["parts"]
    (part,) = lean["parts"]
    assert "springs" not in lean and "particles" not in lean
    for change in found["lean"]["changed"]:
        _, group, key = change["quantity"].split(".")
        expected[group][key] = pytest.approx(expected[group][key] * change["factor"], rel=1e-9)
    assert found["lean"]["changed"] and set(part) == set(expected) - {"shear", "bend"}
    assert all(part[key] == expected[key] for key in part)
    assert {key: lean[key] for key in ("gravity", "title")} == {key: full[key] for key in ("gravity", "title")}
    (row,) = rows_called(found["rows"], "76 springs that never pass")
    assert not row["needed"] and "spring by spring" in row["note"]


def test_what_no_part_can_say_is_written_spring_by_spring_and_said(hooke, write, tmp_path):
    found = find(hooke, write, "pinned-cloth", "-o", tmp_path / "lean.json")
    lean = json.loads((tmp_path / "lean.json").read_text())
    assert [len(group["between"]) for group in lean["springs"]] == [8, 7] and found["lean"]["springs"] == 15
    names = ", ".join(group["name"] for group in lean["springs"])
    assert names == "cloth.structural, cloth.shear" and found["lean"]["note"].startswith(f"{names}: written spring by spring")
    (part,) = lean["parts"]
    assert part["kind"] == "cloth" and "structural" not in part and "shear" not in part
    words = hooke("needs", "scene.json", "--want", "5mm").out
    assert f"{names}: written spring by spring" in " ".join(words.split())


def test_a_scene_in_which_nothing_moves_is_told_so(hooke, write, tmp_path):
    scene = write(SCENES["balanced-mass"])
    answer = hooke("needs", scene, "--want", "1cm", "-o", tmp_path / "lean.json", "--json")
    assert answer.code == 0, answer.err
    claims = {claim["key"]: claim for claim in answer.json["claims"]}
    assert "nothing moves" in claims["note"]["text"] and claims["lean"]["of"] == "unknown" and answer.json["full"]["moved"] < 1e-12
    needed = {row["without"]: row["needed"] for row in answer.json["rows"]}
    assert needed == {"spring": True, "gravity": True, "damping": None, "drag": None, "resistance to compression": None}
    assert answer.json["lean"]["without"] == [] and answer.json["lean"]["times_less"] == 1
    words = " ".join(hooke("needs", scene, "--want", "1cm").out.split())
    assert "note nothing moves" in words and "it cannot be told" in words and "can be left out" not in words
