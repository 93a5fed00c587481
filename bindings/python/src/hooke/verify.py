"""Checks that a trajectory reproduces from its scene."""

from __future__ import annotations

import os
from typing import Any

from ._library import lib
from ._measurement import Measurement
from ._progress import WorkProgress
from ._status import BadValue
from .options import Options
from .scene import limits_of


class Verification:
    """The result of verifying a trajectory; true if it reproduces from its scene.

    `verdict` is "agrees" (to the bit), "within-tolerance" (made by other versions or on another machine), "disagrees"
    or "stopped"; `difference` describes the difference, "" if there is none. `texts` and `numbers` are the columns of
    the table "verify", by name: ``found.numbers["error_estimate"]`` [m].
    """

    def __init__(self, record: dict[str, Any]):
        self.texts: dict[str, str] = {name: value for name, value in record.items() if isinstance(value, str)}
        self.numbers: dict[str, float] = {name: value for name, value in record.items() if name not in self.texts}
        self.verdict = self.texts["verdict"]
        self.difference = self.texts["difference"]

    def __bool__(self) -> bool:
        return self.verdict in ("agrees", "within-tolerance")

    def __repr__(self) -> str:
        return f"Verification({self.verdict}, balance {self.texts['balance']}, {self.difference or 'no difference'})"


def verify(
    path: str | os.PathLike[str],
    *,
    memory: float | None = None,
    outside: bool = False,
    progress: WorkProgress | bool | None = None,
    **options: Any,
) -> Verification:
    """Repeats a slice of a trajectory from the contents of its file and compares it with its frames to the bit;
    compares every frame with its check value, computes the energy balance and estimates the error.

    Keywords: `slice` (from, to) [s], `all`, `budget` [s] of work if neither is given, `bits` for the bits alone;
    `memory` and `outside` as in `Scene.load`; ``progress(share, what)`` receives progress, True for a bar. A file
    that does not reproduce is a result, not an error.
    """
    given, limits = Options._of("verify").set(**options), limits_of(memory, outside)
    measurement = Measurement.made(None, lib.hooke_verify_create, os.fsencode(path), given._handle, limits)
    try:
        measurement.run(progress)
    except BadValue:
        if measurement.text("verify", 0, "verdict") != "disagrees":
            raise
    return Verification(measurement.record("verify"))
