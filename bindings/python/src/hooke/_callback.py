"""Python functions as callbacks of the library.

An exception must not cross C: it is stored, the callback asks the library to stop, and the outermost function raises
the same exception again (see `_status.checker`).
"""

from __future__ import annotations

import contextlib
import ctypes
import operator
import os
import signal
import sys
import threading
from collections.abc import Iterator
from sys import getrefcount
from typing import Any, Callable

import numpy as np

from ._library import lib
from ._memory import Handle, text, view
from ._progress import Shown, shown
from ._prototypes import DRIVE, FORCE, FORCE_PRODUCT, PROGRESS, RATE
from ._status import pending
from ._types import Table

_STOP = 1
Shape = tuple[int, ...]


def stop_value(answer: Any) -> int:
    """Converts the result of a callback for the library: 0 to go on."""
    if answer is None or answer is False:
        return 0
    try:
        number = operator.index(bool(answer) if isinstance(answer, np.bool_) else answer)
    except TypeError:
        raise TypeError(
            "a callback returns None or 0 to go on, a whole number to stop; "
            f"this one returned {type(answer).__name__}"
        ) from None
    if not -(2**31) <= number < 2**31:
        raise OverflowError(f"a callback returned {number}, which is not a 32-bit number")
    return number


def guarded(function: Callable[..., Any], *arguments: Any) -> int:
    """Calls `function` from a callback; returns the result for the library."""
    try:
        answer = stop_value(function(*arguments))
    except BaseException as exception:
        pending.exception = exception
        return _STOP
    return _STOP if pending.exception is not None else answer


def outside() -> int:
    """The stacklevel of a warning that should point at the line that called this package."""
    frame, level = sys._getframe(1), 1  # warnings.warn counts from `guarded`, which calls it
    while frame.f_back is not None and os.path.dirname(frame.f_code.co_filename) == _FOLDER:
        frame, level = frame.f_back, level + 1
    return level + 1


_FOLDER = os.path.dirname(__file__)


# The library frees the arrays of a call or uses them again. So each call gets new views, which all count as references
# to one array over the memory. If that has more of them after a call, something was kept, and the memory is left to it.

_again = np.ndarray.view
_MOST = 64  # places in the library's memory that are known; an integrator has few
_Key = tuple[int, ...]
_Moves = list[tuple[Any, Table]]


def _answered(answer: Any) -> int:
    return 0 if answer is None and pending.exception is None else guarded(lambda: answer)


def force_callback(function: Callable[..., Any]) -> Any:
    """The callback that adds forces, for `function` of `System.set_force`. Its arrays are the library's own."""
    known: dict[_Key, tuple[Table, list[Table]]] = {}

    def look(key: _Key) -> tuple[Table, list[Table]]:
        memory = view(key[1], (3, key[0], 3))
        rows = list(memory)
        for array in rows[:2]:
            array.flags.writeable = False
        if len(known) >= _MOST:
            known.clear()
        known[key] = memory, rows
        return known[key]

    def leave(key: _Key, memory: Any) -> None:
        known.pop(key, None)
        if memory.size:
            place = ctypes.c_double.from_address(key[1])
            lib.hooke_rows_hold(place, 1)
            memory.base.owner = Handle(place, lambda rows: lib.hooke_rows_hold(rows, -1))

    def force(n: int, t: float, q: int, v: int, out: int, _: Any) -> int:
        key = (n, q)
        try:
            memory, rows = known.get(key) or look(key)
            users = getrefcount(memory)
            try:
                return _answered(function(t, *map(_again, rows)))
            finally:
                if getrefcount(memory) != users:
                    leave(key, memory)
        except BaseException as exception:
            pending.exception = exception
            return _STOP

    return FORCE(force)


def _copied(
    function: Callable[..., Any], inputs: int, shape: Callable[[int], Shape], dtype: Any = float, adds: bool = True
) -> Any:
    """The callback for ``function(t, *arrays)``, whose first `inputs` arrays are read-only; it `adds` to the others or
    writes them. They have the `shape` for the count that the library gives, and are in memory of this package."""
    free: list[tuple[Table, list[Table]]] = []  # not in use; several for calls within calls, and from threads
    known: dict[_Key, tuple[_Moves, _Moves]] = {}

    def own(key: _Key) -> tuple[Table, list[Table]]:
        memory: Table = np.zeros((len(key) - 1, *shape(key[0])), dtype)
        rows = list(memory)
        for array in rows[:inputs]:
            array.flags.writeable = False
        return memory, rows

    def look(key: _Key) -> tuple[_Moves, _Moves]:
        """What is copied before and after a call."""
        if len(known) >= _MOST:
            known.clear()
        rows = [(k, view(place, shape(key[0]), dtype=dtype)) for k, place in enumerate(key[1:])]
        known[key] = rows if adds else rows[:inputs], rows[inputs:]
        return known[key]

    def called(count: int, t: float, *places: Any) -> int:
        key = (count, *places[:-1])
        try:
            taken, given = known.get(key) or look(key)
            try:
                mine = free.pop()
            except IndexError:
                mine = own(key)
            memory, rows = mine
            for place, numbers in taken:
                memory[place] = numbers
            users = getrefcount(memory)
            answer = function(t, *map(_again, rows))
            for place, numbers in given:
                numbers[...] = rows[place]
            if getrefcount(memory) == users:
                free.append(mine)
            return _answered(answer)
        except BaseException as exception:
            pending.exception = exception
            return _STOP

    return called


def coordinate_callback(function: Callable[..., Any]) -> Any:
    """The callback for the force of coordinates."""
    return FORCE(_copied(function, 2, lambda n: (n,)))


def product_callback(function: Callable[..., Any], row: Shape = (3,)) -> Any:
    """The callback for the product with the derivative of a force."""
    return FORCE_PRODUCT(_copied(function, 4, lambda n: (n, *row)))


def drive_callback(function: Callable[..., Any]) -> Any:
    """The callback that moves driven particles."""
    return DRIVE(_copied(function, 0, lambda n: (n, 3), adds=False))


def rate_callback(function: Callable[..., Any], shape: Shape, dtype: Any) -> Any:
    """The callback for the rate of a first-order problem."""
    return RATE(_copied(function, 1, lambda _: shape, dtype, adds=False))


@contextlib.contextmanager
def watching(progress: Shown) -> Iterator[Any]:
    """The progress callback of the library during its work; handles Ctrl-C."""
    with shown(progress) as told:
        tell = told or (lambda done, what: None)
        with interruptible():
            yield PROGRESS(lambda done, what, _: guarded(tell, done, text(what)))


@contextlib.contextmanager
def listening(attach: Callable[..., Any], handle: Any, progress: Shown) -> Iterator[None]:
    """Reports progress of the object during the library's work, and handles Ctrl-C; ``attach(handle, watcher, None)``
    is the library function that sets the callback."""
    with watching(progress) as watcher:
        attach(handle, watcher, None)
        try:
            yield
        finally:
            attach(handle, PROGRESS(), None)


@contextlib.contextmanager
def interruptible(integrator: Any = None) -> Iterator[None]:
    """Makes Ctrl-C end the work at its next callback; steps of `integrator` have one every tenth of a second.

    Python would call the handler of the signal on entry to the callback, before any `try`, where ctypes can only drop
    its exception. So the exception is stored like one of the callback.
    """
    mine = threading.current_thread() is threading.main_thread()
    before = signal.getsignal(signal.SIGINT) if mine else None
    if not callable(before):
        yield
        return

    def note(number: int, frame: Any) -> None:
        try:
            before(number, frame)
        except BaseException as exception:
            pending.exception = exception

    signal.signal(signal.SIGINT, note)
    try:
        if integrator is not None:
            lib.hooke_integrator_on_progress(integrator, _HEARING, _HEAR, None)
        yield
    finally:
        if integrator is not None:
            lib.hooke_integrator_on_progress(integrator, _HEARING, PROGRESS(), None)
        if signal.getsignal(signal.SIGINT) is note:
            signal.signal(signal.SIGINT, before)
        late, pending.exception = pending.exception, None
    if late is not None:
        raise late


_HEARING = 0.1  # [s]
_HEAR = PROGRESS(lambda *_: guarded(lambda: None))
