"""Viewing trajectory files: as a page for a browser, and in ParaView."""

from __future__ import annotations

import ctypes
import os
import warnings
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

from ._library import lib
from ._prototypes import MEASUREMENT, RECORD
from ._status import BadValue
from .options import Options

if TYPE_CHECKING:
    from .results import Result

_PathLike = Union[str, "os.PathLike[str]"]


def view(
    trajectory: _PathLike | Result | Sequence[_PathLike | Result],
    output: _PathLike | None = None,
    *,
    title: str | None = None,
    **options: Any,
) -> Path:
    """Writes a trajectory as one HTML page that plays it, to open in a browser, offline, and returns its path.

    `trajectory` is a file that ``hooke.run(..., output=...)`` or ``hooke run -o`` wrote, or the `Result` of such a
    run; `output` the page, by default the file's name with ``.html``; `title` is its heading (by default the
    scene's). Several trajectories play on one page, `output`, side by side or over one another, at the same time and
    seen from the same angle. Keywords: the maximum number of `frames`, of those `beyond` divergence and of `springs`,
    and the maximum `size` of the page [MB]; the page states what is omitted.
    """
    if isinstance(trajectory, Sequence) and not isinstance(trajectory, str):
        sources = [_file_of(one) for one in trajectory]
    else:
        sources = [_file_of(trajectory)]
    if output is None and len(sources) != 1:
        raise BadValue("output: is required for several trajectories")
    page = Path(os.fspath(output)) if output is not None else sources[0].with_suffix(".html")
    with ExitStack() as stack:
        views = [stack.enter_context(_view(source, title, options)) for source in sources]
        for other in views[1:]:
            lib.hooke_view_add(views[0], other)
        lib.hooke_measurement_write(views[0], os.fsencode(page))
    return page


def write_xdmf(trajectory: _PathLike | Result, output: _PathLike | None = None) -> Path:
    """Writes the companion file for ParaView of a trajectory, and returns its path: by default beside the trajectory,
    with ``.xdmf`` in place of its ``.h5``. Runs with ``output=`` write it at their end; after a killed run this
    writes it for the existing frames."""
    source = _file_of(trajectory)
    with _record(source) as record:
        lib.hooke_record_write_xdmf(record, None if output is None else os.fsencode(output))
    if output is not None:
        return Path(os.fspath(output))
    known = source.suffix in (".h5", ".hdf5", ".h5md")
    return source.with_suffix(".xdmf") if known else source.with_name(source.name + ".xdmf")


def write_companion(path: bytes) -> None:
    """The same at the end of a run, for which a name that ParaView cannot read is no failure."""
    try:
        write_xdmf(os.fsdecode(path))
    except BadValue as trouble:
        warnings.warn(f"no .xdmf is written: {trouble}", stacklevel=4)


def _file_of(trajectory: _PathLike | Result) -> Path:
    if isinstance(trajectory, (str, os.PathLike)):
        return Path(os.fspath(trajectory))
    output = getattr(trajectory, "output", None)
    if output is None:
        raise BadValue("trajectory: this run was not written to a file; run it with output=...")
    return Path(os.fspath(output))


@contextmanager
def _view(source: Path, title: str | None, options: dict[str, Any]) -> Iterator[Any]:
    made = MEASUREMENT()
    with _record(source) as record:
        try:
            lib.hooke_view_create(record, Options._of("view").set(**options)._handle, ctypes.byref(made))
            lib.hooke_measurement_label(made, b"title", None if title is None else title.encode())
            yield made
        finally:
            lib.hooke_measurement_destroy(made)


@contextmanager
def _record(path: Path) -> Iterator[Any]:
    record = RECORD()
    lib.hooke_record_open(os.fsencode(path), ctypes.byref(record))
    try:
        yield record
    finally:
        lib.hooke_record_close(record)
