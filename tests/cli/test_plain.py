"""examples/c/plain.c, the definition in plain C: 10^5 steps of it and of hooke end at the same bits."""

import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

pytestmark = pytest.mark.everything

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
GRAVITY, STEPS = [0, -9.81, 0], 100_000
DAMPED = {"stiffness": 40, "damping": 0.02}
NET = {"stiffness": 40, "damping": 0.02, "compression": False}
CLOTH = {"kind": "cloth", "name": "cloth", "size": [3, 3], "edges": [[1, 0, 0], [0, 0.3, 1]], "mass": 0.2, "pinned": "corners"}
SCENES = {
    "rope": {"kind": "rope", "name": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 6, "mass": 0.1, "pinned": "start",
             "stretch": {"stiffness": 100}, "bend": {"stiffness": 1}},
    "cloth": {**CLOTH, "pinned": "top-corners", "structural": DAMPED, "shear": DAMPED},
    "net": {**CLOTH, "structural": NET, "shear": {**NET, "rest_scale": 1.2}},
}


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    to, library = tmp_path_factory.mktemp("plain") / "plain", Path(os.environ["HOOKE_LIBRARY"])
    subprocess.run([os.environ["HOOKE_CC"], "-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-ffp-contract=off",
                    f"-I{ROOT}/include", ROOT / "examples/c/plain.c", library, f"-Wl,-rpath,{library.parent}", "-lm",
                    "-o", to], check=True)
    return lambda *words, **options: subprocess.run([to, *map(str, words)], capture_output=True, text=True, **options)


@pytest.mark.parametrize("name, method", [("rope", "symplectic-euler"), ("rope", "verlet"), ("rope", "rk4"),
                                          ("cloth", "verlet"), ("net", "symplectic-euler"), ("net", "rk4")])
def test_equal_bits(hooke, write, plain, tmp_path, name, method):
    step = 5e-4
    scene = write({"hooke": 1, "gravity": GRAVITY, "parts": [SCENES[name]]})
    final = hooke("run", scene, "--method", method, "--step", step, "--duration", STEPS * step, "--every", STEPS * step,
                  "--verlet-damping", "explicit", "--no-estimate", "--final", "--json").json["final"]
    done = plain(scene, method, step, STEPS, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    own = np.array([line.split() for line in done.stdout.splitlines()], float)
    assert np.array_equal(own, np.hstack([final["position"], final["velocity"]]))
    assert np.abs(own[:, :3]).max() < 3  # the motion is one, and not numbers that have overflowed


@pytest.mark.parametrize("key, value", [("drag", 0.1), ("dynamics", "overdamped"),
                                        ("bodies", [{"name": "plate", "particles": [3, 4, 5, 6]}])])
def test_what_it_does_not_define_is_refused(write, plain, tmp_path, key, value):
    rope = {**SCENES["rope"], "from": [0, 0, 0.1], "stretch": {"stiffness": 100, "rest_scale": 0.9}}
    scene = {"hooke": 1, "gravity": GRAVITY, "parts": [rope], key: value}
    if key == "dynamics":
        scene["drag"] = 1
    done = plain(write(scene), "rk4", 1e-3, 1, cwd=tmp_path)
    assert done.returncode == 1 and "plain: the scene " in done.stderr
