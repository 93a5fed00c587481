"""Modes: frequencies, damping ratios and shapes of the small motions about a state."""

from __future__ import annotations

import numpy as np

from ._keywords import ModesKeywords
from ._look import WorkProgress
from ._measurement import Measurement, Paged
from ._signature import Unpack, takes
from ._types import FloatArray
from .limit import Place, state_at
from .results import Runnable, measured

__all__ = ["Modes", "modes"]


class Modes(Paged, kind="modes"):
    """The lowest modes of a scene that have stiffness, about the positions of a state.

    `rows` is a structured array with one row a mode, the lowest first: those that grow, then by frequency. `shapes`
    (k, n, 3) are their displacements, the largest of each of length 1, and `shares` (k, groups) the parts that the groups
    of springs, named in `groups`, have in their stiffness.
    """

    _untitled = "modes"

    def _read(self, found: Measurement) -> None:
        shapes = [found.series("rows", row, "shape") for row in range(len(self.rows))]
        self.shapes: FloatArray = np.array([np.reshape(shape, (-1, 3)) for shape in shapes if shape is not None])
        groups = found.rows("groups")
        each = len(groups) // max(1, len(self.rows))
        self.groups = [str(name) for name in groups["name"][:each]]
        self.shares: FloatArray = groups["share"].reshape(-1, max(1, each))

    def __repr__(self) -> str:
        return f"Modes({len(self.rows)} modes)"


@takes(ModesKeywords)
def modes(
    problem: Runnable, at: Place | None = None, count: int | None = None, *, progress: WorkProgress | bool | None = None,
    **options: Unpack[ModesKeywords],
) -> Modes:
    """Finds the `count` (6) lowest modes of a scene (or the path of one) or a system `at` a state, as in `hooke.limit`: at
    the start, if None. Modes without stiffness are counted and named (`zero_modes`, `translations`, `rotations`,
    `mechanisms`), and not among them. The stiffness is that of the state as it is, compressed springs and slack ones
    included; `residual` [N] is the force that is left there."""
    return Modes(*measured("modes", problem, {**options, "count": count}, progress, lambda system: state_at(system, at)))
