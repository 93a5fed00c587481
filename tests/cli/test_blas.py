"""Factors by an optimised BLAS, which this machine may not have and its packages do: they are named in files, have the same
bits each time with one number of threads, and decide where bits are compared."""

import os
import subprocess
from pathlib import Path

import pytest
from conftest import hanging_cloth, interrupt

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")
pytestmark = pytest.mark.everything

CLOTH = {
    **hanging_cloth(32, {"stiffness": 5e4, "damping": 20}, shear={"stiffness": 2e4, "damping": 10}),
    "run": {"method": "cvode-bdf", "linear_solver": "direct", "rtol": 1e-4, "duration": 0.1, "every": 0.002, "checkpoint": 0.004},
}


@pytest.fixture(scope="module")
def library():
    """The folder of OpenBLAS, out of the package of this system, without installing it."""
    folder = Path(os.environ["HOOKE_BUILD_DIR"]) / "openblas"
    folder.mkdir(exist_ok=True)
    for words in (["apt-get", "download", "libopenblas0-pthread"], "dpkg-deb -x libopenblas0-pthread*.deb ."):
        if list(folder.glob("usr/lib/*/openblas-pthread/libblas.so.3")):
            break
        try:
            subprocess.run(words, shell=isinstance(words, str), cwd=folder, check=True, capture_output=True, timeout=120)
        except (OSError, subprocess.SubprocessError) as why:
            pytest.skip(f"the package libopenblas0-pthread cannot be had: {why}")
    return next(folder.glob("usr/lib/*/openblas-pthread"))


@pytest.fixture
def blas(hooke, library, monkeypatch):
    """blas(2): from now on OpenBLAS with so many threads, blas(0): the system's; the name that hooke has for it."""

    def take(threads):
        monkeypatch.setenv("LD_LIBRARY_PATH", str(library) if threads else "")
        monkeypatch.setenv("OPENBLAS_NUM_THREADS", str(threads or 1))
        name = next(line[14:] for line in hooke("--version", code=0).out.splitlines() if line.startswith("BLAS"))
        assert name.startswith("OpenBLAS 0.") or not threads
        return name

    return take


def frames(path):
    with h5py.File(path) as file:
        return [file[f"particles/all/{name}/value"][()].tobytes() for name in ("position", "velocity")]


@pytest.mark.parametrize("threads", [1, 2])
def test_an_interrupted_run_goes_on_to_the_bit(hooke, start, write, blas, tmp_path, threads):
    name = blas(threads)
    assert name.endswith(("1 thread", "2 threads")[threads - 1]) or os.cpu_count() < threads
    write(CLOTH)
    hooke("run", "scene.json", "-o", "whole.h5", "--no-estimate", code=0)
    process = start("run", "scene.json", "-o", "out.h5", "--no-estimate")
    interrupt(process, 0.3)
    process.communicate(timeout=60)
    assert process.returncode == 130
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["hooke"].attrs["blas"] in (name, name.encode())
        assert file["hooke/status"][()] == b"stopped"
    hooke("run", "--resume", "out.h5", code=0)
    assert frames(tmp_path / "out.h5") == frames(tmp_path / "whole.h5")
    found = hooke("verify", "out.h5", "--all", "--bits", "--json", code=0).json
    assert (found["verdict"], found["blas"], found["blas_here"]) == ("agrees", name, name)


def test_another_one_may_differ_within_the_error(hooke, write, blas):
    name = blas(1)
    write(CLOTH, duration=0.02)
    hooke("run", "scene.json", "-o", "out.h5", "--no-estimate", code=0)
    for threads in (0, 2):
        other = blas(threads)
        found = hooke("verify", "out.h5", "--all", "--json", code=0).json
        assert found["blas"] == name and found["blas_here"] == ("" if other == "no optimised one" else other)
        assert (found["verdict"] == "agrees") == (name == other)


def test_a_fixed_step_has_its_bits_by_any(hooke, write, blas, tmp_path):
    write(CLOTH, method="backward-euler", step=1e-3, duration=0.006, rtol=None, checkpoint=None)
    for threads in (0, 1, 2):
        blas(threads)
        hooke("run", "scene.json", "-o", f"{threads}.h5", "--no-estimate", code=0)
        assert hooke("verify", "0.h5", "--bits", "--json", code=0).json["verdict"] == "agrees"
    assert frames(tmp_path / "0.h5") == frames(tmp_path / "1.h5") == frames(tmp_path / "2.h5")
