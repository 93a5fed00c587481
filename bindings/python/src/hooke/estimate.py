"""The error of a run: the wanted one, and the estimated one."""

from __future__ import annotations

import os
from typing import Any, NamedTuple, Union

from ._library import lib
from ._measurement import Measurement
from ._status import BadValue, Unsuited
from ._types import Path
from .integrator import Integrator
from .options import Options
from .state import State
from .system import System

#: A length: a number [m], or text with a unit, such as "1mm".
Length = Union[float, str]

_CHOSEN = ("step", "rtol", "atol", "atol_velocity")


class RunError(NamedTuple):
    """The error of a run.

    `estimate` is the distance of the farthest free particle, at any frame, from where it should be [m], and `rms` the
    root mean square over free particles at the worst frame; NaN if they are not known. They hold up to `known_until`
    [s]. `by` is "half-step", "tolerance", "other-method" or "reference", None without an estimate; `wanted` the wanted
    error [m] and `met` whether it was met, None if that is unknown or none was wanted. `energy_rise` is the
    spontaneous rise of energy over the last half of the run, as a fraction of the energy of the scene, NaN if unknown;
    `heat_excess` is the energy that damping and drag dissipated beyond the available energy, as such a fraction, since
    velocities reverse at each step. Where the error is not known, `last_piece` is what the run from `last_from` [s] to
    its end added to it there [m], NaN if that was not measured. `reason` says why an error is not known or not met.
    """

    estimate: float
    rms: float
    known_until: float
    by: str | None
    wanted: float
    met: bool | None
    energy_rise: float
    heat_excess: float
    last_piece: float
    last_from: float
    reason: str


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
        found: RunError = self._measurement.one(RunError, "estimate")
        return found

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
