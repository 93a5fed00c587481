"""Notebooks as pages of the site: their cells, run in order, with what each shows."""

from __future__ import annotations

import ast
import contextlib
import html
import io
import json
import os
import re
import tempfile
import warnings
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple


class Cell(NamedTuple):
    """A cell as it was run: "markdown" or "code", its source, what it printed, and what its last line shows."""

    kind: str
    source: str
    printed: str
    shown: Any


def cells(path: Path) -> list[tuple[str, str]]:
    """Kinds and sources."""
    return [(cell["cell_type"], "".join(cell["source"])) for cell in json.loads(path.read_text("utf-8"))["cells"]]


def code(path: Path) -> str:
    """That of all cells, as one program."""
    return "\n".join(source for kind, source in cells(path) if kind == "code") + "\n"


def run(path: Path) -> Iterator[Cell]:
    """Runs the cells in a folder of their own, as a notebook does."""
    os.environ.setdefault("MPLBACKEND", "Agg")
    before, names, all_cells = Path.cwd(), {"__name__": "__main__"}, cells(path)
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        os.chdir(folder)
        try:
            for kind, source in all_cells:
                yield Cell(kind, source, *(_run(source, names, path.name) if kind == "code" else ("", None)))
        finally:
            os.chdir(before)


def _run(source: str, names: dict[str, Any], name: str) -> tuple[str, Any]:
    tree, printed, shown = ast.parse(source), io.StringIO(), None
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        exec(compile(tree, name, "exec"), names)
        if last is not None:
            shown = eval(compile(ast.Expression(last.value), name, "eval"), names)
    return printed.getvalue(), shown


def page(path: Path, folder: Path) -> str:
    """The text of a page; pictures and pages of its results go into `folder`."""
    import matplotlib.pyplot as plt

    lines: list[str] = []
    for number, cell in enumerate(run(path)):
        name = f"notebook-{path.stem}-{number}"
        if cell.kind == "markdown":
            lines += [cell.source, ""]
            continue
        lines += ["```python", cell.source, "```", ""]
        if cell.printed:
            lines += ["```text", cell.printed.rstrip(), "```", ""]
        figures = [plt.figure(number) for number in plt.get_fignums()]
        for figure in figures:
            figure.savefig(folder / f"{name}.png", dpi=90)
            lines += ["```{raw} html", f'<img src="../{name}.png" alt="the picture that this cell draws">', "```", ""]
        plt.close("all")
        if not figures and cell.shown is not None:
            lines += ["```{raw} html", _markup(cell.shown, folder / f"{name}.html"), "```", ""]
    return "\n".join(lines)


def _markup(value: Any, file: Path) -> str:
    """What a notebook shows of a value; the page in a frame is a file."""
    markup = getattr(value, "_repr_html_", lambda: None)() or f"<pre>{html.escape(repr(value))}</pre>"
    frame = re.search('<iframe srcdoc="([^"]*)"', markup)
    if frame:
        file.write_text(html.unescape(frame[1]), "utf-8")
        markup = markup[: frame.start()] + f'<iframe class="view" src="../{file.name}"' + markup[frame.end() :]
    return markup.replace(' sandbox="allow-scripts allow-downloads"', "").replace("height:720px", "").replace("height:480px", "")
