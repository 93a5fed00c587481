"""Plain first-order problems x' = phi(t, x), for the study of time stepping itself."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from . import _callback
from ._library import lib
from ._memory import Handle, plain
from ._problem import Problem
from ._prototypes import INTEGRATOR
from ._status import BadValue
from ._types import Table
from .options import Options
from .state import State

#: rate(t, x, rate): writes x' into its last argument, arrays (size,).
Rate = Callable[[float, Table, Table], Optional[int]]


class FirstOrder(Problem):
    """x' = phi(t, x) from `x0` (size,), real or complex; ``phi(t, x, rate)`` writes the rate into its last argument::

        def decay(t, x, rate):
            rate[:] = -2 * x

        hooke.FirstOrder(decay, [1.0]).run(method="forward-euler", step=0.1, duration=1.0)

    Arrays that are kept stay as they are at the end of their call. phi returns None or 0 to go on, any other integer to stop.
    """

    _what = "a first-order problem"

    def __init__(self, phi: Rate, x0: Any):
        x0 = np.atleast_1d(plain(x0, "x0"))
        if x0.ndim != 1 or x0.size == 0 or x0.dtype.kind not in "iufc":
            raise BadValue(f"x0: one row of at least one number is needed, this is {x0!r}")
        self._x0 = x0.astype(complex if x0.dtype.kind == "c" else float)
        self._size = self._x0.view(float).size
        self._rate = _callback.rate_callback(phi, self._x0.shape, self._x0.dtype)
        self._callbacks = [self._rate]

    def state(self) -> State:
        """The initial state: t = 0, x = x0."""
        state = State._of_size(self._size, self._x0.dtype)
        state.x = self._x0
        return state

    def _integrator(self, options: Options) -> Handle:
        given = self._size, self._rate, None, options._handle
        create = lib.hooke_integrator_create_first_order
        return Handle.made(INTEGRATOR, lib.hooke_integrator_destroy, None, create, *given)

    def __repr__(self) -> str:
        return f"FirstOrder({self._x0.size} unknowns)"
