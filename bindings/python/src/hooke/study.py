"""Studies: how accurate each method is for what it costs on one scene, and which one to take."""

from __future__ import annotations

import ctypes
import os
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from ._callback import listening
from ._closing import Closing
from ._library import lib
from ._memory import Handle, address_of, text, view
from ._prototypes import STUDY
from ._status import OUTCOMES
from ._tables import read_rows
from ._types import BoolArray, FloatArray, Path, StrArray, Table
from .options import Options
from .results import Runnable, WorkProgress, prepare
from .scene import Scene, scene_text
from .system import Force, System

_TEXTS = ("method", "status")
_FLAGS = ("near_floor", "near_energy_floor", "timed_alone")
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
    "linear_iterations",
    "wall_seconds",
    "wall_median",
    "repeats",
)
_ROW = np.dtype(
    [(name, "U32") for name in _TEXTS]
    + [(name, float) for name in _NUMBERS]
    + [(name, bool) for name in _FLAGS]
)


class Reference(NamedTuple):
    """What the errors are measured against: the two integrators that made it, which share only the force;
    how far they are apart at most [m], the floor of all errors; the time until which they agree [s], up to
    which errors are judged; and how much a small displacement of the start grows at most, true with
    `growth_probability`, both NaN where that is not known. `growth_seen` is the most that one of
    `displacements` displacements grew. `energy_agreement` [J] is the floor of energy drift. `ended` says why it
    was made no better: "agreed", "time" (the budget), or "rounding"."""

    methods: tuple[str, str]
    agreement: float
    trusted_until: float
    growth: float
    growth_probability: float
    growth_seen: float
    displacements: int
    energy_agreement: float
    ended: str


class Order(NamedTuple):
    """The order that a fixed-step method showed, its 95 % interval, the theory's, and why they may differ."""

    order: float
    low: float
    high: float
    theory: float
    note: str


class Series(NamedTuple):
    """One row over the frames that are judged, each (k,): time [s], error [m], energy_drift [J]."""

    time: FloatArray
    error: FloatArray
    energy_drift: FloatArray


class Margin(NamedTuple):
    """What a recommendation has to spare: its error, less and plus the agreement of the reference [m]; its step
    over the largest stable one at the start (NaN: none, or unknown); and the error where stiffness is 10 %
    more or less, or where all particles start with a tenth of the largest speed more or less along (1, 1, 1),
    and whether that is still what is wanted. NaN, and None, where it is not known."""

    error_low: float
    error_high: float
    limit_share: float
    error_stiffness: float
    holds_stiffness: bool | None
    error_start: float
    holds_start: bool | None


class Statistic(NamedTuple):
    """What an ensemble of displaced runs by one method, or by that of the reference, has of one quantity: at
    which step [s] or rtol it ran, how many runs have the quantity (`members`) and how many did not come to
    their end (`failed`), the mean of the runs, their standard deviation (`spread`), and `bias`: the difference
    from the reference's mean in standard errors of it (below 2 in size none is seen; NaN for the reference)."""

    step: float
    rtol: float
    members: float
    failed: float
    mean: float
    spread: float
    bias: float


class Recommendation(NamedTuple):
    """The cheapest run that was seen to meet `want` [m]; if `met` is False, the one that came closest, and
    `note` says what is in the way. Numbers that do not apply are NaN."""

    met: bool
    want: float
    method: str
    step: float
    rtol: float
    atol: float
    error: float
    wall_seconds: float
    force_evaluations: float
    note: str
    margin: Margin

    @property
    def options(self) -> dict[str, Any]:
        """What to give to `hooke.run` to have it."""
        numbers = {name: getattr(self, name) for name in ("step", "rtol", "atol")}
        options: dict[str, Any] = {"method": self.method} if self.method else {}
        options.update({name: number for name, number in numbers.items() if not np.isnan(number)})
        if "atol" in options:
            options["atol_velocity"] = options["atol"]
        return options


class Study(Closing):
    """A study that was made: one row a method and step or tolerance, the coarsest first.

    Each column is an array with one entry a row: method, status ("finished", "diverged", "stopped",
    "failed"), step [s], rtol, atol [m], error (largest root mean square over the free particles [m]),
    error_max [m], error_final [m], energy_drift [J], force_evaluations, steps, linear_iterations,
    wall_seconds (the least of `repeats` runs) and wall_median [s]; near_floor (the error is within ten times
    of what the reference is known to), near_energy_floor (likewise of energy_drift), timed_alone. NaN where a
    number does not apply. `rows` holds them all as one structured array.

    `outcome` is "finished", or "stopped" if the progress function asked for it; `budget_spent` says that
    rows are missing for lack of time. `orders` has an `Order` for each fixed-step method.

    `watched` has for each watched quantity an array of its errors, one a row, in its unit; `agreement` to
    how much the reference is known in it. `statistics`, empty unless an ensemble was asked for and the
    reference is not trusted to the end, has for each quantity ("kinetic", "potential", "energy" and what is
    watched) a `Statistic` for "reference" and for each method.
    """

    outcome: str
    budget_spent: bool
    duration: float
    reference: Reference
    rows: Table
    orders: dict[str, Order]
    watched: dict[str, FloatArray]
    agreement: dict[str, float]
    statistics: dict[str, dict[str, Statistic]]

    method: StrArray
    status: StrArray
    step: FloatArray
    rtol: FloatArray
    atol: FloatArray
    error: FloatArray
    error_max: FloatArray
    error_final: FloatArray
    energy_drift: FloatArray
    force_evaluations: FloatArray
    steps: FloatArray
    linear_iterations: FloatArray
    wall_seconds: FloatArray
    wall_median: FloatArray
    repeats: FloatArray
    near_floor: BoolArray
    near_energy_floor: BoolArray
    timed_alone: BoolArray

    def __init__(
        self, handle: Handle, scene: Scene | None, system: System, status: int, progress: WorkProgress | bool | None
    ):
        self._handle = handle
        self._scene = scene
        self._system = system  # its callbacks have to live as long as the study
        self._status = status
        self._progress = progress
        self.outcome = OUTCOMES.get(status, "stopped")
        count = lib.hooke_study_row_count(handle)
        self.rows = read_rows(handle, count, _ROW, lib.hooke_study_text, lib.hooke_study_number)
        for name in _ROW.names or ():
            setattr(self, name, self.rows[name])
        figure = {what: lib.hooke_study_figure(handle, what.encode()) for what in _FIGURES}
        names = [text(lib.hooke_study_reference(handle, what)) for what in (b"method", b"check")]
        self.reference = Reference(
            (names[0], names[1]),
            agreement=figure["agreement"],
            trusted_until=figure["trusted_until"],
            growth=figure["growth"],
            growth_probability=figure["growth_probability"],
            growth_seen=figure["growth_seen"],
            displacements=int(np.nan_to_num(figure["displacements"])),
            energy_agreement=figure["energy_agreement"],
            ended=text(lib.hooke_study_reference(handle, b"ended")),
        )
        self.duration = figure["duration"]
        self.budget_spent = bool(figure["budget_spent"])
        self.orders = _read_orders(handle, self.methods)
        names = _read_quantities(handle, "watched", "watched")
        self.watched = {name: _read_errors(handle, count, name) for name in names}
        self.agreement = {name: lib.hooke_study_figure(handle, f"agreement:{name}".encode()) for name in names}
        self.statistics = {
            name: _read_statistics(handle, self.methods, name)
            for name in _read_quantities(handle, "quantities", "quantity")
        }

    @property
    def methods(self) -> list[str]:
        """The methods that have rows, in the order of the rows."""
        return [str(name) for name in dict.fromkeys(self.rows["method"])]

    @property
    def recommendation(self) -> Recommendation | None:
        """The latest recommendation; None if there was no `want`."""
        if lib.hooke_study_recommendation_text(self._handle, b"note") is None:
            return None

        def number(what: str) -> float:
            return float(lib.hooke_study_recommendation_number(self._handle, what.encode()))

        def word(what: str) -> str:
            return text(lib.hooke_study_recommendation_text(self._handle, what.encode()))

        def flag(what: str) -> bool | None:
            value = number(what)
            return None if np.isnan(value) else bool(value)

        names = ("step", "rtol", "atol", "error", "wall_seconds", "force_evaluations")
        numbers = {name: number(name) for name in names}
        margin = Margin(
            number("error_low"),
            number("error_high"),
            number("limit_share"),
            number("error_stiffness"),
            flag("holds_stiffness"),
            number("error_start"),
            flag("holds_start"),
        )
        return Recommendation(
            met=bool(number("met")),
            want=number("want"),
            method=word("method"),
            note=word("note"),
            margin=margin,
            **numbers,
        )

    def recommend(self, want: float) -> Recommendation:
        """Finds the cheapest step or tolerance whose error is at most `want` [m], by running it."""
        with listening(lib.hooke_study_on_progress, self._handle, self._progress):
            lib.hooke_study_recommend(self._handle, want)
        found = self.recommendation
        assert found is not None
        return found

    def series(self, row: int) -> Series:
        """Error and energy drift of a row over the frames that are judged; NaN past the end of a run that
        diverged."""
        row = range(len(self.rows))[row]
        count = lib.hooke_study_frame_count(self._handle)
        arrays = []
        for what in Series._fields:
            pointer = lib.hooke_study_series(self._handle, row, what.encode())
            arrays.append(view(address_of(pointer), (count,)).copy() if pointer else np.full(count, np.nan))
        return Series(*arrays)

    def write(self, path: Path) -> None:
        """Writes the rows as a table to a path that ends in ``.csv``, or the whole study to an HDF5 file
        (docs/study.md), which `hooke.plot.study` draws."""
        name = os.fsencode(path)
        if name.endswith(b".csv"):
            lib.hooke_study_write_csv(self._handle, name)
        else:
            lib.hooke_study_write_h5(self._handle, name, scene_text(self._scene), self._status)

    def plot(self, axes: Any = None, **options: Any) -> Any:
        """Draws error against cost and error against step; see `hooke.plot.study`."""
        from .plot import study as draw

        return draw(self, axes, **options)

    def __str__(self) -> str:
        columns = ("step", "rtol", "error", "force_evaluations", "wall_seconds")
        lines = [f"{'method':18}{'status':>10}" + "".join(f"{name:>19}" for name in columns)]
        for row in self.rows:
            numbers = "".join(f"{row[name]:>19.4g}" for name in columns)
            lines.append(f"{row['method']:18}{row['status']:>10}{numbers}")
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"Study({self.outcome}, {len(self.rows)} rows of {len(self.methods)} methods)"


_FIGURES = (
    "agreement",
    "trusted_until",
    "growth",
    "growth_probability",
    "growth_seen",
    "displacements",
    "energy_agreement",
    "duration",
    "budget_spent",
)


def study(
    problem: Runnable,
    methods: str | Iterable[str] | None = None,
    *,
    want: float | None = None,
    budget: float | None = None,
    points: int | None = None,
    steps: Any = None,
    tolerances: Any = None,
    watch: str | Iterable[str] | None = None,
    ensemble: int | None = None,
    seed: int | None = None,
    output: Path | None = None,
    force: Force | None = None,
    progress: WorkProgress | bool | None = None,
    **options: Any,
) -> Study:
    """Runs a scene (or the path of one) or a system by each of `methods` (all that this build has, if None)
    over a ladder of steps or tolerances, judges every run by a reference that checks itself, and returns the
    `Study`.

    `points` rows a method; `steps` [s] and `tolerances` are ladders of your own, from coarse to fine. `want`
    [m] asks for a recommendation, `budget` [s] limits the time. `watch` names quantities whose errors are
    told, too: "57.y" (a particle), "part:0.y", "group:3.length", ".strain" or ".tension" (a spring), "energy",
    "kinetic", "potential", "period:57.y". `ensemble` is the number of displaced starts, by noise from `seed`,
    of which means and spreads are told where the motion is too chaotic to be judged. `output` is a file to write (see
    `Study.write`), `force` adds a force callback, ``progress(fraction, what)`` is told of progress
    (``progress=True`` shows a bar, with tqdm) and stops
    the study by returning a number other than 0. The keywords `options` are those of a run: duration [s],
    every [s], threads, ... ``hooke study --report FILE.html`` makes a page with diagrams of the same study.
    """
    scene, system, run = prepare("study", problem, force, options)
    if methods is not None and not isinstance(methods, str):
        methods = ",".join(methods)
    if watch is not None and not isinstance(watch, str):
        watch = ",".join(watch)
    chosen = Options.for_study().set(
        methods=methods,
        want=want,
        budget=budget,
        points=points,
        steps=steps,
        tolerances=tolerances,
        watch=watch,
        ensemble=ensemble,
        seed=seed,
    )
    pointer = STUDY()
    lib.hooke_study_create(system._committed(), run._handle, chosen._handle, ctypes.byref(pointer))
    handle = Handle(pointer, lib.hooke_study_destroy, system._handle)
    with listening(lib.hooke_study_on_progress, handle, progress):
        status = lib.hooke_study_run(handle)
    made = Study(handle, scene, system, status, progress)
    if output is not None:
        made.write(output)
    return made


def _read_orders(handle: Handle, methods: list[str]) -> dict[str, Order]:
    orders = {}
    for method in methods:
        name = method.encode()
        if lib.hooke_method_is_adaptive(name):
            continue
        numbers = {what: lib.hooke_study_order(handle, name, what.encode()) for what in Order._fields[:-1]}
        orders[method] = Order(note=text(lib.hooke_study_order_note(handle, name)), **numbers)
    return orders


def _read_quantities(handle: Handle, count: str, what: str) -> list[str]:
    number = int(lib.hooke_study_figure(handle, count.encode()))
    return [text(lib.hooke_study_reference(handle, f"{what}:{k}".encode())) for k in range(number)]


def _read_errors(handle: Handle, count: int, quantity: str) -> FloatArray:
    word = f"watched:{quantity}".encode()
    return np.array([lib.hooke_study_number(handle, row, word) for row in range(count)], dtype=float)


def _read_statistics(handle: Handle, methods: list[str], quantity: str) -> dict[str, Statistic]:
    found = {}
    for method in ["reference", *methods]:
        names = (method.encode(), quantity.encode())
        numbers = [lib.hooke_study_statistic(handle, *names, what.encode()) for what in Statistic._fields]
        if not np.isnan(numbers[2]):  # members
            found[method] = Statistic(*numbers)
    return found
