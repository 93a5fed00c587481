"""What looks at results: functions of `hooke.plot`, `hooke.animation` and `hooke.notebook`, which import what is an
extra, or slow to import."""

from __future__ import annotations

import contextlib
import importlib
from collections.abc import Iterator
from typing import Any, Callable, Optional, Union

#: progress(fraction, what): the fraction done, 0 to 1, and the name of the running task.
WorkProgress = Callable[[float, str], Optional[int]]
#: A function that receives progress, True for a bar, or None.
Shown = Union[None, bool, Callable[..., Any]]


def draw(what: str, *arguments: Any, **options: Any) -> Any:
    """Calls a function by its module and name."""
    module, name = what.split(".")
    return getattr(importlib.import_module(f"{__package__}.{module}"), name)(*arguments, **options)


def still(problem: Any) -> str | None:
    """A scene or a system as a notebook shows it."""
    shown: str | None = draw("notebook.still", problem)
    return shown


@contextlib.contextmanager
def shown(progress: Shown, fills: bool = True) -> Iterator[Callable[..., Any] | None]:
    """The function that receives progress: a bar of tqdm if `progress` is True, which is full at the end if `fills`."""
    if progress is not True:
        yield None if progress is False else progress
        return
    with draw("notebook.bar") as tell:
        yield tell
        if fills:
            tell(1.0, None)
