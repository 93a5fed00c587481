"""How Sphinx makes the site: `make docs`. The pages are plain Markdown; docs/index.md orders them."""

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


def navigation(index: str) -> str:
    """Tables of contents from the lists of links under the headings of the first page, so that they are written once."""
    found = []
    for section in re.split(r"^## ", index, flags=re.MULTILINE)[1:]:
        pages = re.findall(r"^- \[[^\]]+\]\(([\w/-]+)\.md\)", section, flags=re.MULTILINE)
        if pages:
            lines = ["```{toctree}", ":hidden:", f":caption: {section.splitlines()[0]}", "", *pages, "```"]
            found.append("\n".join(lines))
    return "\n\n".join(found)


def add_navigation(app, name, source) -> None:
    if name == "index":
        source[0] += "\n\n" + navigation(source[0]) + "\n"


def link_to_repository(app, doctree) -> None:
    """Links to pages that are not below docs/ lead to nothing on a site: their words stay."""
    from docutils import nodes
    from sphinx.addnodes import pending_xref

    for node in list(doctree.findall(pending_xref)):
        if node.get("reftarget", "").startswith("/"):
            node.replace_self(nodes.inline("", "", *node.children))


def setup(app) -> None:
    app.connect("source-read", add_navigation)
    app.connect("doctree-read", link_to_repository)
