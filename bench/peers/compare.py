"""The list of peers, and their cases."""

from __future__ import annotations

from collections.abc import Iterator

import cloth as cloths
import fixed
import tolerance
import with_hooke
import with_lammps
import with_numba
import with_openmm
import with_scipy
from rows import Row

#: The others are compared with the first of each table.
STEPPERS = [
    with_hooke.stepper("symplectic-euler"),
    with_hooke.stepper("verlet", damped=False),  # its steps are implicit with damping
    with_numba.SCATTER,
    with_lammps.HARMONIC,
    with_openmm.LEAPFROG,
]
SOLVERS = [
    with_hooke.solver("rk4"),
    with_hooke.solver("cvode-adams"),
    with_hooke.solver("cvode-bdf"),
    with_scipy.solver("RK45"),
    with_scipy.solver("DOP853"),
    with_scipy.solver("BDF"),
]
STIFF = [with_hooke.solver("cvode-bdf"), with_hooke.solver("cvode-bdf", linear_solver="gmres")]
SLOW = with_scipy.solver("BDF")  # on the stiff cloth


def fixed_steps(sizes: list[int], threads: int, seconds: float) -> Iterator[list[Row]]:
    for damped in (False, True):
        steppers = [s for s in STEPPERS if (s.damped if damped else s.undamped)]
        for size in sizes:
            yield list(fixed.race(size, damped, steppers, threads, seconds))


def tolerances(seconds: float) -> Iterator[list[Row]]:
    """A tenth of a second of a damped cloth at rtol 1e-6."""
    cloth, duration, tight = cloths.make(32, damping=0.01), 0.1, {"rtol": 1e-12, "atol": 1e-13}
    for solver in SOLVERS:
        solver.prepare(cloth)
    exact = tolerance.agree(cloth, duration, 1e-9, (with_scipy.solver("DOP853"), tight),
                            (with_hooke.solver("cvode-adams"), tight))
    yield list(tolerance.race("cloth-32, 0.1 s", cloth, duration, exact, [(s, 1e-6) for s in SOLVERS], seconds))


def stiff(with_slow: bool, seconds: float) -> Iterator[list[Row]]:
    """Ten milliseconds of a heavily damped stiff cloth, with the tolerance at which hooke's error is at most that of
    SciPy with rtol 1e-4, or without SciPy a micrometre."""
    cloth, duration, error, slow = cloths.make(64, stiffness=5e4, damping=20.0), 0.01, 1e-6, []
    exact = tolerance.agree(cloth, duration, 1e-9, (STIFF[0], {"rtol": 1e-8, "atol": 1e-12}),
                            (with_hooke.solver("arkode-esdirk"), {"rtol": 1e-6, "atol": 1e-10}))
    if with_slow:
        slow = list(tolerance.race("cloth-64-stiff, 10 ms", cloth, duration, exact, [(SLOW, 1e-4)], 0.0))
        error = slow[0].distance
    rtol = tolerance.rtol_for(error, STIFF[0], cloth, duration, exact)
    entrants = [(solver, rtol) for solver in STIFF]
    yield [*tolerance.race("cloth-64-stiff, 10 ms", cloth, duration, exact, entrants, seconds), *slow]
