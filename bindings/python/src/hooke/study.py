"""Studies: accuracy and cost of each method on one scene, and a recommendation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from ._closing import Closing
from ._library import lib
from ._measurement import Measurement, Paged
from ._notebook import draw, of_methods
from ._progress import WorkProgress
from ._types import BoolArray, FloatArray, Path, StrArray
from .options import Options, joined
from .results import Runnable, measured
from .scene import Scene
from .system import Force, System


class Reference(NamedTuple):
    """The reference of the errors: the methods of its two runs, which share only the force, or both are rk4; their largest
    distance [m], the floor of all errors; the time until which they agree [s], up to which errors are judged; and a
    bound on the growth of a small displacement of the start, true with `growth_probability`, both NaN if unknown.
    `growth_seen` is the largest growth of `displacements` displacements. `energy_agreement` [J] is the floor of
    energy drift. `ended` says why it was not refined further: "agreed", "time" (the budget), "rounding", "finest"
    (steps of rk4), or "parted" (which ends a first look)."""

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
    """The observed order of a fixed-step method, its 95 % interval, the theoretical order, and reasons for a
    difference."""

    order: float
    low: float
    high: float
    theory: float
    note: str


class Series(NamedTuple):
    """One row over the judged frames, each (k,): time [s], error [m], energy_drift [J]."""

    time: FloatArray
    error: FloatArray
    energy_drift: FloatArray


class Margin(NamedTuple):
    """The margin of a recommendation: its error, minus and plus the agreement of the reference [m]; its step over the
    largest stable one at the start (NaN: none, or unknown); and the error where stiffness is 10 % more or less, or
    where all particles start with a tenth of the largest speed more or less along (1, 1, 1), and whether that still
    meets the wanted error. NaN, and None, if unknown."""

    error_low: float
    error_high: float
    limit_share: float
    error_stiffness: float
    holds_stiffness: bool | None
    error_start: float
    holds_start: bool | None


class Statistic(NamedTuple):
    """Statistics of one quantity over an ensemble of displaced runs by one method, or by that of the reference: its
    step [s] or rtol, the number of runs with the quantity (`members`) and of those that did not finish (`failed`),
    the mean of the runs, their standard deviation (`spread`), and `bias`: the difference from the reference's mean in
    standard errors (none is visible below 2 in size; NaN for the reference)."""

    step: float
    rtol: float
    members: float
    failed: float
    mean: float
    spread: float
    bias: float


class Recommendation(NamedTuple):
    """The cheapest run that was seen to meet `want` [m], `until` [s]; if `met` is False, the closest one, and `note`
    says why. `wall_seconds` is the least of several runs, `wall_median` their median. Numbers that do not apply are
    NaN."""

    met: bool
    want: float
    method: str
    step: float
    rtol: float
    atol: float
    error: float
    until: float
    wall_seconds: float
    wall_median: float
    force_evaluations: float
    note: str
    margin: Margin

    @property
    def options(self) -> dict[str, Any]:
        """The keywords of `hooke.run` for it."""
        numbers = {name: getattr(self, name) for name in ("step", "rtol", "atol")}
        options: dict[str, Any] = {"method": self.method} if self.method else {}
        options.update({name: number for name, number in numbers.items() if not np.isnan(number)})
        if "atol" in options:
            options["atol_velocity"] = options["atol"]
        return options


class Study(Paged, Closing):
    """A finished study: one row a method and step or tolerance, the coarsest first.

    Each column is an array with one entry a row: method, status ("finished", "diverged", "stopped", "failed"), step
    [s], rtol, atol [m], error (largest root mean square over the free particles [m]), error_max (largest distance of one
    [m]), error_final [m], energy_drift [J], force_evaluations, steps, linear_iterations, wall_seconds (the least of
    `repeats` runs) and wall_median [s]; near_floor (the error is within ten times the agreement of the reference),
    near_energy_floor (likewise for energy_drift), timed_alone. NaN where a number does not apply. `rows` holds them all as one
    structured array.

    `outcome` is "finished", or "stopped" if the progress function asked for it; `budget_spent` says that rows are
    missing for lack of time. `orders` has an `Order` for each fixed-step method.

    `watched` has for each watched quantity an array of its errors, one a row, in its unit; `agreement` is the
    accuracy of the reference in it. `statistics`, empty unless an ensemble was requested and the reference is not
    trusted to the end, has for each quantity ("kinetic", "potential", "energy" and the watched ones) a `Statistic`
    for "reference" and for each method.
    """

    budget_spent: bool
    duration: float
    reference: Reference
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

    def __init__(self, measurement: Measurement, scene: Scene | None, system: System, status: int, progress: Any):
        super().__init__(measurement, scene, system, status)
        self._progress = progress
        vars(self).update((name, self.rows[name]) for name in self.rows.dtype.names or ())
        both = tuple(measurement.text("reference", 0, name) for name in ("method", "check"))
        self.reference = measurement.one(Reference, "reference", methods=both)
        self.orders = {
            method: order
            for method, order in zip(measurement.rows("orders")["method"].tolist(), measurement.each(Order, "orders"))
            if method in self.method and not lib.hooke_method_is_adaptive(method.encode())
        }
        watched, errors = measurement.rows("watched"), measurement.rows("watched_errors")
        self.watched = {str(name): errors["error"][errors["quantity"] == name] for name in watched["quantity"]}
        self.agreement = dict(watched[["quantity", "agreement"]].tolist())
        self.statistics = {}
        found = measurement.rows("statistics")[["quantity", "method"]].tolist()
        for (quantity, method), statistic in zip(found, measurement.each(Statistic, "statistics")):
            self.statistics.setdefault(quantity, {})[method] = statistic

    @property
    def methods(self) -> list[str]:
        """The methods with rows, in the order of the rows."""
        return [str(name) for name in dict.fromkeys(self.rows["method"])]

    @property
    def recommendation(self) -> Recommendation | None:
        """The latest recommendation; None if there was no `want`."""
        margin = self._handle.one(Margin, "margin")
        found: Recommendation | None = self._handle.one(Recommendation, "recommendation", margin=margin)
        return found

    def recommend(self, want: float) -> Recommendation:
        """Recommends the cheapest run found whose error_max is at most `want` [m], as ``hooke.run(want=...)`` picks
        it among the methods of the study, and measures it."""
        with self._handle.listening(self._progress):
            lib.hooke_study_recommend(self._handle.handle, want)
        found = self.recommendation
        assert found is not None
        return found

    def series(self, row: int) -> Series:
        """Error and energy drift of a row over the judged frames; NaN past the end of a run that diverged."""
        row = range(len(self.rows))[row]
        time = self._handle.series("reference", 0, "time")
        assert time is not None
        found = [self._handle.series("rows", row, column) for column in ("error_at", "energy_drift_at")]
        return Series(time, *(np.full(len(time), np.nan) if one is None else one for one in found))

    def write(self, path: Path, title: str | None = None) -> None:
        """Writes the results as `Found.write` does. An HDF5 file of `compare` has the motions, too, of runs that are made
        again for it."""
        with self._handle.listening(self._progress if callable(self._progress) else None):
            super().write(path, title)

    def plot(self, axes: Any = None, **options: Any) -> Any:
        """Draws error against cost and error against step; see `hooke.plot.study`."""
        return draw("plot.study", self, axes, **options)

    def __str__(self) -> str:
        return of_methods(self.rows, "step", "rtol", "error", "force_evaluations", "wall_seconds")

    def __repr__(self) -> str:
        return f"Study({self.outcome}, {len(self.rows)} rows of {len(self.methods)} methods)"


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
    once: bool = False,
    output: Path | None = None,
    force: Force | None = None,
    progress: WorkProgress | bool | None = None,
    **options: Any,
) -> Study:
    """Runs a scene (or the path of one) or a system by each of `methods` (all that this build has, if None) over a
    ladder of steps or tolerances, judges every run by a reference that checks itself, and returns the `Study`.

    `points` rows a method; `steps` [s] and `tolerances` are ladders of your own, from coarse to fine. `want` [m]
    requests a recommendation, `budget` [s] limits the time. `watch` names quantities whose errors are reported, too:
    "57.y" (a particle), "part:0.y", "group:3.length", ".strain" or ".tension" (a spring), "energy", "kinetic",
    "potential", "period:57.y". `ensemble` is the number of starts displaced by noise from `seed`; their means and
    spreads are reported if the motion is too chaotic to be judged. `once` is what `compare` asks for. `output` is a file
    to write (see `Study.write`), `force` is the callback force of these runs, ``progress(fraction, what)`` receives
    progress (``progress=True`` shows a bar, with tqdm) and stops the study by returning a non-zero number. The keywords
    `options` are those of a run: duration [s], every [s], threads, ... ``hooke study --report FILE.html`` makes a page
    with diagrams of the same study.
    """
    chosen = Options.for_study().set(
        methods=joined(methods),
        want=want,
        budget=budget,
        points=points,
        steps=steps,
        tolerances=tolerances,
        watch=joined(watch),
        ensemble=ensemble,
        seed=seed,
        once=once,
    )
    made = Study(*measured("study", problem, options, chosen, progress, force=force), progress)
    if output is not None:
        made.write(output)
    return made


def compare(problem: Runnable, methods: str | Iterable[str] | None = None, **options: Any) -> Study:
    """A first look: a `study` with one row a method, run once with the step [s] or the tolerances of the run, against a
    reference that ends where its two runs part. The keywords are those of `study`; an HDF5 file as `output` has
    every motion, too, for which the runs are made again (`hooke.plot.cloth` and `hooke.plot.error` draw it)."""
    return study(problem, methods, once=True, **options)
