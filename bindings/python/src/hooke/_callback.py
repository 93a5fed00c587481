"""Python functions as callbacks of the library.

An exception must not cross C: it is stored, the callback asks the library to stop, and the outermost function raises
the same exception again (see `_status.checker`).
"""

from __future__ import annotations

import contextlib
import contextvars
import ctypes
import math
import operator
import os
import signal
import sys
import warnings
from collections.abc import Iterator
from sys import getrefcount
from typing import Any, Callable

import numpy as np

from ._library import lib
from ._look import Shown, shown
from ._memory import Handle, text, view
from ._prototypes import PROGRESS
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


#: Who hears the warnings of this thread's runs, in place of everyone.
_heard: contextvars.ContextVar[list[str] | None] = contextvars.ContextVar("heard", default=None)
_INSIDE = os.path.dirname(__file__), contextlib.__file__


def warn(sentence: str, category: type[Warning]) -> None:
    """A warning that points at the line that called this package."""
    heard, frame, level = _heard.get(), sys._getframe(1), 2
    if heard is not None:
        heard.append(sentence)
        return
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_INSIDE):
        frame, level = frame.f_back, level + 1
    warnings.warn(sentence, category, level)


@contextlib.contextmanager
def hearing() -> Iterator[list[str]]:
    """A context in which warnings of this package are a list, of this thread alone."""
    heard: list[str] = []
    before = _heard.set(heard)
    try:
        yield heard
    finally:
        _heard.reset(before)


# The arrays of a call are one block of the library, and those of the next call are there again. So each call gets new
# views, which all count as references to one array over the block. If that has more of them after a call, something
# was kept, and the block is left to it. A block is known by the places of all its arrays: where one was freed, another
# one may begin, whose arrays are elsewhere.

_again = np.ndarray.view
_MOST = 64  # blocks that are known; an integrator has few


def on_arrays(
    kind: Any,
    function: Callable[..., Any] | None,
    inputs: int,
    shape: Callable[[int], Shape] = lambda n: (n, 3),
    dtype: Any = float,
) -> Any:
    """The callback of a kind for ``function(t, *arrays)``, whose first `inputs` arrays are read-only; none for None. They
    have the `shape` for the count that the library gives, and are the library's own."""
    if function is None:
        return kind()
    user = function
    known: dict[tuple[int, ...], tuple[Table, list[Table]]] = {}

    def look(key: tuple[int, ...]) -> tuple[Table, list[Table]]:
        count, first = key[:2]
        size = math.prod(shape(count))
        starts = [(place - first) // np.dtype(dtype).itemsize for place in key[1:]]
        memory = view(first, (starts[-1] + size,), dtype=dtype)
        rows = [memory[start : start + size].reshape(shape(count)) for start in starts]
        for array in rows[:inputs]:
            array.flags.writeable = False
        if len(known) >= _MOST:
            known.clear()
        known[key] = memory, rows
        return known[key]

    def leave(key: tuple[int, ...], memory: Any) -> None:
        known.pop(key, None)
        if memory.size:
            place = ctypes.c_double.from_address(key[1])
            lib.hooke_rows_hold(place, 1)
            memory.base.owner = Handle(place, lambda rows: lib.hooke_rows_hold(rows, -1))

    def called(count: int, t: float, *places: Any) -> int:
        key = count, *places[:-1]
        try:
            memory, rows = known.get(key) or look(key)
            users = getrefcount(memory)
            try:
                answer = user(t, *map(_again, rows))
                return 0 if answer is None and pending.exception is None else guarded(lambda: answer)
            finally:
                if getrefcount(memory) != users:
                    leave(key, memory)
        except BaseException as exception:
            pending.exception = exception
            return _STOP

    return kind(called)


@contextlib.contextmanager
def attached(attach: Callable[..., Any], handle: Any, callback: Any, *how: Any) -> Iterator[None]:
    """Has the library call back during its work; ``attach(handle, *how, callback, None)`` is the function that sets it."""
    attach(handle, *how, callback, None)
    try:
        yield
    finally:
        attach(handle, *how, type(callback)(), None)


@contextlib.contextmanager
def listening(attach: Callable[..., Any], handle: Any, progress: Shown) -> Iterator[None]:
    """Reports progress of the object during the library's work, and handles Ctrl-C."""
    with shown(progress) as told, interruptible():
        tell = told or (lambda done, what: None)
        with attached(attach, handle, PROGRESS(lambda done, what, _: guarded(tell, done, text(what)))):
            yield


@contextlib.contextmanager
def interruptible(integrator: Any = None) -> Iterator[None]:
    """Makes Ctrl-C end the work at its next callback; steps of `integrator` have one every tenth of a second.

    Python would call the handler of the signal on entry to the callback, before any `try`, where ctypes can only drop
    its exception. So the exception is stored like one of the callback.
    """
    before = signal.getsignal(signal.SIGINT)

    def note(number: int, frame: Any) -> None:
        try:
            before(number, frame)  # type: ignore[operator, misc]
        except BaseException as exception:
            pending.exception = exception

    try:
        heard = callable(before) and bool(signal.signal(signal.SIGINT, note))
    except ValueError:  # in another thread than the main one, or in a subinterpreter
        heard = False
    if not heard:
        yield
        return
    hear = attached(lib.hooke_integrator_on_progress, integrator, _HEAR, _HEARING) if integrator else contextlib.nullcontext()
    try:
        with hear:
            yield
    finally:
        if signal.getsignal(signal.SIGINT) is note:
            signal.signal(signal.SIGINT, before)
        late, pending.exception = pending.exception, None
    if late is not None:
        raise late


_HEARING = 0.1  # [s]
_HEAR = PROGRESS(lambda *_: guarded(lambda: None))
