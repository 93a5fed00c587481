"""A wheel in an otherwise empty environment: python check_wheel.py, in an environment where it is installed with
h5py. It uses every feature of the library once, and no library of the machine but its C library may be loaded."""

import ctypes
import importlib.metadata
import os
import platform
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import warnings
from pathlib import Path

import h5py
import numpy as np

C_LIBRARY = re.compile(r"/(ld-linux-\w+(-\d+)?|ld-musl-\w+|libc|libm|libdl|libpthread|librt|libutil)(-2\.\d+)?\.so[.\d]*$")
SCENE = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "parts": [
        {"kind": "cloth", "name": "cloth", "size": [8, 8], "origin": [0, 0, 0], "edges": [[1, 0, 0], [0, 0, 1]], "mass": 0.5,
         "structural": {"stiffness": 60, "damping": 0.01}, "shear": {"stiffness": 20}, "pinned": "top-corners"}
    ],
}


def loaded():
    maps = (line.split(None, 5) for line in Path("/proc/self/maps").read_text("utf-8").splitlines())
    return {row[5].strip() for row in maps if len(row) > 5 and ".so" in row[5]}


before = loaded()
import hooke  # noqa: E402

facts = hooke.build_facts()
inside = Path(hooke.__file__).parent
tags = re.findall(r"^Tag: (.*)$", importlib.metadata.distribution("libhooke").read_text("WHEEL"), re.MULTILINE)
libc = "musllinux_1_" if any("musl" in tag for tag in tags) else "manylinux_2_28_"
assert any(tag.startswith(f"py3-none-{libc}") and tag.endswith(platform.machine()) for tag in tags), tags
assert facts["path"] == str(inside / "libhooke.so") and facts["licence"] == "MIT", facts
assert all(facts[part] for part in ("sundials", "lapack", "hdf5", "chartjs")), facts
assert not any(facts[part] for part in ("gsl", "cholmod")), facts
licences = (inside / "LICENSES").read_text(encoding="utf-8")
assert all(f"\n{name}\n===" in licences for name in ("SUNDIALS", "LAPACK and BLAS", "zlib", "hdf5", "Chart.js"))
assert "General Public License" not in licences and "GPL" not in licences
flags = (line.split() for line in Path("/proc/cpuinfo").read_text("utf-8").splitlines() if line.startswith("flags"))
flags = set(next(flags, ()))
best = "avx512" if flags >= {"avx512f", "avx512dq", "avx512vl", "avx512bw"} else "avx2" if "avx2" in flags else "baseline"
assert facts["instructions"] == best, (facts, best)
exported = ctypes.CDLL(facts["path"])  # no other library of this process can use the symbols inside
assert hasattr(exported, "hooke_version")
hidden = ("H5open", "CVode", "ARKStepCreate", "json_loads", "deflate", "dsyev_", "dgemm_", "xerbla_")
assert not any(hasattr(exported, name) for name in hidden)


PROGRAM = [Path(sys.executable).with_name("hooke")]


def program(*arguments, command=PROGRAM, code=0):
    done = subprocess.run([*command, *arguments], capture_output=True, text=True, timeout=60)
    assert done.returncode == code, (arguments, done)
    return done.stdout


def interrupted(*arguments):
    """Ctrl-C: the signal arrives at the program, whose process is that of the command."""
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    running = subprocess.Popen([*PROGRAM, *arguments], **quiet)
    time.sleep(2)
    running.send_signal(signal.SIGINT)
    return running.wait(timeout=60)


scene = hooke.Scene.parse(SCENE)
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    result = scene.run(method="symplectic-euler", step=1e-3, duration=0.5, every=0.05, output="out.h5")
    assert result.status == "finished"
    with h5py.File("out.h5") as file:  # h5py brings an HDF5 of its own
        assert np.array_equal(file["particles/all/position/value"][-1], result.state.q)
        with h5py.File("other.h5", "w") as other:
            other.create_dataset("q", data=result.state.q, compression="gzip")
            scene.run(method="rk4", step=1e-3, duration=0.1, every=0.05, output="again.h5")
    with h5py.File("again.h5") as file:
        assert file["particles/all/position/value"].shape == (3, 64, 3)

    for method in ("cvode-bdf", "cvode-adams", "backward-euler"):
        implicit = scene.run(method=method, step=1e-3, rtol=1e-8, atol=1e-10, duration=0.5)
        assert implicit.status == "finished", method
        assert np.abs(implicit.state.q - result.state.q).max() < 0.05, method

    study = hooke.study(scene, ["symplectic-euler", "verlet", "rk4"], want=1e-4, duration=0.3, every=0.05)
    orders = {name: order.order for name, order in study.orders.items()}
    assert 0.8 < orders["symplectic-euler"] < 1.3 and 3.5 < orders["rk4"] < 4.5, orders
    assert study.recommendation.met and study.reference.methods[1] == "arkode-esdirk", study.reference
    study.write("study.h5")
    with h5py.File("study.h5") as file:
        assert len(file)
    study.write("study.html")
    assert "new Chart(" in Path("study.html").read_text(encoding="utf-8")

    limit = hooke.limit(scene, methods=["symplectic-euler", "rk4"])
    stable, *_ = limit.rows
    assert abs(stable["predicted"] / stable["measured"] - 1) < 0.05, stable
    warnings.simplefilter("ignore", hooke.StepWarning)
    above = scene.run(method="symplectic-euler", step=0.04, duration=40.0, every=0.04)
    assert above.status == "diverged"
    assert hooke.why(above).advice
    assert len(hooke.needs(scene, want=0.05, duration=0.3, every=0.05).rows) > 0

    version = program("--version")
    assert program("--version", command=[sys.executable, "-m", "hooke"]) == version
    assert re.search(rf"^instructions +{best}$", version, re.MULTILINE) and re.search(r"^licence +MIT$", version, re.MULTILINE)
    assert program("--man").startswith(".") and "_hooke()" in program("--completion", "bash")
    program("nothing", code=2)
    scene.save("cloth.json")
    long = ("run", "cloth.json", "--method", "symplectic-euler", "--step", "1e-3")
    program(*long, "--duration", "0.5", "--every", "0.05", "-o", "cloth.h5", "--quiet")
    program("view", "cloth.h5", "-o", "cloth.html")
    assert "THREE" in Path("cloth.html").read_text(encoding="utf-8")
    assert interrupted(*long, "--duration", "1e9") == 130

    ends = []
    threads = [
        threading.Thread(target=lambda: ends.append(scene.run(method="rk4", step=1e-3, duration=2.0, every=1.0)))
        for _ in range(2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(ends) == 2 and np.array_equal(ends[0].state.q, ends[1].state.q)
    os.chdir("/")

subprocess.run([sys.executable, Path(__file__).with_name("bits.py")], check=True)

root = Path(sys.prefix)
foreign = {path for path in loaded() - before if not Path(path).is_relative_to(root) and not C_LIBRARY.search(path)}
foreign -= {path for path in foreign if f"/python3.{sys.version_info.minor}/lib-dynload/" in path}
assert not foreign, foreign
print("libhooke", hooke.__version__, "with", {k: v for k, v in facts.items() if v and k != "path"})
