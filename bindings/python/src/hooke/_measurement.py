"""The common part of all measurements: creating one, running it, and reading its tables as NumPy arrays."""

from __future__ import annotations

import ctypes
import functools
import os
import pathlib
from collections.abc import Mapping
from typing import Any, Callable, TypeVar

import numpy as np

from ._callback import listening
from ._library import lib
from ._memory import Handle, address_of, text, view
from ._notebook import Tabled, embed
from ._prototypes import MEASUREMENT
from ._status import OUTCOMES
from ._types import FloatArray, Path, Table

R = TypeVar("R")


class Measurement:
    """A measurement of the library, and its tables. `system` has to outlive it."""

    def __init__(self, handle: Handle):
        self.handle = handle
        self.kind = text(lib.hooke_measurement_kind(handle))

    @classmethod
    def create(cls, kind: str, system: Any, run: Any, options: Any) -> Measurement:
        given = kind.encode(), system._committed(), run and run._handle, options._handle
        return cls.made(system._handle, lib.hooke_measurement_create, *given)

    @classmethod
    def made(cls, parent: Handle | None, create: Any, *arguments: Any) -> Measurement:
        """What a function of the library makes."""
        return cls(Handle.made(MEASUREMENT, lib.hooke_measurement_destroy, parent, create, *arguments))

    def run(self, progress: Any, state: Any = None) -> int:
        """Runs it and returns the status."""
        with self.listening(progress):
            return int(lib.hooke_measurement_run(self.handle, state and state._handle))

    def listening(self, progress: Any) -> Any:
        """A context in which `progress` is called during the work."""
        return listening(lib.hooke_measurement_on_progress, self.handle, progress)

    # ---- tables ----

    def count(self, table: str) -> int:
        return int(lib.hooke_measurement_row_count(self.handle, table.encode()))

    def number(self, table: str, row: int, column: str) -> float:
        return float(lib.hooke_measurement_number(self.handle, table.encode(), row, column.encode()))

    def text(self, table: str, row: int, column: str) -> str:
        """A text; empty if there is none."""
        return text(lib.hooke_measurement_text(self.handle, table.encode(), row, column.encode()))

    def series(self, table: str, row: int, column: str) -> FloatArray | None:
        """A series as an array of its own; None if there is none."""
        count = ctypes.c_int64()
        pointer = lib.hooke_measurement_series(
            self.handle, table.encode(), row, column.encode(), ctypes.byref(count)
        )
        return view(address_of(pointer), (count.value,)).copy() if pointer else None

    def value(self, table: str, row: int, column: str) -> Any:
        """A number, a text, or a flag: True, False, or None if unknown."""
        kind = columns(self.kind, table)[column]
        if kind == "text":
            return self.text(table, row, column)
        number = self.number(table, row, column)
        if kind == "flag":
            return None if np.isnan(number) else bool(number)
        return number

    def record(self, table: str) -> dict[str, Any] | None:
        """The one row of a record; None if there is none."""
        if self.count(table) < 1:
            return None
        return {name: self.value(table, 0, name) for name, kind in columns(self.kind, table).items() if kind != "series"}

    def one(self, kind: Any, table: str, **others: Any) -> Any:
        """A record as a named tuple, whose fields are columns or `others`; None if there is none."""
        found = self.record(table)
        return None if found is None else kind(**typed(kind, {**found, **others}))

    def each(self, kind: Callable[..., R], table: str) -> list[R]:
        """Its rows as named tuples, whose fields are columns."""
        rows = self.rows(table)
        return [kind(**typed(kind, dict(zip(rows.dtype.names or (), row)))) for row in rows.tolist()]

    def rows(self, table: str) -> Table:
        """A structured array with a field for each column but series; flags are bool if all are known."""
        count = self.count(table)
        fields = []
        for name, kind in columns(self.kind, table).items():
            if kind == "series":
                continue
            read = self.text if kind == "text" else self.number
            values = np.array([read(table, row, name) for row in range(count)], None if count else float)
            if kind == "text":
                values = np.asarray(values, f"U{max(32, max((len(v) for v in values), default=0))}")
            elif kind == "flag" and not np.isnan(values).any():
                values = values.astype(bool)
            fields.append((name, values))
        made = np.empty(count, [(name, values.dtype) for name, values in fields])
        for name, values in fields:
            made[name] = values
        made.flags.writeable = False
        return made

    # ---- files ----

    def label(self, **labels: str | bytes | None) -> None:
        """Sets labels, such as the title of a page."""
        for what, label in labels.items():
            encoded = label.encode() if isinstance(label, str) else label
            lib.hooke_measurement_label(self.handle, what.encode(), encoded)

    def write(self, path: Path, **labels: str | bytes | None) -> None:
        """Writes the results in the format given by the ending of `path`: .csv, .json, .h5 or .html."""
        self.label(**labels)
        lib.hooke_measurement_write(self.handle, os.fsencode(path))


class Found(Tabled):
    """A finished measurement with rows, of a scene if it was made of one. It has the attributes that the record of the
    kind's own name has columns for."""

    outcome: str
    _untitled = ""  # the heading of a page without a title

    def __init__(self, found: Measurement, scene: Any, system: Any, status: int):
        self._handle, self._scene = found, scene
        self._system = system  # its callbacks have to live as long as the measurement
        self.outcome = OUTCOMES.get(status, "stopped")
        self.rows = found.rows("rows")
        vars(self).update(typed(type(self), found.record(found.kind) or {}))

    def write(self, path: Path, title: str | None = None) -> None:
        """Writes the results in the format given by the ending of `path`: .csv, the rows; .json or .h5, all tables; .html,
        the page to read with the heading `title` (that of the scene, if None)."""
        title = title or (self._scene.title if self._scene else "") or self._untitled
        text = self._scene.text if self._scene else None
        self._handle.write(path, title=title or None, scene=text)


class Paged(Found):
    """One with a page of its own, which a notebook shows."""

    def _repr_html_(self) -> str:
        return embed(self.write, 720)

    def report(self, path: Path) -> pathlib.Path:
        """Writes the page to look at, offline, and returns its path, which ends in ``.html``."""
        page = pathlib.Path(os.fspath(path))
        if page.suffix != ".html":
            raise ValueError(f"{page}: a page ends in .html")
        self.write(page)
        return page


#: How a column is read for an attribute of these types; others are taken as they are.
_TYPES: dict[str, Callable[[Any], Any]] = {
    "int": lambda number: int(np.nan_to_num(number)),
    "int | None": lambda number: None if np.isnan(number) else int(number),
    "str | None": lambda word: word or None,
}


def typed(kind: Any, values: Mapping[str, Any]) -> dict[str, Any]:
    """Those of some values that a class has attributes for, by their names, as the types that it declares for them."""
    types = {name: getattr(type_, "__forward_arg__", type_) for name, type_ in kind.__annotations__.items()}
    return {name: _TYPES.get(types[name], lambda value: value)(values[name]) for name in types if name in values}


@functools.lru_cache
def columns(kind: str, table: str) -> dict[str, str]:
    """The types of the columns of a table of a kind, by name."""
    found: dict[str, str] = {}
    while name := lib.hooke_measurement_column(kind.encode(), table.encode(), len(found), b"name"):
        found[text(name)] = text(lib.hooke_measurement_column(kind.encode(), table.encode(), len(found), b"type"))
    return found
