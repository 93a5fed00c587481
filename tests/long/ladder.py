"""Runs of a scene by every method, from coarse to fine in small steps, with their errors: what a wanted error costs at best."""

from __future__ import annotations

import math
import statistics
import warnings
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from truth import Truth

import hooke

STEP_RATIO, TOLERANCE_RATIO = 2 ** (1 / 4), 10 ** (1 / 4)  # the ladders of a study go by 2 and by 10
LOOSEST, TIGHTEST = 0.1, 1e-12


@dataclass
class Row:
    method: str
    options: dict[str, Any] = field(repr=False)
    error: float  # [m] the largest at a frame; infinite where it does not come to the end
    evaluations: int  # of forces
    seconds: float


def rungs(method: str, every: float) -> list[dict[str, Any]]:
    """From the coarsest that there is."""
    if method.startswith("cvode"):
        count = round(math.log(LOOSEST / TIGHTEST, TOLERANCE_RATIO))
        tolerances = [LOOSEST / TOLERANCE_RATIO**k for k in range(count + 1)]
        return [{"method": method, "rtol": rtol, "atol": rtol * 1e-3} for rtol in tolerances]
    return [{"method": method, "step": every / parts} for parts in sorted({round(STEP_RATIO**k) for k in range(80)})]


def run(scene: Path, options: dict[str, Any], **listeners: Any) -> Any:
    """None where its solver gives up."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", hooke.StepWarning)
        try:
            return hooke.run(scene, **options, **listeners)
        except hooke.SolverFailed:
            return None


def measure(scene: Path, options: dict[str, Any], true: Truth) -> Row:
    """The largest error at the frames whose solution is known."""
    every = hooke.Scene.load(scene).run_options["every"]
    solutions = {round(t / every): np.reshape(q, (-1, 3))[true.free] for t, q in true.positions.items()}
    frame, worst = 0, 0.0

    def judge(step: int, state: hooke.State) -> None:
        nonlocal frame, worst
        if frame in solutions:
            with np.errstate(over="ignore"):
                worst = max(worst, np.sqrt(np.sum((state.q[true.free] - solutions[frame]) ** 2, axis=1).max()))
        frame += 1

    done = run(scene, options, on_frame=judge)
    if done is None or done.status != "finished":
        return Row(options["method"], options, math.inf, 0, 0.0)
    return Row(options["method"], options, worst, done.counts["force_evaluations"], done.wall_seconds)


def climb(scene: Path, method: str, true: Truth, want: float, most_seconds: float) -> list[Row]:
    """Rows until a few in a row meet the smallest want or they become too dear."""
    rows: list[Row] = []
    for options in rungs(method, hooke.Scene.load(scene).run_options["every"]):
        rows.append(measure(scene, options, true))
        if len(rows) >= 3 and all(row.error <= want for row in rows[-3:]):
            break
        if math.isfinite(rows[-1].error) and rows[-1].seconds > most_seconds:
            break
    return rows


def ladder(scene: Path, true: Truth, want: float, most_seconds: float) -> list[Row]:
    return [row for method in hooke.methods() for row in climb(scene, method.name, true, want, most_seconds)]


def medians(scene: Path, runs: list[dict[str, Any]], repeats: int = 5) -> list[float]:
    """The median time of each run; they take turns, so that all see the same machine."""
    times: list[list[float]] = [[] for _ in runs]
    for _ in range(repeats):
        for k, options in enumerate(runs):
            times[k].append(run(scene, options).wall_seconds)
    return [statistics.median(each) for each in times]
