"""Fills the tables of docs/notes/extremes.md with results of the suite: python docs/make_extremes.py BUILD [--check]

BUILD is a build folder with its tests, such as build/release. With --check nothing is written; differences are printed.
"""

from __future__ import annotations

import math
import re
import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).with_name("notes") / "extremes.md"
MARK = re.compile(r"(<!-- table: (?P<family>[\w ]+) -->\n).*?(<!-- end -->)", re.DOTALL)
EXACT = 3e-12  # smaller errors are rounding, and differ between machines
FACTOR = 10.0  # larger errors have to agree within this factor

Rows = dict[str, dict[str, dict[str, str]]]  # family, case, method: words


def measure(build: Path) -> Rows:
    """Results of all cases, in the order of the programs."""
    rows: Rows = {}
    programs = sorted((build / "tests").glob("physics_extremes_*"))
    if not programs:
        sys.exit(f"there are no programs physics_extremes_* in {build / 'tests'}; build the tests first")
    for program in programs:
        done = subprocess.run([program, "--rows"], capture_output=True, text=True)
        if done.returncode:
            sys.exit(f"{program.name} failed:\n{done.stdout}{done.stderr}")
        for line in done.stdout.splitlines():
            if line.startswith("row\t"):
                _, family, case, method, words = line.split("\t")
                rows.setdefault(family, {}).setdefault(case, {})[method] = words
    return rows


def table(cases: dict[str, dict[str, str]]) -> str:
    fullest = sorted(cases.values(), key=len, reverse=True)  # in the order of the library
    methods = list(dict.fromkeys(m for case in fullest for m in case))
    lines = [f"| | {' | '.join(f'`{m}`' for m in methods)} |", "| --- |" + " --- |" * len(methods)]
    lines += [f"| {case} | {' | '.join(words.get(m, '') for m in methods)} |" for case, words in cases.items()]
    return "\n".join(lines) + "\n"


def fill(page: str, rows: Rows) -> str:
    return MARK.sub(lambda m: m[1] + table(rows.get(m["family"], {})) + m[3], page)


def read(page: str) -> Rows:
    """Rows of the tables of the page."""
    rows: Rows = {}
    for match in MARK.finditer(page):
        lines = [[cell.strip() for cell in line.strip("|\n").split("|")] for line in match[0].splitlines()[1:-1]]
        methods = [cell.strip("`") for cell in lines[0][1:]]
        rows[match["family"]] = {
            line[0]: {m: w for m, w in zip(methods, line[1:]) if w} for line in lines[2:]
        }
    return rows


def number(words: str) -> float | None:
    try:
        return float(words)
    except ValueError:
        return None


def agree(a: str, b: str) -> bool:
    x, y = number(a), number(b)
    if x is None or y is None or math.isnan(x + y):
        return a == b
    return max(x, y) <= EXACT or (min(x, y) > 0 and max(x, y) / min(x, y) <= FACTOR)


def differences(page: Rows, suite: Rows) -> list[str]:
    """Cells of the page that differ from the results of the suite."""
    found = []
    for family in {**page, **suite}:
        one, other = page.get(family, {}), suite.get(family, {})
        for case in {**one, **other}:
            here, there = one.get(case, {}), other.get(case, {})
            for method in {**here, **there}:
                a, b = here.get(method, ""), there.get(method, "")
                if not agree(a, b):
                    found.append(f"{family}, {case}, {method}: the page has {a!r}, the suite {b!r}")
    return found


def main(build: Path, check: bool) -> int:
    rows, text = measure(build), PAGE.read_text(encoding="utf-8")
    if not check:
        text = fill(text, rows)
        PAGE.write_text(text, encoding="utf-8")
    found = differences(read(text), rows)
    print(*found, sep="\n", end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    words = [w for w in sys.argv[1:] if w != "--check"]
    if len(words) != 1:
        sys.exit(__doc__)
    sys.exit(main(Path(words[0]), "--check" in sys.argv))
