"""Trajectories for other programs to read, written by the program."""

import json
import os
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest

CLI = os.environ["HOOKE_CLI"]

CLOTH = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "parts": [{"kind": "cloth", "origin": [0, 0, 0], "edges": [[0.4, 0, 0], [0, 0, 0.6]], "size": [5, 7], "mass": 0.1,
               "pinned": ["top"], "structural": {"stiffness": 20, "damping": 0.01}, "shear": {"stiffness": 5}}],
    "driven": [{"particles": [34], "motion": "harmonic", "amplitude": [0, 0.1, 0], "frequency": 2}],
    "run": {"method": "symplectic-euler", "step": 1e-4, "duration": 0.1, "every": 0.01},
}
DUST = {"hooke": 1, "gravity": [0, -9.81, 0], "particles": {"position": [[0, 0, 0], [1, 2, 3]], "mass": [1, 2]},
        "run": {"method": "rk4", "step": 0.01, "duration": 0.1}}


def write(folder, scene, name="out.h5", code=0, **run):
    scene = {**scene, "run": {**scene["run"], **run}}
    (folder / "scene.json").write_text(json.dumps(scene))
    done = subprocess.run([CLI, "run", "scene.json", "-o", name], cwd=folder, capture_output=True, text=True, timeout=60)
    assert done.returncode == code, done.stderr
    return folder / name


@pytest.fixture(scope="session")
def cloth(tmp_path_factory):
    return write(tmp_path_factory.mktemp("cloth"), CLOTH)


@pytest.fixture(scope="session")
def diverged(tmp_path_factory):
    return write(tmp_path_factory.mktemp("diverged"), CLOTH, code=4, step=0.02, every=0.02, duration=2)


@pytest.fixture(scope="session")
def killed(tmp_path_factory):
    """A killed run: its file has space for more frames than written, and no companion."""
    folder = tmp_path_factory.mktemp("killed")
    (folder / "scene.json").write_text(json.dumps({**CLOTH, "run": {**CLOTH["run"], "duration": 100}}))
    process = subprocess.Popen([CLI, "run", "scene.json", "-o", "out.h5", "--quiet"], cwd=folder, stdout=subprocess.DEVNULL)
    for _ in range(2000):
        time.sleep(0.005)
        if (folder / "out.h5").exists() and sum(there(folder / "out.h5")) > 3:
            break
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert 3 < sum(there(folder / "out.h5")) < 10001 and not (folder / "out.xdmf").exists()
    return folder / "out.h5"


def there(path):
    """For each frame, whether it was written."""
    with h5py.File(path) as file:
        return ~np.isnan(file["particles/all/position/time"][:])
