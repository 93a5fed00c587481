"""The library and the program for Windows under wine: the bits of every method with a fixed step, the numbers of the program,
and files."""

import json
import os
import subprocess

import numpy as np
from conftest import ROOT

import hooke

SCENES = ["cantilever", "cloth-16", "cloth-damped", "cloth-gentle", "curl", "drag-or-damping", "lattice", "mesh", "rope", "stiff-spring"]
STEPS = 40
CHANGES = ("wall_seconds", "output")


def native(scene, method):
    system = scene.system
    state = system.state()
    hooke.Integrator(system, method=method, step=scene.run_options["step"]).step(state, STEPS)
    return np.concatenate([state.q.ravel(), state.v.ravel()]).tobytes().hex()


def test_bits(wine):
    files = [f"examples/scenes/{name}.json" for name in SCENES]
    lines = [line.split() for line in wine("states.exe", STEPS, *files).stdout.splitlines()]
    methods = [m.name for m in hooke.methods() if not m.adaptive]
    assert [(file, method) for file, method, _ in lines] == [(file, method) for file in files for method in methods]
    assert len(methods) >= 6
    scenes = {file: hooke.Scene.load(ROOT / file) for file in files}
    for scene in scenes.values():
        scene.system.commit()
    different = [(file, method) for file, method, state in lines if state != native(scenes[file], method)]
    assert not different, different
    assert len({state for *_, state in lines}) > 0.9 * len(lines)  # methods differ, so that equal bits say something


def test_numbers_of_runs(wine):
    """Here and there: times, energies, momenta, and the estimate of the error."""
    for name in ("cloth-16", "curl", "rope"):
        words = ["run", f"examples/scenes/{name}.json", "--duration", "0.02", "--json", "--threads", "2"]
        here = subprocess.run([os.environ["HOOKE_CLI"], *words], cwd=ROOT, capture_output=True, check=True, text=True).stdout
        one, two = json.loads(wine("hooke.exe", *words).stdout), json.loads(here)
        assert {k: v for k, v in one.items() if k not in CHANGES} == {k: v for k, v in two.items() if k not in CHANGES}


def test_verbs(wine):
    study = json.loads(wine("hooke.exe", "study", "examples/scenes/rope.json", "--duration", "0.05", "--methods",
                            "symplectic-euler,rk4", "--json").stdout)
    assert len(study["rows"]) > 4 and all(row["error"] >= 0 for row in study["rows"] if row["error"] is not None)
    rows = {}
    for name, run in (("there", wine), ("here", lambda program, *words: subprocess.run(
            [os.environ["HOOKE_CLI"], *words], cwd=ROOT, capture_output=True, check=True, text=True))):
        words = ("limit", "examples/scenes/curl.json", "--methods", "rk4", "--predict", "--json")
        rows[name] = json.loads(run("hooke.exe", *words).stdout)["methods"]
    assert [round(row["predicted"], 9) for row in rows["there"]] == [round(row["predicted"], 9) for row in rows["here"]]


def test_files(wine, tmp_path):
    """Files are written as whole ones in the place of others, by paths of both kinds; lines end as everywhere."""
    (tmp_path / "inner").mkdir()
    for words in (("-o", "inner/rope.json"), ("-o", "inner\\rope.json"), ("--stiffness", "500", "-o", "inner\\rope.json")):
        wine("hooke.exe", "make", "rope", "--from", "0,0,0", "--to", "1,0,0", "--segments", "6", *words, folder=tmp_path)
        assert [path.name for path in (tmp_path / "inner").iterdir()] == ["rope.json"]
    written = (tmp_path / "inner/rope.json").read_bytes()
    assert json.loads(written)["parts"] and b"\r" not in written
    assert wine("hooke.exe", "make", "rope", "--particles", "7", folder=tmp_path).stdout.encode() == written
    wine("hooke.exe", "run", "inner\\rope.json", "--duration", "0.01", "--step", "1e-4", folder=tmp_path)
    gone = wine("hooke.exe", "run", "inner\\none.json", folder=tmp_path, expect=3)
    assert "cannot be opened: No such file or directory" in gone.stderr
    refused = wine("hooke.exe", "make", "rope", "-o", "inner", folder=tmp_path, expect=4)
    assert "is not a regular file" in refused.stderr
