"""The package as a user gets it: found, refused, installed."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import PACKAGES, ROOT

import hooke
from hooke._library import lib


def python(code, **environment):
    """Runs code in a new Python without our settings; a value of None removes a variable."""
    clean = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "HOOKE_LIBRARY")}
    clean.update({k: str(v) for k, v in environment.items()})
    return subprocess.run(
        [sys.executable, "-c", code], env=clean, cwd="/", capture_output=True, text=True, timeout=120
    )


def compiled(tmp_path, code):
    """A shared library of this C code."""
    source, library = tmp_path / "fake.c", tmp_path / "libfake.so"
    source.write_text(code)
    subprocess.run(
        [os.environ.get("HOOKE_CC") or "cc", "-shared", "-fPIC", "-o", library, source], check=True
    )
    return library


def test_versions_agree():
    header = (ROOT / "include/hooke/base.h").read_text()
    assert re.search(r'#define HOOKE_VERSION +"([^"]+)"', header).group(1) == hooke.__version__
    assert hooke.build_facts()["version"] == hooke.__version__


def test_no_library(tmp_path):
    shutil.copytree(PACKAGES / "hooke", tmp_path / "hooke", ignore=shutil.ignore_patterns("lib*", "share"))
    run = python("import hooke", PYTHONPATH=tmp_path)
    if run.returncode == 0:
        pytest.skip("a hooke library is installed in this machine's own folders")
    assert "ImportError: the hooke library was not found" in run.stderr
    assert "pip install" in run.stderr and "HOOKE_LIBRARY" in run.stderr


def test_a_library_that_is_not_there():
    run = python("import hooke", PYTHONPATH=PACKAGES, HOOKE_LIBRARY="/nowhere/libhooke.so")
    assert run.returncode and "ImportError: HOOKE_LIBRARY names '/nowhere/libhooke.so'" in run.stderr


def test_another_abi_is_refused(tmp_path):
    library = compiled(tmp_path, "int hooke_abi(void) { return 7; }")
    run = python("import hooke", PYTHONPATH=PACKAGES, HOOKE_LIBRARY=library)
    assert run.returncode and "has ABI 7, this package needs ABI 1" in run.stderr


def test_another_library_is_refused(tmp_path):
    library = compiled(tmp_path, "int nothing(void) { return 7; }")
    run = python("import hooke", PYTHONPATH=PACKAGES, HOOKE_LIBRARY=library)
    assert run.returncode and "is not the hooke library" in run.stderr


def test_a_library_without_a_function_is_refused(tmp_path):
    library = compiled(tmp_path, "int hooke_abi(void) { return 1; }")
    run = python("import hooke", PYTHONPATH=PACKAGES, HOOKE_LIBRARY=library)
    assert run.returncode and "has no function hooke_last_error" in run.stderr


def test_importing_is_light():
    code = "import sys, hooke; print([m for m in ('matplotlib', 'h5py', 'scipy') if m in sys.modules])"
    run = python(code, PYTHONPATH=PACKAGES, HOOKE_LIBRARY=lib.path)
    assert run.stdout.strip() == "[]", run.stderr


@pytest.mark.parametrize("module", ["plot", "animation"])
def test_pictures_need_matplotlib_and_say_so(module):
    code = f"import sys; sys.modules['matplotlib'] = None; import hooke; import hooke.{module}"
    run = python(code, PYTHONPATH=PACKAGES, HOOKE_LIBRARY=lib.path)
    assert run.returncode and "need matplotlib" in run.stderr and "pip install matplotlib h5py" in run.stderr


def test_leaving_with_everything_alive():
    code = """
import hooke
system = hooke.System()
system.add_particles([[0, 0, 0]], mass=1)
system.set_force(lambda t, q, v, force: None)
integrator = hooke.Integrator(system, method="symplectic-euler", step=1.0, duration=2.0)
state = system.state()
view = state.q
print(integrator.run(state))
"""
    run = python(code, PYTHONPATH=PACKAGES, HOOKE_LIBRARY=lib.path)
    assert (run.returncode, run.stdout, run.stderr) == (0, "finished\n", "")


def test_a_subinterpreter_runs():
    """Which has no signals."""
    inside = "import hooke; system = hooke.System(); system.add_particles([[0, 0, 0]], [[1, 0, 0]], mass=1); " \
             "print(hooke.run(system, method='rk4', step=0.5, duration=2.0).state.q[0, 0])"
    code = f"import _xxsubinterpreters as of; of.run_string(of.create(), {inside!r})"
    run = python(code, PYTHONPATH=PACKAGES, HOOKE_LIBRARY=lib.path, PYTHONWARNINGS="ignore")
    if "No module named" in run.stderr or "numpy" in run.stderr:
        pytest.skip("NumPy loads in none here")
    assert run.stdout == "2.0\n", run.stderr


@pytest.mark.parametrize("first", ["h5py", "hooke"])
def test_h5py_and_the_library_get_along(first, tmp_path):
    """Each brings its own HDF5."""
    other = {"h5py": "hooke", "hooke": "h5py"}[first]
    code = f"""
import {first}, {other}
system = hooke.System()
system.add_particles([[0, 0, 0]], [[1, 0, 0]], mass=1)
for k in range(3):
    hooke.run(system, method="symplectic-euler", step=0.5, duration=2.0, output={str(tmp_path / "a.h5")!r})
    with h5py.File({str(tmp_path / "a.h5")!r}) as file:
        print(file["particles/all/position/value"][-1, 0, 0])
"""
    run = python(code, PYTHONPATH=PACKAGES, HOOKE_LIBRARY=lib.path)
    assert (run.returncode, run.stdout, run.stderr) == (0, "2.0\n" * 3, "")


def test_pip_install_gives_a_package_that_stands_alone(tmp_path):
    """The slow one: builds the library as a user's pip does, but without optimisation. pip fetches its build tools
    from the network."""
    environment = {k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "HOOKE_LIBRARY")}
    target = tmp_path / "packages"
    before = set(ROOT.iterdir()) | set((ROOT / "bindings/python").iterdir())
    command = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"]
    settings = ["cmake.build-type=None", "cmake.define.HOOKE_KERNEL_OPTIMISATION=-O0", "cmake.define.HOOKE_KERNEL_COPIES=OFF"]
    install = subprocess.run(
        [*command, *(f"--config-settings={setting}" for setting in settings), "--target", target, "."],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert install.returncode == 0, install.stderr
    assert set(ROOT.iterdir()) | set((ROOT / "bindings/python").iterdir()) == before
    modules, built = ({path.relative_to(of / "hooke") for path in (of / "hooke").rglob("*.py")} for of in (target, PACKAGES))
    assert modules == built and Path("plot/__init__.py") in modules
    packages = {path.parts[0] for path in modules} | {"__pycache__"}
    files = {path.name for path in (target / "hooke").iterdir()} - packages
    share = {"share"} if hooke.build_facts()["chartjs"] else set()  # files of reports
    others = {"libhooke.so", "hooke", "LICENSE", "py.typed"}
    assert files == others | share
    beside = {path.name for path in target.iterdir()} - {"__pycache__"}
    assert beside == {"hooke", "hooke_program.py", "bin", f"libhooke-{hooke.__version__}.dist-info"}
    code = """
import hooke
scene = hooke.Scene.parse(
    {"hooke": 1, "particles": {"position": [[0, 0, 0]], "mass": 1}, "gravity": [0, -8, 0]}
)
result = scene.run(method="symplectic-euler", step=0.5, duration=1.0)
print(hooke.build_facts()["path"], result.state.v[0, 1], hooke.build_facts()["sundials"] != "")
"""
    run = python(code, PYTHONPATH=target)
    assert run.stdout.split() == [str(target / "hooke" / "libhooke.so"), "-8.0", "True"], run.stderr
    version = subprocess.run([target / "bin/hooke", "--version"], env=environment | {"PYTHONPATH": str(target)}, capture_output=True, text=True)
    assert re.search("^licence +MIT$", version.stdout, re.MULTILINE), version
