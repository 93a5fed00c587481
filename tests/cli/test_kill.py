"""A run killed at any moment leaves a file that opens and in which every frame that has a time is whole."""

import random
import subprocess
import time

import pytest
from conftest import CLI

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")
pytestmark = pytest.mark.everything

KILLS = 30
FRAMES = 1501

# A frame is over 3 KiB, so that many lie across two pages.
CLOTH = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "parts": [
        {
            "kind": "cloth",
            "origin": [0, 0, 0],
            "edges": [[1, 0, 0], [0, 0, 1]],
            "size": [12, 12],
            "mass": 1,
            "pinned": ["corners"],
            "structural": {"stiffness": 20, "damping": 0.01},
            "shear": {"stiffness": 5},
        }
    ],
    "run": {"method": "symplectic-euler", "step": 1e-4, "duration": 1.5, "every": 1e-3},
}


def read(path):
    """Everything with one entry a frame."""
    with h5py.File(path) as file:
        names = ["position", "velocity"]
        frames = {name: file[f"particles/all/{name}/value"][:] for name in names}
        frames.update({name: file[f"observables/{name}/value"][:] for name in file["observables"]})
        frames["step"] = file["particles/all/position/step"][:]
        return file["particles/all/position/time"][:], frames, file["hooke/status"][()]


def test_killed_runs(write, tmp_path):
    seed = random.randrange(10**9)
    print("seed", seed)
    moments = random.Random(seed)
    scene = write(CLOTH)
    out = tmp_path / "out.h5"
    call = [CLI, "run", scene, "-o", "out.h5"]

    began = time.monotonic()
    subprocess.run(call, cwd=tmp_path, check=True, capture_output=True)
    whole = time.monotonic() - began
    times, frames, status = read(out)
    assert status == b"finished" and len(times) == FRAMES and np.isfinite(times).all()

    unfinished = 0
    for kill in range(KILLS):
        out.write_bytes(b"old")
        process = subprocess.Popen(call, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(moments.uniform(0, 1.1 * whole))
        process.kill()
        process.wait()
        if out.read_bytes()[:3] == b"old":
            continue  # not yet ready to take frames: the older file is still there
        found_times, found, found_status = read(out)
        done = int(np.isfinite(found_times).sum())
        assert len(found_times) == FRAMES
        assert np.array_equal(found_times[:done], times[:done]) and np.isnan(found_times[done:]).all()
        for name, values in found.items():
            assert np.array_equal(values[:done], frames[name][:done]), f"{name}, kill {kill}"
            # the frame under way may be there in part; what follows is as it was made
            rest = values[done + 1 :]
            assert (rest == -1).all() if name == "step" else np.isnan(rest).all(), name
        assert found_status == b"running" or done == FRAMES
        unfinished += 0 < done < FRAMES
    assert unfinished >= KILLS // 10, "the kills did not hit the runs"

    subprocess.run(call, cwd=tmp_path, check=True, capture_output=True)
    assert np.array_equal(read(out)[0], times)
