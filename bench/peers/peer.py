"""Interface of a peer: fixed steps, or an end within tolerances."""

from __future__ import annotations

from typing import Callable, NamedTuple

import numpy as np

from cloth import Cloth


class Motion(NamedTuple):
    """A stepper started on a cloth."""

    step: Callable[[int], object]  # takes so many steps
    positions: Callable[[], np.ndarray]  #: (n, 3) [m]


class Stepper(NamedTuple):
    name: str
    version: Callable[[], str]
    method: str  # the method of hooke with the same motion
    damped: bool  # whether it supports damping along springs, and uses it
    undamped: bool
    start: Callable[[Cloth, float, int], Motion]  #: from a cloth, a step [s] and a number of threads
    has_threads: bool = True


class Solver(NamedTuple):
    name: str
    version: Callable[[], str]
    #: from a cloth, a duration [s], rtol= and atol= [m]: positions at the end (n, 3) [m]
    solve: Callable[..., np.ndarray]
    prepare: Callable[[Cloth], object] = lambda cloth: None  # work that is not timed, such as compiling
    has_tolerances: bool = True
