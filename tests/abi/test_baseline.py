"""The promise of the ABI: programs compiled against an older minor version run with this library, and libabigail finds no
function removed or changed since."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import freeze
import headers
import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
LIBRARY = Path(os.environ["HOOKE_LIBRARY"])
CC = os.environ["HOOKE_CC"]
BASELINES = sorted(Path(__file__).with_name("baseline").iterdir())
WARNINGS = ("-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror")

abigail = pytest.mark.skipif(not shutil.which("abidiff"), reason="libabigail (abigail-tools) is not installed")


def numbers(header):
    """Names and values of all #define of a header with a value."""
    return dict(re.findall(r"^#define (HOOKE_\w+) +(.+?)$", re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL), flags=re.M))


def changed_numbers(old, new):
    return {name for name, value in numbers(old).items()
            if numbers(new).get(name, "").strip() != value.strip() and name not in ("HOOKE_VERSION", "HOOKE_API")}


def library_of(header, folder):
    """A shared library with the functions of a header, and empty bodies."""
    folder.mkdir()
    (folder / "hooke.h").write_text(header)
    lines = ['#include "hooke.h"']
    for _, words in headers.statements(header):
        if match := re.fullmatch(r"HOOKE_API ([^(]*?)\b(\w+) ?\((.*)\)", words):
            body = "" if match[1].strip() == "void" else "return 0;"
            lines.append(f"{match[1]}{match[2]}({match[3]}) {{ {body} }}")
    (folder / "hooke.c").write_text("\n".join(lines) + "\n")
    library = folder / LIBRARY.resolve().name
    soname = re.sub(r"(\.so\.\d+).*", r"\1", library.name)
    subprocess.run([CC, "-g", "-shared", "-fPIC", f"-Wl,-soname,{soname}", f"-Wl,--version-script={ROOT}/src/hooke.map",
                    folder / "hooke.c", "-o", library], check=True)
    return library


def differences(old, new, *options):
    """(removed, changed, added) functions from one library to another, and the output of abidiff."""
    command = [str(c) for c in ("abidiff", *options, old, new)]
    text = subprocess.run(command, capture_output=True, text=True).stdout
    counts = re.search(r"Functions changes summary: (\d+) Removed, (\d+) Changed.*?, (\d+) Added", text)
    assert counts or not text, text
    return (tuple(int(n) for n in counts.groups()) if counts else (0, 0, 0)), text


def differences_of_headers(old, new, tmp_path):
    """The same between two headers. Opaque structs are opaque on both sides, so that no change is suppressed as
    harmless."""
    return differences(library_of(old, tmp_path / "one"), library_of(new, tmp_path / "other"), "--harmless")


@pytest.mark.parametrize("baseline", BASELINES, ids=lambda p: p.name)
def test_old_program(baseline, tmp_path):
    program = tmp_path / "program"
    flags = [f"-I{baseline}", f"-L{LIBRARY.parent}", "-lhooke", "-lm", f"-Wl,-rpath,{LIBRARY.parent}"]
    subprocess.run([CC, *WARNINGS, baseline / "program.c", *flags, "-o", program], check=True)
    result = subprocess.run([program], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith(f"compiled with {baseline.name}.")


@pytest.mark.parametrize("baseline", BASELINES, ids=lambda p: p.name)
def test_numbers_stay(baseline):
    assert changed_numbers((baseline / "hooke.h").read_text(), freeze.one_header()) == set()


def test_planted_number():
    old = freeze.one_header()
    assert changed_numbers(old, re.sub(r"(HOOKE_DIVERGED +)2", r"\g<1>4", old)) == {"HOOKE_DIVERGED"}
    assert changed_numbers(old, old.replace("#define HOOKE_STOPPED", "#define HOOKE_ENDED")) == {"HOOKE_STOPPED"}


@abigail
@pytest.mark.parametrize("baseline", BASELINES, ids=lambda p: p.name)
def test_library_has_the_baseline(baseline, tmp_path):
    header = (baseline / "hooke.h").read_text()
    old = library_of(header, tmp_path / "old")
    for (removed, changed, _), text in (differences(old, LIBRARY),
                                        differences_of_headers(header, freeze.one_header(), tmp_path)):
        assert (removed, changed) == (0, 0), text


def test_baseline_is_up_to_date():
    """That of this version has every function, and no other."""
    header = freeze.one_header()
    baseline = Path(__file__).with_name("baseline") / freeze.minor_version(header) / "hooke.h"
    changed = headers.functions(header) ^ headers.functions(baseline.read_text())
    assert not changed, f"python tests/abi/freeze.py adds or removes {sorted(changed)}"


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
def test_planted_change(pattern, by, expected, tmp_path):
    old = freeze.one_header()
    new, count = re.subn(pattern, by, old)
    assert count == 1
    counts, text = differences_of_headers(old, new, tmp_path)
    assert counts == expected, text


@abigail
def test_planted_library(tmp_path):
    """A library that lacks a function, and one that takes another type."""
    header = freeze.one_header().replace("hooke_system_create(", "hooke_system_made(")
    new = re.sub(r"(hooke_state_set_time\(hooke_state \*state, )double", r"\1int32_t", header)
    (removed, changed, added), text = differences(LIBRARY, library_of(new, tmp_path / "new"))
    assert (removed, changed, added) == (1, 1, 1), text
