"""Progress bars."""

from __future__ import annotations

import contextlib
import importlib
from collections.abc import Iterator
from typing import Any, Callable, Optional, Union

from ._status import plain

#: progress(fraction, what): the fraction done, 0 to 1, and the name of the running task.
WorkProgress = Callable[[float, str], Optional[int]]
#: A function that receives progress, True for a bar, or None.
Shown = Union[None, bool, Callable[..., Any]]


@contextlib.contextmanager
def shown(progress: Shown, fills: bool = True) -> Iterator[Callable[..., Any] | None]:
    """The function that receives progress: a bar of tqdm if `progress` is True, which is full at the end if `fills`."""
    if not isinstance(progress, bool):
        yield progress
        return
    if not progress:
        yield None
        return
    try:
        tqdm: Any = importlib.import_module("tqdm.auto")
    except ImportError:
        raise ImportError(
            'progress=True shows a bar of tqdm, which is not installed: pip install "libhooke[progress]"; '
            "a function of your own, progress=f, needs nothing"
        ) from None
    with tqdm.tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining}{postfix}") as bar:

        def tell(fraction: float, what: Any) -> None:
            if isinstance(what, str):
                bar.set_postfix_str(plain(what), refresh=False)
            bar.update(max(fraction - bar.n, 0.0))

        yield tell
        if fills:
            bar.update(1.0 - bar.n)
