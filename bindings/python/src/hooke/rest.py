"""Rest: where the forces of a scene are in equilibrium."""

from __future__ import annotations

from ._keywords import RestKeywords
from ._look import WorkProgress
from ._measurement import Measurement, Paged
from ._signature import Unpack, takes
from ._types import FloatArray
from .limit import Place, state_at
from .problems import Problem
from .results import Runnable, measured

__all__ = ["Rest", "rest"]


class Rest(Paged, kind="rest", rows="watched"):
    """The position of rest of a scene: `position` (n, 3) [m] is there, or where the search ended; `status` says which.
    `rows` is a structured array with one row a watched quantity, and `watched` has their values by name."""

    _untitled = "rest"

    def _read(self, found: Measurement) -> None:
        position = found.series("rest", 0, "position")
        self.position: FloatArray | None = None if position is None else position.reshape(-1, 3)
        self.watched: dict[str, float] = {str(row["quantity"]): float(row["value"]) for row in self.rows}

    def __repr__(self) -> str:
        return f"Rest({self.status}, residual {self.residual:.3g} N)"


def rest(
    problem: Runnable,
    at: Place | None = None,
    *,
    progress: WorkProgress | bool | None = None,
    **options: Unpack[RestKeywords],
) -> Rest:
    """Finds where a scene (or the path of one) or a system is at rest, from `at` (the start, if None), a place as
    `hooke.limit` has it. `watch` names quantities.
    """
    return Rest(*measured("rest", problem, options, progress, lambda system: state_at(system, at)))


rest = Problem.rest = takes(RestKeywords)(rest)
