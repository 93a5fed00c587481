"""Records the headers that callers of this version are compiled against: python tests/abi/freeze.py

Makes tests/abi/baseline/<major.minor>/hooke.h, all public headers as one, without comments. To be run after
every change of a public header; once the minor version is released, the file stays as it is.
"""

import re
from pathlib import Path

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


if __name__ == "__main__":
    text = one_header()
    folder = HERE / "baseline" / minor_version(text)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "hooke.h").write_text("/* clang-format off */\n" + text)
