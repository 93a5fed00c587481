"""Trajectory files, as the library reads them: their numbers, pages of them for a browser, ParaView, and whether they
reproduce from their scenes."""

from __future__ import annotations

import csv
import ctypes
import importlib
import os
import pathlib
from collections.abc import Mapping, Sequence
from typing import Any, Protocol, Union

import numpy as np

from ._callback import warn
from ._keywords import VerifyKeywords, ViewKeywords
from ._library import lib
from ._look import WorkProgress
from ._measurement import Claim, Measurement, Record, said
from ._memory import Handle, double_pointer
from ._signature import Unpack, takes
from ._status import BadValue
from ._types import FloatArray, Path, Table
from .options import Options
from .scene import limits_of

__all__ = ["Verification", "verify", "view", "write_xdmf"]


def opened(path: Path) -> Handle:
    """A file, which closes with its last user."""
    return Handle.made(None, lib.hooke_record_open, os.fsencode(path))


def run_options(record: Handle) -> Options:
    """The options of its run, with defaults filled in."""
    return Options(Handle(lib.hooke_record_options(record), None, record), read_only=True)


def numbers(record: Handle, what: str) -> FloatArray:
    """A whole array of the file (rows,), or (rows, columns) if it has several columns."""
    rows, columns, name = ctypes.c_int64(), ctypes.c_int64(), what.encode()
    lib.hooke_record_size(record, name, ctypes.byref(rows), ctypes.byref(columns))
    found = np.empty((rows.value, columns.value))
    lib.hooke_record_numbers(record, name, double_pointer(found))
    return found[:, 0] if columns.value == 1 else found


def read_probes(path: Path) -> Table:
    """A structured array of what a file of probes holds."""
    if not os.fsdecode(path).endswith(".csv"):
        try:
            h5py: Any = importlib.import_module("h5py")
        except ImportError:
            raise ImportError("probes in HDF5 are read by h5py, which is not installed: pip install h5py") from None
        with h5py.File(path) as file:
            return np.asarray(file["probes"][:])
    with open(path, encoding="utf-8", newline="") as lines:
        names, *rows = csv.reader(lines)
    found = np.empty(len(rows), [(name, float) for name in names])
    for name, column in zip(names, zip(*rows)):
        found[name] = [float(value or "nan") for value in column]
    return found


class Written(Protocol):
    """What has the file that it was written to in its `output`: the `Result` of a run."""

    @property
    def output(self) -> Path | None:
        """The file; None if there is none."""


Source = Union[Path, Written]


@takes(ViewKeywords)
def view(
    trajectory: Source | Sequence[Source],
    output: Path | None = None,
    *,
    title: str | None = None,
    **options: Unpack[ViewKeywords],
) -> pathlib.Path:
    """Writes a trajectory as one HTML page that plays it, to open in a browser, offline, and returns its path.

    `trajectory` is a file that ``hooke.run(..., output=...)`` or ``hooke run -o`` wrote, or the `Result` of such a
    run; `output` the page, by default the file's name with ``.html``; `title` is its heading (by default the
    scene's). Several trajectories play on one page, `output`, side by side or over one another, at the same time and
    seen from the same angle. The page states what is omitted.
    """
    if isinstance(trajectory, str) or not isinstance(trajectory, Sequence):
        trajectory = [trajectory]
    sources = [_file_of(one) for one in trajectory]
    if not sources:
        raise BadValue("trajectory: there is none; allowed: a trajectory, or several")
    if output is None and len(sources) != 1:
        raise BadValue("output: is required for several trajectories")
    page = pathlib.Path(os.fspath(output)) if output is not None else sources[0].with_suffix(".html")
    views = [view_of(source, title, options) for source in sources]
    for other in views[1:]:
        lib.hooke_view_add(views[0].handle, other.handle)
    lib.hooke_measurement_write(views[0].handle, os.fsencode(page))
    return page


def write_xdmf(trajectory: Source, output: Path | None = None) -> pathlib.Path:
    """Writes the companion file for ParaView of a trajectory, and returns its path: by default beside the trajectory,
    with ``.xdmf`` in place of its ``.h5``. Runs with ``output=`` write it at their end; after a killed run this
    writes it for the existing frames."""
    source = _file_of(trajectory)
    lib.hooke_record_write_xdmf(opened(source), None if output is None else os.fsencode(output))
    if output is not None:
        return pathlib.Path(os.fspath(output))
    known = source.suffix in (".h5", ".hdf5", ".h5md")
    return source.with_suffix(".xdmf") if known else source.with_name(source.name + ".xdmf")


def write_companion(path: bytes) -> None:
    """The same at the end of a run, for which a name that ParaView cannot read is no failure."""
    try:
        write_xdmf(os.fsdecode(path))
    except BadValue as trouble:
        warn(f"no .xdmf is written: {trouble}", UserWarning)


def _file_of(trajectory: Source) -> pathlib.Path:
    output = trajectory if isinstance(trajectory, (str, os.PathLike)) else getattr(trajectory, "output", None)
    if output is None:
        raise BadValue("trajectory: this run was not written to a file; run it with output=...")
    return pathlib.Path(os.fspath(output))


def view_of(source: Path, title: str | None, options: Mapping[str, object]) -> Measurement:
    """What a page shows of a trajectory."""
    record, chosen = opened(source), Options._of("view").set(**options)
    made = Measurement.made(record, lib.hooke_view_create, record, chosen._handle)
    made.label(title=title)
    return made


class Verification(Record, table="verify.verify", also=("claims",)):
    """The result of verifying a trajectory; true if it reproduces from its scene. Machines and versions are those that
    made the file, and those here. `claims` are what it says, which ``print(found)`` shows."""

    @property
    def texts(self) -> dict[str, str]:
        """The texts by name."""
        return {name: value for name, value in self._asdict().items() if isinstance(value, str)}

    @property
    def numbers(self) -> dict[str, float]:
        """The numbers by name: ``found.numbers["error_estimate"]`` [m]."""
        return {name: value for name, value in self._asdict().items() if not isinstance(value, str)}

    def __bool__(self) -> bool:
        return self.verdict in ("agrees", "within-tolerance")

    def __str__(self) -> str:
        return said(self.claims)

    def __repr__(self) -> str:
        return f"Verification({self.verdict}, balance {self.balance}, {self.difference or 'no difference'})"


@takes(VerifyKeywords)
def verify(
    path: Path,
    *,
    memory: float | None = None,
    outside: bool = False,
    progress: WorkProgress | bool | None = None,
    **options: Unpack[VerifyKeywords],
) -> Verification:
    """Repeats a slice of a trajectory from the contents of its file and compares it with its frames to the bit;
    compares every frame with its check value, computes the energy balance and estimates the error.

    `memory` and `outside` are as in `Scene.load`. A file that does not reproduce is a result, not an error.
    """
    given, limits = Options._of("verify").set(**options), limits_of(memory, outside)
    measurement = Measurement.made(None, lib.hooke_verify_create, os.fsencode(path), given._handle, limits)
    try:
        measurement.run(progress)
    except BadValue:
        if measurement.text("verify", 0, "verdict") != "disagrees":
            raise
    return measurement.each(Verification, "verify", claims=measurement.each(Claim, "claims"))[0]
