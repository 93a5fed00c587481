"""The Fortran module of an installed hooke is compiled by the compiler of the project that uses it: by find_package,
by pkg-config, and from the sources of hooke; the examples run with it."""

import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
BUILD = Path(os.environ["HOOKE_BUILD_DIR"])
EXAMPLES = ROOT / "examples/fortran"
CMAKE, CC, COMPILER = os.environ["HOOKE_CMAKE"], os.environ["HOOKE_CC"], os.environ["HOOKE_FORTRAN"]
pytestmark = pytest.mark.skipif(not COMPILER, reason="there is no Fortran compiler")


def run(*command, expect=0, **more):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)
    assert (result.returncode == 0) == (expect == 0), f"{command}\n{result.stdout}{result.stderr}"
    return result.stdout + result.stderr


def configure(source, folder, *arguments, expect=0):
    return run(CMAKE, "-S", source, "-B", folder, "-G", "Ninja", f"-DCMAKE_C_COMPILER={CC}",
               f"-DCMAKE_Fortran_COMPILER={COMPILER}", *arguments, expect=expect)


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    """Installed in one place, then moved to another."""
    first = tmp_path_factory.mktemp("install") / "first"
    run(CMAKE, "--install", BUILD, "--prefix", first)
    return first.rename(first.with_name("second place"))


def test_files(prefix):
    folder = prefix / "share/hooke/fortran"
    installed = {p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file()}
    assert installed == {*(folder / "sources.txt").read_text().split(), "sources.txt"}
    assert not list(prefix.rglob("*.mod")), "no module file of one compiler"


WORDS = {"own_loop": r"nine tenths of 0\.625 J are gone after \d\.\d\d s", "own_force": r"z = -?\d*\.\d{3} m",
         "driven_particle": r"at *-?0?\.0000 *0?\.1000 *-?0?\.0000 m", "study": r"recommended: \S+ with steps|no study: ",
         "flow": r"(?s)river +6\.0+ +-0\.488169686858.*linear .*van-der-pol "}


def test_examples(prefix, tmp_path):
    text = configure(EXAMPLES, tmp_path, f"-DCMAKE_PREFIX_PATH={prefix}")
    run(CMAKE, "--build", tmp_path, "-j2")
    assert {p.stem for p in EXAMPLES.glob("*.f90")} == {*WORDS, "threads", "tether"}, "every example is run"
    for name, words in WORDS.items():
        assert re.search(words, run(tmp_path / name)), name
    if "Found OpenMP_Fortran" in text:
        lines = run(tmp_path / "threads", env=os.environ | {"OMP_NUM_THREADS": "4"}).splitlines()
        ends = [[float(x) for x in line.split()[1:]] for line in lines]
        assert len(ends) == 8 and all(abs(a - b) < 0.0011 for end in ends for a, b in zip(end, ends[7]))


PROGRAM = """
program long_numbers
  use hooke
  implicit none
  type(hooke_system) :: system
  integer :: first
  call system%create()
  call system%add_particles(reshape([0, 0, 0, 1, 0, 0]*1.0_hooke_real, [3, 2]), 1.0_hooke_real, first=first)
  call system%pin([first])
  print "(i0, 1x, a, 2(1x, i0))", storage_size(first), hooke_version(), first, system%particle_count()
end program
"""


@pytest.mark.skipif(not shutil.which("pkg-config"), reason="pkg-config is not installed")
def test_pkg_config(prefix, tmp_path):
    """Here with default integers of 8 bytes, which the module accepts."""
    env = os.environ | {"PKG_CONFIG_PATH": str(next(prefix.rglob("hooke.pc")).parent)}
    sources = shlex.split(run("pkg-config", "--variable=fortran_sources", "hooke", env=env).replace("\n", ""))
    assert sources and all(Path(s).is_file() for s in sources)
    flags = shlex.split(run("pkg-config", "--libs", "hooke", env=env))
    rpath = f"-Wl,-rpath,{next(prefix.rglob('libhooke.so')).parent}"
    (tmp_path / "program.f90").write_text(PROGRAM)
    longer = ["-fdefault-integer-8"] if "GNU Fortran" in run(COMPILER, "--version") else []
    run(COMPILER, "-O0", *longer, *sources, "program.f90", *flags, rpath, "-o", "program", cwd=tmp_path)
    words = run(tmp_path / "program").split()
    assert words[2:] == ["1", "2"] and words[0] == ("64" if longer else "32")


def project(folder, languages, body):
    folder.mkdir()
    (folder / "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION 3.25)\nproject(user LANGUAGES {languages})\n{body}\n")
    return folder


def test_component_in_a_project_without_fortran(prefix, tmp_path):
    source = project(tmp_path / "source", "C", "find_package(hooke CONFIG REQUIRED COMPONENTS fortran)")
    text = configure(source, tmp_path / "build", f"-DCMAKE_PREFIX_PATH={prefix}", expect=1)
    assert "LANGUAGES Fortran" in re.sub(r"\s+", " ", text)


def test_subdirectory(tmp_path):
    """hooke::fortran exists in a project that has Fortran and builds hooke itself."""
    body = f"add_subdirectory({ROOT} hooke EXCLUDE_FROM_ALL)\nif(NOT TARGET hooke::fortran)\nmessage(FATAL_ERROR none)\nendif()"
    configure(project(tmp_path / "source", "C Fortran", body), tmp_path / "build",
              *(f"-DHOOKE_{part}=OFF" for part in ("SUNDIALS", "CHOLMOD", "GSL", "HDF5")))
