"""Viewing trajectory files: as a page for a browser, and in ParaView."""

from __future__ import annotations

import os
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Protocol, Union

from ._library import lib
from ._measurement import Measurement
from ._record import opened
from ._status import BadValue
from ._types import Path as PathLike
from .options import Options


class Written(Protocol):
    """What has the file that it was written to in its `output`: the `Result` of a run."""

    @property
    def output(self) -> PathLike | None:
        """The file; None if there is none."""


Source = Union[PathLike, Written]


def view(
    trajectory: Source | Sequence[Source],
    output: PathLike | None = None,
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
    views = [_view(source, title, options) for source in sources]
    for other in views[1:]:
        lib.hooke_view_add(views[0].handle, other.handle)
    lib.hooke_measurement_write(views[0].handle, os.fsencode(page))
    return page


def write_xdmf(trajectory: Source, output: PathLike | None = None) -> Path:
    """Writes the companion file for ParaView of a trajectory, and returns its path: by default beside the trajectory,
    with ``.xdmf`` in place of its ``.h5``. Runs with ``output=`` write it at their end; after a killed run this
    writes it for the existing frames."""
    source = _file_of(trajectory)
    lib.hooke_record_write_xdmf(opened(source), None if output is None else os.fsencode(output))
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


def _file_of(trajectory: Source) -> Path:
    if isinstance(trajectory, (str, os.PathLike)):
        return Path(os.fspath(trajectory))
    output = getattr(trajectory, "output", None)
    if output is None:
        raise BadValue("trajectory: this run was not written to a file; run it with output=...")
    return Path(os.fspath(output))


def _view(source: Path, title: str | None, options: dict[str, Any]) -> Measurement:
    record, chosen = opened(source), Options._of("view").set(**options)
    made = Measurement.made(record, lib.hooke_view_create, record, chosen._handle)
    made.label(title=title)
    return made
