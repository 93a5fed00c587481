"""Compares the time of the run that `hooke run --want` picks with the best row of a fine ladder of every method.

HOOKE_EXTRAPOLATE=build/release/tests/long/extrapolate PYTHONPATH=build/release/python python bench/picked.py SCENE...

Rows whose largest error at a frame, by extrapolation in long double, is at most the want; medians of 5, runs in turn.
Needs a build with -DHOOKE_LONG_TESTS=ON.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests/long"))
from ladder import Row, ladder, medians
from truth import ROOT, truth
from wants import WANTS

NEAR = 1.5  # times the median time of the best row
SHARE = 0.9  # of the pairs of a scene and a want
CANDIDATES = 6  # the quickest rows of the ladder, which are timed again
WORDS = ("method", "step", "rtol", "atol", "atol_velocity")


def picked(hooke: str, scene: Path, asked: str) -> dict[str, Any] | None:
    """The options of the run; None if the want is not reported as met."""
    done = subprocess.run([hooke, "run", str(scene), "--want", asked, "--json"], capture_output=True, text=True)
    if done.returncode != 0:
        return None
    value = json.loads(done.stdout)
    return {word: value[word] for word in WORDS if value.get(word) is not None}


def frames(scene: Path) -> list[float]:
    settings = json.loads(scene.read_text())["run"]
    count = round(settings["duration"] / settings["every"])
    return [settings["every"] * k for k in range(1, count + 1)]


def setting(options: dict[str, Any]) -> str:
    return f"{options['method']} {options.get('step') or options['rtol']:.3g}"


def compare(hooke: str, scene: Path, asked: str, rows: list[Row]) -> float:
    """Ratio of the times of the pick and the best row; infinite if there is none."""
    quickest = sorted((row for row in rows if row.error <= WANTS[asked]), key=lambda row: row.seconds)[:CANDIDATES]
    options = picked(hooke, scene, asked)
    if options is None or not quickest:
        what = "not met" if options is None else setting(options)
        print(f"{scene.stem:16} {asked:>5} {what:28} {len(quickest)} rows of the ladder meet it", flush=True)
        return 1.0 if options is None and not quickest else math.inf
    mine, *others = medians(scene, [options, *(row.options for row in quickest)])
    k = min(range(len(others)), key=others.__getitem__)
    ratio = mine / others[k]
    print(f"{scene.stem:16} {asked:>5} {setting(options):28} {1e3 * mine:9.3f} {setting(quickest[k].options):28} "
          f"{1e3 * others[k]:9.3f} {ratio:7.2f}", flush=True)  # fmt: skip
    return ratio


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("scenes", nargs="+", type=Path)
    parser.add_argument("--want", action="append", choices=list(WANTS))
    parser.add_argument("--hooke", default=os.environ.get("HOOKE_CLI", "build/release/hooke"))
    parser.add_argument("--most", type=float, default=1.0, help="[s] that a run of the ladder may take")
    given = parser.parse_args()
    ratios: list[float] = []
    print(f"{'scene':16} {'want':>5} {'picked':28} {'[ms]':>9} {'best of the ladder':28} {'[ms]':>9} {'ratio':>7}")
    for scene in given.scenes:
        times = frames(scene)
        true = truth(scene, times, kept=ROOT / "build/long/want")
        if true is None:
            print(f"{scene.stem:16} its solution is not known")
            continue
        asked = [name for name in given.want or WANTS if max(true.apart.values()) <= 0.1 * WANTS[name]]
        rows = ladder(scene, true, min(WANTS[name] for name in asked), given.most) if asked else []
        ratios += [compare(given.hooke, scene, name, rows) for name in asked]
    near = sum(ratio <= NEAR for ratio in ratios)
    print(f"{near} of {len(ratios)} picks take at most {NEAR} times as long as the best row")
    return 0 if near >= SHARE * len(ratios) else 1


if __name__ == "__main__":
    sys.exit(main())
