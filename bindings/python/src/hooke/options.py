"""Named options: of a run, of a group of springs, of a part. They come from the library's tables."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, MutableMapping
from typing import Any, NamedTuple, Union

import numpy as np

from ._library import lib
from ._memory import Handle, Owner, address_of, double_pointer, doubles, plain, text, view
from ._status import BadCall, BadValue, placed
from ._types import Table

__all__ = ["Options", "Row", "describe", "options_of", "part_kind_summary", "part_kinds"]

Value = Union[None, bool, int, float, str, Table, list[Any]]


class Row(NamedTuple):
    """One option. Text is "" and a number None where there is none.

    `type` is "number", "numbers", "flag", "choice", "text" or "family"; `allowed` describes the allowed values;
    `words` are the choices, or the words allowed instead of numbers; `family` is the family of the option; `example`
    is a value for a first try. `low` and `high` are bounds of every number, inclusive unless `above_low`; `required`
    of a member of a family applies if the family is given; `min_count` and `max_count` bound the count of "numbers",
    in rows of `columns`, a single one `flat` as well; with `word_lists` words and numbers may be mixed; `units` are those
    that a text may name instead of `unit`; `only` are the words of a choice with which it may be given, `by` that choice
    ("": the first).
    """

    name: str
    type: str
    unit: str
    units: list[str]
    default: str
    allowed: str
    doc: str
    words: list[str]
    family: str
    example: str
    low: float | None
    high: float | None
    above_low: bool
    whole: bool
    required: bool
    min_count: int | None
    max_count: int | None
    columns: int | None
    flat: bool
    word_lists: bool
    only: str
    by: str


_TABLES: dict[str, dict[str, Row]] = {}  #: the rows of the tables that were read, by their names
_LISTS = ("methods", "watch", "probe")  #: texts that are lists of words


def _of_table(what: str) -> classmethod[Options, [], Options]:
    """A method of `Options` that makes those of one table."""

    def make(cls: type[Options]) -> Options:
        return cls._of(what)

    make.__doc__ = f"The options that ``hooke.describe(\"{what}\")`` lists."
    make.__name__, make.__qualname__ = f"for_{what}", f"Options.for_{what}"
    return classmethod(make)


class Options(Owner, MutableMapping[str, Any]):
    """The options of one thing by name: ``options["step"] = 1e-3``.

    A value is a number, a flag, a word, an array of numbers, a list where words and numbers are mixed, or None if
    there is neither a value nor a default. Setting None, or deleting, resets an option. A family of options (the
    springs of a part) is set by a dict and read by dotted names: ``options["stretch"] = {"stiffness": 50}``,
    ``options["stretch.stiffness"]``.

    Options of an integrator cannot be changed.
    """

    def __init__(self, handle: Handle, read_only: bool = False, table: str = "run"):
        self._handle = handle
        self._read_only = read_only
        self._table = table
        if table not in _TABLES:
            _TABLES[table] = {row.name: row for row in _rows(handle)}
        self._rows = _TABLES[table]

    @classmethod
    def _of(cls, table: str) -> Options:
        return cls(Handle.made(None, lib.hooke_options_create, table.encode()), table=table)

    @classmethod
    def _again(cls, table: str, values: dict[str, Value], read_only: bool) -> Options:
        made = cls._of(table)
        for name, value in values.items():
            made[name] = value
        made._read_only = read_only
        return made

    def __reduce__(self) -> Any:
        values = {name: "" if row.type == "family" else self[name] for name, row in self._rows.items() if self.is_set(name)}
        return Options._again, (self._table, values, self._read_only)

    for_run = _of_table("run")
    for_study = _of_table("study")
    for_limit = _of_table("limit")
    for_cost = _of_table("cost")
    for_why = _of_table("why")
    for_needs = _of_table("needs")
    for_springs = _of_table("springs")
    for_altitude = _of_table("altitude")
    for_anchors = _of_table("anchors")

    @classmethod
    def for_scene(cls, what: str = "scene") -> Options:
        """Options for other keys of a scene: of the "scene" itself (title, gravity, drag), of its "particles", of
        "driven" particles, or the "limits" of loading it."""
        return cls._of(what)

    @classmethod
    def for_part(cls, kind: str) -> Options:
        """Options of a part, such as a "rope" or a "cloth"."""
        return cls._of(kind)

    def copy(self) -> Options:
        """A copy with the same values."""
        return Options(Handle.made(None, lib.hooke_options_copy, self._handle), table=self._table)

    @property
    def rows(self) -> list[Row]:
        """The table: every option."""
        return list(self._rows.values())

    def is_set(self, name: str) -> bool:
        """Whether the option was set, rather than having its default or no value."""
        return bool(lib.hooke_options_is_set(self._handle, name.encode()))

    def __getitem__(self, name: str) -> Value:
        if name not in self._rows:
            raise KeyError(name)
        key = name.encode()
        words = text(lib.hooke_options_text(self._handle, key))
        count = lib.hooke_options_number_count(self._handle, key)
        if count == 0:
            return words or None
        numbers = view(
            address_of(lib.hooke_options_numbers(self._handle, key)), (count,), self._handle
        ).copy()
        if self._rows[name].type == "flag":
            return bool(numbers[0])
        if "whole number" in self._rows[name].allowed:
            numbers = numbers.astype(np.int64)
        if words:
            return [*words.split(), *numbers.tolist()]
        return numbers if count > 1 else float(numbers[0]) if numbers.dtype == float else int(numbers[0])

    def __setitem__(self, name: str, value: Any) -> None:
        if self._read_only:
            raise BadCall(
                "these are the options that an integrator runs with; make another integrator to change them"
            )
        key = name.encode()
        if name in _LISTS and isinstance(value, Iterable) and not isinstance(value, str):
            value = ",".join(map(str, value))
        if name in ("method", "methods") and isinstance(value, str):
            value = ",".join(_method_meant(name, word) for word in value.split(","))
        if value is None:
            lib.hooke_options_unset(self._handle, key)
        elif isinstance(value, str):
            lib.hooke_options_set_text(self._handle, key, value.encode())
        elif isinstance(value, Mapping):
            lib.hooke_options_set_text(self._handle, key, b"")
            for member, member_value in value.items():
                with placed(name):
                    self[f"{name}.{member}"] = member_value
        elif np.ndim(value) == 0:
            plain(value, name)
            lib.hooke_options_set_number(self._handle, key, as_number(name, value))
        elif has_words(value):
            flat = [item for row in value for item in (row if np.ndim(row) else [row])]
            words = ",".join(item if isinstance(item, str) else repr(as_number(name, item)) for item in flat)
            lib.hooke_options_set_text(self._handle, key, words.encode())
        else:
            numbers, columns = doubles(value, name), name in self._rows and self._rows[name].columns
            if columns and numbers.ndim > 1 and numbers.shape[-1] != columns:
                doubles(numbers, name, (numbers.size // columns, columns))  # says what is allowed
            lib.hooke_options_set_numbers(self._handle, key, numbers.size, double_pointer(numbers))

    def __delitem__(self, name: str) -> None:
        if name not in self._rows:
            raise KeyError(name)
        self[name] = None

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows)

    def __len__(self) -> int:
        return len(self._rows)

    def set(self, **values: Any) -> Options:
        """Sets options by keyword, without those that are None; ``from_`` means the option ``from``."""
        for name, value in values.items():
            if value is not None:
                self[option_name(name)] = value
        return self

    def describe(self) -> str:
        """The table as text."""
        lines = [
            f"{row.name:24} {row.allowed or row.type}{f' [{row.unit}]' if row.unit else ''}"
            f"{f', default {row.default}' if row.default else ''}: {row.doc}"
            for row in self.rows
        ]
        return "\n".join(lines)

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={self[name]!r}" for name in self if self.is_set(name))
        return f"Options({values})"


def _method_meant(option: str, word: str) -> str:
    """The name of a method of which another common name may be given; other words as they are."""
    meant = text(lib.hooke_method_meant(word.strip().encode()))
    if " " in meant:
        raise BadValue(f"{option}: {word!r} is no method; choose one of {', '.join(meant.split())}")
    return meant or word


def part_kinds() -> list[str]:
    """The kinds of parts: "rope", "cloth", "lattice", "mesh"."""
    names = (text(lib.hooke_part_kind(kind, b"name")) for kind in itertools.count())
    return list(itertools.takewhile(bool, names))


def part_kind_summary(kind: str) -> str:
    """One-line description of a kind of part."""
    return text(lib.hooke_part_kind(part_kinds().index(kind), b"summary"))


def options_of(what: str) -> Options:
    """The options of a "run", a "study", a "limit", a "cost", a "why", of "needs", of "springs", of "anchors", of a
    "scene" itself, of its "particles", of "driven" particles, or of a kind of part. Their `rows` are the table."""
    return Options._of(what)


def describe(what: str) -> str:
    """The table of `options_of` as text: names, units, defaults, bounds."""
    return options_of(what).describe()


def option_name(keyword: str) -> str:
    """The option of a keyword: ``from_`` means ``from``, which Python reserves."""
    return keyword[:-1] if keyword.endswith("_") else keyword


def has_words(value: Any) -> bool:
    """Whether words, such as numbers with units, are among the numbers of a list, or of its rows."""
    leaves = (item for row in value for item in (row if isinstance(row, (list, tuple)) else [row]))
    return not isinstance(value, np.ndarray) and any(isinstance(item, str) for item in leaves)


def in_units(table: str, key: str, value: Any) -> Any:
    """Numbers with units as those of an option; others as they are."""
    if not (isinstance(value, str) or (isinstance(value, (list, tuple)) and has_words(value))):
        return value
    chosen = Options._of(table)
    chosen[key] = value
    return np.reshape(chosen[key], np.shape(value))  # type: ignore[arg-type]


def as_number(name: str, value: Any) -> float:
    """`value` as a number; BadValue if it is not one."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise BadValue(f"{name}: a number is needed, this is {value!r}") from None


def _rows(handle: Handle) -> Iterator[Row]:
    for row in range(lib.hooke_options_row_count(handle)):
        yield Row(*(_property(handle, row, name) for name in Row._fields))


def _property(handle: Handle, row: int, name: str) -> Any:
    kind: Any = Row.__annotations__[name]
    kind = getattr(kind, "__forward_arg__", kind)
    if kind in ("str", "list[str]"):
        words = text(lib.hooke_options_row(handle, row, name.encode()))
        return words if kind == "str" else [word for word in words.split(", " if name == "units" else " ") if word]
    number = lib.hooke_options_row_number(handle, row, name.encode())
    return None if math.isnan(number) else {"bool": bool, "int | None": int, "float | None": float}[kind](number)
