"""Whether a trajectory is what its scene gives."""

from __future__ import annotations

import ctypes
import os
from typing import Any

from ._callback import listening
from ._library import lib
from ._memory import Handle, text
from ._prototypes import OPTIONS, VERIFY
from ._status import BadValue
from .options import Options
from .results import WorkProgress
from .scene import limits_of

_TEXTS = (
    "verdict",
    "difference",
    "balance",
    "method",
    "run",
    "version",
    "sundials",
    "cholmod",
    "instructions",
    "machine",
)
_NUMBERS = (
    "frames",
    "frames_checked",
    "frame_first",
    "frame_last",
    "time_first",
    "time_last",
    "steps",
    "step",
    "rtol",
    "atol",
    "step_limit",
    "step_share",
    "energy_change",
    "work",
    "heat",
    "residual",
    "residual_refined",
    "residual_bound",
    "error_estimate",
    "check_scene",
    "check_last",
)


class Verification:
    """What was found of a trajectory; true where it is what its scene gives.

    `verdict` is "agrees" (to the bit), "within-tolerance" (made by other versions or on another machine), "disagrees" or
    "stopped"; `difference` says what differs, "" if nothing does. `texts` and `numbers` are what hooke/verify.h lists,
    by name: ``found.numbers["error_estimate"]`` [m].
    """

    def __init__(self, handle: Handle):
        self.texts = {name: text(lib.hooke_verify_text(handle, name.encode())) for name in _TEXTS}
        self.numbers: dict[str, float] = {
            name: lib.hooke_verify_number(handle, name.encode()) for name in _NUMBERS
        }
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
    """Runs a slice of a trajectory again from what the file holds and compares it with its frames to the bit; holds every
    frame against its check value, takes the balance of energy and estimates the error.

    Keywords: `slice` (from, to) [s], `all`, `budget` [s] of work where neither is given, `bits` for the bits alone;
    `memory` and `outside` as in `Scene.load`; ``progress(share, what)`` is told how far it is, True for a bar. A file that is
    not what its scene gives is a result, not an error.
    """
    pointer = OPTIONS()
    lib.hooke_verify_options_create(ctypes.byref(pointer))
    given = Options(Handle(pointer, lib.hooke_options_destroy)).set(**options)
    limits = limits_of(memory, outside)
    made = VERIFY()
    lib.hooke_verify_create(os.fsencode(path), given._handle, limits._handle, ctypes.byref(made))
    handle = Handle(made, lib.hooke_verify_destroy)
    with listening(lib.hooke_verify_on_progress, handle, progress):
        try:
            lib.hooke_verify_run(handle)
        except BadValue:
            if lib.hooke_verify_text(handle, b"verdict") != b"disagrees":
                raise
    return Verification(handle)
