"""Handles, and NumPy arrays shared with the library: views of its memory, and arguments for it."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Callable, Generic, TypeVar

import numpy as np

from ._library import lib
from ._prototypes import DOUBLES, INTEGERS, PROTOTYPES
from ._status import BadCall, BadValue
from ._types import FloatArray, IntArray, Table

C = TypeVar("C", bound="Closing")
V = TypeVar("V")


class Owner:
    """Base of classes that hold an object of the library, which belongs to this process: they cannot be copied or pickled,
    unless they say how they are made again."""

    __slots__ = ()

    def __reduce__(self) -> Any:
        way = "copy() makes another" if hasattr(self, "copy") else "build it again where it is needed"
        raise TypeError(
            f"a {type(self).__name__} holds an object of the library and cannot be copied or pickled; {way}. "
            "States and arrays can"
        )


class Handle(Owner):
    """Owns one object of the library and releases it with its last user, parents after their children.

    It can be passed wherever a function expects the pointer. The count keeps the order of release right also if
    Python collects parent and child in one garbage cycle.
    """

    __slots__ = ("__weakref__", "_as_parameter_", "_destroy", "_parent", "_users")

    def __init__(self, pointer: Any, destroy: Any = None, parent: Handle | None = None):
        self._as_parameter_ = pointer
        self._destroy = destroy
        self._parent = parent
        self._users = 1
        if parent is not None:
            parent._users += 1

    @classmethod
    def made(cls, parent: Handle | None, create: Any, *arguments: Any) -> Handle:
        """Owns what a function of the library makes, whose last argument is the place for it."""
        kind = PROTOTYPES[create.__name__][-1]._type_
        name, pointer = kind._type_.__name__, kind()
        create(*arguments, ctypes.byref(pointer))
        return cls(pointer, getattr(lib, f"{name}_destroy", None) or getattr(lib, f"{name}_close"), parent)

    def _release(self) -> None:
        self._users -= 1
        if self._users == 0:
            if self._destroy is not None:
                self._destroy(self._as_parameter_)
            if self._parent is not None:
                self._parent._release()

    def __del__(self) -> None:
        if hasattr(self, "_users"):
            self._release()


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


class Asked(property, Generic[V]):
    """A property as a row of a table: the method that answers, what it says, and what the method is asked for."""

    def __init__(self, answer: Callable[..., V], doc: str, *what: Any):
        def read(thing: Any) -> V:
            return answer(thing, *what)

        read.__annotations__, read.__doc__ = getattr(answer, "__annotations__", {}), doc
        super().__init__(read)

    if TYPE_CHECKING:

        def __get__(self, thing: Any, kind: type | None = None) -> V: ...  # type: ignore[override]


def view(
    address: int, shape: Sequence[int], owner: Any = None, writeable: bool = True, dtype: Any = float
) -> Table:
    """An array of doubles over the library's memory, without a copy; it keeps `owner` alive."""
    bytes_ = int(np.prod(shape, dtype=np.int64)) * np.dtype(dtype).itemsize
    if not bytes_:
        return np.empty(shape, dtype)
    memory: Any = (ctypes.c_char * bytes_).from_address(address)
    memory.owner = owner
    array: Table = np.ndarray(shape, dtype, buffer=memory)
    array.flags.writeable = writeable
    return array


def address_of(pointer: Any) -> int:
    return ctypes.cast(pointer, ctypes.c_void_p).value or 0


def plain(values: Any, name: str) -> Table:
    """`values` as an array; BadValue if an element is masked, as NumPy would use the hidden value."""
    if isinstance(values, (list, tuple)) and any(isinstance(item, np.ma.MaskedArray) for item in values):
        values = np.ma.array(values)
    if np.ma.is_masked(values):
        place = "".join(f"[{number}]" for number in np.argwhere(np.ma.getmaskarray(values))[0])
        raise BadValue(f"{name}{place}: is masked; give it a value or leave it out")
    return np.asarray(values)


def doubles(values: Any, name: str, *shapes: Sequence[int]) -> FloatArray:
    """`values` as contiguous doubles of the first of `shapes` that fits their shape, or of the size of one."""
    array = plain(values, name)
    if array.dtype.kind not in "iuf" and array.size:
        raise BadValue(f"{name}: numbers are needed, these are {array.dtype}")
    array = np.ascontiguousarray(array, dtype=np.float64)
    if shapes and not any(array.shape == tuple(shape) for shape in shapes):
        allowed = " or ".join(str(tuple(shape)) for shape in shapes)
        raise BadValue(f"{name}: its shape is {array.shape}, allowed is {allowed}")
    return array


def rows(values: Any, name: str, count: int) -> FloatArray:
    """`values` as `count` rows of x y z, given so or flat."""
    return doubles(values, name, (count, 3), (3 * count,))


def indices(values: Any, name: str) -> IntArray:
    """`values` as contiguous 64-bit indices; fractions are refused rather than truncated."""
    array = plain(values, name)
    if array.size and array.dtype.kind not in "iu":
        raise BadValue(f"{name}: whole numbers are needed, these are {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.int64)


def double_pointer(array: FloatArray) -> Any:
    """Contiguous doubles as an argument, which keeps the array alive."""
    try:
        buffer: Any = array
        return ctypes.c_double.from_buffer(buffer)  # ten times faster
    except (TypeError, ValueError):  # read-only or empty
        return array.ctypes.data_as(DOUBLES)


def index_pointer(array: IntArray) -> Any:
    return array.ctypes.data_as(INTEGERS)


def text(value: bytes | None) -> str:
    return "" if value is None else value.decode("utf-8", "replace")
