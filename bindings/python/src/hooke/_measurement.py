"""The common part of all measurements: creating one, running it, and reading its tables as NumPy arrays."""

from __future__ import annotations

import copyreg
import ctypes
import functools
import itertools
import operator
import os
import pathlib
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from ._callback import listening
from ._library import lib
from ._look import draw
from ._memory import Asked, Handle, address_of, text, view
from ._status import OUTCOMES, BadCall, NotBuilt, plain
from ._types import FloatArray, Path, Table
from .system import kept

F = TypeVar("F", bound="Found")
R = TypeVar("R", bound="Record")


class Column(NamedTuple):
    """A column of a table: "number", "count", "flag", "text" or "series", its unit and what it says."""

    type: str
    unit: str
    doc: str


@functools.lru_cache
def columns(kind: str, table: str) -> dict[str, Column]:
    """The columns of a table of a kind, by name."""
    found: dict[str, Column] = {}
    of, key = lib.hooke_measurement_column, (kind.encode(), table.encode())
    while name := of(*key, len(found), b"name"):
        found[text(name)] = Column(*(text(of(*key, len(found), what.encode())) for what in Column._fields))
    return found


def described(kind: str, table: str, without: tuple[str, ...] = ()) -> str:
    """What the columns of a table say, for a docstring."""
    shown = ((name, *column[1:]) for name, column in columns(kind, table).items() if name not in without)
    lines = (f"- `{name}`: {doc}{f' [{unit}]' if unit else ''}" for name, unit, doc in shown)
    return "\n".join(textwrap.fill(line, 110, subsequent_indent="  ") for line in lines)


class Record(tuple[Any, ...]):
    """A row of a table of results: a tuple with a name for each column but series, and for what a class has `also`.
    Numbers that do not apply or are not known are NaN, flags None, and so is what a class names in `none`."""

    _fields: tuple[str, ...]
    _none: tuple[str, ...]

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    def __init_subclass__(
        cls, table: str, also: tuple[str, ...] = (), without: tuple[str, ...] = (), none: tuple[str, ...] = ()
    ) -> None:
        kind, _, name = table.partition(".")
        there = [one for one, column in columns(kind, name).items() if column.type != "series" and one not in without]
        cls._fields, cls._none = (*there, *also), none
        cls.__doc__ = f"{cls.__doc__}\n\n{described(kind, name, without)}"
        for place, field in enumerate(cls._fields):
            column = columns(kind, name).get(field)
            setattr(cls, field, property(operator.itemgetter(place), doc=column and column.doc))

    def __new__(cls: type[R], **values: Any) -> R:
        return tuple.__new__(cls, ((values[name] or None) if name in cls._none else values[name] for name in cls._fields))

    def __getnewargs_ex__(self) -> tuple[tuple[()], dict[str, Any]]:
        return (), self._asdict()

    def __repr__(self) -> str:
        return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in self._asdict().items())})"

    def _asdict(self) -> dict[str, Any]:
        return dict(zip(self._fields, self))

    def _replace(self: R, **values: Any) -> R:
        return type(self)(**{**self._asdict(), **values})


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
        return cls(Handle.made(parent, create, *arguments))

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

    def unit(self, table: str, column: str) -> str:
        """That of a column; empty if it has none here."""
        return text(lib.hooke_measurement_unit(self.handle, table.encode(), column.encode()))

    def series(self, table: str, row: int, column: str) -> FloatArray | None:
        """A series as an array of its own; None if there is none."""
        count = ctypes.c_int64()
        pointer = lib.hooke_measurement_series(
            self.handle, table.encode(), row, column.encode(), ctypes.byref(count)
        )
        return view(address_of(pointer), (count.value,)).copy() if pointer else None

    def value(self, table: str, row: int, column: str) -> Any:
        """A number, a text, or a flag: True, False, or None if unknown."""
        kind = columns(self.kind, table).get(column, Column("number", "", "")).type
        if kind == "text":
            return self.text(table, row, column)
        number = self.number(table, row, column)
        if np.isnan(number):
            return None if kind == "flag" else number
        return bool(number) if kind == "flag" else int(number) if kind == "count" else number

    def record(self, table: str) -> dict[str, Any]:
        """The values of a record by name, without series; {} if there is none."""
        names = columns(self.kind, table).items() if self.count(table) > 0 else ()
        return {name: self.value(table, 0, name) for name, column in names if column.type != "series"}

    def each(self, kind: type[R], table: str, **others: Any) -> list[R]:
        """The rows of a table, each with `others`; what the table has no column for is NaN."""
        names = [name for name in kind._fields if name not in others]
        rows = range(self.count(table))
        return [kind(**{name: self.value(table, row, name) for name in names}, **others) for row in rows]

    def one(self, kind: type[R], table: str, **others: Any) -> R | None:
        """A record; None if there is none."""
        return next(iter(self.each(kind, table, **others)), None)

    def rows(self, table: str) -> Table:
        """A structured array with a field for each column but series; flags are bool if all are known."""
        count = self.count(table)
        fields = []
        for name, (kind, *_) in columns(self.kind, table).items():
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

    def label(self, **labels: str | None) -> None:
        """Sets labels, such as the title of a page."""
        for what, label in labels.items():
            lib.hooke_measurement_label(self.handle, what.encode(), label.encode() if label else None)

    def __reduce__(self) -> Any:
        kind, tables = self.kind.encode(), itertools.count()
        of, read = lib.hooke_measurement_table, {"text": self.text, "series": self.series}
        values = {
            (table, name): (self.unit(table, name), [read.get(column.type, self.number)(table, row, name) for row in rows])
            for table in map(text, iter(lambda: of(kind, next(tables), b"name"), None))
            for rows in [range(self.count(table))]
            for name, column in columns(self.kind, table).items()
        }
        return Kept, (self.kind, values)


class Kept(Measurement):
    """The tables of a measurement of another process, all that a pickle holds of it."""

    def __init__(self, kind: str, values: dict[tuple[str, str], tuple[str, list[Any]]]):
        self.kind, self._values = kind, values

    def __reduce__(self) -> Any:
        return Kept, (self.kind, self._values)

    @property
    def handle(self) -> Handle:  # type: ignore[override]
        raise BadCall(f"this {self.kind} was pickled, which keeps its tables alone; measure again for more")

    def count(self, table: str) -> int:
        return max((len(values) for (of, _), (_, values) in self._values.items() if of == table), default=0)

    def _value(self, table: str, row: int, column: str, none: Any) -> Any:
        values = self._values.get((table, column), ("", []))[1]
        return values[row] if row < len(values) else none

    def number(self, table: str, row: int, column: str) -> float:
        return float(self._value(table, row, column, np.nan))

    def text(self, table: str, row: int, column: str) -> str:
        return str(self._value(table, row, column, ""))

    def unit(self, table: str, column: str) -> str:
        return self._values.get((table, column), ("", []))[0]

    def series(self, table: str, row: int, column: str) -> FloatArray | None:
        found: FloatArray | None = self._value(table, row, column, None)
        return found if found is None else found.copy()


class Claim(Record, table="study.claims"):
    """A sentence about results."""


def said(claims: Sequence[Claim]) -> str:
    """The texts of claims, a line each; foreign names in them are made plain."""
    return "\n".join(plain(claim.text) for claim in claims)


class Found:
    """A finished measurement with rows, of a scene if it was made of one. The columns of the record of its `kind` are its
    attributes."""

    _rows: str  # the table that they are
    _untitled = ""  # the heading of a page without a title

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any: ...

    def __init_subclass__(cls, kind: str = "", rows: str = "rows") -> None:
        if kind:
            cls._rows = rows
            cls.__doc__ = f"{cls.__doc__}\n\n{described(kind, kind)}\n\n`rows`, by name:\n\n{described(kind, rows)}"

    def __init__(self, found: Measurement, scene: Any, system: Any, status: int):
        self._handle, self._scene = found, scene
        self._system = system  # its callbacks have to live as long as the measurement
        self.outcome: str = OUTCOMES.get(status, "stopped")
        self.rows: Table = found.rows(self._rows)
        vars(self).update(found.record(found.kind))
        self._read(found)

    def __reduce__(self) -> Any:
        state = {**vars(self), "_handle": self._handle, "_scene": None, "_system": kept(self._system), "_progress": None}
        return copyreg.__newobj__, (type(self),), state  # type: ignore[attr-defined]

    def __copy__(self: F) -> F:
        made = type(self).__new__(type(self))
        vars(made).update(vars(self))
        return made

    def __deepcopy__(self: F, memo: Any) -> F:
        """It shares what it does not change."""
        return self.__copy__()

    @property
    def claims(self) -> list[Claim]:
        """What the results say, the most important first; `str()` has their texts, a line each."""
        return self._handle.each(Claim, "claims")

    def __str__(self) -> str:
        return said(self.claims)

    def _read(self, found: Measurement) -> None:
        """Reads what a kind has beside its rows and its record."""

    def __getitem__(self, name: str) -> np.void:
        """The first row that has this name in the first column."""
        names = self.rows[self.rows.dtype.names[0]].tolist() if self.rows.dtype.names else []
        if name not in names:
            raise KeyError(f"{name!r}; there are {', '.join(names)}")
        row: np.void = self.rows[names.index(name)]
        return row

    def write(self, path: Path, title: str | None = None) -> None:
        """Writes the results in the format given by the ending of `path`: .csv, the rows; .json or .h5, all tables; .html,
        the page to read with the heading `title` (that of the scene, if None)."""
        title = title or (self._scene.title if self._scene else "") or self._untitled
        text = self._scene.text if self._scene else None
        self._handle.label(title=title or None, scene=text)
        lib.hooke_measurement_write(self._handle.handle, os.fsencode(path))

    def _repr_html_(self) -> str | None:
        shown: str | None = draw("notebook.table", self.rows, str(self))
        return shown

    def report(self, path: Path) -> pathlib.Path:
        """Writes a page to look at, offline, and returns its path."""
        page = pathlib.Path(os.fspath(path))
        draw("notebook.page", page, type(self).__name__, self.rows, str(self))
        return page

    def to_pandas(self) -> Any:
        """The rows as a pandas data frame; pandas has to be installed."""
        return draw("notebook.data_frame", self.rows)


def _methods(found: Found) -> list[str]:
    return [str(name) for name in dict.fromkeys(found.rows["method"])]


methods_of_rows = Asked(_methods, "The methods with rows, in the order of the rows.")


class Paged(Found):
    """One with a page of its own, which a notebook shows."""

    def _repr_html_(self) -> str | None:
        try:
            shown: str = draw("notebook.embed", self.write)
            return shown
        except (BadCall, NotBuilt):  # of another process, or without what draws
            return super()._repr_html_()

    def report(self, path: Path) -> pathlib.Path:
        """Writes the page to look at, offline, and returns its path, which ends in ``.html``."""
        page = pathlib.Path(os.fspath(path))
        if page.suffix != ".html":
            raise ValueError(f"{page}: a page ends in .html")
        self.write(page)
        return page
