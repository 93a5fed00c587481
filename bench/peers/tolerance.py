"""Runs with error control, on one thread: processor time against measured error, all in turns."""

from __future__ import annotations

import time
from collections.abc import Iterator
from statistics import median

import numpy as np

import cloth as cloths
from fixed import Different
from peer import Solver
from rows import NAN, Row

ALLOWED = 2e-6  # [m]; a tenth more of damping moves the end of the first cloth by 7e-6 m
ATOL = 1e-9  # [m]


def error_of(q: np.ndarray, exact: np.ndarray, name: str) -> float:
    """The largest difference of a component [m]."""
    error = float(np.abs(q - exact).max())
    if not error <= ALLOWED:
        raise Different(f"{name}: {error:.3g} m from the reference, {ALLOWED:.3g} m allowed")
    return error


def agree(
    cloth: cloths.Cloth, duration: float, within: float, *runs: tuple[Solver, dict[str, float]]
) -> np.ndarray:
    """A reference: the end of the first run, which the others have to confirm."""
    ends = [solver.solve(cloth, duration, **tolerances) for solver, tolerances in runs]
    for (solver, _), q in zip(runs[1:], ends[1:]):
        apart = float(np.abs(q - ends[0]).max())
        if not apart <= within:
            raise Different(f"{solver.name} is {apart:.3g} m from the reference, {within:.3g} m allowed")
    return ends[0]


def race(name: str, cloth: cloths.Cloth, duration: float, exact: np.ndarray, entrants: list[tuple[Solver, float]],
         seconds: float) -> Iterator[Row]:
    """A row for each solver with its rtol. They take turns, each until its turns have taken `seconds`, at least once."""
    taken: list[list[float]] = [[] for _ in entrants]
    errors = [0.0] * len(entrants)
    for solver, _ in entrants:
        solver.prepare(cloth)
    while any(not times or sum(times) < seconds for times in taken):
        for k, (solver, rtol) in enumerate(entrants):
            if taken[k] and sum(taken[k]) >= seconds:
                continue
            begun = time.process_time()
            q = solver.solve(cloth, duration, rtol=rtol, atol=ATOL)
            taken[k].append(time.process_time() - begun)
            errors[k] = error_of(q, exact, solver.name)
    for (solver, rtol), times, error in zip(entrants, taken, errors):
        yield Row(name, solver.name, solver.version(), 1, len(times), min(times), median(times),
                  rtol=rtol if solver.has_tolerances else NAN,
                  distance=error, allowed=ALLOWED)


def rtol_for(error: float, solver: Solver, cloth: cloths.Cloth, duration: float, exact: np.ndarray) -> float:
    """The loosest rtol, in steps of the square root of ten from 1e-2 on, whose measured error is at most `error`."""
    for k in range(4, 21):
        rtol = 10 ** (-k / 2)
        if float(np.abs(solver.solve(cloth, duration, rtol=rtol, atol=ATOL) - exact).max()) <= error:
            return rtol
    raise Different(f"{solver.name}: no rtol down to 1e-10 has an error of {error:.3g} m or less")
