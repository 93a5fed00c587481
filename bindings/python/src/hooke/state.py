"""State of a motion: time, positions and velocities."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._library import lib
from ._memory import Handle, address_of, double_pointer, plain, view
from ._types import FloatArray, Table

__all__ = ["State"]


class State:
    """Time, positions and velocities of a system (``system.state()``) or of a first- or second-order problem
    (``problem.state()``).

    `q` and `v` are NumPy arrays over the library's own memory, no copy: write into them to set the state, and read
    them again after a run. They stay valid as long as they are kept, even without the state. A state can be copied
    and pickled; an unpickled one belongs to no system, and fits all of its size.
    """

    __slots__ = ("__weakref__", "_handle", "_q", "_v", "_x")

    def __init__(self, handle: Handle, dtype: Any = float, in_rows: bool = True, moves: bool = True):
        self._handle = handle
        size = lib.hooke_state_size(handle)
        velocity = lib.hooke_state_velocity(handle)
        numbers = size if np.dtype(dtype) == float else size // 2
        self._x = view(address_of(lib.hooke_state_position(handle)), (numbers,), handle, dtype=dtype)
        self._q: FloatArray | None = None
        self._v: FloatArray | None = None
        if moves and (velocity or not size):
            shape = (size // 3, 3) if in_rows else (size,)
            self._q = self._x.reshape(shape)
            self._v = view(address_of(velocity), shape, handle)

    @classmethod
    def _made(cls, system: Handle | None, create: Any, given: Any, **kind: Any) -> State:
        """What a function of the library makes of a system or a size."""
        return cls(Handle.made(system, create, given), **kind)

    @classmethod
    def _of_particles(cls, count: int) -> State:
        """A state of a system with that many particles and nothing else."""
        system = Handle.made(None, lib.hooke_system_create)
        place, mass = double_pointer(np.zeros((count, 3))), double_pointer(np.ones(1))
        lib.hooke_system_add_particles(system, count, place, None, 1, mass, None)
        lib.hooke_system_commit(system)
        return cls._made(system, lib.hooke_state_create, system)

    @property
    def t(self) -> float:
        """Time [s]."""
        return float(lib.hooke_state_time(self._handle))

    @t.setter
    def t(self, value: float) -> None:
        lib.hooke_state_set_time(self._handle, value)

    @property
    def q(self) -> FloatArray:
        """Positions (n, 3) [m], or the coordinates of a second-order problem (size,); a view."""
        return self._q.view() if self._q is not None else self._no_particles("q")

    @q.setter
    def q(self, value: Any) -> None:
        self.q[...] = plain(value, "q")

    @property
    def v(self) -> FloatArray:
        """Velocities (n, 3) [m/s], or those of coordinates (size,); a view."""
        return self._v.view() if self._v is not None else self._no_particles("v")

    @v.setter
    def v(self, value: Any) -> None:
        self.v[...] = plain(value, "v")

    @property
    def x(self) -> Table:
        """All positions in one row (3n,) [m], or the unknowns of a first- or second-order problem (size,); a view."""
        return self._x.view()

    @x.setter
    def x(self, value: Any) -> None:
        self._x[...] = plain(value, "x")

    def copy(self) -> State:
        """A copy with the same values."""
        if self._v is None or self._v.ndim == 1:
            return restored(self.t, self._x, self._v)
        other = _alike(self._x, self._v, self._handle._parent)
        other.assign(self)
        return other

    def __copy__(self) -> State:
        return self.copy()

    def __deepcopy__(self, memo: Any) -> State:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return restored, (self.t, self._x.copy(), None if self._v is None else self._v.copy())

    def assign(self, other: State) -> None:
        """Copies time, positions and velocities from a state of the same size."""
        lib.hooke_state_copy(other._handle, self._handle)

    def _no_particles(self, name: str) -> Any:
        raise AttributeError(f"a first-order problem has no {name}; its unknowns are x")

    def __repr__(self) -> str:
        if self._v is None:
            return f"State(t={self.t!r}, {self._x.size} unknowns)"
        return f"State(t={self.t!r}, {len(self._v)} {'particles' if self._v.ndim == 2 else 'coordinates'})"


def _alike(x: Table, v: FloatArray | None, system: Handle | None = None) -> State:
    """A state for such arrays, of a system or of none."""
    if v is None:
        return State._made(None, lib.hooke_state_create_first_order, x.view(float).size, dtype=x.dtype)
    if v.ndim == 1:
        return State._made(None, lib.hooke_state_create_second_order, v.size, in_rows=False)
    return State._of_particles(len(v)) if system is None else State._made(system, lib.hooke_state_create, system)


def restored(t: float, x: Table, v: FloatArray | None) -> State:
    """A state with these values, of no system."""
    state = _alike(x, v)
    state.t, state.x = t, x
    if v is not None:
        state.v = v
    return state
