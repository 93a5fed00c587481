"""Lattices and meshes in the verbs."""

import json
import pathlib
import shutil

import pytest

pytestmark = pytest.mark.everything

SCENES = pathlib.Path(__file__).resolve().parents[2] / "examples" / "scenes"
SHORT = ("--duration", "0.04", "--every", "0.02")


@pytest.fixture
def scenes(tmp_path):
    """The two examples, the lattice a smaller one, with names of files."""
    lattice = json.loads((SCENES / "lattice.json").read_text())
    lattice["parts"][0]["size"] = [3, 3, 5]
    (tmp_path / "lattice.json").write_text(json.dumps(lattice))
    for name in ("mesh.json", "ball.obj"):
        shutil.copy(SCENES / name, tmp_path)
    return {"lattice": (45, {"block.structural": 96, "block.shear": 200, "block.bend": 57}),
            "mesh": (42, {"ball.structural": 120, "ball.bend": 120})}  # fmt: skip


@pytest.mark.parametrize("name", ["lattice", "mesh"])
def test_every_verb_takes_it(hooke, scenes, name):
    particles, groups = scenes[name]
    check = hooke("check", f"{name}.json", "--json").json
    assert check["particles"] == particles
    assert {group["name"]: group["springs"] for group in check["groups"]} == groups
    assert check["warnings"] == []
    limit = hooke("limit", f"{name}.json", "--predict", "--json").json
    bounds = {row["method"]: row for row in limit["rows"]}
    verlet = bounds["verlet"]
    assert 0 < verlet["bound"] <= verlet["predicted"] < 0.1
    compare = hooke("compare", f"{name}.json", *SHORT, "--json").json
    errors = {row["method"]: row["error"] for row in compare["rows"]}
    assert errors["rk4"] < errors["verlet"] < errors["forward-euler"] < 0.01
    needs = hooke("needs", f"{name}.json", *SHORT, "--want", "1cm", "--json", "-o", "lean.json").json
    rows = {row["without"]: row for row in needs["rows"]}
    assert set(groups) <= set(rows)
    assert any(row["kind"] == "resolution" and row["without"].endswith(" of block") for row in needs["rows"]) == (name == "lattice")
    assert needs["lean"]["error"] <= 0.01
    lean = hooke("check", "lean.json", "--json")
    assert lean.code == 0 and lean.json["springs"] <= check["springs"]


def test_a_mesh_has_no_resolution(hooke, scenes):
    answer = hooke("needs", "mesh.json", *SHORT, "--want", "1cm", "--refine")
    assert answer.code == 0 and "a mesh has no resolution to change" in answer.out


def test_a_trajectory_holds_the_mesh_and_a_scene_needs_its_file(hooke, scenes, tmp_path):
    answer = hooke("run", "mesh.json", *SHORT, "-o", "out.h5", "--json", "--final")
    assert answer.code == 0, answer.err
    (tmp_path / "ball.obj").unlink()
    again = hooke("run", "out.h5", "--json", "--final")
    assert again.code == 0 and again.json["final"] == answer.json["final"]
    lost = hooke("run", "mesh.json")
    assert lost.code == 3 and 'parts[0].file: "ball.obj" cannot be opened' in lost.err


def test_a_link_out_of_the_folder_is_refused(hooke, scenes, tmp_path):
    inner = tmp_path / "inner"
    inner.mkdir()
    shutil.copy(SCENES / "mesh.json", inner)
    (inner / "ball.obj").symlink_to("../ball.obj")
    hooke("check", "inner/mesh.json", code=3, err="leads out of the scene's folder")


def test_a_lattice_keeps_its_bits_at_any_number_of_threads(hooke, scenes, tmp_path):
    scene = json.loads((tmp_path / "lattice.json").read_text())
    scene["parts"][0]["size"] = [17, 16, 33]
    (tmp_path / "large.json").write_text(json.dumps(scene))
    finals = [hooke("run", "large.json", "--step", "1e-5", "--duration", "2e-4", "--every", "1e-4", "--threads", threads, "--json",
                    "--final").json["final"] for threads in (1, 2)]  # fmt: skip
    assert finals[0] == finals[1]
