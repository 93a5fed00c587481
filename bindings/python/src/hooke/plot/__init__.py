"""Pictures of results, with matplotlib (``pip install "libhooke[plot]"``). Every function draws into `ax`,
or into new axes, and returns the axes. Colours are those of Okabe and Ito, which all eyes tell apart."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from .. import BadValue, Limit, Needs, Result, Scene, Study, System, Trajectory, options_of
from .._signature import takes
from .._types import FloatArray, IntArray, Path, Table
from ._pictures import Line3DCollection, LogLocator, MaxNLocator, Poly3DCollection, to_rgb

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: An HDF5 file of a run or of `hooke.compare`, a `Trajectory`, a `Result`, a `Scene` or `System`, which is committed, or
#: positions (n, 3) and springs (m, 2).
Source = Union[Path, Trajectory, Result, Scene, System, tuple[Any, Any]]

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
_AXES = {"x": 0, "y": 1, "z": 2}
_FAINT = 0.55  # of white, in the colour of what is farthest


@takes()
def cloth(
    source: Source,
    ax: Any = None,
    *,
    run: str = "all",
    frame: int = -1,
    up: str = "y",
    color: str = COLOURS[0],
    linewidth: float = 0.8,
    label: str | None = None,
    surface: bool = True,
) -> Any:
    """Draws a cloth, or any other system, in space: cloths and meshes as surfaces, the lighter the more they face the eye,
    unless `surface` is False, and other springs as lines, which are the fainter the farther they are from the eye.

    `source` is a file that a run or `hooke.compare` wrote, a `Trajectory`, a `Result`, a `Scene` or `System` at its start,
    or a pair of positions (n, 3) [m] and spring ends (m, 2). In a file, `run` is "all" (the run, or the reference) or one
    of the compared methods, and `frame` counts the frames that were written, from the end if negative. `up` is the axis
    drawn upwards.
    """
    q, springs, time, system = _frame(source, run, frame)
    order = axis_order(up)
    points, ends = np.asarray(q, float)[:, order], np.asarray(springs, int)
    if ax is None:
        ax = new_space(order)
        if time is not None:
            ax.set_title(f"t = {time:g} s")
    fit(ax, points)
    faces = _faces(system) if surface and system is not None else []
    inside = np.isin(ends, [particle for each in faces for particle in np.unique(each)]).all(axis=1)
    elevation, azimuth = np.deg2rad([ax.elev, ax.azim])
    eye = [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)]
    for each in faces:
        corner = points[each]
        normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        light = np.abs(normal @ eye) / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)  # from the eye, on both sides
        look = {"facecolors": _paled(color, 0.2 + light), "edgecolors": color, "linewidths": 0.4 * linewidth}
        ax.add_collection3d(Poly3DCollection(corner, label=label, **look), autolim=False)
    lines = points[ends[~inside]]
    if len(lines):
        away = -lines.mean(axis=1) @ eye
        far = np.argsort(-away)
        faint = (away[far] - away.min()) / max(np.ptp(away), 1e-300)
        drawn = Line3DCollection(lines[far], colors=_paled(color, faint), linewidths=linewidth, label=None if faces else label)
        ax.add_collection3d(drawn, autolim=False)
    return ax


def _paled(color: Any, faint: FloatArray) -> FloatArray:
    """A colour mixed with white, by 0 to 1 of the most that is mixed."""
    share = _FAINT * faint[:, None]
    paled: FloatArray = (1 - share) * np.asarray(to_rgb(color)) + share
    return paled


def _faces(system: System) -> list[IntArray]:
    """The faces of cloths (k, 4) and of meshes (k, 3), as particles; none of a system that no scene holds."""
    try:
        parts = json.loads(system.text).get("parts", [])
    except TypeError:
        return []
    found: list[IntArray] = []
    for number, part in enumerate(parts):
        first = system.part(part.get("name") or f"{part['kind']}{number}").start
        if part["kind"] == "cloth":
            across, down = part["size"]
            corner = first + (across * np.arange(down - 1)[:, None] + np.arange(across - 1)).ravel()
            found.append(corner[:, None] + [0, 1, across + 1, across])
        elif part["kind"] == "mesh":
            found.append(first + np.reshape(part["triangles"], (-1, 3)))
    return found


@takes()
def over_time(
    source: Trajectory | Result | Path, watch: str | Iterable[str], ax: Axes | None = None
) -> Axes:
    """Draws quantities of a trajectory, in the grammar of ``hooke.run(watch=...)``, over time: ``over_time(out, "57.y")``.
    Several have to share a unit."""
    path = source.output if isinstance(source, Result) else source
    if path is None:
        raise BadValue("source: this run was not written to a file; run it with output=...")
    trajectory = path if isinstance(path, Trajectory) else Trajectory(path)
    ax = _new_axes() if ax is None else ax
    found = trajectory.watched(watch)
    units = {unit for unit, _ in found.values()}
    if len(units) > 1:
        raise BadValue(f"watch: {', '.join(found)} have the units {', '.join(sorted(units))}; draw one unit at a time")
    for number, (name, (_, values)) in enumerate(found.items()):
        ax.plot(trajectory.t, values, label=name, linewidth=1.2, **_style(number, marker=""))
    ax.set(xlabel="time [s]", ylabel=f"{'' if len(found) > 1 else next(iter(found))} [{units.pop() or '1'}]".strip())
    if len(found) > 1:
        _legend(ax)
    return ax


@takes()
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
    for number, (method, row) in enumerate(zip(methods, values)):
        shown = row > 0  # a logarithm has no zero, and NaN is past the end
        ax.plot(time[shown], row[shown], label=method, **_style(number, markevery=max(1, len(time) // 8)))
    ax.set_yscale("log")
    ax.set_xlabel("time [s]")
    ax.set_ylabel({"error": "error [m]", "energy_drift": "energy error [J]"}[series])
    ax.set_title(f"against {reference}" if reference else "")
    _legend(ax)
    return ax


@takes()
def study(
    source: Study | Path, axes: Any = None, *, cost: str = "wall_seconds", want: float | str | None = None
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
    work_precision(source, costs, cost=cost, want=want)
    costs.get_legend().remove()
    unstepped = []
    for number, method in enumerate(dict.fromkeys(table["method"])):
        rows, style = np.flatnonzero(table["method"] == method), _style(number)
        order = table.orders.get(method, np.nan)
        if not np.isfinite(table["step"][rows]).any():
            unstepped += [line for line in costs.lines if line.get_label() == method]
            continue
        label = f"{method}, order {order:.2f}" if np.isfinite(order) else method
        _ladder(steps, table["step"][rows], table["error_max"][rows], label, style)
        _ladder(steps, table["step"][rows], table["error_step"][rows], "_", {**style, "marker": ".", "linestyle": ":"})
        _edge(steps, table["step"][rows[np.isnan(table["error_max"][rows])]], style)
    steps.set_xlabel("step [s]")
    _finish(steps, table, getattr(source, "unit", "m"), want, unstepped)
    return axes


@takes()
def work_precision(
    source: Study | Path, ax: Axes | None = None, *, cost: str = "wall_seconds", want: float | str | None = None
) -> Axes:
    """Draws error_max [m] against cost of a study, or of the file that one wrote, one marked line a method; with `cost` and
    `want` as for `study`."""
    table = _Table(source)
    ax = _new_axes() if ax is None else ax
    for number, method in enumerate(dict.fromkeys(table["method"])):
        rows = np.flatnonzero(table["method"] == method)
        _ladder(ax, table[cost][rows], table["error_max"][rows], method, _style(number))
    ax.set_xlabel({"wall_seconds": "wall time [s]"}.get(cost, cost.replace("_", " ")))
    _finish(ax, table, getattr(source, "unit", "m"), want)
    return ax


def _finish(ax: Any, table: _Table, unit: str, want: float | str | None, lines: Iterable[Any] = ()) -> None:
    wanted: Any = options_of("study").set(want=want)["want"]
    ax.set(xscale="log", yscale="log", ylabel=f"error [{unit}]" if unit else "error")
    if wanted is not None:  # before the limits are set
        ax.axhline(wanted, color="0.4", linestyle="--", linewidth=0.8, label=f"wanted: {wanted:g} {unit}")
    low, high = ax.get_xlim()
    if high < 100 * low:  # few powers of ten: some numbers between them
        ax.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        ax.xaxis.set_major_formatter("{x:g}")
    ax.xaxis.set_minor_formatter("")
    if table.agreement > 0:
        ax.axhspan(table.agreement / 1e3, table.agreement * 10, color="0.92", zorder=0)
        ax.set_ylim(bottom=np.nanmin([table.agreement, *table["error_step"]]))
    _legend(ax, lines)


@takes()
def limit(found: Limit, axes: Any = None, *, step: float | str | None = None) -> Any:
    """Draws the modes of a scene times `step` [s] on the regions of stability, into two axes (made if not given), and
    returns them: the eigenvalues on the regions of the methods that have one for each eigenvalue, and frequency and
    decay on those of all methods that have a limit. A method is stable while every point is within its line.

    Without `step`, that of the scene is taken or, if it names none, the smallest predicted limit; without that, one that
    shows all modes.
    """
    predicted = found.rows["predicted"]
    limits = predicted[(predicted > 0) & np.isfinite(predicted)]
    h: Any = options_of("run").set(step=step)["step"]
    if h is None:
        fastest = np.abs(found.modes).max(initial=0.0)
        smallest = limits.min() if limits.size else 2 / fastest if fastest > 0 else 1.0
        h = found.step if np.isfinite(found.step) else smallest
    axes = _two_axes() if axes is None else axes
    plane, reach = axes
    angle = np.linspace(0, np.pi / 2, 181)
    for number, row in enumerate(found.rows):
        style = {**_style(number, marker=""), "label": row["method"], "linewidth": 1.5}
        edge = found.step_of_mode(row["method"], 1.0, 0.5)
        if not np.isfinite(edge):
            if edge > 0 and not limits.size:  # or nothing would tell of it
                reach.plot([], [], linestyle="", label=f"{row['method']}: everywhere")
            continue
        if row["by_eigenvalue"]:
            edge = found.step_of_mode(row["method"], 1.0, np.sin(angle))
            z = edge * (-np.sin(angle) + 1j * np.cos(angle))
            z = np.concatenate([z, z[::-1].conj()])
            plane.plot(z.real, z.imag, **style)
        edge = np.minimum(found.step_of_mode(row["method"], np.cos(angle), np.sin(angle)), 100)
        reach.plot(edge * np.cos(angle), edge * np.sin(angle), **style)
    dots = {"linestyle": "", "marker": "o", "markersize": 4, "color": "0.1", "label": "modes"}
    modes = h * np.concatenate([found.modes, found.modes.conj()])
    plane.plot(modes.real, modes.imag, **dots)
    reach.plot(h * found.frequency, h * found.decay, **dots)
    reach.axline((0, 0), slope=1, color="0.6", linestyle="--", linewidth=1, label="critical damping")
    for ax, left, bottom, names in (
        (plane, -3.6, -3.2, ("real part of h \u03bb", "imaginary part of h \u03bb")),
        (reach, 0, 0, ("h \u03c9, step times frequency", "h d, step times decay")),
    ):
        ax.set(xlim=(left, left + 4.2), ylim=(bottom, 3.2), xlabel=names[0], ylabel=names[1], aspect="equal")
    _legend(reach)
    reach.set_xlim(0, 3.2)
    plane.set_title(f"h = {h:.4g} s")
    return axes


@takes()
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
        ("needed", COLOURS[1], rows["needed"]),
        ("not needed, and left out", COLOURS[2], ~rows["needed"] & rows["left_out"]),
        ("not needed, but kept", "0.7", ~rows["needed"] & ~rows["left_out"]),
    ):
        if which.any():
            ax.barh(place[which], length[which], color=color, label=label)
    ax.axvline(found.want, color="0.2", linestyle="--", linewidth=1, label="wanted")
    ax.set(xscale="log", xlim=(low, high), xlabel="change of the watched positions [m]")
    ax.set_yticks(place, list(rows["without"]))
    _legend(ax)
    return ax


@takes()
def flow(rate: Any, *results: Result, box: tuple[float, float, float, float], ax: Axes | None = None) -> Axes:
    """Draws the flow x' = phi(t, x) of two components at t = 0 as arrows of one length in `box`, (left, right, low, high), and
    the frames of results of it as marked lines."""
    ax = _new_axes() if ax is None else ax
    left, right, low, high = box
    place = np.stack(np.meshgrid(np.linspace(left, right, 20), np.linspace(low, high, 14)))
    speed = np.zeros_like(place)
    for i, j in np.ndindex(*place.shape[1:]):
        rate(0.0, place[:, i, j], speed[:, i, j])
    size = np.hypot(*speed)
    ax.quiver(*place, *speed / np.where(size > 0, size, 1), color="0.7", angles="xy")
    for number, result in enumerate(results):
        frames = result.frames
        if frames is None:
            raise BadValue("results: a result without frames; give run() frames=True")
        label = "{method}, {step:g} s".format(**result.options) if result.options["step"] else str(result.options["method"])
        ax.plot(*frames.q.T, label=label, **_style(number))
    ax.set(xlim=(left, right), ylim=(low, high), xlabel="x", ylabel="y", aspect="equal")
    if results:
        ax.legend(fontsize="small")
    return ax


_MARKERS = "osD^v<>PX*"


def _style(number: int, **options: Any) -> dict[str, Any]:
    """The look of a line: a colour and a mark, which together tell 70 apart, and dashes from the eighth on."""
    dashes = ("-", "--", ":", "-.")[number // len(COLOURS) % 4]
    marker = _MARKERS[number % len(_MARKERS)]
    return {"color": COLOURS[number % len(COLOURS)], "linestyle": dashes, "marker": marker, "markersize": 4, **options}


def _legend(ax: Any, lines: Iterable[Any] = ()) -> None:
    """Beside the axes in a figure of this module, which makes room for it, within them in others; with `lines` of others."""
    beside = {"loc": "upper left", "bbox_to_anchor": (1.01, 1), "borderaxespad": 0}
    handles = [*ax.get_legend_handles_labels()[0], *lines]
    ax.legend(handles=handles, fontsize="small", frameon=False, **(beside if ax.figure.get_layout_engine() is not None else {}))


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
    ax.plot(x, height, transform=ax.get_xaxis_transform(), **{**style, "linestyle": "", "marker": "x"})


def _frame(source: Source, run: str, frame: int) -> tuple[Table, Table, float | None, System | None]:
    if isinstance(source, Scene):
        source = source.system
    if isinstance(source, System):
        state = source.state()
        return state.q, source.spring_ends, None, source
    if isinstance(source, Result):
        return source.state.q, source.system.spring_ends, source.state.t, source.system
    if isinstance(source, Trajectory):
        return source[frame].q, source.springs, source[frame].t, None if source.scene is None else source.system
    if not isinstance(source, (str, os.PathLike)):
        return (*source, None, None)
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
        system = Scene.load(source).system if "scene" in file.get("hooke", ()) else None
        return position["value"][number], file["connectivity/springs"][:], float(position["time"][number]), system


def _two_axes(**options: Any) -> Any:
    import matplotlib.pyplot as plt

    return plt.subplots(1, 2, figsize=(10, 4.5), layout="constrained", **options)[1]


def _new_axes(**options: Any) -> Any:
    import matplotlib.pyplot as plt

    return plt.figure(layout="constrained").add_subplot(**options)


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
        name(f"{'xyz'[axis]} [m]", labelpad=17)
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
    most = max(float((high - low).max()), 1e-9)
    middle, size = (low + high) / 2, np.maximum(1.04 * (high - low), 0.3 * most)  # numbers stand apart, also on short axes
    ax.set(**{f"{name}lim": limits for name, *limits in zip("xyz", middle - size / 2, middle + size / 2)})
    ax.set_box_aspect((*size,), zoom=0.75)
    for axis, share in zip((ax.xaxis, ax.yaxis, ax.zaxis), size / most):
        axis.set_major_locator(MaxNLocator(max(1, round(5 * float(share))), min_n_ticks=1))


def _text(value: Any) -> str:
    return value.decode("utf-8", "replace").rstrip("\0") if isinstance(value, bytes) else str(value)
