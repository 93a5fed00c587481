"""A run killed at any moment leaves a file that opens, in which every frame with a time is whole, and that can be
continued to the same end."""

import os
import random
import signal
import subprocess
import time
import zlib

import pytest
from conftest import CLI, default_signals

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")
pytestmark = pytest.mark.everything

LONG = os.environ.get("HOOKE_LONG") == "1"

# A frame is over 3 KiB, so that many cross a page boundary; the larger ones are written by a thread. Every third kill
# comes soon after an interrupt, when a run rewrites its file.
SIZES = [(12, 601, 700 if LONG else 20), (38, 101, 300 if LONG else 10)]


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
        "run": {"method": "symplectic-euler", "step": 1e-4, "duration": (frames - 1) / 1000, "every": 1e-3, "checkpoint": 0.05},
    }


def read(path):
    """Everything with one entry a frame."""
    with h5py.File(path) as file:
        names = ["position", "velocity"]
        frames = {name: file[f"particles/all/{name}/value"][:] for name in names}
        frames.update({name: file[f"observables/{name}/value"][:] for name in file["observables"]})
        frames["step"] = file["particles/all/position/step"][:]
        frames["check"] = file["hooke/frame_check"][:]
        return file["particles/all/position/time"][:], frames, file["hooke/status"][()]


def check_value(times, frames, frame):
    value = zlib.crc32(times[frame].tobytes(), zlib.crc32(frames["step"][frame].tobytes()))
    order = ["position", "velocity", "kinetic_energy", "potential_energy", "total_energy", "dissipated_power"]
    for name in [*order, "momentum", "angular_momentum"]:
        value = zlib.crc32(frames[name][frame].tobytes(), value)
    return value


class Run:
    """The uninterrupted run, and its duration."""

    def __init__(self, folder, scene):
        self.folder, self.out = folder, folder / "out.h5"
        self.call = [CLI, "run", scene, "-o", "out.h5", "--quiet"]
        began = time.monotonic()
        subprocess.run(self.call, cwd=folder, check=True, capture_output=True)
        self.seconds = time.monotonic() - began
        self.times, self.frames, status = read(self.out)
        assert status == b"finished" and np.isfinite(self.times).all()
        for frame in range(0, len(self.times), 7):
            assert self.frames["check"][frame] == check_value(self.times, self.frames, frame)

    def kill(self, call, moment, interrupt=None):
        """Kills it so many seconds after its start; `interrupt`: or so many after an interrupt."""
        silent = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "preexec_fn": default_signals}
        process = subprocess.Popen(call, cwd=self.folder, **silent)
        time.sleep(moment)
        if interrupt is not None:
            process.send_signal(signal.SIGINT)
            time.sleep(interrupt)
        process.kill()
        process.wait()

    def check_left(self, kill):
        """Frames in the file. None if the older file is in place."""
        if self.out.read_bytes()[:3] == b"old":
            return None  # not yet ready to take frames
        began = time.monotonic()
        times, frames, status = read(self.out)
        assert time.monotonic() - began < 1 + self.seconds
        done = int(np.isfinite(times).sum())
        assert len(times) == len(self.times) or (status == b"stopped" and done == len(times))
        assert np.array_equal(times[:done], self.times[:done]) and np.isnan(times[done:]).all()
        for name, values in frames.items():
            assert np.array_equal(values[:done], self.frames[name][:done]), f"{name}, kill {kill}"
            # the current frame may be there in part; the rest is as created
            rest = values[done + 1 :]
            empty = {"step": -1, "position": 0, "velocity": 0, "check": 0}.get(name, np.nan)
            assert np.array_equal(rest, np.full_like(rest, empty), equal_nan=True), name
        assert status in (b"running", b"stopped") or done == len(self.times)
        return done

    def go_on(self):
        done = subprocess.run([CLI, "run", "--resume", "out.h5", "--quiet"], cwd=self.folder, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        times, frames, status = read(self.out)
        assert status == b"finished" and np.array_equal(times, self.times)
        for name, values in frames.items():
            assert np.array_equal(values, self.frames[name]), name


@pytest.mark.parametrize("side, planned, kills", SIZES)
def test_killed_runs(write, tmp_path, side, planned, kills):
    seed = random.randrange(10**9)
    print("seed", seed)
    moments = random.Random(seed)
    run = Run(tmp_path, write(cloth(side, planned)))
    unfinished = again = 0
    for kill in range(20 * kills):
        if kill >= kills and unfinished >= kills // 10:
            break  # on a busy machine more kills are needed to hit the runs
        for path in tmp_path.glob("out.*"):
            path.unlink()
        run.out.write_bytes(b"old")
        interrupt = moments.uniform(0, 0.01) if kill % 3 == 2 else None
        run.kill(run.call, moments.uniform(0, 1.1 * run.seconds), interrupt)
        done = run.check_left(kill)
        if done is None:
            continue
        unfinished += 0 < done < planned
        if kill % 2 == 1:  # and again while it continues
            run.kill([CLI, "run", "--resume", "out.h5", "--quiet"], moments.uniform(0, run.seconds))
            now = run.check_left(kill)
            assert now >= done, "a frame that was there is lost"
            again += now > done
        run.go_on()
    print(f"{kills} kills: {unfinished} in the midst of the frames, {again} of runs that went on")
    assert unfinished >= kills // 10, "the kills did not hit the runs"
    run.out.unlink()
    subprocess.run(run.call, cwd=tmp_path, check=True, capture_output=True)
    assert np.array_equal(read(run.out)[0], run.times)
