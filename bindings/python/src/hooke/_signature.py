"""Signatures of functions whose keywords are options of the library, and keywords that a function does not have."""

from __future__ import annotations

import difflib
import functools
import inspect
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Callable, TypeVar

from ._status import UnknownOption
from .options import option_name

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack
else:
    Unpack = None  # which Python has from 3.11 on

_PROGRESS = """``progress(fraction, what)`` receives the fraction done and the name of the running task, and stops the work by
returning a non-zero number; ``progress=True`` shows a bar, with tqdm."""
F = TypeVar("F", bound=Callable[..., Any])


def refuse_unknown(function: str, given: Iterable[str], known: Mapping[str, Any], options: bool = True) -> None:
    """UnknownOption names a keyword that a function does not have, as one of `options` if it has some, and what is nearest."""
    for name in given:
        if name not in known and not (options and option_name(name) in known):
            near = difflib.get_close_matches(name, known, 1)
            meant = f'; did you mean "{near[0]}"?' if near else f"; allowed: {', '.join(known)}"
            raise UnknownOption(f'{function}: unknown keyword "{name}"{meant}')


def takes(keywords: Any = None) -> Callable[[F], F]:
    """A decorator of a function with ``**options: Unpack[keywords]``, or with no options: `inspect.signature` has each of
    them, the docstring says what they are, and others are refused."""

    def signed(function: F) -> F:
        own = inspect.signature(function)
        named = [parameter for parameter in own.parameters.values() if parameter.kind is not parameter.VAR_KEYWORD]
        for name, hint in (keywords.__annotations__ if keywords else {}).items():
            given = {"default": None, "annotation": getattr(hint, "__forward_arg__", hint)}
            named.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, **given))
        known = {parameter.name: parameter for parameter in named
                 if parameter.name != "self" and parameter.kind is not parameter.VAR_POSITIONAL}
        called = function.__qualname__.split(".")[-2 if function.__name__ == "__init__" else -1]

        @functools.wraps(function)
        def checked(*arguments: Any, **options: Any) -> Any:
            if not options.keys() <= known.keys():
                taken = own.bind_partial(*arguments).arguments
                left = {name: known[name] for name in known if name not in taken}
                refuse_unknown(called, options, left, keywords is not None)
            return function(*arguments, **options)

        checked.__signature__ = own.replace(parameters=named)  # type: ignore[attr-defined]
        if keywords:
            tells = [_PROGRESS] if "progress" in known and function.__name__ != "run" else []
            words = inspect.cleandoc(keywords.__doc__).partition("\n\n")[2]
            checked.__doc__ = "\n\n".join([inspect.cleandoc(function.__doc__ or ""), *tells, words]) + "\n"
        return checked  # type: ignore[return-value]

    return signed
