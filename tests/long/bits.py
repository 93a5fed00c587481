"""Compares the output of tests/long/bits.c in several builds: python tests/long/bits.py fixed|all FILE FILE [FILE
...]

"fixed" looks at what is the same on every machine, "all" also at what is the same with one set of libraries.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import Any


def read(path: str, kinds: str) -> dict[str, str]:
    lines = re.findall(r"^(\S+ \S+ \d) (fixed|library) ([0-9a-f]{16})$", Path(path).read_text(), re.MULTILINE)
    return {what: found for what, kind, found in lines if kinds == "all" or kind == kinds}


def compared(text: str) -> dict[str, Any]:
    """Number of equal lines and of files, from the output of main()."""
    found = re.search(r"^(\d+) hashes are equal in (\d+) files$", text, re.MULTILINE)
    if not found:
        raise ValueError("the bits differ")
    return {"lines": int(found[1]), "files": int(found[2])}


def main(kinds: str, *paths: str) -> int:
    first, *others = (read(path, kinds) for path in paths)
    if not first or not others:
        sys.exit("there is nothing to compare")
    different = 0
    for path, other in zip(paths[1:], others, strict=True):
        for what in sorted(set(first) | set(other)):
            if first.get(what) != other.get(what):
                different += 1
                print(f"{what}: {first.get(what, 'missing')} in {paths[0]}, {other.get(what, 'missing')} in {path}")
    threads: dict[str, set[str]] = {}
    for what, found in first.items():
        threads.setdefault(what.rsplit(" ", 1)[0], set()).add(found)
    for what in (what for what, found in threads.items() if len(found) > 1):
        different += 1
        print(f"{what}: not the same for every number of threads")
    if different == 0:
        print(f"{len(first)} hashes are equal in {len(paths)} files")
    return different > 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
