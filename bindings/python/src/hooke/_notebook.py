"""Results in notebooks: their pages, embedded, or tables where there is no page."""

from __future__ import annotations

import html
import importlib
import os
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ._status import plain
from ._types import Table

_DOCUMENT = """<!DOCTYPE html><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title}</title><style>body{{font:15px system-ui;margin:2em}}td,th{{padding:2px 10px;text-align:right}}</style>
<h1>{title}</h1>{table}
"""


def embed(write: Callable[[Path], Any], height: int) -> str:
    """A frame for a notebook with the page that `write(path)` makes; `height` in pixels. Everything is in it."""
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder, "page.html")
        write(page)
        source = html.escape(page.read_text("utf-8"))
    style = f"width:100%;height:{height}px;border:0"
    return f'<iframe srcdoc="{source}" style="{style}" sandbox="allow-scripts allow-downloads"></iframe>'


def table(rows: Table) -> str:
    """An HTML table of a structured array, numbers with six digits."""

    def cell(value: Any) -> str:
        if isinstance(value, (float, np.floating)):
            return "" if np.isnan(value) else f"{value:.6g}"
        return html.escape(str(value))

    names = rows.dtype.names or ()
    lines = ["".join(f"<td>{cell(row[name])}</td>" for name in names) for row in rows]
    head = "".join(f"<th>{html.escape(name)}</th>" for name in names)
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    return f'<div style="overflow-x:auto"><table><tr>{head}</tr>{body}</table></div>'


def draw(what: str, *arguments: Any, **options: Any) -> Any:
    """Calls a function of `hooke.plot` or `hooke.animation`; matplotlib is an extra, and slow to import."""
    module, name = what.split(".")
    return getattr(importlib.import_module(f"{__package__}.{module}"), name)(*arguments, **options)


def named(rows: Table, column: str, name: str) -> np.void:
    """The first row that has a name in a column."""
    names = rows[column].tolist()
    if name not in names:
        raise KeyError(f"{name!r}; there are {', '.join(names)}")
    row: np.void = rows[names.index(name)]
    return row


def lined(heads: Sequence[str], rows: Sequence[Sequence[Any]]) -> list[str]:
    """A table as lines of text; numbers that are not known are "-", and what is not limited is "none"."""

    def cell(value: Any) -> str:
        if isinstance(value, str):
            return plain(value)
        return "-" if np.isnan(value) else "none" if np.isinf(value) else f"{value:.6g}"

    cells = [list(heads), *([cell(value) for value in row] for row in rows)]
    first, *widths = (max(map(len, column)) for column in zip(*cells))
    lines = (f"{name:{first}}" + "".join(f"{word:>{width + 2}}" for word, width in zip(words, widths)) for name, *words in cells)
    return [line.rstrip() for line in lines]


def of_methods(rows: Table, *columns: str) -> str:
    """Rows of methods as text, with these columns."""
    names = ["method", "status", *columns]
    return "\n".join(lined(names, rows[names].tolist()))


class Tabled:
    """A result with rows, which a notebook shows as a table."""

    rows: Table

    def _repr_html_(self) -> str | None:
        return table(self.rows)

    def report(self, path: str | os.PathLike[str]) -> Path:
        """Writes a page to look at, offline, and returns its path."""
        page = Path(os.fspath(path))
        page.write_text(_DOCUMENT.format(title=type(self).__name__, table=table(self.rows)), "utf-8")
        return page

    def to_pandas(self) -> Any:
        """The rows as a pandas data frame; pandas has to be installed."""
        import pandas

        return pandas.DataFrame.from_records(self.rows)
