"""Messages of the library with the place in a scene that is built in Python."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator

from ._status import Error

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
