"""What can be run: the base of scenes and systems, first-order problems x' = phi(t, x), for the study of time stepping
itself, and second-order problems q'' = W f(t, q, v) of generalized coordinates."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Optional

import numpy as np

from . import _callback
from ._library import lib
from ._memory import Handle, Owner, double_pointer, doubles, plain
from ._prototypes import FORCE, FORCE_PRODUCT, RATE
from ._status import BadValue
from ._types import FloatArray, Table
from .options import Options
from .state import State, restored

if TYPE_CHECKING:
    from .rest import rest as _rest
    from .results import run as _run

__all__ = ["FirstOrder", "SecondOrder"]

#: rate(t, x, rate): writes x' into its last argument, arrays (size,).
Rate = Callable[[float, Table, Table], Optional[int]]
#: f(t, q, v, force): adds to its last argument, which is zero; arrays (size,).
CoordinateForce = Callable[[float, FloatArray, FloatArray, FloatArray], Optional[int]]
#: derivative(t, q, v, dq, dv, out): adds (df/dq) dq + (df/dv) dv to its last argument, which is zero.
CoordinateProduct = Callable[[float, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray], Optional[int]]


class Problem(Owner):
    """A problem that `hooke.run` takes."""

    _what: str  #: what it is, for messages
    _shown: dict[str, Any]  #: how `State` shows its states, where it has no particles
    if TYPE_CHECKING:  # functions above all problems, which make themselves methods
        run = _run
        rest = _rest

    def _posed(self) -> tuple[Handle, list[Any]]:
        """It as a system of the library, and the callbacks of that (see `Posed`)."""
        raise NotImplementedError


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
        shape = self._x0.shape
        self._rate = _callback.on_arrays(RATE, phi, 1, lambda _: shape, self._x0.dtype)
        self._callbacks = [self._rate]
        self._shown = {"dtype": self._x0.dtype, "in_rows": False, "moves": False}

    def state(self) -> State:
        """The initial state: t = 0, x = x0."""
        return restored(0.0, self._x0, None)

    def _integrator(self, options: Options) -> Handle:
        given = self._size, self._rate, None, options._handle
        return Handle.made(None, lib.hooke_integrator_create_first_order, *given)

    def _posed(self) -> tuple[Handle, list[Any]]:
        given = self._rate, None, self.state()._handle
        return Handle.made(None, lib.hooke_system_create_first_order, *given), self._callbacks

    def __repr__(self) -> str:
        return f"FirstOrder({self._x0.size} unknowns)"


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
        self._force = _callback.on_arrays(FORCE, f, 2, lambda n: (n,))
        self._derivative = _callback.on_arrays(FORCE_PRODUCT, derivative, 4, lambda n: (n,))
        self._callbacks = [self._force, self._derivative]
        self._shown = {"in_rows": False}

    def state(self) -> State:
        """The initial state: t = 0, q and v (size,) as given."""
        return restored(0.0, self._q, self._v)

    def _integrator(self, options: Options) -> Handle:
        masses = self._inverse_mass.size, double_pointer(self._inverse_mass)
        given = self._size, self._force, self._derivative, None, *masses, options._handle
        return Handle.made(None, lib.hooke_integrator_create_second_order, *given)

    def _posed(self) -> tuple[Handle, list[Any]]:
        masses = self._inverse_mass.size, double_pointer(self._inverse_mass)
        given = self._force, self._derivative, None, *masses, self.state()._handle
        return Handle.made(None, lib.hooke_system_create_second_order, *given), self._callbacks

    def __repr__(self) -> str:
        return f"SecondOrder({self._size} coordinates)"
