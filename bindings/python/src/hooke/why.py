"""Diagnosis of a run that blew up: cause, place and suggestions."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from ._library import lib
from ._look import WorkProgress
from ._measurement import Measurement, Paged
from ._memory import Handle, text
from ._status import Stopped, plain
from .options import Options
from .problems import Problem

__all__ = ["Why"]


class Blame(NamedTuple):
    """A limiting spring: its number, its ends, its group ("" if that has no name), and its share of the whole (NaN if
    unknown). Or, before springs, a `force` that has half of the whole or more: "drag", "damping", "bending",
    "altitude" or "geometric" (gravity and tensions that turn rigid bodies); then there is no spring, and its number
    and ends are -1."""

    spring: int
    ends: tuple[int, int]
    group: str
    share: float
    force: str = ""

    @classmethod
    def read(cls, measurement: Measurement) -> list[Blame]:
        """The table "blame"."""
        return [
            cls(_whole(number), (_whole(first), _whole(second)), group, share, force)
            for number, first, second, group, share, force in measurement.rows("blame").tolist()
        ]

    def __str__(self) -> str:
        place = self.force or f"spring {self.spring}, between particles {self.ends[0]} and {self.ends[1]}"
        return place + (f", group {plain(self.group)}" if self.group else "")


class Advice(NamedTuple):
    """A change in words, and the options of a run that make it, for ``hooke.run(scene, **options)``; {} if the scene
    has to change."""

    change: str
    options: dict[str, Any]


class Why(Paged, kind="why", rows="advice"):
    """The diagnosis of a run that ended early; NaN where a number does not apply, None for `particle`.

    `blame` has the limiting springs, the largest share first, `advice` the suggestions, the best first. A page takes the
    steps around the trouble again, so that callbacks are called again.
    """

    sentence: str

    _untitled = "a run that blew up"

    def __init__(
        self, run: Handle, problem: Problem, title: str, budget: float | str | None, progress: WorkProgress | bool | None
    ):
        chosen = Options.for_why().set(budget=budget)
        found = Measurement.made(run, lib.hooke_why_create, run, chosen._handle)
        if found.run(progress):
            raise Stopped(text(lib.hooke_last_error()))
        super().__init__(found, None, problem, 0)
        self._untitled = title or self._untitled

    def _read(self, found: Measurement) -> None:
        particle = found.number("why", 0, "particle")
        self.particle: int | None = None if math.isnan(particle) else int(particle)
        self.blame = Blame.read(found)
        self.advice = [_advice(found, row) for row in range(found.count("advice"))]

    def __repr__(self) -> str:
        return f"Why({self.cause}, t={self.time!r}, {self.method})"


def _whole(number: float) -> int:
    return -1 if math.isnan(number) else int(number)


def _advice(found: Measurement, row: int) -> Advice:
    changes = Options.for_run()
    lib.hooke_why_advice_apply(found.handle, row, changes._handle)
    options = {name: changes[name] for name in changes if changes.is_set(name)}
    return Advice(found.text("advice", row, "change"), options)
