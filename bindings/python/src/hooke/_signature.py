"""Signatures of functions whose keywords are options of the library."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any, Callable, TypeVar

if TYPE_CHECKING:
    from typing_extensions import Unpack as Unpack
else:
    Unpack = None  # which Python has from 3.11 on

F = TypeVar("F", bound=Callable[..., Any])


def takes(keywords: Any) -> Callable[[F], F]:
    """A decorator of a function with ``**options: Unpack[keywords]``: `inspect.signature` has each of them, and the docstring
    says what they are."""

    def signed(function: F) -> F:
        own = inspect.signature(function)
        named = [parameter for parameter in own.parameters.values() if parameter.kind is not parameter.VAR_KEYWORD]
        for name, hint in keywords.__annotations__.items():
            given = {"default": None, "annotation": getattr(hint, "__forward_arg__", hint)}
            named.append(inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, **given))
        function.__signature__ = own.replace(parameters=named)  # type: ignore[attr-defined]
        words = inspect.cleandoc(keywords.__doc__).partition("\n\n")[2]
        function.__doc__ = f"{inspect.cleandoc(function.__doc__ or '')}\n\n{words}\n"
        return function

    return signed
