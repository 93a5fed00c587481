"""Writes the table of packages in docs/install.md, from cmake/packages.txt: python docs/make_packages.py"""

from __future__ import annotations

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/install.md"
SYSTEMS = 5
MARK = re.compile(r"(<!-- packages -->\n\n).*?(\n<!-- end -->)", re.DOTALL)


def table() -> str:
    """What is built with: a row of packages each, `-` where a system has none."""
    lines = (ROOT / "cmake/packages.txt").read_text("utf-8").splitlines()
    head, *rows = (line.split(maxsplit=SYSTEMS + 2) for line in lines)
    shown = [head[:-2] + ["without it there are no"], ["---"] * (SYSTEMS + 2)]
    shown += [row[:-2] + [row[-1].replace("-", "") if row[-1] == "-" else row[-1]] for row in rows if row[-2] != "test"]
    return "".join(f"| {' | '.join(row)} |\n" for row in shown)


def written(text: str) -> str:
    return MARK.sub(lambda found: found[1] + table() + found[2], text)


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text("utf-8")), "utf-8")
