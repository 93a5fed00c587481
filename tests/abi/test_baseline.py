"""What a closed version had only grows: programs compiled against it run with this library, libabigail finds no function
removed or changed since, and the names of Python and Fortran are there and take what they took. What this version would be
as a baseline is held in the same way, so that the tests have something to hold before the first version is closed."""

import functools
import os
import re
import shutil
import subprocess
from pathlib import Path

import freeze
import headers
import names
import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
LIBRARY = Path(os.environ["HOOKE_LIBRARY"])
CC = os.environ["HOOKE_CC"]
CLOSED = sorted(Path(__file__).with_name("baseline").glob("*"))
LISTS = ("python.txt", "fortran.txt")
WARNINGS = ("-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror")

abigail = pytest.mark.skipif(not shutil.which("abidiff"), reason="libabigail (abigail-tools) is not installed")


@pytest.fixture(scope="module", params=["now", *CLOSED], ids=lambda p: getattr(p, "name", p))
def baseline(request, tmp_path_factory):
    return freeze.write(tmp_path_factory.mktemp("baseline") / "now") if request.param == "now" else request.param


def numbers(header):
    """Names and values of all #define of a header with a value."""
    return dict(re.findall(r"^#define (HOOKE_\w+) +(.+?)$", re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL), flags=re.M))


def changed_numbers(old, new):
    return {name for name, value in numbers(old).items()
            if numbers(new).get(name, "").strip() != value.strip() and name not in ("HOOKE_VERSION", "HOOKE_API")}


@pytest.fixture(scope="module")
def library_of(tmp_path_factory):
    return functools.cache(lambda header: compiled(header, tmp_path_factory.mktemp("library")))


def compiled(header, folder):
    """A shared library with the functions of a header, and empty bodies, called as the library of that ABI is."""
    abi = numbers(header)["HOOKE_ABI"].strip()
    (folder / "hooke.h").write_text(header)
    (folder / "hooke.map").write_text(f"HOOKE_{abi} {{ global: hooke_*; local: *; }};\n")
    lines = ['#include "hooke.h"']
    for _, words in headers.statements(header):
        if match := re.fullmatch(r"HOOKE_API ([^(]*?)\b(\w+) ?\((.*)\)", words):
            body = "" if match[1].strip() == "void" else "return 0;"
            lines.append(f"{match[1]}{match[2]}({match[3]}) {{ {body} }}")
    (folder / "hooke.c").write_text("\n".join(lines) + "\n")
    library = folder / f"libhooke.so.{abi}"
    subprocess.run([CC, "-g", "-shared", "-fPIC", f"-Wl,-soname,{library.name}", f"-Wl,--version-script={folder}/hooke.map",
                    folder / "hooke.c", "-o", library], check=True)
    return library


def differences(old, new, *options):
    """(removed, changed, added) functions from one library to another, and the output of abidiff."""
    command = [str(c) for c in ("abidiff", *options, old, new)]
    text = subprocess.run(command, capture_output=True, text=True).stdout
    counts = re.search(r"Functions changes summary: (\d+) Removed, (\d+) Changed.*?, (\d+) Added", text)
    assert counts or not text, text
    return (tuple(int(n) for n in counts.groups()) if counts else (0, 0, 0)), text


def differences_of_headers(old, new, library_of):
    """The same between two headers. Opaque structs are opaque on both sides, so that no change is suppressed as
    harmless."""
    return differences(library_of(old), library_of(new), "--harmless")


def test_old_program(baseline, tmp_path, library_of):
    """Linked with a library of that version, of which it keeps the name, and run with this one."""
    header, program = (baseline / "hooke.h").read_text(), tmp_path / "program"
    old = library_of(header)
    subprocess.run([CC, *WARNINGS, baseline / "program.c", f"-I{baseline}", old, "-lm", "-o", program], check=True)
    result = subprocess.run([program], capture_output=True, text=True, env=os.environ | {"LD_LIBRARY_PATH": str(LIBRARY.parent)})
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith(f"compiled with {freeze.minor_version(header)}.")


def test_numbers_stay(baseline):
    assert changed_numbers((baseline / "hooke.h").read_text(), freeze.one_header()) == set()


@pytest.mark.parametrize("which, now", [(LISTS[0], names.of_python), (LISTS[1], names.of_fortran)], ids=LISTS)
def test_names_stay(baseline, which, now):
    old = (baseline / which).read_text().splitlines()
    assert len(old) > 200 and names.lost(old, list(now())) == []


@pytest.mark.parametrize("old, new", [
    ("hooke.run(problem, *, state=)", "hooke.go(problem, *, state=)"),
    ("hooke.run(problem, *, state=)", "hooke.run"),
    ("hooke.run(problem, *, state=)", "hooke.run(problem, *, start=)"),
    ("hooke.run(problem, *, state=)", "hooke.run(problem, *, state)"),
    ("hooke.run(problem, *, state=)", "hooke.run(problem, method, *, state=)"),
    ("hooke.cost(problem, state=)", "hooke.cost(problem, budget=, state=)"),
    ("hooke.cost(problem, state=)", "hooke.cost(problem, *, state=)"),
    ("hooke_force%add[n, t, force]", "hooke_force%add[n, t, force, work]"),
])  # fmt: skip
def test_planted_names(old, new):
    grown = [old.replace("=)", "=, *, more=)"), "hooke.new(problem)"]
    assert names.lost([old], grown) == [] and names.lost([old], [*grown[1:], new]) == [old]


def test_planted_number():
    old = freeze.one_header()
    assert changed_numbers(old, re.sub(r"(HOOKE_DIVERGED +)2", r"\g<1>4", old)) == {"HOOKE_DIVERGED"}
    assert changed_numbers(old, old.replace("#define HOOKE_STOPPED", "#define HOOKE_ENDED")) == {"HOOKE_STOPPED"}


@abigail
def test_library_has_the_baseline(baseline, library_of):
    header = (baseline / "hooke.h").read_text()
    for (removed, changed, _), text in (differences(library_of(header), LIBRARY),
                                        differences_of_headers(header, freeze.one_header(), library_of)):
        assert (removed, changed) == (0, 0), text


def listed(folder):
    """{file: names} of a baseline."""
    return {"hooke.h": headers.functions((folder / "hooke.h").read_text())} | {
        which: set((folder / which).read_text().splitlines()) for which in LISTS}


def unkept(changelog, baselines, now):
    """Faults of the baselines {minor version: folder}: a version with a date has one, and no other has; and as long as the
    last version has a date, that is what there is `now`, no less and no more."""
    sections = re.findall(r"^## (\d+\.\d+)\.\d+(.*)", changelog, flags=re.MULTILINE)
    dated = {minor for minor, words in sections if "unreleased" not in words}
    faults = [f"{minor}: without a date, or without a baseline" for minor in sorted(dated ^ baselines.keys())]
    if not faults and sections[0][0] in dated and "unreleased" not in sections[0][1]:
        old, new = listed(baselines[sections[0][0]]), listed(now)
        faults = [f"{file}: {name}" for file in old for name in sorted(old[file] ^ new[file])]
    return faults


def test_closed_versions_have_their_baselines(tmp_path):
    """`python tests/abi/freeze.py` makes that of the version that is being closed."""
    changelog = (ROOT / "CHANGELOG.md").read_text()
    assert unkept(changelog, {path.name: path for path in CLOSED}, freeze.write(tmp_path)) == []


def test_planted_baselines(tmp_path):
    changelog, now = "## 0.4.1 (2026-12-01)\n\n## 0.3.0 (2026-11-28)\n\n## 0.2.0 (unreleased)\n", freeze.write(tmp_path / "now")
    both = {minor: freeze.write(tmp_path / minor) for minor in ("0.3", "0.4")}
    assert unkept(changelog, both, now) == []
    assert len(unkept(changelog, {"0.3": both["0.3"]}, now)) == 1
    assert len(unkept(changelog, both | {"0.2": both["0.3"]}, now)) == 1
    text = (both["0.4"] / "python.txt").read_text()
    (both["0.4"] / "python.txt").write_text(text.replace("hooke.open(path)\n", ""))
    assert unkept(changelog, both, now) == ["python.txt: hooke.open(path)"]
    assert unkept("## 0.5.0 (unreleased)\n" + changelog, both, now) == []


@abigail
@pytest.mark.parametrize(
    "pattern, by, expected",
    [
        (r"HOOKE_API void hooke_state_set_time\([^)]*\);", "", (1, 0, 0)),
        (r"(hooke_system_add_particles\(hooke_system \*system, )int64_t", r"\1int32_t", (0, 1, 0)),
        (r"(HOOKE_API) int64_t (hooke_state_size\()", r"\1 double \2", (0, 1, 0)),
        (r"(typedef int32_t hooke_observer\()int64_t", r"\1double", (0, 3, 0)),
        (r"(HOOKE_API int32_t hooke_abi\(void\);)", r"\1 HOOKE_API int32_t hooke_new(void);", (0, 0, 1)),
    ],
)
def test_planted_change(pattern, by, expected, library_of):
    old = freeze.one_header()
    new, count = re.subn(pattern, by, old)
    assert count == 1
    counts, text = differences_of_headers(old, new, library_of)
    assert counts == expected, text


@abigail
def test_planted_library(library_of):
    """A library that lacks a function, and one that takes another type."""
    header = freeze.one_header().replace("hooke_system_create(", "hooke_system_made(")
    new = re.sub(r"(hooke_state_set_time\(hooke_state \*state, )double", r"\1int32_t", header)
    (removed, changed, added), text = differences(LIBRARY, library_of(new))
    assert (removed, changed, added) == (1, 1, 1), text
