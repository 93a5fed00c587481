"""Times the calls of the Python package in a time loop: for each, the time that Python adds to the library.

    PYTHONPATH=build/release/python python bench/python_calls.py

One particle on one spring, so that the library itself takes little time. That time is measured by steps in one call
(``step(state, 10**6)``) and by evaluations of the energy from C, and is not subtracted from the other rows, so that
these are the times that a caller sees. The minimum of several rounds, since other programs only add time.
"""

from __future__ import annotations

import time
from typing import Callable

import hooke

ROUNDS, CALLS = 400, 250


def seconds(function: Callable[[], object]) -> float:
    """Minimum time of one call [s], without the loop's own."""

    def once(calls: range, f: Callable[[], object]) -> float:
        begin = time.perf_counter()
        for _ in calls:
            f()
        return (time.perf_counter() - begin) / len(calls)

    calls = range(CALLS)
    empty = min(once(calls, int) for _ in range(ROUNDS))
    nothing = min(once(calls, lambda: None) for _ in range(ROUNDS))
    return min(once(calls, function) for _ in range(ROUNDS)) - min(empty, nothing)


def main() -> None:
    scene = hooke.Scene().particles([[0, 0, 0], [1.25, 0, 0]], mass=1, pinned=0)
    system = scene.springs(between=[[0, 1]], stiffness=20, rest_length=1).system
    state = system.state()
    integrator = hooke.Integrator(system, method="symplectic-euler", step=1e-3)
    q, v = state.q, state.v
    steps = 10**6
    begin = time.perf_counter()
    integrator.step(state, steps)
    own = (time.perf_counter() - begin) / steps
    rows: dict[str, Callable[[], object]] = {
        "integrator.step(state)": lambda: integrator.step(state),
        "integrator.advance()": lambda: integrator.advance(),
        "integrator.get(1)": lambda: integrator.get(1),
        "integrator.put(1, q[1])": lambda: integrator.put(1, q[1]),
        "state.t": lambda: state.t,
        "state.q": lambda: state.q,
        "state.v": lambda: state.v,
        "system.energy(q, v)": lambda: system.energy(q, v),
        "system.energy(state.q, state.v)": lambda: system.energy(state.q, state.v),
        "system.kinetic_energy(v)": lambda: system.kinetic_energy(v),
        "system.particle_count": lambda: system.particle_count,
    }
    print(f"{'call':36}{'microseconds':>14}")
    for name, function in rows.items():
        print(f"{name:36}{1e6 * seconds(function):14.2f}")
    print(f"{'one of a million steps in one call':36}{1e6 * own:14.2f}")


if __name__ == "__main__":
    main()
