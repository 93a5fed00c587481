"""Statuses of the library as exceptions, and exceptions of callbacks passed through the library."""

from __future__ import annotations

import contextlib
import re
import threading
from collections.abc import Iterator, Sequence
from typing import Any, Callable

__all__ = ["BadCall", "BadValue", "Error", "IOFailed", "Internal", "NoMemory", "NotBuilt", "SolverFailed", "Stopped", "Unsuited"]

#: Outcomes of a run: they are results, not exceptions.
OUTCOMES = {0: "finished", 1: "stopped", 2: "diverged", 3: "step-limit"}


def plain(text: str) -> str:
    """Foreign text, such as a name or the name of a file, on one line: "?" replaces characters that could control a
    terminal."""
    return "".join(character if character.isprintable() else "?" for character in text)


class Error(Exception):
    """A failure reported by the library; the message is the library's own, `status` its number."""

    status: int | None = None
    lines: int = 1  # of a message of the library

    def __reduce__(self) -> Any:
        """Without what belongs to this process."""
        return type(self), self.args, {name: value for name, value in vars(self).items() if name != "integrator"}

    def __str__(self) -> str:
        return "\n".join(plain(line) for line in super().__str__().split("\n", self.lines - 1))


class NoMemory(Error, MemoryError):
    """An allocation failed."""


class BadValue(Error, ValueError):
    """An argument, an option or a scene has a value that is not allowed."""


class BadCall(Error, RuntimeError):
    """Calls out of order, such as adding to a committed system."""


class IOFailed(Error, OSError):
    """A file could not be read or written."""


class MissingInput(BadValue, FileNotFoundError):
    """A scene, or a file that one is made of, is not there."""


class MissingFile(IOFailed, FileNotFoundError):
    """A file, or the folder that it should go into, is not there."""


class UnknownOption(BadValue, TypeError):
    """An option, or a keyword that stands for one, has a name that is not known."""


class NotBuilt(Error, NotImplementedError):
    """This build of the library lacks the requested part."""


class Unsuited(Error, ValueError):
    """The method does not support this kind of problem."""


class SolverFailed(Error, ArithmeticError):
    """A nonlinear or error-controlled solver gave up; ``hooke.why(failure)`` explains it, and `diagnosis` is its
    sentence."""

    integrator: Any = None  # the one that failed, if there is one

    @property
    def diagnosis(self) -> str:
        """A sentence with cause, place and time; the message if nothing more is known."""
        return str(self) if self.integrator is None else self.integrator.diagnosis


class Internal(Error, RuntimeError):
    """The library found a defect of its own; nothing was measured."""


class Stopped(Error):
    """A callback asked to stop outside of a run, so that there is no result to return."""


_KINDS = (NoMemory, BadValue, BadCall, IOFailed, NotBuilt, Unsuited, SolverFailed, Internal)
FAILURES: dict[int, type[Error]] = {1: Stopped, **{-number: kind for number, kind in enumerate(_KINDS, 1)}}
for _number, _kind in FAILURES.items():
    _kind.status = _number
_SPECIAL: dict[str, dict[int, type[Error]]] = {  # where the message of the library says so
    "No such file or directory": {-2: MissingInput, -4: MissingFile},
    'unknown option "': {-2: UnknownOption},
}


_KEY = re.compile(r"[a-z_]+(\[\d+\])*(\.[a-z_]+(\[\d+\])*)*: ")


@contextlib.contextmanager
def placed(place: str) -> Iterator[None]:
    """A context in which failures name their place: "stiffness: ..." becomes "cloth.stiffness: ..."."""
    try:
        yield
    except Error as error:
        message = str(error)
        if not message.startswith((f"{place}: ", f"{place}.")):
            message = f"{place}{'.' if _KEY.match(message) else ': '}{message}"
        failure = type(error)(message)
        failure.status = error.status
        raise failure from None


class _Pending(threading.local):
    """The stored exception of a callback of this thread, until the library has returned."""

    exception: BaseException | None = None


pending = _Pending()


def checker(words: Sequence[Callable[..., Any]], outcomes: bool) -> Callable[[int, Any, Any], int]:
    """The ctypes `errcheck` of functions that return a status; `words` are hooke_last_error and hooke_status_name.
    With `outcomes` a positive status is a result and not raised."""
    last_error, status_name = words

    def check(code: int, _function: Any, _arguments: Any) -> int:
        exception = pending.exception
        if exception is not None:
            pending.exception = None
            raise exception
        if code < 0 or (code > 0 and not outcomes):
            message = last_error().decode("utf-8", "replace") or status_name(code).decode()
            kinds = next((kinds for words, kinds in _SPECIAL.items() if words in message and code in kinds), FAILURES)
            failure: Error = kinds.get(code, Error)(message)
            failure.status = code
            failure.lines = message.count("\n") + 1
            raise failure
        return code

    return check
