"""Holds the error that `hooke run` prints against the truth, on a thousand random runs by seed (`calibrate.py`)."""

from __future__ import annotations

import json
from typing import Any

from steps import ROOT, Part, Step

BUILD = "build/long/release"
PICTURE = "docs/images/calibration.svg"
RUNS = 1000
LEAST_COVERED, MOST_LOW, MOST_UNKNOWN = 0.95, 0.01, 0.1  # that the intervals of the shares have to allow
MOST_EXCESS = 3  # of a figure over an error, in the median


def calibrate(text: str) -> dict[str, Any]:
    """The figures on the last line; an error if the printed errors do not hold."""
    found = json.loads(text.strip().splitlines()[-1].removeprefix("figures "))
    all_runs = found["all"]
    if all_runs["covered"][2] < LEAST_COVERED:
        raise ValueError(f"only {percent(all_runs['covered'])} of the errors are below the printed ones")
    if all_runs["low"][1] > MOST_LOW:
        raise ValueError(f"{percent(all_runs['low'])} of the errors are above three times the printed ones")
    if all_runs["unknown"][1] > MOST_UNKNOWN:
        raise ValueError(f"of {percent(all_runs['unknown'])} of the runs no error is known")
    if not all_runs["excess"][0] <= MOST_EXCESS:
        raise ValueError(f"half of the printed errors are above {all_runs['excess'][0]:.3g} times the true ones")
    return found


def percent(found: list[float]) -> str:
    return f"{100 * found[0]:.1f} % ({100 * found[1]:.1f} to {100 * found[2]:.1f})"


def figure(one: dict[str, Any]) -> str:
    if one["unknown"][0] == 1:
        return f"{one['runs']} runs, of none is an error printed"
    middle, low, high = one["excess"]
    return (f"{one['runs']} runs: {percent(one['covered'])} covered, {percent(one['low'])} above three times the figure, "
            f"the figure {middle:.2f} ({low:.2f} to {high:.2f}) times the error, not known of {percent(one['unknown'])}")  # fmt: skip


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if not figures:
        return []
    methods = [(f"errors by `{name}`", figure(one)) for name, one in figures["by method"].items()]
    return [("printed errors of all runs", figure(figures["all"])), *methods]


PART = Part(
    "calibration",
    [],
    [
        Step("build", f"cmake --preset release -B {BUILD} -DHOOKE_EVERYTHING=ON -DHOOKE_LONG_TESTS=ON && "
                      f"cmake --build {BUILD} --target hooke_cli hooke_long_extrapolate", 240),
        Step(f"{RUNS} random runs", f"HOOKE_EXTRAPOLATE={BUILD}/tests/long/extrapolate build/venv/bin/python tests/long/calibrate.py "
                                    f"--runs {RUNS} --hooke {BUILD}/hooke --picture {PICTURE}", 600, calibrate),
    ],
    rows,
    page=ROOT / "docs/notes/errors.md",
)  # fmt: skip
