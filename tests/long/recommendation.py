"""Compares the recommendations of studies with finer ladders: python tests/long/recommendation.py [SCENE ...]

For every example scene and three wants each: is the error of the recommended run, measured again against a reference
of this script's own, at most what was wanted; and would a ladder four times as fine, over all steps that fit and all
tolerances that are allowed, have had a row much cheaper? Takes about a quarter of an hour on a quiet machine.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import hooke

SCENES = Path(__file__).resolve().parents[2] / "examples/scenes"
WANTS = (1e-2, 1e-3, 1e-4)  # of the largest distance of a particle from its start
BUDGET = 60  # [s] for one study
RATIO = 1.3  # allowed ratio of the cost of a recommendation to the finer ladder's best
HOLD = 0.95  # fraction of the pairs for which that has to hold
STEP_RATIO, TOLERANCE_RATIO = 2 ** (1 / 4), 10 ** (1 / 4)  # the ladders of a study go by 2 and by 10
LOOSEST, TIGHTEST = 0.1, 1e-11
FARTHEST = 12  # times the cost of the costliest recommendation, where a ladder ends
ADAPTIVE = [method.name for method in hooke.methods() if method.adaptive]
LONG = {  # scenes that are shortened: duration and time between frames [s]
    "cloth-16": (0.3, 0.01),
    "cloth-64": (0.02, 0.002),
    "cloth-stiff": (0.2, 0.005),
    "rope-resolution": (0.5, 0.02),
    "stiff-spring": (1.0, 0.05),
}


class Row(NamedTuple):
    method: str
    value: float
    error: float
    evaluations: int
    seconds: float
    options: dict[str, Any]


class Truth:
    """The frames of a tight run by a method that no study recommends."""

    def __init__(self, scene: Path, times: dict[str, float]):
        self.scene, self.times = scene, times
        run = hooke.run(scene, method="rk8pd", rtol=1e-12, atol=1e-14, atol_velocity=1e-14, frames=True, **times)
        assert run.status == "finished", run.message
        self.frames = run.frames.q
        self.free = run.system.inverse_masses > 0
        self.size = float(np.linalg.norm(self.frames - self.frames[0], axis=2).max())

    def measure(self, options: dict[str, Any], repeats: int = 1) -> Row:
        """The largest root mean square error over the frames, infinite for a run that does not finish."""
        error, seconds, k = 0.0, math.inf, 0

        def judge(step: int, state: hooke.State) -> None:
            nonlocal error, k
            apart = (state.q - self.frames[k])[self.free]
            error, k = max(error, math.sqrt(np.mean(np.sum(apart * apart, axis=1)))), k + 1

        for _ in range(repeats):
            k = 0
            try:
                run = hooke.run(self.scene, on_frame=judge, **options, **self.times)
            except hooke.SolverFailed:
                return Row(options["method"], math.nan, math.inf, 0, math.inf, options)
            if run.status != "finished":
                error = math.inf
                break
            seconds = min(seconds, run.wall_seconds)
        value = options.get("step", options.get("rtol"))
        return Row(options["method"], value, error, run.counts["force_evaluations"], seconds, options)


def values(method: str, unit: float) -> list[dict[str, Any]]:
    """A ladder four times as fine as that of a study, from the coarsest value on."""
    rows: list[dict[str, Any]] = []
    if method in ADAPTIVE:
        rtol = LOOSEST
        while rtol > TIGHTEST:
            rows.append({"method": method, "rtol": rtol, "atol": rtol * 1e-3, "atol_velocity": rtol * 1e-3})
            rtol /= TOLERANCE_RATIO
        return rows
    parts = sorted({round(STEP_RATIO**k) for k in range(80)})
    return [{"method": method, "step": unit / m} for m in parts]


def climb(truth: Truth, method: str, want: float, most_seconds: float) -> list[Row]:
    """Rows from coarse to fine, until a few in a row meet the smallest want or they become too costly."""
    rows: list[Row] = []
    for options in values(method, truth.times["every"]):
        row = truth.measure(options)
        if row.seconds < 0.02:
            row = min(row, truth.measure(options, 3), key=lambda r: r.seconds)
        rows.append(row)
        if len(rows) >= 4 and all(r.error <= want for r in rows[-4:]):
            break
        if math.isfinite(row.error) and row.seconds > most_seconds:
            break
    return rows


def cheapest(rows: list[Row], want: float, key: str, count: int = 1) -> list[Row]:
    fits = [row for row in rows if row.error <= want]
    return sorted(fits, key=lambda row: getattr(row, key))[:count]


def race(truth: Truth, runs: list[dict[str, Any]]) -> list[float]:
    """Minimum time of each run. They take turns, so that all see the same machine, and continue where the first seems
    slow."""
    least = [math.inf] * len(runs)
    for turn in range(30):
        for k, options in enumerate(runs):
            least[k] = min(least[k], truth.measure(options).seconds)
        if turn >= 5 and (sum(least) > 1 or (turn >= 10 and least[0] <= RATIO * min(least))):
            break
    return least


def check(scene: Path) -> list[tuple[bool, ...]]:
    settings = hooke.Scene.load(scene).run_options
    duration, every = LONG.get(scene.stem, (settings["duration"], settings["every"]))
    truth = Truth(scene, {"duration": duration, "every": every})
    wants = [float(f"{share * truth.size:.2g}") for share in WANTS]
    study = hooke.study(scene, want=wants[-1], budget=BUDGET, **truth.times)
    found = {want: study.recommend(want) for want in wants}
    dearest = max([one.wall_seconds for one in found.values() if one.met], default=1.0)
    rows = [
        row
        for method in hooke.methods()
        for row in climb(truth, method.name, wants[-1], max(0.05, FARTHEST * dearest))
    ]
    return [judge(truth, want, found[want], rows) for want in wants]


def judge(truth: Truth, want: float, one: Any, rows: list[Row]) -> tuple[bool, ...]:
    """Whether the error holds, the evaluations within those of the method, the time and the evaluations within any."""
    name = truth.scene.stem
    if not one.met:
        print(f"{name:16} {want:8.2g}  none: {one.note}", flush=True)
        return False, False, False, False
    again = truth.measure(one.options, 3)
    of_method = [row for row in rows if row.method == one.method]
    best_same = cheapest(of_method, want, "evaluations")
    best_all = cheapest(rows, want, "evaluations")
    quickest = cheapest(rows, want, "seconds", 4)
    times = race(truth, [one.options, *(row.options for row in quickest)])
    same = again.evaluations / best_same[0].evaluations if best_same else 0.0
    over_all = again.evaluations / best_all[0].evaluations if best_all else 0.0
    k = min(range(1, len(times)), key=times.__getitem__) if quickest else 0
    winner = quickest[k - 1] if quickest else again
    value = one.step if one.step > 0 else one.rtol
    itself = winner.method == one.method and math.isclose(winner.value, value)
    slower = 1.0 if itself else times[0] / times[k]  # otherwise noise of the clock
    print(
        f"{name:16} {want:8.2g} {one.method:16} {value:9.3g} {one.error / want:7.3f} {again.error / want:7.3f} "
        f"{again.evaluations:8d} {same:7.2f} {slower:7.2f} {over_all:7.2f}   {1e3 * times[0]:.3g} ms; quickest "
        f"{winner.method} {winner.value:.3g}, fewest {best_all[0].method if best_all else '-'}",
        flush=True,
    )
    return again.error <= want, same <= RATIO, slower <= RATIO, over_all <= RATIO


def main(names: list[str]) -> int:
    scenes = [SCENES / f"{name}.json" for name in names] or sorted(SCENES.glob("*.json"))
    print(
        f"{'scene':16} {'want':>8} {'recommended':16} {'':>9} {'error':>7} {'again':>7} {'force':>8} {'evals':>7} "
        f"{'time':>7} {'evals':>7}\n{'':16} {'[m]':>8} {'':16} {'':>9} {'/ want':>7} {'/ want':>7} {'evals':>8} "
        f"{'same':>7} {'any':>7} {'any':>7}   method of the finer ladder",
        flush=True,
    )
    pairs = [pair for scene in scenes for pair in check(scene)]
    held = [sum(pair[k] for pair in pairs) for k in range(4)]
    words = (
        "error at most the want",
        f"force evaluations within {RATIO} of the best row of the method",
        f"time within {RATIO} of the quickest row of any method",
        f"force evaluations within {RATIO} of the fewest of any method (not asked for: not all cost the same)",
    )
    print(f"\nof {len(pairs)} pairs", *(f"{count:4d}  {word}" for count, word in zip(held, words)), sep="\n")
    return 0 if min(held[:3]) >= HOLD * len(pairs) else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
