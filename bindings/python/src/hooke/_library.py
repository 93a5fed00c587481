"""Finds and loads the shared library, once; `lib` then holds every public function with its prototype."""

from __future__ import annotations

import ctypes
import ctypes.util
import functools
import operator
import os
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable

from . import _prototypes
from ._status import BadValue, checker

#: The ABI that this package was written for, HOOKE_ABI of the headers.
ABI = 1

#: Functions whose positive status is an outcome, which their callers handle; for all others it is raised.
OUTCOMES = frozenset(
    (
        "hooke_integrator_advance",
        "hooke_integrator_begin",
        "hooke_integrator_resume",
        "hooke_integrator_run",
        "hooke_integrator_step",
        "hooke_integrator_sync",
        "hooke_measurement_run",
        "hooke_study_recommend",
    )
)

_FILE_NAMES = {"darwin": "libhooke.dylib", "win32": "hooke.dll"}


class Library:
    """The public functions of the library. Any other name is an AttributeError, also in assignment."""

    __slots__ = (*_prototypes.PROTOTYPES, "path")

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    def __init__(self, path: str, library: ctypes.CDLL):
        self.path = path
        _require_abi(path, library)
        words = [_install(path, library, name) for name in ("hooke_last_error", "hooke_status_name")]
        checks = [checker(words, outcomes) for outcomes in (False, True)]
        for name in _prototypes.PROTOTYPES:
            setattr(self, name, _guarded(_install(path, library, name, checks[name in OUTCOMES])))


def _install(path: str, library: ctypes.CDLL, name: str, check: Any = None) -> Any:
    result, *arguments = _prototypes.PROTOTYPES[name]
    try:
        function = getattr(library, name)
    except AttributeError:
        raise ImportError(
            f"{path} has no function {name}; it and this package are of different versions"
        ) from None
    function.argtypes = arguments
    function.restype = ctypes.c_int32 if result is _prototypes.STATUS else result
    if result is _prototypes.STATUS:
        function.errcheck = check
    return function


def _text(value: Any) -> Any:
    if value is not None and b"\0" in value:
        raise BadValue(f"{value.decode('utf-8', 'replace')!r} is not allowed: a text has no NUL character")
    return value


def _whole(bits: int) -> Callable[[Any], int]:
    def check(value: Any) -> int:
        try:
            number = operator.index(value)
        except TypeError:
            raise BadValue(f"{value!r} is not allowed; a whole number is needed") from None
        if not -(1 << bits - 1) <= number < 1 << bits - 1:
            raise BadValue(f"{number} is not allowed; whole numbers go from -2^{bits - 1} to 2^{bits - 1} - 1")
        return number

    return check


_CHECKS = {_prototypes.TEXT: _text, _prototypes.INT32: _whole(32), _prototypes.INT64: _whole(64)}


def _guarded(function: Any) -> Any:
    """The function with its texts and integers checked, which ctypes would truncate silently."""
    checks = [(place, _CHECKS[kind]) for place, kind in enumerate(function.argtypes) if kind in _CHECKS]
    if not checks:
        return function

    @functools.wraps(function)
    def call(*arguments: Any) -> Any:
        for place, check in checks:
            check(arguments[place])
        return function(*arguments)

    return call


def _require_abi(path: str, library: ctypes.CDLL) -> None:
    try:
        abi = _install(path, library, "hooke_abi")()
    except ImportError:
        raise ImportError(f"{path} is not the hooke library (it has no function hooke_abi)") from None
    if abi != ABI:
        raise ImportError(
            f"{path} has ABI {abi}, this package needs ABI {ABI}; install both from the same version of hooke"
        )


def _candidates() -> Iterator[str]:
    name = _FILE_NAMES.get(sys.platform, "libhooke.so")
    for folder in sys.modules[__package__].__path__:  # two, where the sources are installed to be edited
        bundled = Path(folder) / name
        if bundled.exists():
            yield str(bundled)
    found = ctypes.util.find_library("hooke")
    if found:
        yield found
    for prefix in (sys.prefix, "/usr/local", "/usr"):
        for folder in ("lib", "lib64"):
            path = Path(prefix) / folder / name
            if path.exists():
                yield str(path)


def load() -> Library:
    """Loads the library from $HOOKE_LIBRARY or, if that is not set, from the first place that has it."""
    given = os.environ.get("HOOKE_LIBRARY")
    if given:
        try:
            return Library(given, ctypes.CDLL(given))
        except OSError as error:
            raise ImportError(f"HOOKE_LIBRARY names {given!r}, which does not load: {error}") from None
    failures = []
    for path in _candidates():
        try:
            return Library(path, ctypes.CDLL(path))
        except (OSError, ImportError) as error:
            failures.append(f"{path}: {error}")
    raise ImportError(
        "the hooke library was not found. Either install this package with `pip install .`, "
        "which builds the library into it, or set the environment variable HOOKE_LIBRARY to the path of "
        "libhooke.so" + "".join(f"\n  tried {failure}" for failure in failures)
    )


lib = load()
