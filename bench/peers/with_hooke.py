"""hooke, through its Python package: one call takes all steps of a turn."""

from __future__ import annotations

import math

import numpy as np

import hooke
from cloth import Cloth
from peer import Motion, Solver, Stepper


def version() -> str:
    facts = hooke.build_facts()
    return f"{facts['version']} {facts['instructions']}"


def stepper(method: str, damped: bool = True) -> Stepper:
    def start(cloth: Cloth, step: float, threads: int) -> Motion:
        integrator = hooke.Integrator(cloth.system, method=method, step=step, threads=threads)
        state = cloth.state()
        return Motion(lambda count: integrator.step(state, count), lambda: state.q)

    return Stepper(f"hooke {method}", version, method, damped, True, start)


def solver(method: str, **options: object) -> Solver:
    """By tolerances, or for rk4 with nine tenths of the certainly stable step."""

    def solve(cloth: Cloth, duration: float, **tolerances: float) -> np.ndarray:
        chosen = {**tolerances, **options}
        if method == "rk4":
            chosen = {"step": duration / math.ceil(duration / cloth.stable_step(method, 0.9))}
        state = cloth.state()
        outcome = hooke.Integrator(cloth.system, method=method, duration=duration, every=duration, **chosen).run(state)
        if outcome != "finished":
            raise RuntimeError(f"hooke {method}: {outcome}")
        return state.q

    words = "".join(f" {value}" for value in options.values())
    return Solver(f"hooke {method}{words}", version, solve, has_tolerances=method != "rk4")
