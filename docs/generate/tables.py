"""The reference of measurements, from the tables of results in the library."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from scenes import cell

INTRO = """# Measurement reference

The tables that each kind of measurement has, with their columns, as `hooke_measurement_number()` and its like, files in
JSON, CSV and HDF5, and `--json` name them. A record has one row, or none where there is nothing to say. Series have a
number for every frame; they are in HDF5 files and for programs. In Python rows are structured arrays with the same names:

```python
import hooke

found = hooke.needs("examples/scenes/cantilever.json", 1e-3, duration=0.1)
print(found.rows.dtype.names)
```"""


def words(ask: Any, *place: Any) -> Iterator[Any]:
    """A function for each entry of a list of the library, which takes what is asked of it."""
    number = 0
    while ask(*place, number, b"name"):
        yield lambda what, number=number: (ask(*place, number, what.encode()) or b"").decode()
        number += 1


def columns(lib: Any, kind: bytes, table: bytes) -> list[str]:
    lines = ["| column | meaning | type | unit |", "| --- | --- | --- | --- |"]
    for column in words(lib.hooke_measurement_column, kind, table):
        lines.append(f"| `{column('name')}` | {cell(column('doc'))} | {column('type')} | {column('unit')} |")
    return lines


def page() -> str:
    from hooke._library import lib

    lines = [INTRO]
    for kind in words(lib.hooke_measurement_table, None):
        name = kind("name").encode()
        lines.append(f"\n## {kind('name')}")
        for table in words(lib.hooke_measurement_table, name):
            doc = table("doc")
            lines += [f"\n### {table('name')} of {kind('name')}", f"\n{doc[0].upper()}{doc[1:]} ({table('shape')}).\n"]
            lines += columns(lib, name, table("name").encode())
    return "\n".join(lines) + "\n"
