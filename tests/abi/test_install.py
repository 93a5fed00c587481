"""An installed hooke is found and used, shared and static, by find_package and by pkg-config; so are its sources by
add_subdirectory."""

import os
import re
import shlex
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
BUILD = Path(os.environ["HOOKE_BUILD_DIR"])
CONSUMER = Path(__file__).with_name("consumer")
EXAMPLES = ROOT / "examples/c"
CMAKE, CC, CXX = os.environ["HOOKE_CMAKE"], os.environ["HOOKE_CC"], os.environ["HOOKE_CXX"]
PRESET = os.environ["HOOKE_PRESET"]
PARTS = ("SUNDIALS", "CHOLMOD", "LAPACK", "GSL", "HDF5", "CHARTJS")
QUICK = ("-DHOOKE_KERNEL_OPTIMISATION=-O0", "-DHOOKE_KERNEL_COPIES=OFF")  # to compile
DATE = re.compile(r"\d{4}-\d\d-\d\d")  # of the build, in the manual page
VERSION = re.search(r'#define HOOKE_VERSION +"(.+)"', (ROOT / "include/hooke/base.h").read_text()).group(1)


def run(*command, expect=0, env=None):
    result = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=os.environ | (env or {}))
    assert (result.returncode == 0) == (expect == 0), f"{command}\n{result.stdout}{result.stderr}"
    return result.stdout + result.stderr


def needed(program):
    text = run("ldd", program)
    return "libhooke.so." in text


def check(folder, languages=("c", "cpp")):
    for language in languages:
        shared, static = folder / f"shared_{language}", folder / f"static_{language}"
        for program in (shared, static):
            assert run(program).startswith(VERSION + " ")
        assert needed(shared) and not needed(static)


def configure(folder, *arguments, expect=0, source=CONSUMER):
    compilers = [f"-DCMAKE_C_COMPILER={CC}", f"-DCMAKE_CXX_COMPILER={CXX}"]
    return run(CMAKE, "-S", source, "-B", folder, "-G", "Ninja", *compilers, *arguments, expect=expect)


@pytest.fixture(scope="module")
def prefix(tmp_path_factory):
    """Installed in one place, then moved to another: no file may contain the path."""
    first = tmp_path_factory.mktemp("install") / "first"
    run(CMAKE, "--install", BUILD, "--prefix", first)
    return first.rename(first.with_name("second place"))


def test_files(prefix):
    installed = {p.relative_to(prefix).as_posix() for p in prefix.rglob("*") if not p.is_dir()}
    headers = {"include/" + p.relative_to(ROOT / "include").as_posix() for p in (ROOT / "include").rglob("*.h")}
    scenes = {"share/hooke/examples/scenes/" + p.name for p in (ROOT / "examples/scenes").iterdir()}
    assert headers <= installed
    assert scenes <= installed
    if "HOOKE_CLI" in os.environ:
        for word, file in [("--man", "man/man1/hooke.1"), ("--completion", "bash-completion/completions/hooke")]:
            there, told = ((prefix / "share" / file).read_text(), run(prefix / "bin/hooke", word, "bash"))
            assert DATE.sub("", there)[:60] == DATE.sub("", told)[:60]
    assert {p for p in installed if p.startswith("include/")} == headers


def test_program(prefix):
    if "HOOKE_CLI" not in os.environ:
        pytest.skip("this build has no program")
    assert VERSION in run(prefix / "bin/hooke", "--version")


def test_report(prefix, tmp_path):
    """The installed program finds the page of a report in its own share/hooke, also after a move."""
    pages = {p.name for p in (prefix / "share/hooke").glob("*.*")}
    if "HOOKE_CLI" not in os.environ or not pages:
        pytest.skip("this build writes no reports")
    sources = {p.name for p in (ROOT / "src/io/page/assets").rglob("*.*")}
    assert pages == sources | {"chart.js", "three.js", "three_orbit.js"}
    oscillator, stiff = (prefix / f"share/hooke/examples/scenes/{name}.json" for name in ("oscillator", "stiff-spring"))
    texts = ""
    for words in (("why", stiff, "--step", "0.0025"), ("modes", stiff), ("needs", oscillator, "--want", "0.1"),
                  ("limit", oscillator, "--methods", "rk4"), ("study", oscillator, "--methods", "rk4")):
        command = [prefix / "bin/hooke", *words, "--report", tmp_path / "page.html"]
        if oscillator in words:
            command += ["--duration", "0.5"]
        run(*command)
        texts += (tmp_path / "page.html").read_text()
    run(prefix / "bin/hooke", "run", oscillator, "-o", tmp_path / "out.h5")
    for files in (("out.h5",), ("out.h5", "out.h5")):
        run(prefix / "bin/hooke", "view", *(tmp_path / name for name in files), "-o", tmp_path / "page.html")
        texts += (tmp_path / "page.html").read_text()
    seen = {name for name in pages if (prefix / "share/hooke" / name).read_text() in texts}
    assert pages - seen == {"page.html", "view.html", "views.html"}, "the forms, with marks where the others are put in"
    (prefix / "share/hooke/study.js").rename(prefix / "share/hooke/away.js")
    assert "share/hooke/study.js" in run(*command, expect=6)
    (prefix / "share/hooke/away.js").rename(prefix / "share/hooke/study.js")


def test_find_package(prefix, tmp_path):
    configure(tmp_path, f"-DCMAKE_PREFIX_PATH={prefix}", f"-DHOOKE_WANTED={VERSION}")
    run(CMAKE, "--build", tmp_path)
    check(tmp_path)


QUARTERED = {
    "driven_particles": ("step = 1e-4", "step = 2.5e-5"), "many_systems": ('"step", 1e-4', '"step", 2.5e-5'),
    "own_force": ("{1e-4, 5e-4}", "{2.5e-5, 1.25e-4}"), "own_time_loop": ("step = 1e-4", "step = 2.5e-5"),
}  # fmt: skip


def build_examples(prefix, source, folder, *targets):
    configure(folder, f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release", source=source)
    run(CMAKE, "--build", folder, *(["--target", *targets] if targets else []))


def test_examples(prefix, tmp_path):
    """Each example prints something, and its exit code says that it is right; at a quarter of the step it prints the same
    digits, to one in the last place."""
    build_examples(prefix, EXAMPLES, tmp_path)
    lines = {}
    scene = prefix / "share/hooke/examples/scenes/rope.json"
    words = {"plain": [scene, "rk4", "1e-3", "10"], "lecture": ["plane"]}
    for source in sorted(EXAMPLES.glob("*.c")):
        if source.stem != "tether" and (source.stem not in ("study", "plain") or PRESET != "minimal"):
            lines[source.stem] = run(tmp_path / source.stem, *words.get(source.stem, [])).splitlines()
    if PRESET != "minimal":
        run(prefix / "bin/hooke", "check", scene, "--force", next(tmp_path.glob("tether.*")))
    assert lines["own_time_loop"][-1].endswith("particles on the floor: yes")
    inside = [float(line.split()[-7]) for line in lines["own_force"]]
    assert len(inside) == 2 and all(0 < mm < 1 for mm in inside)
    assert [line.split()[-2] for line in lines["driven_particles"]] == ["-0.050", "+0.000", "+0.050", "+0.000"]
    assert lines["many_systems"][-1] == "the same bits as in one thread"
    assert "study" not in lines or lines["study"][-1].startswith("run with it: ")
    finer = shutil.copytree(EXAMPLES, tmp_path / "finer")
    for name, (step, quarter) in QUARTERED.items():
        text = (finer / f"{name}.c").read_text()
        assert text.count(step) == 1, name
        (finer / f"{name}.c").write_text(text.replace(step, quarter))
    build_examples(prefix, finer, tmp_path / "fine", *QUARTERED)
    for name in QUARTERED:
        one, other = (re.findall(r"[-+]?\d+\.\d+", text) for text in ("\n".join(lines[name]), run(tmp_path / "fine" / name)))
        assert len(one) == len(other) > 0
        for a, b in zip(one, other):
            assert abs(float(a) - float(b)) < 1.01 * 10.0 ** -len(a.split(".")[1]), (name, a, b)


def test_find_package_refuses_another_version(prefix, tmp_path):
    text = configure(tmp_path, f"-DCMAKE_PREFIX_PATH={prefix}", "-DHOOKE_WANTED=99.0", expect=1)
    assert "99.0" in text


@pytest.mark.skipif(not shutil.which("pkg-config"), reason="pkg-config is not installed")
def test_pkg_config(prefix, tmp_path):
    pc = next(prefix.rglob("hooke.pc"))
    env = {"PKG_CONFIG_PATH": str(pc.parent)}
    assert run("pkg-config", "--modversion", "hooke", env=env).strip() == VERSION
    flags = shlex.split(run("pkg-config", "--cflags", "--libs", "hooke", env=env))
    rpath = f"-Wl,-rpath,{next(prefix.rglob('libhooke.so')).parent}"
    run(CC, CONSUMER / "main.c", *flags, rpath, "-o", tmp_path / "shared_c")
    # with both libraries in one folder, the static one is selected by its file name
    flags = shlex.split(run("pkg-config", "--static", "--cflags", "--libs", "hooke", env=env))
    flags = ["-l:libhooke.a" if f == "-lhooke" else f for f in flags]
    run(CC, CONSUMER / "main.c", *flags, "-o", tmp_path / "static_c")
    check(tmp_path, languages=("c",))


def test_folders_given_in_full(prefix, tmp_path):
    """A package stages the files below DESTDIR; a folder of its own for libraries is found from wherever it is."""
    stage = tmp_path / "stage"
    run(CMAKE, "--install", BUILD, "--prefix", "/usr", env={"DESTDIR": str(stage)})
    assert (stage / "usr/include/hooke.h").exists()
    if "HOOKE_CLI" in os.environ:
        assert VERSION in run(stage / "usr/bin/hooke", "--version")
    run(CMAKE, "-S", ROOT, "-B", tmp_path / "build", "-G", "Ninja", f"-DCMAKE_C_COMPILER={CC}", "-DCMAKE_INSTALL_PREFIX=/usr",
        "-DCMAKE_INSTALL_LIBDIR=/opt/hooke/lib64", "-DBUILD_TESTING=OFF", *(f"-DHOOKE_{part}=OFF" for part in PARTS))
    folder = tmp_path / "opt/hooke/lib64/pkgconfig"
    folder.mkdir(parents=True)
    shutil.copy(tmp_path / "build/hooke.pc", folder)
    if shutil.which("pkg-config"):
        flags = shlex.split(run("pkg-config", "--cflags", "--libs", "hooke", env={"PKG_CONFIG_PATH": str(folder)}))
        places = [os.path.normpath(flag[2:]) for flag in flags[:2]]
        assert places == [str(tmp_path / "usr/include"), str(tmp_path / "opt/hooke/lib64")]


@pytest.mark.parametrize("way", ["SOURCES", "FETCHED"])
def test_sources(way, tmp_path):
    """As a subdirectory or by FetchContent, which configure alike: it is built once, without other libraries."""
    told = configure(tmp_path, f"-DHOOKE_{way}={ROOT}", "-DCMAKE_BUILD_TYPE=None", *QUICK)
    assert all(f"{part.lower()}: left out" in told for part in PARTS)
    if way == "FETCHED" and PRESET in ("minimal", ""):
        run(CMAKE, "--build", tmp_path, "-j2")
        check(tmp_path)


def test_missing_part_is_named(tmp_path):
    """A requested part that is missing is an error that names the package."""
    text = configure(tmp_path, f"-DHOOKE_SOURCES={ROOT}", "-DHOOKE_GSL=ON", "-DHOOKE_GSL_INCLUDE_DIR=", expect=1)
    assert "apt-get install libgsl-dev" in text
