"""One scene over MPI ranks has the bits of one process: examples/ranks, with the MPI that it was built with."""

import itertools
import os
import re
import shutil
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from random_scenes import drape, network

import hooke

ROOT, MPIEXEC = Path(os.environ["HOOKE_SOURCE_DIR"]), os.environ.get("HOOKE_MPIEXEC")
FOLDER = Path(os.environ["HOOKE_BUILD_DIR"]) / "tests/ranks"
ALLOWED = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1",
           "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe"}
LONG = 120
ARRAYS = ("time", "step", "position", "velocity", "kinetic_energy", "potential_energy")
pytestmark = pytest.mark.skipif(not MPIEXEC, reason="there is no MPI, or its programs were not built (cmake says which)")


def begin(ranks, program, *arguments, folder=FOLDER, mpiexec=MPIEXEC):
    command = [mpiexec, "-n", ranks, folder / program, *arguments]
    return subprocess.Popen([str(c) for c in command], env=os.environ | ALLOWED, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)


def over(ranks, program, *arguments, expect=0, **where):
    process = begin(ranks, program, *arguments, **where)
    try:
        told = process.communicate(timeout=LONG)[0]
    finally:
        process.kill()
    assert process.returncode == expect, told
    return told


def frames_of(path):
    record = hooke.open(path)
    return [np.concatenate([[frame.t], frame.q.ravel(), frame.v.ravel()]).tobytes() for frame in record]


def saved(folder, scene, name="scene"):
    path = folder / f"{name}.json"
    scene.save(path)
    return path


def trials(folder, seeds, steps):
    scenes = [saved(folder, network(seed), f"network-{seed}") for seed in seeds]
    return [steps, *scenes, saved(folder, network(0, dynamics="overdamped"), "overdamped")]


def test_bits(tmp_path):
    """1, 2, 3 and 5 ranks, by bisection and at random, with all forces, by five methods, and three of them overdamped; a
    list of ghosts that is off by one has other bits."""
    told = over(5, "trial", *trials(tmp_path, [1], 2))
    assert told.splitlines()[-2:] == ["64 of 64 equal", "with a fault: 0 of 8 equal"]


@pytest.mark.check
def test_bits_of_many_scenes(tmp_path):
    told = over(5, "trial", *trials(tmp_path, range(2, 10), 20))
    assert told.splitlines()[-2] == f"{8 * 40 + 24} of {8 * 40 + 24} equal"


def test_file(tmp_path):
    """The frames of one process; --energy changes nothing of them."""
    scene = saved(tmp_path, drape())
    hooke.run(hooke.Scene.load(scene), output=tmp_path / "one.h5", duration=0.04)
    over(2, "ranks", scene, "-o", tmp_path / "two.h5", "--energy", "--duration", "0.04")
    assert frames_of(tmp_path / "two.h5") == frames_of(tmp_path / "one.h5")


@pytest.mark.check
def test_ends(tmp_path):
    """All ranks end alike: at numbers that are not finite, by the energy, and with what is refused."""
    scene = saved(tmp_path, drape())
    for more, expect, told in (
        (("--step", "1", "--duration", "900", "--every", "900"), 4, "diverged"),
        (("--step", "0.02", "--duration", "0.4", "--energy"), 4, "more energy than"),
        (("--method", "backward-euler"), 3, "allowed: forward-euler"),
        (("--method", "verlet", "--verlet_damping", "implicit"), 3, "where it does not solve"),
        (("--step", "wrong"), 3, "step"),
    ):
        text = over(3, "ranks", scene, *more, expect=expect)
        assert told in text and text.count("\nrank ") <= 1, text


def ranks_of(process):
    """Processes of the program that a launcher has begun."""
    found = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            found[int(stat.parent.name)] = int(stat.read_text().rsplit(")", 1)[1].split()[1])
            name = (stat.parent / "comm").read_text().strip()
        except OSError:
            continue
        if name != "ranks":
            found[int(stat.parent.name)] *= -1
    below = {process.pid}
    for _ in range(4):
        below |= {pid for pid, parent in found.items() if abs(parent) in below}
    return [pid for pid in below if found.get(pid, 0) > 0]


def count_of(path):
    try:
        return len(hooke.open(path)) if path.exists() else 0
    except (hooke.Error, OSError):
        return 0


def killed(path, ranks, *arguments, after):
    """Kills one rank when the file has so many frames; whether it was in time. One of them is of this run, so that all ranks
    are there: Open MPI's launcher may wait for ever for what it starts, if a rank is killed meanwhile."""
    after = max(after, 1 + count_of(path))
    process = begin(ranks, "ranks", *arguments)
    limit = time.monotonic() + LONG
    while process.poll() is None and time.monotonic() < limit:
        found = ranks_of(process) if count_of(path) >= after else []
        if found:
            os.kill(found[-1], signal.SIGKILL)
            break
        time.sleep(0.01)
    try:
        process.communicate(timeout=LONG)
    finally:
        process.kill()
    return process.returncode != 0


def kill_and_resume(folder, kills):
    scene, one, path = saved(folder, drape(12)), folder / "one.h5", folder / "ranks.h5"
    run = ("--step", "1e-5", "--duration", "0.4", "--every", "0.002")
    hooke.run(hooke.Scene.load(scene), output=one, step=1e-5, duration=0.4, every=0.002)
    done, sizes = 0, itertools.cycle([2, 3, 1, 5])
    for k in range(kills):
        file = ("--resume", path) if path.exists() else ("-o", path)
        done += killed(path, next(sizes), scene, *file, *run, after=2 + 200 * k // (kills + 1))
    over(next(sizes), "ranks", scene, "--resume", path, *run)
    assert done == kills
    assert frames_of(path) == frames_of(one)


@pytest.mark.check
def test_killed_and_resumed(tmp_path):
    kill_and_resume(tmp_path, 8)


def values(folder, scene, words, *sizes):
    told = [over(ranks, "cvode_ranks", scene, "--duration", "0.05", "--rtol", "1e-5", *words, folder=folder) for ranks in sizes]
    assert all("returned 0" in text for text in told), told
    return [re.search(r"check value (\w+)", text)[1] for text in told]


@pytest.mark.check
@pytest.mark.skipif(not (FOLDER / "cvode_ranks").exists(), reason="SUNDIALS has no parallel vector for this MPI")
def test_cvode(tmp_path):
    """One result for 1, 2 and 3 ranks, and by other owners; by the stock sum several."""
    scene = saved(tmp_path, drape(6))
    assert len(set(values(FOLDER, scene, [], 1, 2, 3) + values(FOLDER, scene, ["--owners", "7"], 3))) == 1
    assert len(set(values(FOLDER, scene, ["--sum", "stock"], 1, 2, 3))) > 1


@pytest.mark.check
@pytest.mark.parametrize("other", ["openmpi", "mpich"])
def test_other_mpi(other, tmp_path):
    """As a user builds it, against an installed hooke, with each MPI of Debian."""
    compiler, mpiexec = shutil.which(f"mpicc.{other}"), shutil.which(f"mpiexec.{other}")
    if not (compiler and mpiexec):
        pytest.skip(f"{other} is not installed")
    cmake = os.environ["HOOKE_CMAKE"]
    for command in ([cmake, "--install", os.environ["HOOKE_BUILD_DIR"], "--prefix", tmp_path / "prefix"],
                    [cmake, "-S", ROOT / "examples/ranks", "-B", tmp_path / "build", f"-DMPI_C_COMPILER={compiler}",
                     f"-DCMAKE_PREFIX_PATH={tmp_path / 'prefix'}"], [cmake, "--build", tmp_path / "build"]):
        subprocess.run(command, check=True, capture_output=True)
    scene = saved(tmp_path, network(1))
    hooke.run(hooke.Scene.load(scene), output=tmp_path / "one.h5")
    over(3, "ranks", scene, "-o", tmp_path / "three.h5", folder=tmp_path / "build", mpiexec=mpiexec)
    assert frames_of(tmp_path / "three.h5") == frames_of(tmp_path / "one.h5")
