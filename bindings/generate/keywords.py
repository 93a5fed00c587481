"""The module of the Python package with the keywords of functions, from options.json, which has the tables of options of the
library and which schema.py writes."""

import json
import textwrap
from pathlib import Path

TABLES = Path(__file__).with_name("options.json")
INTRO = '''"""Keywords of functions that are options of the library; made from bindings/generate/options.json by
bindings/generate/keywords.py."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, TypedDict

from ._types import Numbers
'''
# The classes: their tables, what takes them, and the options that it has as parameters of its own.
CLASSES = {"run": ("a run", ()), "study": ("`hooke.study`", ("methods",)), "limit": ("`hooke.limit`", ("methods",)),
           "cost": ("`hooke.cost`", ()), "check": ("`hooke.check`", ()), "needs": ("`hooke.needs`", ("want", "watch")),
           "rest": ("`hooke.rest`", ()), "modes": ("`hooke.modes`", ("count",)), "view": ("`hooke.view`", ()),
           "verify": ("`hooke.verify`", ())}
OF_FILES = ("view", "verify")  # the others take options of a run, too
LISTS = ("methods", "watch")


def hint(row):
    """The type of an option in Python."""
    if row.type == "choice":
        return f"Literal[{', '.join(json.dumps(word) for word in row.words)}]"
    number = "int" if row.whole else "float | str" if row.units else "float"
    text = "str | Iterable[str]" if row.name in LISTS else "str"
    return {"number": number, "numbers": "Numbers", "flag": "bool", "text": text}[row.type]


def tables():
    """Types and descriptions of options, as options.json has them."""
    import hooke

    def words(row):
        unit, given = f" [{row.unit}]" if row.unit else "", f" (default {row.default})" if row.default else ""
        return f"{row.doc}{unit}{given}"

    return {kind: {row.name: [hint(row), words(row)] for row in hooke.options_of(kind).rows} for kind in CLASSES}


def written(kind, rows, run):
    """The class of a table."""
    of, own = CLASSES[kind]
    keys = {name: row for name, row in rows.items() if name not in own}
    base = "TypedDict" if kind == "run" or kind in OF_FILES else "RunKeywords"
    listed = [line for name, (_, words) in keys.items() for line in textwrap.wrap(
        f"- `{name}`: {words}", 114, initial_indent="    ", subsequent_indent="      ")]
    others = f"And those of a run: {', '.join(f'`{name}`' for name in run if name not in rows)}."
    also = textwrap.wrap(others, 114, initial_indent="    ", subsequent_indent="    ") if base != "TypedDict" else []
    return ["", "", f"class {kind.capitalize()}Keywords({base}, total=False):", f'    """Keywords of {of} that are options.', "",
            *listed, *([""] if listed and also else []), *also, '    """', "",
            *(f"    {name}: {kind} | None" for name, (kind, _) in keys.items())]


def module():
    """The text of the module."""
    found = json.loads(TABLES.read_text(encoding="utf-8"))
    lines = [line for kind, rows in found.items() for line in written(kind, rows, found["run"])]
    return INTRO + "\n".join(lines) + "\n"
