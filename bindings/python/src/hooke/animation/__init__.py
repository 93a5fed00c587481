"""Films of trajectories, with matplotlib (``pip install "libhooke[plot]"``)."""

from __future__ import annotations

import os
import pathlib
from typing import Any

import numpy as np

from .. import BadValue, NotBuilt, Trajectory
from .._signature import takes
from .._types import FloatArray, Path
from ..plot import axis_order, fit, new_space
from ..plot._pictures import FuncAnimation, Line3DCollection, LinearSegmentedColormap, writers

_SHORTEST, _LONGEST = 4.0, 10.0
_COLOURS = ["tab:blue", "0.35", "tab:red"]  # dark in the middle, to be visible on white


class Animation(FuncAnimation):
    """A film; a notebook shows it, ``save("film.gif")`` or ``save("film.mp4")`` writes it."""

    def save(self, filename: Path, writer: Any = None, *arguments: Any, **options: Any) -> None:
        """Writes the film to a file, by its ending: ``.gif`` with Pillow, ``.html`` as a page, others with ffmpeg; see
        matplotlib's Animation.save for `writer` and the other options."""
        name = os.fspath(filename)
        if writer is None and name.endswith(".html"):
            pathlib.Path(name).write_text(self.to_jshtml(), "utf-8")
            return
        if writer is None and not name.endswith(".gif") and not writers.is_available("ffmpeg"):
            raise NotBuilt(f"{name}: needs ffmpeg, which is not installed; .gif and .html do without")
        super().save(name, "pillow" if writer is None and name.endswith(".gif") else writer, *arguments, **options)

    def _repr_html_(self) -> str:
        return str(self.to_jshtml())


@takes()
def animate(
    trajectory: Trajectory,
    ax: Any = None,
    *,
    seconds: float | None = None,
    fps: float = 25.0,
    up: str = "y",
    color: str = "tab:blue",
    linewidth: float = 0.5,
    repeat: bool = True,
) -> Animation:
    """A film of the springs of a trajectory, drawn into `ax` or into new axes.

    It lasts `seconds`; if None as long as the run, but from 4 to 10 s. It has at most `fps` pictures a second and at
    most one for each frame. `up` is the axis drawn upwards, `color` that of the springs, or "strain" for red where
    they are stretched and blue where they are compressed. Pinned particles are marked.
    """
    if not len(trajectory):
        raise BadValue(f"{trajectory.path}: has no frames to show")
    t, q, springs, order = trajectory.t, trajectory.q, trajectory.springs, axis_order(up)
    lasting = min(max(float(t[-1] - t[0]), _SHORTEST), _LONGEST) if seconds is None else seconds
    count = int(min(len(t), max(2, round(lasting * fps))))
    shown = np.unique(np.linspace(0, len(t) - 1, count).round().astype(int))
    ax = new_space(order) if ax is None else ax
    for frame in shown:
        fit(ax, q[frame][:, order])
    lines = Line3DCollection(q[0][:, order][springs], linewidths=linewidth)
    if color == "strain":
        strains = [trajectory.strain(int(frame)) for frame in shown]
        sizes = np.abs(np.concatenate(strains))
        sizes = sizes[np.isfinite(sizes)]
        largest = float(np.quantile(sizes, 0.99)) if sizes.any() else 1.0  # a few springs do not determine the scale
        lines.set(cmap=LinearSegmentedColormap.from_list("strain", _COLOURS), clim=(-largest, largest))
        ax.figure.colorbar(lines, ax=ax, label="strain", shrink=0.6, pad=0.15, extend="both")
    else:
        lines.set_color(color)
    ax.add_collection3d(lines, autolim=False)
    held = q[0][trajectory.pinned][:, order]
    if len(held):
        ax.plot(*held.T, linestyle="", marker="s", markersize=3, color="0.2")

    def draw(number: int) -> list[Any]:
        frame = int(shown[number])
        segments: FloatArray = q[frame][:, order][springs]
        lines.set_segments(segments)
        if color == "strain":
            lines.set_array(strains[number])
        ax.set_title(f"t = {t[frame]:.3g} s")
        return [lines]

    return Animation(ax.figure, draw, frames=len(shown), interval=1000 * lasting / len(shown), repeat=repeat)
