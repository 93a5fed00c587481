"""Settings of Sphinx for the site that `make docs` builds. Pages are plain Markdown; those of the references are
generated; docs/index.md gives their order."""

from __future__ import annotations

import html
import re
import shutil
from pathlib import Path

from docutils import nodes

HERE = Path(__file__).parent

project = "hooke"
release = re.search(r'HOOKE_VERSION "(.+)"', (HERE.parent / "include/hooke/base.h").read_text("utf-8"))[1]
copyright = "the authors of hooke, MIT licence"
extensions = ["myst_parser"]
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath"]
exclude_patterns = ["README.md"]
nitpicky = True

html_theme = "furo"
html_title = f"hooke {release}"
html_copy_source = False
html_show_sourcelink = False
templates_path: list[str] = []
html_static_path = ["site.css"]
html_css_files = ["site.css"]

# KaTeX typesets formulas in the reader's browser, from files of the site; without it they are shown as TeX.
KATEX = next(filter(Path.exists, map(Path, ["/usr/share/javascript/katex", "/usr/share/katex"])), None)
html_math_renderer = "katex"
TYPESET = """document.addEventListener("DOMContentLoaded", () => {
  for (const formula of document.querySelectorAll(".math")) {
    katex.render(formula.textContent, formula, { displayMode: formula.tagName === "DIV" });
  }
});"""

# The page of `make playground`, where it was made.
LIVE = HERE.parent / "build/playground/live.html"
LECTURE = LIVE.with_name("lecture.js")
html_extra_path = [str(path) for path in (LIVE, LECTURE) if path.exists()]
FRONT = """```{raw} html
<p>Drag the step to the right until the cloth blows up. This is hooke itself, in the browser
(<a href="live.html">in a window of its own</a>).</p>
<iframe class="front" src="live.html#front" title="A cloth that hooke integrates in the browser"></iframe>
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


def lecture(text: str) -> str:
    """Puts the functions of the example in C where the page of the lecture links to them, and the script of its figures."""
    program = (HERE.parent / "examples/c/lecture.c").read_text("utf-8")

    def function(link: re.Match) -> str:
        code = re.search(rf"^static void {link[1]}\(.*?^}}$", program, re.MULTILINE | re.DOTALL)[0]
        return (f"```{{raw}} html\n<details><summary>In C</summary>\n```\n\n```c\n{code}\n```\n\n"
                f"```{{raw}} html\n</details>\n```\n\n")  # fmt: skip

    text = re.sub(r"In C: \[(\w+)\(\)\]\([^)]*\)(?:[.;] *(?:in )?)?", function, text)
    return text + ('\n```{raw} html\n<script defer src="lecture.js"></script>\n```\n' if LECTURE.exists() else "")


def adapt(app, name, source) -> None:
    """Adds tables of contents, removes the addresses of links to files that are not on the site, and fills in the links
    of the page about the references."""
    if name == "index":
        if LIVE.exists():
            title, rest = source[0].split("\n\n", 1)
            source[0] = f"{title}\n\n{FRONT}\n{rest}"
        source[0] += "\n\n" + navigation(source[0]) + "\n"
    if name == "notebooks" and (Path(app.srcdir) / "notebooks").exists():
        source[0] = re.sub(r"\(\.\./examples/(notebooks/[\w-]+)\.ipynb\)", r"(\1.md)", source[0])
        pages = re.findall(r"\((notebooks/[\w-]+)\.md\)", source[0])
        source[0] += "\n\n" + "\n".join(["```{toctree}", ":hidden:", "", *pages, "```"]) + "\n"
    if name == "lecture":
        source[0] = lecture(source[0])
    if not name.startswith("reference/"):
        if name == "gallery" and LIVE.exists():
            live = r'`\1.json`, <a href="live.html#open=\1">in the playground</a>'
            source[0] = re.sub(r"\[`([\w-]+)\.json`\]\(\.\./[^)]*\)", live, source[0])
        source[0] = re.sub(r"\[([^\]]*)\]\(\.\./[^)]*\)", r"\1", source[0])
    if name == "playground" and LIVE.exists():
        source[0] = source[0].replace("`build/playground/live.html`", '<a href="live.html">live.html</a>')
    if name == "reference":
        pages = re.findall(r"`(reference/[\w-]+)\.md`", source[0])
        source[0] = re.sub(r"`(reference/([\w-]+)\.md)`", r"[\2](\1)", source[0])
        source[0] += "\n\n" + "\n".join(["```{toctree}", ":hidden:", "", *pages, "```"]) + "\n"


def play(app, name, source) -> None:
    """Puts a page that make_playing.py made where the comment `<!-- plays page.html: title -->` is."""

    def frame(mark: re.Match) -> str:
        page, fragment, title = mark[1], mark[2] or "", html.escape(mark[3])
        if not (Path(app.srcdir) / "playing" / page).exists():
            return ""
        kind = "why" if fragment == "#bare" else "view"
        return (f'```{{raw}} html\n<iframe class="{kind}" src="{page}{fragment}" title="{title}" loading="lazy"></iframe>\n'
                f'<p>{title} (<a href="{page}">all of it</a>).</p>\n```')  # fmt: skip

    source[0] = re.sub(r"<!-- plays ([\w.-]+)(#\w+)?: (.*?) -->", frame, source[0], flags=re.DOTALL)


def inline_formula(self, node) -> None:
    self.body.append(f'<span class="math">{html.escape(node.astext())}</span>')
    raise nodes.SkipNode


def formula(self, node) -> None:
    self.body.append(f'<div class="math">{html.escape(node.astext())}</div>\n')
    raise nodes.SkipNode


def typeset(app, pagename, templatename, context, doctree) -> None:
    """KaTeX is on pages with formulas only."""
    if KATEX and doctree and any(doctree.findall(lambda node: isinstance(node, (nodes.math, nodes.math_block)))):
        app.add_css_file("katex/katex.min.css")
        app.add_js_file("katex/katex.min.js")
        app.add_js_file(None, body=TYPESET)


def add_files(app, exception) -> None:
    if KATEX and not exception:
        folder = Path(app.outdir) / "_static/katex"
        shutil.copytree(KATEX / "fonts", folder / "fonts", dirs_exist_ok=True, ignore=shutil.ignore_patterns("*.ttf", "*.woff"))
        for name in ("katex.min.css", "katex.min.js"):
            shutil.copyfile(KATEX / name, folder / name)


def add_pages(app, config) -> None:
    if (Path(app.srcdir) / "playing").exists():
        config.html_extra_path.append(str(Path(app.srcdir) / "playing"))


def setup(app) -> None:
    app.add_html_math_renderer("katex", (inline_formula, None), (formula, None))
    app.connect("config-inited", add_pages)
    app.connect("source-read", adapt)
    app.connect("source-read", play)
    app.connect("html-page-context", typeset)
    app.connect("build-finished", add_files)
