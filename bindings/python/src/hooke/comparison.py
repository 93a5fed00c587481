"""One scene by several methods against CVODE at tight tolerance: how accurate each is for what it costs."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Callable, Optional

import numpy as np

from . import _callback
from ._library import lib
from ._memory import Handle, address_of, text, view
from ._progress import Shown
from ._prototypes import COMPARISON, COMPARISON_FILE, COMPARISON_FRAME
from ._status import BadValue
from ._types import FloatArray, Path, Table
from .integrator import methods as all_methods
from .options import Options
from .results import Runnable, resolve
from .scene import scene_text
from .state import State
from .system import Force, System

#: progress(fraction, what): the share done, 0 to 1, and what is running.
ComparisonProgress = Callable[[float, str], Optional[int]]
#: observer(run, frame, step, state): `run` is "reference" or a method's name.
ComparisonObserver = Callable[[str, int, int, State], Optional[int]]

_TEXTS = ("method", "status")
_NUMBERS = (
    "step",
    "rtol",
    "atol",
    "error",
    "error_max",
    "error_final",
    "energy_drift",
    "force_evaluations",
    "steps",
    "wall_seconds",
)
_ROW = np.dtype([(name, "U32") for name in _TEXTS] + [(name, float) for name in _NUMBERS])


@dataclass(frozen=True)
class Comparison:
    """A comparison that was made.

    `rows` is a structured array with one row a method: method, status, step [s], rtol, atol [m], error
    (largest root mean square over the free particles [m]), error_max [m], error_final [m], energy_drift [J],
    force_evaluations, steps, wall_seconds; NaN where a number does not apply. Over the frames: `time` (k,)
    [s], `error` (rows, k) [m] and `energy_drift` (rows, k) [J], NaN past the end of a run that diverged.
    """

    status: str
    reference: str
    rows: Table
    time: FloatArray
    error: FloatArray
    energy_drift: FloatArray

    @property
    def methods(self) -> list[str]:
        """The methods in the order of the rows."""
        return [str(name) for name in self.rows["method"]]

    def __str__(self) -> str:
        columns = ("error", "error_final", "energy_drift", "force_evaluations", "wall_seconds")
        lines = [f"{'method':18}{'status':>10}" + "".join(f"{name:>19}" for name in columns)]
        for row in self.rows:
            numbers = "".join(f"{row[name]:>19.4g}" for name in columns)
            lines.append(f"{row['method']:18}{row['status']:>10}{numbers}")
        return "\n".join(lines)


def compare(
    problem: Runnable,
    methods: Iterable[str] | None = None,
    *,
    output: Path | None = None,
    force: Force | None = None,
    progress: ComparisonProgress | bool | None = None,
    on_frame: ComparisonObserver | None = None,
    **options: Any,
) -> Comparison:
    """Runs a scene (or the path of one) or a system by each of `methods` (all that this build has, if None)
    and by CVODE at tight tolerance, and returns the `Comparison`.

    The keywords `options` are those of a run: step [s], duration [s], every [s], rtol, atol [m]; `output` is
    an HDF5 file to write (`hooke.plot` draws it), `force` adds a force callback, ``progress(fraction, what)``
    is told of progress, ``progress=True`` shows a bar (with tqdm),
    ``on_frame(run, frame, step, state)`` sees every frame (not together with `output`).
    """
    if output is not None and on_frame is not None:
        raise BadValue("on_frame: not together with output, which takes the frames")
    scene, system, given = resolve(problem, force)
    if not isinstance(system, System):
        raise BadValue("compare: a system is needed, this is a first-order problem")
    chosen = (given.copy() if given is not None else Options.for_run()).set(**options)
    pointer = COMPARISON()
    lib.hooke_comparison_create(system._committed(), chosen._handle, ctypes.byref(pointer))
    handle = Handle(pointer, lib.hooke_comparison_destroy, system._handle)
    names = [method.name for method in all_methods() if method.built] if methods is None else list(methods)
    for name in names:
        lib.hooke_comparison_add(handle, name.encode())
    watcher = None if on_frame is None else _watch_frames(on_frame, system.state())
    if watcher is not None:
        lib.hooke_comparison_on_frame(handle, watcher, None)
    if output is None:
        return _read(handle, _run(handle, progress))
    return _read(handle, _run_to_file(os.fsencode(output), scene, system, handle, progress))


def _run(handle: Handle, progress: Shown) -> str:
    with _callback.listening(lib.hooke_comparison_on_progress, handle, progress):
        return "stopped" if lib.hooke_comparison_run(handle) else "finished"


def _run_to_file(path: bytes, scene: Any, system: System, handle: Handle, progress: Shown) -> str:
    file = COMPARISON_FILE()
    lib.hooke_comparison_file_create(path, system._handle, handle, scene_text(scene), ctypes.byref(file))
    try:
        return _run(handle, progress)
    finally:
        lib.hooke_comparison_file_close(file)


def _watch_frames(on_frame: ComparisonObserver, copy: State) -> Any:
    def call(run: bytes, frame: int, step: int, address: int) -> int | None:
        source = ctypes.cast(address, type(copy._handle.pointer))
        lib.hooke_state_copy(source, copy._handle)
        return on_frame(text(run), frame, step, copy)

    return COMPARISON_FRAME(
        lambda run, frame, step, state, _: _callback.guarded(call, run, frame, step, state)
    )


def _read(handle: Handle, status: str) -> Comparison:
    count = lib.hooke_comparison_row_count(handle)
    rows = np.empty(count, _ROW)
    for row in range(count):
        for name in _TEXTS:
            rows[name][row] = text(lib.hooke_comparison_text(handle, row, name.encode()))
        for name in _NUMBERS:
            rows[name][row] = lib.hooke_comparison_number(handle, row, name.encode())
    frames = lib.hooke_comparison_frame_count(handle)

    def series(what: bytes) -> FloatArray:
        out = np.full((count, frames), np.nan)
        for row in range(count):
            out[row] = _series(handle, row, what, frames)
        return out

    time = _series(handle, 0, b"time", frames) if count else np.empty(0)
    reference = text(lib.hooke_comparison_reference(handle))
    return Comparison(status, reference, rows, time, series(b"error"), series(b"energy_drift"))


def _series(handle: Handle, row: int, what: bytes, frames: int) -> FloatArray:
    pointer = lib.hooke_comparison_series(handle, row, what)
    return view(address_of(pointer), (frames,)).copy() if pointer else np.full(frames, np.nan)
