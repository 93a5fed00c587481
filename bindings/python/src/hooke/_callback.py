"""Python functions as callbacks of the library.

An exception must not cross C: it is stored, the callback asks the library to stop, and the outermost function raises
the same exception again (see `_status.checker`).
"""

from __future__ import annotations

import contextlib
import operator
import os
import signal
import sys
import threading
from collections.abc import Iterator
from typing import Any, Callable

import numpy as np

from ._library import lib
from ._memory import text, view
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


class _Views:
    """Arrays over the addresses passed to callbacks. An integrator uses few, so they are cached."""

    LIMIT = 64

    def __init__(self, dtype: Any = float):
        self._dtype = dtype
        self._views: dict[tuple[int, Shape, bool], Table] = {}

    def __call__(self, address: int, shape: Shape, writeable: bool) -> Table:
        key = (address, shape, writeable)
        array = self._views.get(key)
        if array is None:
            if len(self._views) >= self.LIMIT:
                self._views.clear()
            array = self._views[key] = view(address, shape, None, writeable, self._dtype)
        return array


def force_callback(function: Callable[..., Any], row: Shape = (3,)) -> Any:
    """The callback that adds forces, for `function` of `System.set_force`; `row` () for one of coordinates."""
    views = _Views()

    def force(n: int, t: float, q: int, v: int, out: int, _: Any) -> int:
        return guarded(call, n, t, q, v, out)

    def call(n: int, t: float, q: int, v: int, out: int) -> Any:
        shape = (n, *row)
        return function(t, views(q, shape, False), views(v, shape, False), views(out, shape, True))

    return FORCE(force)


def product_callback(function: Callable[..., Any], row: Shape = (3,)) -> Any:
    """The callback for the product with the derivative of a force."""
    views = _Views()

    def product(n: int, t: float, q: int, v: int, dq: int, dv: int, out: int, _: Any) -> int:
        return guarded(call, n, t, (q, v, dq, dv), out)

    def call(n: int, t: float, inputs: tuple[int, ...], out: int) -> Any:
        shape = (n, *row)
        return function(t, *(views(address, shape, False) for address in inputs), views(out, shape, True))

    return FORCE_PRODUCT(product)


def drive_callback(function: Callable[..., Any]) -> Any:
    """The callback that moves driven particles."""
    views = _Views()

    def drive(count: int, t: float, q: int, v: int, _: Any) -> int:
        return guarded(call, count, t, q, v)

    def call(count: int, t: float, q: int, v: int) -> Any:
        return function(t, views(q, (count, 3), True), views(v, (count, 3), True))

    return DRIVE(drive)


def rate_callback(function: Callable[..., Any], shape: Shape, dtype: Any) -> Any:
    """The callback for the rate of a first-order problem."""
    views = _Views(dtype)

    def rate(_n: int, t: float, x: int, out: int, _: Any) -> int:
        return guarded(call, t, x, out)

    def call(t: float, x: int, out: int) -> Any:
        return function(t, views(x, shape, False), views(out, shape, True))

    return RATE(rate)


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
