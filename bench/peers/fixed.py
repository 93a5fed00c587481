"""Fixed steps on cloths of several sizes: all steppers of a cloth take turns."""

from __future__ import annotations

import time
from collections.abc import Iterator
from statistics import median

import numpy as np

import cloth as cloths
import hooke
from peer import Motion, Stepper
from rows import Row

DAMPING = 0.01  # [N s]
CHECKED = 100  # steps after which positions are compared
ALLOWED = 1e-6  # of the largest displacement of a particle, in one component
TURN = 0.05  # [s]
LEAST_TURNS = 3


class Different(RuntimeError):
    """A peer does not compute the same motion."""


def compare(stepper: Stepper, q: np.ndarray, exact: np.ndarray, start: np.ndarray) -> tuple[float, float]:
    """The largest difference of two motions in a component, and its allowed value [m]."""
    apart, allowed = float(np.abs(q - exact).max()), ALLOWED * float(np.abs(exact - start).max())
    if not apart <= allowed:
        raise Different(f"{stepper.name}: {apart:.3g} m from hooke {stepper.method} after {CHECKED} steps, "
                        f"{allowed:.3g} m allowed")
    return apart, allowed


def reference(cloth: cloths.Cloth, method: str, step: float) -> np.ndarray:
    state = cloth.state()
    hooke.Integrator(cloth.system, method=method, step=step).step(state, CHECKED)
    return state.q


def steps_of_turn(motion: Motion) -> int:
    steps = 10
    for _ in range(2):  # the first warms up
        begun = time.perf_counter()
        motion.step(steps)
        steps = max(10, int(steps * TURN / (time.perf_counter() - begun)))
    return steps


def race(size: int, damped: bool, steppers: list[Stepper], threads: int, seconds: float) -> Iterator[Row]:
    """A row for each stepper; `seconds` is the time for the turns of each."""
    cloth = cloths.make(size, damping=DAMPING if damped else 0.0).shaken()
    step = cloth.stable_step("symplectic-euler")
    motions = [stepper.start(cloth, step, threads) for stepper in steppers]
    exact = {method: reference(cloth, method, step) for method in {stepper.method for stepper in steppers}}
    differences = []
    for stepper, motion in zip(steppers, motions):
        motion.step(CHECKED)
        differences.append(compare(stepper, motion.positions(), exact[stepper.method], cloth.q))
    counts = [steps_of_turn(motion) for motion in motions]
    taken: list[list[float]] = [[] for _ in motions]
    end = time.perf_counter() + seconds * len(motions)
    while len(taken[0]) < LEAST_TURNS or time.perf_counter() < end:
        for motion, count, times in zip(motions, counts, taken):
            begun = time.perf_counter()
            motion.step(count)
            times.append((time.perf_counter() - begun) / count)
    for stepper, times, (apart, allowed) in zip(steppers, taken, differences):
        yield Row(
            f"cloth-{size}" + ("" if damped else "-undamped"), stepper.name, stepper.version(),
            threads if stepper.has_threads else 1, len(times), min(times), median(times),
            springs=len(cloth.ends), step=step, distance=apart, allowed=allowed,
        )
