"""Comparison of several methods on one scene with a checked reference: accuracy and cost of each."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Callable, Optional

import numpy as np

from . import _callback
from ._library import lib
from ._measurement import Measurement
from ._memory import text
from ._notebook import Tabled, of_methods
from ._progress import WorkProgress
from ._prototypes import COMPARISON_FILE, COMPARISON_FRAME
from ._status import BadValue
from ._types import FloatArray, Path, Table
from .options import Options, joined
from .results import Runnable, resolve
from .scene import scene_text
from .state import State
from .system import Force, system_of

#: observer(run, frame, step, state): `run` is "reference" or a method's name.
ComparisonObserver = Callable[[str, int, int, State], Optional[int]]


@dataclass(frozen=True)
class Comparison(Tabled):
    """A finished comparison.

    `rows` is a structured array with one row a method: method, step [s], rtol, atol [m], error (largest root mean
    square over the free particles [m]), error_max [m], error_final [m], energy_drift [J], force_evaluations, steps,
    linear_iterations, wall_seconds, status; NaN where a number does not apply. Over the frames: `time` (k,) [s],
    `error` (rows, k) [m] and `energy_drift` (rows, k) [J], NaN past the end of a run that diverged and past
    `trusted_until` [s], until when the two integrators of the reference agree, to `agreement` [m].
    """

    status: str
    reference: str
    rows: Table
    time: FloatArray
    error: FloatArray
    energy_drift: FloatArray
    agreement: float = np.nan
    trusted_until: float = np.nan

    @property
    def methods(self) -> list[str]:
        """The methods in the order of the rows."""
        return [str(name) for name in self.rows["method"]]

    def __str__(self) -> str:
        columns = ("error", "error_final", "energy_drift", "force_evaluations", "wall_seconds")
        return of_methods(self.rows, *columns)


def compare(
    problem: Runnable,
    methods: Iterable[str] | None = None,
    *,
    output: Path | None = None,
    force: Force | None = None,
    progress: WorkProgress | bool | None = None,
    on_frame: ComparisonObserver | None = None,
    **options: Any,
) -> Comparison:
    """Runs a scene (or the path of one) or a system by each of `methods` (all that this build has, if None) and by
    two integrators at tight tolerances that check each other, and returns the `Comparison`.

    The keywords `options` are those of a run: step [s], duration [s], every [s], rtol, atol [m]; `output` is an HDF5
    file to write (`hooke.plot` draws it), `force` adds a force callback, ``progress(fraction, what)`` receives
    progress, ``progress=True`` shows a bar (with tqdm), ``on_frame(run, frame, step, state)`` receives every frame
    (not together with `output`).
    """
    if output is not None and on_frame is not None:
        raise BadValue("on_frame: not together with output, which takes the frames")
    scene, found, chosen = resolve(problem, force, options)
    system = system_of(found, "compare")
    wanted = Options.for_comparison().set(methods=joined(methods or ""))
    measurement = Measurement.create("comparison", system, chosen, wanted)
    watcher = None if on_frame is None else _watch_frames(on_frame, system.state())
    if watcher is not None:
        lib.hooke_comparison_on_frame(measurement.handle, watcher, None)
    file = None if output is None else _create_file(os.fsencode(output), scene, measurement)
    try:
        status = measurement.run(progress)
    finally:
        if file is not None:
            lib.hooke_comparison_file_close(file)
    return _read(measurement, "stopped" if status else "finished")


def _create_file(path: bytes, scene: Any, measurement: Measurement) -> Any:
    file = COMPARISON_FILE()
    lib.hooke_measurement_label(measurement.handle, b"scene", scene_text(scene))
    lib.hooke_comparison_file_create(path, measurement.handle, ctypes.byref(file))
    return file


def _watch_frames(on_frame: ComparisonObserver, copy: State) -> Any:
    def call(run: bytes, frame: int, step: int, address: int) -> int | None:
        source = ctypes.cast(address, type(copy._handle.pointer))
        lib.hooke_state_copy(source, copy._handle)
        return on_frame(text(run), frame, step, copy)

    return COMPARISON_FRAME(lambda run, frame, step, state, _: _callback.guarded(call, run, frame, step, state))


def _read(measurement: Measurement, status: str) -> Comparison:
    rows = measurement.rows("rows")
    time = measurement.series("reference", 0, "time")
    frames = 0 if time is None else len(time)

    def series(column: str) -> FloatArray:
        out = np.full((len(rows), frames), np.nan)
        for row in range(len(rows)):
            found = measurement.series("rows", row, column)
            if found is not None:
                out[row] = found
        return out

    return Comparison(
        status,
        measurement.text("reference", 0, "method"),
        rows,
        np.empty(0) if time is None else time,
        series("error_at"),
        series("energy_drift_at"),
        measurement.number("reference", 0, "agreement"),
        measurement.number("reference", 0, "trusted_until"),
    )
