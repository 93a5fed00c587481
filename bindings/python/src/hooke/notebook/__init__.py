"""Results in notebooks: their pages, embedded, or tables where there is no page; and bars of progress."""

from __future__ import annotations

import contextlib
import html
import importlib
import tempfile
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from .. import Error, Scene, run, view
from .._status import plain
from .._types import Table

_DOCUMENT = """<!DOCTYPE html><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>{title}</title><style>body{{font:15px system-ui;margin:2em}}td,th{{padding:2px 10px;text-align:right}}</style>
<h1>{title}</h1>{table}
"""


def embed(write: Callable[[Path], Any], height: int = 720) -> str:
    """A frame for a notebook with the page that `write(path)` makes; `height` in pixels. Everything is in it."""
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder, "page.html")
        write(page)
        source = html.escape(page.read_text("utf-8"))
    style = f"width:100%;height:{height}px;border:0"
    return f'<iframe srcdoc="{source}" style="{style}" sandbox="allow-scripts allow-downloads"></iframe>'


def still(problem: Any) -> str | None:
    """A frame with a scene or a system at its start; None if it is not committed and has no text. A scene stays open."""
    scene = problem if isinstance(problem, Scene) else None
    system = problem if scene is None else scene.system
    try:
        if not system.is_committed:
            if scene is None:
                return None
            scene = Scene.parse(scene.text)
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a run that nobody asked for
            method = "symplectic-euler" if system.dynamics == "inertial" else "rk4"
            path, shown = Path(folder, "start.h5"), scene or system
            run(shown, method=method, step=1e-9, every=1e-9, duration=1e-9, output=path, estimate=False)
            return embed(lambda page: view(path, page, title=scene.title if scene else "system"), 480)
    except Error:
        return None  # what cannot be shown is told of in words


def paragraphs(lines: str) -> str:
    """Lines of text as paragraphs of HTML."""
    return "".join(f"<p>{html.escape(line)}</p>" for line in lines.splitlines())


def table(rows: Table, words: str = "") -> str:
    """An HTML table of a structured array, numbers with six digits, below lines of text."""

    def cell(value: Any) -> str:
        if isinstance(value, (float, np.floating)):
            return "" if np.isnan(value) else f"{value:.6g}"
        return html.escape(str(value))

    names = rows.dtype.names or ()
    lines = ["".join(f"<td>{cell(row[name])}</td>" for name in names) for row in rows]
    head = "".join(f"<th>{html.escape(name)}</th>" for name in names)
    body = "".join(f"<tr>{line}</tr>" for line in lines)
    return paragraphs(words) + f'<div style="overflow-x:auto"><table><tr>{head}</tr>{body}</table></div>'


def page(path: Path, title: str, rows: Table, lines: str) -> None:
    """Writes a page with a table."""
    path.write_text(_DOCUMENT.format(title=title, table=table(rows, lines)), "utf-8")


def data_frame(rows: Table) -> Any:
    """A data frame of pandas."""
    try:
        import pandas
    except ImportError:
        raise ImportError("to_pandas() gives a data frame of pandas, which is not installed: pip install pandas") from None

    return pandas.DataFrame.from_records(rows)


@contextlib.contextmanager
def bar() -> Iterator[Callable[[float, Any], None]]:
    """A bar of tqdm; gives the function that is told the fraction done and the name of the running task."""
    try:
        tqdm: Any = importlib.import_module("tqdm.auto")
    except ImportError:
        raise ImportError(
            'progress=True shows a bar of tqdm, which is not installed: pip install "libhooke[progress]"; '
            "a function of your own, progress=f, needs nothing"
        ) from None
    with tqdm.tqdm(total=1.0, bar_format="{l_bar}{bar}| {elapsed}<{remaining}{postfix}") as shown:

        def tell(fraction: float, what: Any) -> None:
            if isinstance(what, str):
                shown.set_postfix_str(plain(what), refresh=False)
            shown.update(max(fraction - shown.n, 0.0))

        yield tell
