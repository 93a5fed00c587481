"""The counted campaign of tests/fuzz: 1e7 executions of each target, 1e8 of scenes. Its driver keeps where it was."""

from __future__ import annotations

import json
from typing import Any

from steps import ROOT, Part, Step

FIGURES = ROOT / "build/fuzz/figures.json"


def so_far() -> dict[str, Any]:
    return json.loads(FIGURES.read_text())["targets"]


def counted(_: str) -> dict[str, Any]:
    targets = so_far()
    behind = [
        f"{name} {f['executions']:.3g} of {f['wanted']:.3g}" for name, f in targets.items() if f["executions"] < f["wanted"]
    ]
    if behind:
        raise ValueError(f"executions so far: {', '.join(behind)}; start it again, and it goes on")
    return targets


def rows(done: dict[str, dict[str, Any]]) -> list[tuple[str, str]]:
    told = []
    for name, f in done.get("campaign", {}).items():
        lines = f"{f['lines']['percent']} % of the lines of its files, " if f.get("lines") else ""
        told.append((name, f"{f['executions']:.3g} executions, {f['past_syntax_percent']} % past the syntax, {lines}"
                     f"{f['edges']['fuzz']} edges, none new in the last {f['executions_since_last_edge']:.3g} executions "
                     f"({f['seconds_since_last_edge'] / 60:.0f} min of processor), {f['findings']} findings; "
                     f"at {', '.join(f'{commit} {n:.2g}' for commit, n in f['commits'].items())}"))  # fmt: skip
    return told


PART = Part(
    "fuzz",
    ["clang", "libclang-rt-14-dev"],
    [Step("campaign", "python3 tests/fuzz/run.py --executions 1e7 --quiet 60 --minutes 140 || test $? -eq 3", 8400, counted)],
    rows,
    lambda: {"campaign": so_far()} if FIGURES.exists() else {},
)
