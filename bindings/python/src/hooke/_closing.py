"""Objects that release their resources at the end of a `with` block."""

from __future__ import annotations

from typing import Any, TypeVar

from ._memory import Owner
from ._status import BadCall

C = TypeVar("C", bound="Closing")


class Closing(Owner):
    """Has a `_handle`, which `close` releases; later use of it is a BadCall."""

    def close(self) -> None:
        """Releases the memory and the files that this object holds; arrays obtained from it stay valid. A second call
        does nothing."""
        self.__dict__.pop("_handle", None)

    def __enter__(self: C) -> C:
        """The object itself, which is closed at the end of the block."""
        return self

    def __exit__(self, *_: object) -> None:
        """Closes the object."""
        self.close()

    def __getattr__(self, name: str) -> Any:
        if name == "_handle":
            raise BadCall(f"this {type(self).__name__} is closed")
        raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
