"""Closes a minor version: python tests/abi/freeze.py, after `make`

Writes tests/abi/baseline/<major.minor>, what callers of this version rely on: all public headers as one, without comments
(hooke.h), a program that is compiled against them (program.c), and the names of the Python package and of the Fortran
module (names.py). The folder stays as it is from then on; what it holds may only grow.
"""

import re
from pathlib import Path

import names

HERE = Path(__file__).parent
INCLUDE = HERE.parents[1] / "include"


def one_header(include=INCLUDE, name="hooke.h", seen=None):
    """The text of a public header with its includes expanded, each once."""
    seen = set() if seen is None else seen
    if name in seen:
        return ""
    seen.add(name)
    text = re.sub(r"/\*.*?\*/", "", (include / name).read_text(), flags=re.DOTALL)
    folder = Path(name).parent
    text = re.sub(r'#include "(.+)"\n', lambda m: one_header(include, (folder / m[1]).as_posix(), seen), text)
    return re.sub(r"[ \t]*\n+", "\n", text).lstrip()


def minor_version(header):
    return re.search(r'#define HOOKE_VERSION +"(\d+\.\d+)\.', header)[1]


def write(folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "hooke.h").write_text("/* clang-format off */\n" + one_header())
    (folder / "program.c").write_text((HERE / "program.c").read_text())
    for language, listed in (("python", names.of_python), ("fortran", names.of_fortran)):
        (folder / f"{language}.txt").write_text("".join(f"{line}\n" for line in sorted(listed())))
    return folder


if __name__ == "__main__":
    print(write(HERE / "baseline" / minor_version(one_header())))
