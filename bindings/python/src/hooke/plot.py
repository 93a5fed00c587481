"""Pictures of results, with matplotlib (``pip install "libhooke[plot]"``). Every function draws into `ax`,
or into new axes, and returns the axes."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from .results import Result

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Path = Union[str, "os.PathLike[str]"]
#: An HDF5 file of a run or a comparison, a `Result`, or positions (n, 3) and springs (m, 2).
Source = Union[Path, Result, tuple[Any, Any]]

_AXES = {"x": 0, "y": 1, "z": 2}


def cloth(
    source: Source,
    ax: Any = None,
    *,
    run: str = "all",
    frame: int = -1,
    up: str = "y",
    color: str = "tab:blue",
    linewidth: float = 0.5,
    label: str | None = None,
) -> Any:
    """Draws the springs of a cloth, or of anything else, in space.

    `source` is a file that a run or a comparison wrote, a `Result`, or a pair of positions (n, 3) [m] and
    spring ends (m, 2). In a file, `run` is "all" (the run, or the reference of a comparison) or a method of
    the comparison, and `frame` counts the frames that were written, from the end if negative. `up` is the
    axis that is drawn upwards.
    """
    from mpl_toolkits.mplot3d.art3d import Line3DCollection

    q, springs, time = _frame(source, run, frame)
    height = _AXES[up]
    # cyclic, so that the picture is not mirrored
    order = [(height + 1) % 3, (height + 2) % 3, height]
    points = np.asarray(q, float)[:, order]
    if ax is None:
        ax = _new_axes(projection="3d")
        for name, axis in zip((ax.set_xlabel, ax.set_ylabel, ax.set_zlabel), order):
            name(f"{'xyz'[axis]} [m]")
        if time is not None:
            ax.set_title(f"t = {time:g} s")
    ax.add_collection3d(
        Line3DCollection(points[np.asarray(springs, int)], colors=color, linewidths=linewidth, label=label),
        autolim=False,
    )
    _fit(ax, points)
    return ax


def error(path: Path, ax: Axes | None = None, *, series: str = "error") -> Axes:
    """Draws the root mean square error [m] of each method of a comparison over time, from the file that it
    wrote; ``series="energy_drift"`` draws the size of the energy error [J] instead."""
    import h5py

    with h5py.File(path, "r") as file:
        table = file["comparison"]
        methods = [_text(name) for name in table["method"][:]]
        reference = _text(table["reference"][()])
        time, values = table["series/time"][:], np.abs(table[f"series/{series}"][:])
    if ax is None:
        ax = _new_axes()
    for method, row in zip(methods, values):
        shown = row > 0  # a logarithm has no zero, and NaN is past the end
        ax.plot(time[shown], row[shown], label=method)
    ax.set_yscale("log")
    ax.set_xlabel("time [s]")
    ax.set_ylabel({"error": "error [m]", "energy_drift": "energy error [J]"}[series])
    ax.set_title(f"against {reference}" if reference else "")
    ax.legend()
    return ax


def _frame(source: Source, run: str, frame: int) -> tuple[np.ndarray, np.ndarray, float | None]:
    if isinstance(source, Result):
        return source.state.q, source.system.spring_ends, source.state.t
    if not isinstance(source, (str, os.PathLike)):
        return (*source, None)
    import h5py

    with h5py.File(source, "r") as file:
        position = file[f"particles/{run}/position"]
        written = np.flatnonzero(~np.isnan(position["time"][:]))
        if not -written.size <= frame < written.size:
            raise IndexError(f"frame {frame}: {source} has {written.size} frames of {run!r}")
        number = written[frame]
        return position["value"][number], file["connectivity/springs"][:], float(position["time"][number])


def _new_axes(**options: Any) -> Any:
    import matplotlib.pyplot as plt

    return plt.figure().add_subplot(**options)


def _fit(ax: Any, points: np.ndarray) -> None:
    """Widens the limits to what is drawn, with one scale for the three axes."""
    points = points[np.isfinite(points).all(axis=1)]
    if not len(points):
        return
    low, high = points.min(axis=0), points.max(axis=0)
    drawn = getattr(ax, "_hooke_limits", None)
    if drawn is not None:
        low, high = np.minimum(low, drawn[0]), np.maximum(high, drawn[1])
    ax._hooke_limits = low, high
    margin = max(float((high - low).max()), 1e-9) * 0.02
    ax.set_xlim(low[0] - margin, high[0] + margin)
    ax.set_ylim(low[1] - margin, high[1] + margin)
    ax.set_zlim(low[2] - margin, high[2] + margin)
    ax.set_box_aspect(high - low + 2 * margin)


def _text(value: Any) -> str:
    return value.decode("utf-8", "replace").rstrip("\0") if isinstance(value, bytes) else str(value)
