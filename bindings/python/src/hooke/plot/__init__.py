"""Pictures of results, with matplotlib (``pip install "libhooke[plot]"``). Every function draws into `ax`,
or into new axes, and returns the axes."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from .. import BadValue, Limit, Needs, Result, Study, Trajectory
from .._types import FloatArray, Path, Table
from ._pictures import Line3DCollection

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: An HDF5 file of a run or of `hooke.compare`, a `Trajectory`, a `Result`, or positions (n, 3) and springs (m, 2).
Source = Union[Path, Trajectory, Result, tuple[Any, Any]]

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
    """Draws the springs of a cloth, or of any other system, in space.

    `source` is a file that a run or `hooke.compare` wrote, a `Trajectory`, a `Result`, or a pair of positions (n, 3)
    [m] and spring ends (m, 2). In a file, `run` is "all" (the run, or the reference) or one of the compared methods,
    and `frame` counts the frames that were written, from the end if negative. `up` is the axis drawn upwards.
    """
    q, springs, time = _frame(source, run, frame)
    order = axis_order(up)
    points = np.asarray(q, float)[:, order]
    if ax is None:
        ax = new_space(order)
        if time is not None:
            ax.set_title(f"t = {time:g} s")
    ax.add_collection3d(
        Line3DCollection(points[np.asarray(springs, int)], colors=color, linewidths=linewidth, label=label),
        autolim=False,
    )
    fit(ax, points)
    return ax


def error(path: Path, ax: Axes | None = None, *, series: str = "error") -> Axes:
    """Draws the root mean square error [m] of each row of a study over time, from the file that it or `hooke.compare`
    wrote; ``series="energy_drift"`` draws the size of the energy error [J] instead."""
    import h5py

    with h5py.File(path, "r") as file:
        table = file["study"]
        methods = [_text(name) for name in table["method"][:]]
        reference = table["reference"].attrs["method"]
        time, values = table["series/time"][:], np.abs(table[f"series/{series}"][:])
    ax = _new_axes() if ax is None else ax
    for method, row in zip(methods, values):
        shown = row > 0  # a logarithm has no zero, and NaN is past the end
        ax.plot(time[shown], row[shown], label=method)
    ax.set_yscale("log")
    ax.set_xlabel("time [s]")
    ax.set_ylabel({"error": "error [m]", "energy_drift": "energy error [J]"}[series])
    ax.set_title(f"against {reference}" if reference else "")
    ax.legend()
    return ax


def study(
    source: Study | Path, axes: Any = None, *, cost: str = "wall_seconds", want: float | None = None
) -> Any:
    """Draws a study, or the file that one wrote, into two axes (made if not given) and returns them: error_max [m]
    against cost, one marked line a method, and error against step with the observed orders; errors of one step are dotted.

    `cost` is "wall_seconds" [s], "force_evaluations" or "steps". Steps at which a run diverged are marked at the
    upper edge of the second. The grey band is the uncertainty of the reference, and ten times that. `want` [m] draws
    a line.
    """
    table = _Table(source)
    axes = _two_axes(sharey=True) if axes is None else axes
    costs, steps = axes
    for number, method in enumerate(dict.fromkeys(table["method"])):
        rows = np.flatnonzero(table["method"] == method)
        style = {"color": f"C{number % 10}", "marker": _MARKERS[number % len(_MARKERS)], "markersize": 4}
        _ladder(costs, table[cost][rows], table["error_max"][rows], method, style)
        if np.isfinite(table["step"][rows]).any():
            order = table.orders.get(method, np.nan)
            label = f"{method}, order {order:.2f}" if np.isfinite(order) else method
            _ladder(steps, table["step"][rows], table["error_max"][rows], label, style)
            _ladder(steps, table["step"][rows], table["error_step"][rows], "_", {**style, "marker": ".", "linestyle": ":"})
            _edge(steps, table["step"][rows[np.isnan(table["error_max"][rows])]], style)
    costs.set_xlabel({"wall_seconds": "wall time [s]"}.get(cost, cost.replace("_", " ")))
    steps.set_xlabel("step [s]")
    for ax in (costs, steps):
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_ylabel("error [m]" if getattr(source, "unit", "m") else "error")
        if table.agreement > 0:
            ax.axhspan(table.agreement / 1e3, table.agreement * 10, color="0.92", zorder=0)
            ax.set_ylim(bottom=np.nanmin([table.agreement, *table["error_step"]]))
        if want is not None:
            ax.axhline(want, color="0.4", linestyle="--", linewidth=0.8)
        ax.legend(fontsize="small")
    return axes


def limit(found: Limit, axes: Any = None, *, step: float | None = None) -> Any:
    """Draws the modes of a scene times `step` [s] on the regions of stability, into two axes (made if not given), and
    returns them: the eigenvalues on the regions of the methods that have one for each eigenvalue, and frequency and
    decay on those of all methods that have a limit. A method is stable while every point is within its line.

    Without `step`, that of the scene is taken or, if it names none, the smallest predicted limit.
    """
    predicted = found.rows["predicted"]
    limits = predicted[(predicted > 0) & np.isfinite(predicted)]
    if step is None:
        step = found.step if np.isfinite(found.step) else limits.min() if limits.size else 1.0
    axes = _two_axes() if axes is None else axes
    plane, reach = axes
    angle = np.linspace(0, np.pi / 2, 181)
    for number, row in enumerate(found.rows):
        style = {"color": f"C{number % 10}", "label": row["method"], "linewidth": 1.5}
        if not np.isfinite(found.step_of_mode(row["method"], 1.0, 0.5)):
            continue
        if row["by_eigenvalue"]:
            edge = found.step_of_mode(row["method"], 1.0, np.sin(angle))
            z = edge * (-np.sin(angle) + 1j * np.cos(angle))
            z = np.concatenate([z, z[::-1].conj()])
            plane.plot(z.real, z.imag, **style)
        edge = np.minimum(found.step_of_mode(row["method"], np.cos(angle), np.sin(angle)), 100)
        reach.plot(edge * np.cos(angle), edge * np.sin(angle), **style)
    dots = {"linestyle": "", "marker": "o", "markersize": 4, "color": "0.1", "label": "modes"}
    modes = step * np.concatenate([found.modes, found.modes.conj()])
    plane.plot(modes.real, modes.imag, **dots)
    reach.plot(step * found.frequency, step * found.decay, **dots)
    reach.axline((0, 0), slope=1, color="0.6", linestyle="--", linewidth=1, label="critical damping")
    for ax, left, bottom, names in (
        (plane, -3.6, -3.2, ("real part of h \u03bb", "imaginary part of h \u03bb")),
        (reach, 0, 0, ("h \u03c9, step times frequency", "h d, step times decay")),
    ):
        ax.set(xlim=(left, left + 4.2), ylim=(bottom, 3.2), xlabel=names[0], ylabel=names[1], aspect="equal")
        ax.legend(fontsize="small")
    reach.set_xlim(0, 3.2)
    plane.set_title(f"h = {step:.4g} s")
    return axes


def needs(found: Needs, ax: Axes | None = None) -> Axes:
    """Draws the change of the watched positions [m] without each ingredient, the largest on top, with the wanted
    error as a line: needed ones in one colour, others in another, those that the lean scene lacks darker."""
    rows = found.rows[np.argsort(np.where(np.isnan(found.rows["error"]), np.inf, found.rows["error"]), kind="stable")]
    ax = _new_axes() if ax is None else ax
    seen = np.append(rows["error"][rows["error"] > 1e-9 * found.want], found.want)
    low, high = seen.min() / 3, seen.max() * 3
    length = np.clip(np.where(np.isnan(rows["error"]), high, rows["error"]), low, high)
    place = np.arange(len(rows))
    for label, color, which in (
        ("needed", "tab:red", rows["needed"]),
        ("not needed, and left out", "tab:green", ~rows["needed"] & rows["left_out"]),
        ("not needed, but kept", "0.7", ~rows["needed"] & ~rows["left_out"]),
    ):
        if which.any():
            ax.barh(place[which], length[which], color=color, label=label)
    ax.axvline(found.want, color="0.2", linestyle="--", linewidth=1, label="wanted")
    ax.set(xscale="log", xlim=(low, high), xlabel="change of the watched positions [m]")
    ax.set_yticks(place, list(rows["without"]))
    ax.legend(fontsize="small")
    return ax


def flow(rate: Any, *results: Result, box: tuple[float, float, float, float], ax: Axes | None = None) -> Axes:
    """Draws the flow x' = phi(t, x) of two components at t = 0 as arrows in `box`, (left, right, low, high), and the frames of
    results of it as marked lines."""
    ax = _new_axes() if ax is None else ax
    left, right, low, high = box
    place = np.stack(np.meshgrid(np.linspace(left, right, 20), np.linspace(low, high, 14)))
    speed = np.zeros_like(place)
    for i, j in np.ndindex(*place.shape[1:]):
        rate(0.0, place[:, i, j], speed[:, i, j])
    ax.quiver(*place, *speed, color="0.7", angles="xy")
    for result in results:
        frames = result.frames
        if frames is None:
            raise BadValue("results: a result without frames; give run() frames=True")
        ax.plot(*frames.q.T, marker=".", label=str(result.options["method"]))
    ax.set(xlim=(left, right), ylim=(low, high), xlabel="x", ylabel="y", aspect="equal")
    ax.legend(fontsize="small")
    return ax


_MARKERS = "osD^v<>PX*"


class _Table:
    """Columns, orders and the floor of a study or of its file."""

    def __init__(self, source: Study | Path):
        if isinstance(source, Study):
            self._columns = {name: source.rows[name] for name in source.rows.dtype.names or ()}
            self.orders = {name: order.order for name, order in source.orders.items()}
            self.agreement = source.reference.agreement
            return
        import h5py

        with h5py.File(source, "r") as file:
            group = file["study"]
            self._columns = {name: group[name][:] for name in group if isinstance(group[name], h5py.Dataset)}
            self._columns.setdefault("error_step", np.full(len(group["method"]), np.nan))  # of an older version
            for name in ("method", "status"):
                self._columns[name] = np.array([_text(word) for word in self._columns[name]])
            names = (_text(word) for word in group["orders/method"][:])
            self.orders = dict(zip(names, group["orders/order"][:].tolist()))
            self.agreement = float(group["reference"].attrs["agreement"])

    def __getitem__(self, name: str) -> Table:
        return self._columns[name]


def _ladder(ax: Any, x: FloatArray, error: FloatArray, label: str, style: dict[str, Any]) -> None:
    there = error > 0
    ax.plot(x[there], error[there], label=label, linewidth=1, **style)


def _edge(ax: Any, x: FloatArray, style: dict[str, Any]) -> None:
    height = np.full(x.size, 0.98)
    ax.plot(x, height, transform=ax.get_xaxis_transform(), linestyle="", **{**style, "marker": "x"})


def _frame(source: Source, run: str, frame: int) -> tuple[Table, Table, float | None]:
    if isinstance(source, Result):
        return source.state.q, source.system.spring_ends, source.state.t
    if isinstance(source, Trajectory):
        return source[frame].q, source.springs, source[frame].t
    if not isinstance(source, (str, os.PathLike)):
        return (*source, None)
    if run == "all":
        with Trajectory(source) as trajectory:
            return _frame(trajectory, run, frame)
    import h5py

    with h5py.File(source, "r") as file:
        position = file[f"particles/{run}/position"]
        written = np.flatnonzero(~np.isnan(position["time"][:]))
        if not -written.size <= frame < written.size:
            raise IndexError(f"frame {frame}: {os.fspath(source)!r} has {written.size} frames of {run!r}")
        number = written[frame]
        return position["value"][number], file["connectivity/springs"][:], float(position["time"][number])


def _two_axes(**options: Any) -> Any:
    import matplotlib.pyplot as plt

    return plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained", **options)[1]


def _new_axes(**options: Any) -> Any:
    import matplotlib.pyplot as plt

    return plt.figure().add_subplot(**options)


def axis_order(up: str) -> list[int]:
    """The axes drawn as x, y and z with `up` upwards; cyclic, so that the picture is not mirrored."""
    if up not in _AXES:
        raise BadValue(f'up: "{up}" is not allowed; allowed: "x", "y" or "z"')
    height = _AXES[up]
    return [(height + 1) % 3, (height + 2) % 3, height]


def new_space(order: list[int]) -> Any:
    """New axes in space, named by the `order` of `axis_order`."""
    ax = _new_axes(projection="3d")
    for name, axis in zip((ax.set_xlabel, ax.set_ylabel, ax.set_zlabel), order):
        name(f"{'xyz'[axis]} [m]")
    return ax


def fit(ax: Any, points: FloatArray) -> None:
    """Widens the limits to the drawn data, with one scale for the three axes."""
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
