"""docs/troubleshooting.md has every exit code, every status and every cause."""

import os
import re
from pathlib import Path

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
PAGE = (ROOT / "docs/troubleshooting.md").read_text(encoding="utf-8")


def test_every_exit_code():
    codes = re.findall(r"HOOKE_EXIT_\w+ = (\d+)", (ROOT / "cli/verb.h").read_text(encoding="utf-8"))
    assert len(codes) > 5
    titles = re.findall(r"^## Exit code (\d+):", PAGE, re.MULTILINE)
    assert sorted(titles) == sorted(codes)


def test_every_status_with_its_number():
    header = (ROOT / "include/hooke/base.h").read_text(encoding="utf-8")
    statuses = re.findall(r"^#define (HOOKE_\w+) +\(?(-?\d+)\)?", header.split("/* Statuses.")[1], re.MULTILINE)
    assert len(statuses) > 10
    for name, number in statuses:
        assert f"`{name}`" in PAGE and (number == "0" or f"`{name}` ({number})" in PAGE), name


def test_every_cause():
    table = (ROOT / "docs/why.md").read_text(encoding="utf-8").split("| cause |")[1].split("\n\n")[0]
    causes = re.findall(r"^\| `([\w-]+)` \|", table, re.MULTILINE)
    assert len(causes) > 5
    assert set(re.findall(r"^### ([\w-]+)$", PAGE, re.MULTILINE)) == set(causes)
