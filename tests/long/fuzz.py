"""The counted campaign of tests/fuzz: 1e7 executions of each target, 1e8 of scenes. Its driver stores its progress.

Here are the targets that read text; fuzz_hdf5.py has those that read HDF5 files, which take as long as all others.
`python3 tests/fuzz/run.py --executions 1e7 --quiet 60` goes on with it until no target has come to a new edge for an
hour.
"""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from steps import ROOT, Part, Step

FIGURES = ROOT / "build/fuzz/figures.json"


def counted(name: str) -> Callable[[str], dict[str, Any]]:
    def figures(_: str) -> dict[str, Any]:
        of: dict[str, Any] = json.loads(FIGURES.read_text())["targets"][name]
        if of["executions"] < of["wanted"]:
            raise ValueError(f"{of['executions']:.3g} executions of {of['wanted']:.3g} so far; start it again, and it goes on")
        return of

    return figures


def so_far(known: dict[str, Any]) -> dict[str, Any]:
    """With the counts of the driver, if it is finished and they are not older."""
    targets = json.loads(FIGURES.read_text())["targets"] if FIGURES.exists() else {}
    with_counts = dict(known)
    for name, figures in targets.items():
        step = known.get(name, {"seconds": 0, "processor": 0, "date": ""})
        if figures["executions"] >= figures["wanted"] and figures["date"] >= step["date"]:
            # the step is the last session, the counts are of all
            times = {"seconds": max(step["seconds"], figures["seconds"]), "processor": max(step["processor"], figures["processor_seconds"])}
            with_counts[name] = step | times | {"date": figures["date"], "commit": ", ".join(figures["commits"]), "figures": figures}
    return with_counts


def rows(target: str, f: dict[str, Any]) -> list[tuple[str, str]]:
    lines = f"{f['lines']['percent']} % of the lines of its files, " if f.get("lines") else ""
    return [(target, f"{f['executions']:.3g} executions, {f['past_syntax_percent']} % past the syntax, {lines}"
             f"{max(f['edges'].values())} edges, none new in the last {f['executions_since_last_edge']:.3g} executions "
             f"({f['seconds_since_last_edge'] / 60:.0f} min of processor), {f['findings']} findings")]  # fmt: skip


def step(target: str, seconds: float) -> Step:
    return Step(target, f"python3 tests/fuzz/run.py --executions 1e7 {target} || test $? -eq 3", seconds, counted(target))


def part(name: str, targets: dict[str, float]) -> Part:
    """Of targets and the seconds that each takes."""
    return Part(name, ["clang", "libclang-rt-dev"], [step(*target) for target in targets.items()], rows, so_far)


PART = part("fuzz", {"scene": 3300, "differential": 1300, "options": 300, "obj": 300, "checkpoint": 300})
