"""Writes tests/data/wants.json: the final positions of the particles of the scenes of tests/cli/test_want.py, by
extrapolation in long double, and the minimum cost of each want on a fine ladder of every method.

HOOKE_EXTRAPOLATE=build/release/tests/long/extrapolate python tests/long/make_wants.py [--ends] SCENE...

With --ends without the ladder.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from ladder import ladder
from truth import ROOT, Truth, truth
from wants import DATA, WANTS  # of tests/cli

ASKED = ["1cm", "1mm"]
MOST_SECONDS = 0.5  # of a run of the ladder


def best(path: Path, true: Truth) -> dict[str, dict[str, int]]:
    """The fewest evaluations of each method that meets a want."""
    rows = ladder(path, true, min(WANTS[name] for name in ASKED), MOST_SECONDS)
    found: dict[str, dict[str, int]] = {name: {} for name in ASKED}
    for name, least in found.items():
        for row in rows:
            if row.error <= WANTS[name]:
                least[row.method] = min(row.evaluations, least.get(row.method, row.evaluations))
    return found


def facts(path: Path, with_ladder: bool) -> dict[str, Any]:
    end = json.loads(path.read_text())["run"]["duration"]
    true = truth(path, [end], kept=ROOT / "build/long/want")
    assert true is not None and true.apart[end] < 1e-9, path
    return {
        "scene": str(path.resolve().relative_to(ROOT)),
        "time": end,
        "apart": true.apart[end],
        "free": true.free,
        "position": true.positions[end],
        "best": best(path, true) if with_ladder else None,
    }


if __name__ == "__main__":
    kept = {one["scene"]: one for one in json.loads(DATA.read_text())} if DATA.exists() else {}
    names = [name for name in sys.argv[1:] if name != "--ends"]
    for name in names:
        one = facts(Path(name), "--ends" not in sys.argv)
        kept[one["scene"]] = one
        print(one["scene"], one["best"], flush=True)
        DATA.write_text("[\n" + ",\n".join(json.dumps(each) for each in kept.values()) + "\n]\n")
