"""Diagnosis of a run that blew up: cause, place and suggestions."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from ._library import lib
from ._measurement import Measurement, typed
from ._memory import Handle, text
from ._notebook import embed
from ._problem import Problem
from ._progress import WorkProgress
from ._status import NotBuilt, Stopped, plain
from ._types import Path
from .options import Options


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


class Why:
    """The diagnosis of a run that ended early.

    `cause` is "step-above-limit", "never-stable", "collapsed-spring", "force-not-finite", "solver-failed",
    "overflow", "model-gains-energy" or "unknown"; `sentence` states the cause with place and time. `time` [s] is that
    of the last step within all bounds, `noticed` [s] when the run came to notice, `step` [s] and `limit` [s] the step
    and the largest stable one, `particle` the one concerned (None if none is); NaN where a number does not apply.
    `blame` has the limiting springs, the largest share first, `advice` the suggestions, the best first. `left_out`
    lists the checks that did not fit the time or memory.
    """

    cause: str
    sentence: str
    method: str
    left_out: str
    time: float
    noticed: float
    step: float
    limit: float
    particle: int | None

    def __init__(
        self, run: Handle, problem: Problem, title: str, budget: float | None, progress: WorkProgress | bool | None
    ):
        chosen = Options.for_why().set(budget=budget)
        self._problem = problem  # its callbacks are called by the library
        self._title = title
        self._found = found = Measurement.made(run, lib.hooke_why_create, run, chosen._handle)
        if found.run(progress):
            raise Stopped(text(lib.hooke_last_error()))
        vars(self).update(typed(Why, found.record("why") or {}))
        self.blame = Blame.read(found)
        self.advice = [_advice(found, row) for row in range(found.count("advice"))]

    def write(self, path: Path, title: str | None = None) -> None:
        """Writes what was found by the ending of `path`: .html, the page of ``hooke why --report`` with `title` over it
        (that of the scene, if None), for which the steps around the trouble are taken again, so that callbacks are
        called again; .json or .h5, the tables."""
        self._found.write(path, title=title or self._title or "a run that blew up")

    def report(self, path: Path) -> Path:
        """Writes the page to look at, offline, to a path that ends in ``.html``, and returns the path."""
        self.write(path)
        return path

    def _repr_html_(self) -> str | None:
        try:
            return embed(self.write, 720)
        except NotBuilt:
            return None

    def __repr__(self) -> str:
        return f"Why({self.cause}, t={self.time!r}, {self.method})"

    def __str__(self) -> str:
        sentences = [self.sentence, *([self.left_out] if self.left_out else [])]
        return "\n".join([*sentences, *(f"- {one.change} {one.options or ''}".rstrip() for one in self.advice)])


def _whole(number: float) -> int:
    return -1 if math.isnan(number) else int(number)


def _advice(found: Measurement, row: int) -> Advice:
    changes = Options.for_run()
    lib.hooke_why_advice_apply(found.handle, row, changes._handle)
    options = {name: changes[name] for name in changes if changes.is_set(name)}
    return Advice(found.text("advice", row, "change"), options)
