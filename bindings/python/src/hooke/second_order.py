"""Any second-order problem q'' = W f(t, q, v) of generalized coordinates."""

from __future__ import annotations

from typing import Any, Callable, Optional

import numpy as np

from . import _callback
from ._library import lib
from ._memory import Handle, double_pointer, doubles, plain
from ._problem import Problem
from ._prototypes import FORCE_PRODUCT, INTEGRATOR
from ._status import BadValue
from ._types import FloatArray
from .options import Options
from .state import State

#: f(t, q, v, force): adds to its last argument, which is zero; arrays (size,).
CoordinateForce = Callable[[float, FloatArray, FloatArray, FloatArray], Optional[int]]
#: derivative(t, q, v, dq, dv, out): adds (df/dq) dq + (df/dv) dv to its last argument, which is zero.
CoordinateProduct = Callable[[float, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray], Optional[int]]


class SecondOrder(Problem):
    """q'' = W f(t, q, v) from the coordinates `q` (size,) and velocities `v` (size,; zero by default), with the
    constant inverse masses W > 0 in `inverse_mass`, one or (size,). ``f(t, q, v, force)`` writes f into its last
    argument::

        def pendulum(t, q, v, force):
            force[0] = -9.81 * np.sin(q[0])

        hooke.SecondOrder(pendulum, [1.0]).run(method="verlet", step=1e-3, duration=10)

    Where masses depend on q, `f` gives the accelerations and `inverse_mass` is 1. ``derivative(t, q, v, dq, dv, out)``
    writes (df/dq) dq + (df/dv) dv into its last argument; without it difference quotients of `f` replace it. Arrays
    that are kept stay as they are at the end of their call. Callbacks return None or 0 to go on, any other integer to stop.
    """

    _what = "a second-order problem"

    def __init__(
        self,
        f: CoordinateForce,
        q: Any,
        v: Any = None,
        inverse_mass: Any = 1.0,
        derivative: CoordinateProduct | None = None,
    ):
        self._q = doubles(np.atleast_1d(plain(q, "q")), "q")
        if self._q.ndim != 1 or self._q.size == 0:
            raise BadValue(f"q: one row of at least one number is needed, this is {q!r}")
        shape = self._q.shape
        self._v = np.zeros(shape) if v is None else doubles(np.atleast_1d(plain(v, "v")), "v", shape)
        masses = np.atleast_1d(plain(inverse_mass, "inverse_mass"))
        self._inverse_mass = doubles(masses, "inverse_mass", (1,), shape)
        self._size = self._q.size
        self._force = _callback.force_callback(f, ())
        self._derivative = _callback.product_callback(derivative, ()) if derivative else FORCE_PRODUCT()
        self._callbacks = [self._force, self._derivative]

    def state(self) -> State:
        """The initial state: t = 0, q and v (size,) as given."""
        state = State._of_coordinates(self._size)
        state.q, state.v = self._q, self._v
        return state

    def _integrator(self, options: Options) -> Handle:
        masses = self._inverse_mass.size, double_pointer(self._inverse_mass)
        given = self._size, self._force, self._derivative, None, *masses, options._handle
        create = lib.hooke_integrator_create_second_order
        return Handle.made(INTEGRATOR, lib.hooke_integrator_destroy, None, create, *given)

    def __repr__(self) -> str:
        return f"SecondOrder({self._size} coordinates)"
