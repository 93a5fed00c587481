"""A run killed at any moment leaves a file that opens and in which every frame that has a time is whole."""

import random
import subprocess
import time

import pytest
from conftest import CLI

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")
pytestmark = pytest.mark.everything

# A frame is over 3 KiB, so that many lie across two pages; the larger ones are written by a thread.
SIZES = [(12, 1501, 30), (38, 301, 10)]


def cloth(side, frames):
    return {
        "hooke": 1,
        "gravity": [0, -9.81, 0],
        "parts": [
            {
                "kind": "cloth",
                "origin": [0, 0, 0],
                "edges": [[1, 0, 0], [0, 0, 1]],
                "size": [side, side],
                "mass": 1,
                "pinned": ["corners"],
                "structural": {"stiffness": 20, "damping": 0.01 * 12 / side},
                "shear": {"stiffness": 5},
            }
        ],
        "run": {"method": "symplectic-euler", "step": 1e-4, "duration": (frames - 1) / 1000, "every": 1e-3},
    }


def read(path):
    """Everything with one entry a frame."""
    with h5py.File(path) as file:
        names = ["position", "velocity"]
        frames = {name: file[f"particles/all/{name}/value"][:] for name in names}
        frames.update({name: file[f"observables/{name}/value"][:] for name in file["observables"]})
        frames["step"] = file["particles/all/position/step"][:]
        return file["particles/all/position/time"][:], frames, file["hooke/status"][()]


@pytest.mark.parametrize("side, planned, kills", SIZES)
def test_killed_runs(write, tmp_path, side, planned, kills):
    seed = random.randrange(10**9)
    print("seed", seed)
    moments = random.Random(seed)
    scene = write(cloth(side, planned))
    out = tmp_path / "out.h5"
    call = [CLI, "run", scene, "-o", "out.h5"]

    began = time.monotonic()
    subprocess.run(call, cwd=tmp_path, check=True, capture_output=True)
    whole = time.monotonic() - began
    times, frames, status = read(out)
    assert status == b"finished" and len(times) == planned and np.isfinite(times).all()

    unfinished = 0
    for kill in range(kills):
        out.write_bytes(b"old")
        process = subprocess.Popen(call, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(moments.uniform(0, 1.1 * whole))
        process.kill()
        process.wait()
        if out.read_bytes()[:3] == b"old":
            continue  # not yet ready to take frames: the older file is still there
        found_times, found, found_status = read(out)
        done = int(np.isfinite(found_times).sum())
        assert len(found_times) == planned
        assert np.array_equal(found_times[:done], times[:done]) and np.isnan(found_times[done:]).all()
        for name, values in found.items():
            assert np.array_equal(values[:done], frames[name][:done]), f"{name}, kill {kill}"
            # the frame under way may be there in part; what follows is as it was made
            rest = values[done + 1 :]
            empty = {"step": -1, "position": 0, "velocity": 0}.get(name, np.nan)
            assert np.array_equal(rest, np.full_like(rest, empty), equal_nan=True), name
        assert found_status == b"running" or done == planned
        unfinished += 0 < done < planned
    assert unfinished >= kills // 10, "the kills did not hit the runs"

    subprocess.run(call, cwd=tmp_path, check=True, capture_output=True)
    assert np.array_equal(read(out)[0], times)
