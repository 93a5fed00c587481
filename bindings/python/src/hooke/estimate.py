"""The error of a run: the wanted one, and the estimated one."""

from __future__ import annotations

import os
from typing import Any, Union

from ._library import lib
from ._measurement import Measurement, Record
from ._status import BadValue, Unsuited
from ._types import Path
from .integrator import Integrator
from .options import Options
from .state import State
from .system import System

#: A length: a number [m], or text with a unit, such as "1mm".
Length = Union[float, str]

_CHOSEN = ("step", "rtol", "atol", "atol_velocity")


class RunError(Record, table="estimate.estimate", without=("seconds", "memory_bytes", "reversal"), none=("by",)):
    """The error of a run; a number that is not known is NaN. `met` is None if that is unknown or no error was wanted."""


class Estimate:
    """A measurement of kind "estimate": picks, observes and measures runs of one system."""

    def __init__(self, system: System, want: Length | None, progress: Any = None):
        wanted = want.strip() if isinstance(want, str) else want
        options = Options._of("estimate").set(want=wanted, callbacks=True)
        self._measurement = Measurement.create("estimate", system, None, options)
        self._handle = self._measurement.handle
        self._progress = progress

    def pick(self, options: Options, given: dict[str, Any]) -> None:
        """Sets a method and its step or tolerance for the wanted error; keeps the method if it is among those
        `given`."""
        chosen = [name for name in _CHOSEN if given.get(name) is not None]
        if chosen:
            raise BadValue(f"want picks the step or the tolerance; leave out {' and '.join(chosen)}, or want")
        method = given.get("method")
        with self._measurement.listening(self._progress):
            lib.hooke_estimate_pick(self._handle, None if method is None else method.encode(), options._handle)

    def begin(self, integrator: Integrator, state: State) -> None:
        """Call before a run of `integrator` from `state`."""
        lib.hooke_estimate_begin(self._handle, integrator._handle, state._handle)

    def see(self, step: int, state: State) -> None:
        """An observer of its frames."""
        lib.hooke_estimate_see(step, state._handle, self._handle.pointer)

    def measure(self, state: State) -> RunError:
        """The result, after the run that ended with `state`."""
        self._measurement.run(self._progress, state)
        return self._measurement.each(RunError, "estimate")[0]

    def write(self, path: Path) -> None:
        """Adds it to the output file of the run."""
        lib.hooke_estimate_write_h5(self._handle, os.fsencode(path))

    def refine(self, options: Options) -> bool:
        """Sets something finer, if that is known to help."""
        try:
            lib.hooke_estimate_refine(self._handle, options._handle)
        except Unsuited:
            return False
        return True
