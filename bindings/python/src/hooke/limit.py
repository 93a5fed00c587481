"""Limits: the largest stable step of each method on one scene, predicted and measured, and what determines it."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any, Union

import numpy as np

from ._keywords import LimitKeywords
from ._library import lib
from ._look import WorkProgress, draw
from ._measurement import Measurement, Paged, Record, methods_of_rows
from ._signature import Unpack, takes
from ._types import ComplexArray, FloatArray, Path
from .files import opened
from .results import Runnable, measured
from .state import State
from .system import System
from .why import Blame

__all__ = ["Limit", "limit"]

#: Where to find limits: a state, positions (n, 3) [m], or a trajectory file with its last frame or the given one.
Place = Union[State, FloatArray, Path, tuple[Path, int]]

class Participation(Record, table="limit.participation"):
    """A particle of the limiting mode."""


class Changes(Record, table="limit.changes"):
    """A change of the limiting springs or particles. `kind` is "" if no small set is to blame, and the numbers are then
    NaN."""


class Limit(Paged, kind="limit"):
    """The largest stable steps of a scene, linearised at its positions and at rest.

    `rows` is a structured array with one row a method. A step is infinite where nothing limits it, 0 where none is
    stable, NaN where it does not apply.

    `modes` (k,) [1/s] are the known eigenvalues, complex, of conjugates the one with the positive imaginary part, the
    largest first; `frequency` (k,) [rad/s] and `decay` (k,) [1/s] those of x'' + 2 decay x' + frequency^2 x = 0, of
    which they are roots. `shape` (n, 3) is the mode that limits the method of the run (of the first row with a limit,
    if that has none), its largest displacement 1; None if nothing is limited. `blame` has the springs that determine
    it, at most 100, and before them a force that has half of it; `participation` has the particles that move in it, both
    with the largest share first; `changes` is the gain of changing them, None if nothing is limited.

    `outcome` is "finished", or the outcome of the run along which limits were found.
    """

    _untitled = "limits of steps"

    def _read(self, found: Measurement) -> None:
        modes = found.rows("modes")
        self.modes: ComplexArray = modes["real"] + 1j * modes["imaginary"]
        self.frequency: FloatArray = modes["frequency"]
        self.decay: FloatArray = modes["decay"]
        shape = found.series("limit", 0, "shape")
        self.shape = None if shape is None else shape.reshape(-1, 3)
        self.blame = Blame.read(found)
        self.participation = found.each(Participation, "participation")
        self.changes = found.one(Changes, "changes")

    methods = methods_of_rows

    @staticmethod
    def step_of_mode(method: str, frequency: Any, decay: Any) -> FloatArray:
        """The largest step [s] at which a method is stable for x'' + 2 decay x' + frequency^2 x = 0, an array of the shape
        of `frequency` [rad/s] and `decay` [1/s]: 0 if none is, infinite if nothing limits it, NaN if that is not known."""
        number = np.vectorize(lambda *mode: lib.hooke_limit_of_mode(method.encode(), *mode), otypes=[float])
        steps: FloatArray = number(frequency, decay)
        return steps

    def plot(self, axes: Any = None, **options: Any) -> Any:
        """Draws the modes on the regions of stability; see `hooke.plot.limit`."""
        return draw("plot.limit", self, axes=axes, **options)

    def __repr__(self) -> str:
        return f"Limit({self.outcome}, {len(self.rows)} methods, {len(self.modes)} modes)"


@takes(LimitKeywords)
def limit(
    problem: Runnable,
    at: Place | None = None,
    methods: str | Iterable[str] | None = None,
    *,
    progress: WorkProgress | bool | None = None,
    **options: Unpack[LimitKeywords],
) -> Limit:
    """Finds the largest stable step of each of `methods` (all of fixed step, if None) on a scene (or the path of one)
    or a system: predicted from the eigenvalues of the scene linearised `at` its positions (at the start, if None) and
    at rest, and then measured by running the method, unless `predict` is True.

    `at` is a state, positions (n, 3) [m], or a trajectory file, of which the last frame is taken, or a pair of that and
    the number of a frame. With ``along=True`` it predicts at every frame of the run and returns the smallest limits and
    their times; ``nonlinear=True`` measures on the scene itself.
    """
    return Limit(*measured("limit", problem, {**options, "methods": methods}, progress, lambda system: state_at(system, at)))


def state_at(system: System, at: Place | None) -> State:
    """A separate state, since a run may change it."""
    state = system.state()
    if isinstance(at, State):
        lib.hooke_state_copy(at._handle, state._handle)
    elif isinstance(at, (tuple, str, os.PathLike)):
        path, frame = at if isinstance(at, tuple) else (at, -1)
        lib.hooke_record_read(opened(path), frame, state._handle)
    elif at is not None:
        state.q = at
    return state
