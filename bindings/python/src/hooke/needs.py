"""Needs: the ingredients of a scene that a wanted accuracy requires, and its resolution."""

from __future__ import annotations

from typing import Any

import numpy as np

from ._keywords import NeedsKeywords
from ._library import lib
from ._look import WorkProgress, draw
from ._measurement import Measurement, Paged, Record
from ._memory import Closing, Handle, double_pointer, rows
from ._signature import Unpack, takes
from ._status import BadCall
from ._types import FloatArray, Path
from .options import Options
from .results import Length, Runnable, measured
from .system import System, write_scene

__all__ = ["Needs", "needs"]


class RunCost(Record, table="needs.full", without=("own_error", "moved")):
    """The cost of a run; NaN where a number does not apply."""


class Needs(Paged, Closing, kind="needs"):
    """The needs of a scene for watched positions within `want` [m].

    `rows` is a structured array with one row for everything that was left out in turn; its `needed` is True also where
    it is unknown, as `note` says. `full` is the cost of the full system with a step error of a tenth of the wanted
    error, and `own_error` [m] the possible error of its finer run, which all variants are compared with.

    `lean_cost` is the cost of the lean system's recommended run, and `lean_error` [m] a bound on its error against
    the full system, including `own_error`. `cheapest` is the cost of the full system's own run within the wanted
    error, by the same method, `cheapest_error` its error, and `times_less` its wall time over that of the lean one;
    `other_method` is one that runs the full system within the wanted error in clearly less time, `other_seconds` [s].
    None and NaN if there are none. `lean_note` names parts that are rigid bodies in the lean system, with its steps and
    those of the full one, and groups of parts that it has spring by spring.

    `moved` [m] is the motion of the watched particles from their start; both notes are "" where there is nothing to
    say. `parts` is a structured array with one row a part, after ``refine=True``: how it changes with its resolution.
    `outcome` is "finished", or "stopped" if the progress function asked for it.
    """

    def _read(self, found: Measurement) -> None:
        kinds = self.rows.dtype
        kinds = np.dtype([(name, bool if name == "needed" else kinds[name]) for name in kinds.names or ()])
        self.rows = self.rows.astype(kinds)  # needed, if that is unknown
        self.rows.flags.writeable = False
        self.parts = found.rows("parts")
        self.full = found.each(RunCost, "full")[0]
        self.lean_cost, self.cheapest = (found.one(RunCost, table) for table in ("lean", "cheapest"))
        self.own_error, self.moved = (found.number("full", 0, name) for name in ("own_error", "moved"))
        self.times_less, self.other_seconds = (found.number("lean", 0, name) for name in ("times_less", "other_seconds"))
        self.other_method = found.text("lean", 0, "other_method") or None
        self.lean_error, self.cheapest_error = (found.number(table, 0, "error") for table in ("lean", "cheapest"))
        self.lean_note = found.text("lean", 0, "note")

    @property
    def left_out(self) -> list[str]:
        """The ingredients that the lean system lacks."""
        return [str(name) for name in self.rows["without"][self.rows["left_out"]]]

    @property
    def lean(self) -> System | None:
        """The lean system, committed; a copy of the full one if all is needed, None if it was not found."""
        if self.lean_cost is None:
            return None
        handle = Handle(lib.hooke_needs_lean(self._handle.handle), None, self._handle.handle)
        return System._committed_by(handle, self._system._callbacks)

    @property
    def lean_options(self) -> dict[str, Any]:
        """Its run: ``hooke.run(found.lean, **found.lean_options)``; {} if there is none."""
        run = self._lean_run()
        return {} if run is None else {name: run[name] for name in run if run.is_set(name)}

    def _lean_run(self) -> Options | None:
        if self.lean_cost is None:
            return None
        handle = self._handle.handle
        return Options(Handle(lib.hooke_needs_lean_run(handle), None, handle), read_only=True)

    def save_lean(self, path: Path) -> None:
        """Writes the lean system and its run as a scene file."""
        run, lean = self._lean_run(), self.lean
        if run is None or lean is None:
            raise BadCall("there is no lean system: it was not looked for, or the work was stopped before")
        write_scene(path, lean, self._scene.title if self._scene is not None else "", run)

    def lean_position(self, q: Any) -> FloatArray:
        """Positions (n, 3) [m] of the particles of the full system at positions `q` of the lean one: those of the
        same material points, NaN where they were left out."""
        lean = self.lean
        q = rows(q, "q", lean.particle_count if lean is not None else 0)
        position = np.empty((self._system.particle_count, 3))
        lib.hooke_needs_lean_position(self._handle.handle, double_pointer(q), double_pointer(position))
        return position

    def plot(self, ax: Any = None, **options: Any) -> Any:
        """Draws the change of the scene by each ingredient; see `hooke.plot.needs`."""
        return draw("plot.needs", self, ax=ax, **options)

    def __repr__(self) -> str:
        if self.parts.size:
            return f"Needs({self.outcome}, want={self.want!r}, {len(self.parts)} parts)"
        return f"Needs({self.outcome}, want={self.want!r}, {len(self.rows)} rows, {len(self.left_out)} left out)"


@takes(NeedsKeywords)
def needs(
    problem: Runnable,
    want: Length,
    watch: Any = None,
    *,
    progress: WorkProgress | bool | None = None,
    **options: Unpack[NeedsKeywords],
) -> Needs:
    """Leaves out of a scene (or the path of one) or a system one ingredient after another, and finds the change of
    the watched positions and the savings; then leaves out together everything that is not needed for errors of at
    most `want` [m], or within a list as of ``hooke.run``, and checks the lean system against the full one.

    `watch` is the name of a part or of a group, or particle numbers; None: all free particles. Steps and
    tolerances are found. ``refine=True`` does the reverse: it runs each part at once, twice and four times its
    resolution, and finds the resolution for the wanted error. Where `progress` stops it, there are the results so far.
    ``found.write("page.html")`` makes a page with diagrams.
    """
    watch = watch if watch is None or isinstance(watch, str) else np.ravel(watch)
    return Needs(*measured("needs", problem, {**options, "want": want, "watch": watch}, progress))
