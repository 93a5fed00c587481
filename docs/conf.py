"""Settings of Sphinx for the site that `make docs` builds. Pages are plain Markdown; those of the references are
generated; docs/index.md gives their order."""

from __future__ import annotations

import re
from pathlib import Path

HERE = Path(__file__).parent

project = "hooke"
release = re.search(r'HOOKE_VERSION "(.+)"', (HERE.parent / "include/hooke/base.h").read_text("utf-8"))[1]
copyright = "the authors of hooke, MIT licence"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
exclude_patterns = ["README.md"]
nitpicky = True

html_theme = "furo"
html_title = f"hooke {release}"
html_copy_source = False
html_show_sourcelink = False
templates_path: list[str] = []

# The page of `make playground`, where it was made.
LIVE = HERE.parent / "build/playground/live.html"
html_extra_path = [str(LIVE)] if LIVE.exists() else []
FRONT = """```{raw} html
<p>Drag the step to the right until the cloth blows up. This is hooke itself, in the browser
(<a href="live.html">in a window of its own</a>).</p>
<style>
#live { width: 100%; height: 640px; border: 0 }
@media (max-width: 700px) { #live { height: 880px } }
</style>
<iframe id="live" src="live.html#front" title="A cloth that hooke integrates in the browser"></iframe>
```
"""


def navigation(index: str) -> str:
    """Makes tables of contents from the lists of links under the headings of the first page."""
    found = []
    for section in re.split(r"^## ", index, flags=re.MULTILINE)[1:]:
        pages = re.findall(r"^- \[[^\]]+\]\(([\w/-]+)\.md\)", section, flags=re.MULTILINE)
        if pages:
            lines = ["```{toctree}", ":hidden:", f":caption: {section.splitlines()[0]}", "", *pages, "```"]
            found.append("\n".join(lines))
    return "\n\n".join(found)


def adapt(app, name, source) -> None:
    """Adds tables of contents, removes the addresses of links to files that are not on the site, and fills in the links
    of the page about the references."""
    if name == "index":
        if LIVE.exists():
            title, rest = source[0].split("\n\n", 1)
            source[0] = f"{title}\n\n{FRONT}\n{rest}"
        source[0] += "\n\n" + navigation(source[0]) + "\n"
    if not name.startswith("reference/"):
        source[0] = re.sub(r"\[([^\]]*)\]\(\.\./[^)]*\)", r"\1", source[0])
    if name == "playground" and LIVE.exists():
        source[0] = source[0].replace("`build/playground/live.html`", '<a href="live.html">live.html</a>')
    if name == "reference":
        pages = re.findall(r"`(reference/[\w-]+)\.md`", source[0])
        source[0] = re.sub(r"`(reference/([\w-]+)\.md)`", r"[\2](\1)", source[0])
        source[0] += "\n\n" + "\n".join(["```{toctree}", ":hidden:", "", *pages, "```"]) + "\n"


def setup(app) -> None:
    app.connect("source-read", adapt)
