"""Costs: time, memory and stable step of each ingredient of one scene on this machine; and what can be told of a scene
without running it."""

from __future__ import annotations

from ._keywords import CheckKeywords, CostKeywords
from ._look import WorkProgress
from ._measurement import Found, Measurement
from ._signature import Unpack, takes
from .results import Runnable, measured
from .state import State

__all__ = ["Check", "Cost", "check", "cost"]


class Cost(Found, kind="cost"):
    """The cost of a scene, as a whole and by ingredients.

    `rows` is a structured array with one row an ingredient, whose column "ingredient" is called "name" here; `outcome` is
    "finished" or "stopped".
    """

    def _read(self, found: Measurement) -> None:
        self.rows.dtype.names = tuple("name" if name == "ingredient" else name for name in self.rows.dtype.names or ())

    def __repr__(self) -> str:
        return f"Cost({self.outcome}, {self.method}, {len(self.rows)} ingredients)"


@takes(CostKeywords)
def cost(
    problem: Runnable,
    state: State | None = None,
    *,
    progress: WorkProgress | bool | None = None,
    **options: Unpack[CostKeywords],
) -> Cost:
    """Measures the cost of each ingredient of a scene (or the path of one) or of a system: compares it with the same
    scene without the ingredient, at `state` (at the start, if None).

    ``predict=True`` skips the timing. Of many groups the `groups` largest are measured; the numbers of the others stay NaN.
    """
    return Cost(*measured("cost", problem, options, progress, lambda _: state))


class Check(Found, kind="check", rows="step_limit"):
    """What can be told of a scene without running it; `claims` begin with its warnings. `rows` is a structured array with one
    row a method."""

    def __repr__(self) -> str:
        return f"Check({self.particles} particles, {self.springs} springs)"


@takes(CheckKeywords)
def check(problem: Runnable, state: State | None = None, **options: Unpack[CheckKeywords]) -> Check:
    """Checks a scene (or the path of one) or a system at `state` (at the start, if None): what it has, the step up to which
    each method is certain to be stable, the memory of a run, and what is seldom meant in it. A step, `every` and duration are
    chosen and adjusted as `hooke.run` does."""
    return Check(*measured("check", problem, options, None, lambda _: state))
