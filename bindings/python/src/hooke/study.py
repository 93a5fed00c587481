"""Studies: accuracy and cost of each method on one scene, and a recommendation."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np

from ._keywords import StudyKeywords
from ._library import lib
from ._look import WorkProgress, draw
from ._measurement import Measurement, Paged, Record, methods_of_rows
from ._memory import Closing
from ._signature import Unpack, takes
from ._status import BadValue
from ._types import FloatArray, Path
from .options import Options
from .results import Length, Runnable, measured
from .system import Force

__all__ = ["Study", "compare", "study"]


class Reference(Record, table="study.reference"):
    """The reference of the errors, made by two runs."""

    @property
    def methods(self) -> tuple[str, str]:
        """The methods of the two, which share only the force, or are both rk4."""
        return self.method, self.check


class Order(Record, table="study.orders"):
    """The observed order of a fixed-step method."""


class Series(NamedTuple):
    """One row over the judged frames, each (k,): time [s], error [m], energy_drift [J]."""

    time: FloatArray
    error: FloatArray
    energy_drift: FloatArray


class Margin(Record, table="study.margin"):
    """The margin of a recommendation. NaN, and None, if unknown."""


class Statistic(Record, table="study.statistics"):
    """Statistics of one quantity over an ensemble of displaced runs by one method, or by that of the reference, whose
    `bias` is NaN."""


class Recommendation(Record, table="study.recommendation", also=("margin",)):
    """The cheapest run that was seen to meet `want` [m], `until` [s]; if `met` is False, the closest one, and `note`
    says why. Numbers that do not apply are NaN. `margin` is its `Margin`."""

    @property
    def options(self) -> dict[str, Any]:
        """The keywords of `hooke.run` for it."""
        numbers = {name: getattr(self, name) for name in ("step", "rtol", "atol", "atol_velocity")}
        options: dict[str, Any] = {"method": self.method} if self.method else {}
        return {**options, **{name: number for name, number in numbers.items() if not np.isnan(number)}}


class Study(Paged, Closing, kind="study"):
    """A finished study: one row a method and step or tolerance, the coarsest first.

    Each column of `rows` is an array with one entry a row, NaN where a number does not apply: ``study.error`` (k,).

    `outcome` is "finished", or "stopped" if the progress function asked for it. `orders` has an `Order` for each
    fixed-step method.

    `watched` has for each watched quantity an array of its errors, one a row, in its unit, `at_end` of its values at
    the last frame that the reference is trusted at; `agreement` is the accuracy of the reference in it. `statistics`,
    empty unless an ensemble was requested and the reference is not trusted to the end, has for each quantity
    ("kinetic", "potential", "energy" and the watched ones) a `Statistic` for "reference" and for each method.
    """

    _progress: Any = None
    unit: str  #: that of its errors: "m", or "" where they are in the units of a problem's numbers

    def _read(self, found: Measurement) -> None:
        vars(self).update((name, self.rows[name]) for name in self.rows.dtype.names or ())
        self.unit = found.unit("rows", "error")
        self.reference = found.each(Reference, "reference")[0]
        self.orders = {
            order.method: order
            for order in found.each(Order, "orders")
            if order.method in self.method and not lib.hooke_method_is_adaptive(order.method.encode())
        }
        watched, errors = found.rows("watched"), found.rows("watched_errors")
        self.watched, self.at_end = (
            {str(name): errors[what][errors["quantity"] == name] for name in watched["quantity"]}
            for what in ("error", "at_end")
        )
        self.agreement: dict[str, float] = dict(watched[["quantity", "agreement"]].tolist())
        self.statistics: dict[str, dict[str, Statistic]] = {}
        for statistic in found.each(Statistic, "statistics"):
            self.statistics.setdefault(statistic.quantity, {})[statistic.method] = statistic

    methods = methods_of_rows

    @property
    def recommendation(self) -> Recommendation | None:
        """The latest recommendation; None if there was no `want`."""
        margin = self._handle.one(Margin, "margin")
        return self._handle.one(Recommendation, "recommendation", margin=margin)

    def recommend(self, want: Length) -> Recommendation:
        """Recommends the cheapest run found whose error_max is at most `want` [m] ("1mm"), as ``hooke.run(want=...)`` picks
        it among the methods of the study, and measures it. After a list of wants it is a number, by which all bounds of the
        list are multiplied."""
        before = self.recommendation
        listed = before is not None and before.error_unit == "wants"
        wish = want if listed else Options._of("study").set(want=want)["want"]
        if isinstance(wish, str):
            raise BadValue(f"want: {wish!r} is not allowed; " + (
                "the study has a list of wants, and a number that multiplies it is" if listed else "a length is"))
        with self._handle.listening(self._progress):
            lib.hooke_study_recommend(self._handle.handle, wish)
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
        return draw("plot.study", self, axes=axes, **options)

    def __repr__(self) -> str:
        return f"Study({self.outcome}, {len(self.rows)} rows of {len(self.methods)} methods)"


@takes(StudyKeywords)
def study(
    problem: Runnable,
    methods: str | Iterable[str] | None = None,
    *,
    output: Path | None = None,
    force: Force | None = None,
    progress: WorkProgress | bool | None = None,
    **options: Unpack[StudyKeywords],
) -> Study:
    """Runs a scene (or the path of one), a system or a first- or second-order problem by each of `methods` (all that this
    build has, if None) over a ladder of steps or tolerances, judges every run by a reference that checks itself, and returns
    the `Study`.

    `steps` [s] and `tolerances` are ladders of your own, `want` [m] requests a recommendation. `output` is a file to
    write (see `Study.write`), `force` is the callback force of these runs. ``hooke study --report FILE.html`` makes a page
    with diagrams of the same study.
    """
    made = Study(*measured("study", problem, {**options, "methods": methods}, progress, force=force))
    made._progress = progress
    if output is not None:
        made.write(output)
    return made


@takes(StudyKeywords)
def compare(
    problem: Runnable,
    methods: str | Iterable[str] | None = None,
    *,
    output: Path | None = None,
    force: Force | None = None,
    progress: WorkProgress | bool | None = None,
    **options: Unpack[StudyKeywords],
) -> Study:
    """A first look: a `study` with one row a method, run once with the step [s] or the tolerances of the run, against a
    reference that ends where its two runs part. The keywords are those of `study`; an HDF5 file as `output` has
    every motion, too, for which the runs are made again (`hooke.plot.cloth` and `hooke.plot.error` draw it)."""
    options["once"] = True
    return study(problem, methods, output=output, force=force, progress=progress, **options)
