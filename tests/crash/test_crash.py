"""A run is killed at each of its writes in turn, before the write and in the middle of it: reported frames are in the
file to the bit, nothing else counts as a frame, and the continued run ends like the uninterrupted one. The same for a
failing write, and for a signal at each of them. The points are those of crash.c. A few of them are tested; HOOKE_LONG=1 tests them all."""

import errno
import json
import os
import shutil
import signal
import subprocess
import tempfile
import time
from pathlib import Path

import pytest

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")
hooke = pytest.importorskip("hooke")

CLI, CRASH = os.environ["HOOKE_CLI"], os.environ["HOOKE_CRASH"]
LONG = os.environ.get("HOOKE_LONG") == "1"
STRIDE = 1 if LONG else 23
OLD = b"a file of before, which stays until the new one is ready\n" * 100

ROPE = {
    "kind": "rope",
    "from": [0, 0, 0],
    "to": [1, 0.1, 0],
    "segments": 3,
    "mass": 0.5,
    "pinned": ["start"],
    "stretch": {"stiffness": 30, "damping": 0.1},
}
CLOTH = {
    "kind": "cloth",
    "origin": [0, 0, 0],
    "edges": [[1, 0, 0], [0, 0, 1]],
    "size": [15, 15],
    "mass": 1,
    "pinned": ["corners"],
    "structural": {"stiffness": 20, "damping": 0.01},
}


def scene(part, **run):
    return {"hooke": 1, "gravity": [0, -9.81, 0], "parts": [part], "run": run}


# A frame of the cloth has two rows of more than 5 KiB, which cross page boundaries. A run that diverges rewrites its
# file.
SCENES = {
    "rope": scene(ROPE, method="symplectic-euler", step=1e-3, duration=0.05, every=0.01, checkpoint=0.02),
    "cloth": scene(CLOTH, method="verlet", step=1e-3, duration=0.04, every=0.01, checkpoint=0.015),
    "diverging": scene(
        {**ROPE, "stretch": {"stiffness": 1e5}}, method="forward-euler", step=2e-3, duration=0.2, every=0.01, checkpoint=0.02
    ),
    "cvode": scene(ROPE, method="cvode-bdf", rtol=1e-6, duration=0.05, every=0.01, checkpoint=0.02),
}


class Place:
    """A folder for runs, in memory if possible: this tests processes that die, not machines."""

    def __init__(self):
        memory = "/dev/shm"
        self.folder = Path(tempfile.mkdtemp(dir=memory if os.access(memory, os.W_OK) else None))
        self.out, self.journal = self.folder / "out.h5", self.folder / "journal"

    def fill(self, words):
        for path in self.folder.iterdir():
            path.unlink()
        (self.folder / "scene.json").write_text(json.dumps(words))
        self.out.write_bytes(OLD)

    def run(self, *words, **crash):
        environment = {**os.environ, "LD_PRELOAD": CRASH, "HOOKE_CRASH_LOG": str(self.journal)}
        environment.update({f"HOOKE_CRASH_{name.upper()}": str(int(value)) for name, value in crash.items()})
        command = [CLI, "run", *words, "--json", "--final", "--quiet"]
        return subprocess.run(command, cwd=self.folder, env=environment, capture_output=True, text=True, timeout=60)

    def start_over(self, **crash):
        return self.run("scene.json", "-o", "out.h5", **crash)

    def resume(self, **crash):
        return self.run("--resume", "out.h5", **crash)

    def told(self):
        """Times of the reported frames, and the number of points if the run finished."""
        lines = self.journal.read_text().split("\n") if self.journal.exists() else []
        frames = {float.fromhex(line.split()[1]) for line in lines if line.startswith("frame")}
        points = [int(line.split()[1]) for line in lines if line.startswith("points")]
        return frames, points[-1] if points else None


def read(path):
    """Everything with one row a frame, and the status."""
    with h5py.File(path) as file:
        frames = {name: file[f"particles/all/{name}/value"][:] for name in ["position", "velocity"]}
        frames.update({name: file[f"observables/{name}/value"][:] for name in file["observables"]})
        frames.update({name: file[f"particles/all/position/{name}"][:] for name in ["step", "time"]})
        frames["check"] = file["hooke/frame_check"][:]
        return frames, file["hooke/status"][()].decode()


class Whole:
    """The uninterrupted run."""

    def __init__(self, place, words, code=0, status="finished"):
        place.fill(words)
        done = place.start_over()
        assert done.returncode == code, done.stderr
        self.code, self.status = code, status
        self.final = json.loads(done.stdout)["final"]
        self.frames, found = read(place.out)
        assert found == status and np.isfinite(self.frames["time"]).all()
        self.reported, self.points = place.told()
        assert self.reported == set(self.frames["time"].tolist())
        assert code != 0 or "out.h5.checkpoint" not in os.listdir(place.folder), "a run that finished needs none"

    def check_left(self, place, reported, more=()):
        """The files of a killed process."""
        began = time.monotonic()
        frames, status = read(place.out)
        with hooke.open(place.out) as out:
            out.check()
            count = len(out)
        assert time.monotonic() - began < 1
        there = np.isfinite(frames["time"])
        assert there[:count].all() and not there[count:].any()
        assert reported <= set(frames["time"][:count].tolist()), "a frame that was reported is lost"
        for name, values in frames.items():
            assert np.array_equal(values[:count], self.frames[name][:count]), name
        ended = status == self.status and count == len(self.frames["time"])
        assert ended or status in ("running", *more)
        return status

    def check_end(self, place, done, left="running"):
        assert done.returncode == self.code, done.stderr
        frames, status = read(place.out)
        assert status == self.status
        for name, values in frames.items():
            assert np.array_equal(values, self.frames[name]), name
        with hooke.open(place.out) as out:
            out.check()
        if left != "finished":  # otherwise there is nothing to continue
            assert json.loads(done.stdout)["final"] == self.final


@pytest.fixture(scope="module")
def place():
    place = Place()
    yield place
    shutil.rmtree(place.folder)


@pytest.fixture(scope="module", params=list(SCENES))
def case(request, place):
    code, status = (4, "diverged") if request.param == "diverging" else (0, "finished")
    return SCENES[request.param], Whole(place, SCENES[request.param], code, status)


def points_of(count, stride=STRIDE):
    """Every few, and the first and last ones, which create the file and close it."""
    return sorted({*range(1, count + 1, stride), 2, count - 1, count})


@pytest.mark.parametrize("torn", [False, True], ids=["crash", "torn"])
def test_every_write(place, case, torn):
    words, whole = case
    before = unfinished = 0
    points = points_of(whole.points)
    for at in points:
        place.fill(words)
        killed = place.start_over(at=at, torn=torn)
        assert killed.returncode == -9, (at, killed.stderr)
        reported, _ = place.told()
        if place.out.read_bytes() == OLD:
            before += 1
            assert not reported
            whole.check_end(place, place.start_over())
            continue
        left = whole.check_left(place, reported)
        unfinished += len(reported) < len(whole.frames["time"])
        whole.check_end(place, place.resume(), left)
    assert before > 0 and unfinished > 0
    print(f"{len(points)} of {whole.points} points, {before} before the file was there, {unfinished} before its last frame")
    place.fill(words)
    assert place.start_over(at=whole.points + 1, torn=torn).returncode == whole.code, "there are no more points"


@pytest.mark.parametrize("torn", [False, True], ids=["crash", "torn"])
def test_every_write_of_a_run_that_goes_on(place, case, torn):
    words, whole = case
    place.fill(words)
    half = sorted(whole.reported)[len(whole.reported) // 2]
    at = whole.points // 3
    while half not in place.told()[0]:  # killed in the middle of its frames
        at += 5
        place.fill(words)
        assert place.start_over(at=at).returncode == -9
    reported, _ = place.told()
    there = {path.name: path.read_bytes() for path in place.folder.iterdir()}

    def again():
        place.fill(words)
        for name, content in there.items():
            (place.folder / name).write_bytes(content)

    again()
    whole.check_end(place, place.resume())
    count = place.told()[1]
    points = points_of(count)
    for point in points:
        again()
        assert place.resume(at=point, torn=torn).returncode == -9
        now, _ = place.told()
        assert now >= reported
        left = whole.check_left(place, now)
        whole.check_end(place, place.resume(), left)
    print(f"{len(points)} of {count} points")


def test_a_signal_at_every_write_of_a_run_for_a_wanted_error(place):
    """Also at the last ones, when the run is over and its error is looked into: an interrupted run that did not keep to
    its want has been interrupted."""
    words, command = scene(ROPE, duration=0.05, every=0.01), ["scene.json", "-o", "out.h5", "--want", "1e-18", "--method", "rk4"]
    place.fill(words)
    assert place.run(*command).returncode == 7
    count = place.told()[1]
    for at in points_of(count):
        place.fill(words)
        done = place.run(*command, at=at, signal=signal.SIGTERM)
        assert done.returncode == 130, (at, count, done.stderr)


# Result of a failure: exit code 5, or the run's own if nothing is lost, such as when a file to remove does not exist.
@pytest.mark.parametrize("more", [False, True], ids=["once", "from-then-on"])
def test_every_failing_write(place, case, more):
    words, whole = case
    harmless = 0
    points = points_of(whole.points, 1 if LONG else 41)
    for at in points:
        place.fill(words)
        done = place.start_over(at=at, error=errno.ENOSPC if more else errno.EIO, **{"from": more})
        assert done.returncode in (5, whole.code), (at, done.returncode, done.stderr)
        failed = done.returncode == 5
        assert not failed or ("could not" in done.stderr and "out." in done.stderr), (at, done.stderr)
        harmless += not failed
        reported, _ = place.told()
        if place.out.read_bytes() == OLD:
            assert failed and not reported, at
            continue
        left = whole.check_left(place, reported, more=("failed", "stopped"))
        assert failed or left == whole.status, at
        whole.check_end(place, place.resume(), left)
    print(f"{len(points)} of {whole.points} points, {harmless} of them of no consequence")
