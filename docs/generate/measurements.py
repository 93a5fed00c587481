"""Writes the reference of measurements: every kind with its tables and columns, as the library lists them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Callable

INTRO = """# Measurements reference

The tables of every kind of measurement, as `hooke_measurement_table()` and `hooke_measurement_column()` list
them. C, Fortran, Python, JSON and files of results have these names. A record has one row, or none where there
is no result.

```console
$ hooke limit examples/scenes/rope.json --predict --json
```"""


def listed(ask: Callable[[int, bytes], bytes | None], *words: str) -> Iterator[list[str]]:
    """Values of `ask(k, word)` for each of `words`, for k from 0 on until there is none."""
    k = 0
    while ask(k, words[0].encode()):
        yield [(ask(k, word.encode()) or b"").decode() for word in words]
        k += 1


def table(kind: bytes, name: str, doc: str, shape: str) -> str:
    from hooke._library import lib

    lines = [f"### {name}", "", ("A record: " + doc if shape == "record" else doc[0].upper() + doc[1:]) + ".", ""]
    lines += ["| column | unit | type | meaning |", "| --- | --- | --- | --- |"]
    columns = listed(lambda k, what: lib.hooke_measurement_column(kind, name.encode(), k, what), "name", "unit", "type", "doc")
    return "\n".join(lines + [f"| `{column}` | {unit} | {sort} | {text} |" for column, unit, sort, text in columns])


def of_kind(kind: str) -> str:
    from hooke._library import lib

    tables = listed(lambda k, what: lib.hooke_measurement_table(kind.encode(), k, what), "name", "doc", "shape")
    return "\n\n".join([f"## {kind}", *(table(kind.encode(), *words) for words in tables)])


def page() -> str:
    from hooke._library import lib

    kinds = listed(lambda k, what: lib.hooke_measurement_table(None, k, what), "name")
    return "\n\n".join([INTRO, *(of_kind(kind) for (kind,) in kinds)]) + "\n"
