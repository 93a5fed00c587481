"""Turns the text of comments and docstrings into Markdown."""

from __future__ import annotations

import re
import textwrap

WIDTH = 120


def paragraph(lines: list[str], indent: str = "") -> str:
    text = " ".join(line.strip() for line in lines)
    pieces = re.split(r"(`+[^`]*`+)", text)
    pieces[::2] = [re.sub(r"(\*|<(?=[a-zA-Z/!?]))", r"\\\1", piece) for piece in pieces[::2]]
    whole = "".join(pieces)
    wrapped = textwrap.fill(whole, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
    means_more = re.search(r"^ *([-+>#=|]|\d+[.)])( |$)", wrapped, re.MULTILINE)  # at the start of a line
    return whole if means_more else wrapped


def kind_of(line: str) -> str:
    if not line.strip():
        return "blank"
    if line.startswith(("  ", ">>>", "...")):
        return "as it is"
    return "item" if re.match(r"[-*] ", line) else "words"


def markdown(text: str) -> str:
    """Joins the lines of paragraphs, keeps indented ones. A word above a line of dashes becomes the title of a list."""
    pieces: list[tuple[str, list[str]]] = []
    for line in text.splitlines():
        kind = kind_of(line)
        if re.fullmatch(r"-{3,}", line) and pieces and len(pieces[-1][1]) == 1:
            pieces[-1] = ("title", pieces[-1][1])
            continue
        if pieces and kind == "as it is" and pieces[-1][0] == "item":
            pieces[-1][1].append(line)
        elif pieces and kind == pieces[-1][0] and kind != "item":
            pieces[-1][1].append(line)
        else:
            pieces.append((kind, [line]))
    found = []
    for kind, lines in pieces:
        if kind == "words":
            found.append(paragraph(lines))
        elif kind == "title":
            found.append(f"**{lines[0].strip()}**")
        elif kind == "item":
            found.append("- " + paragraph([lines[0][2:], *lines[1:]], "  "))
        elif kind == "as it is":
            found.append("```text\n" + "\n".join(lines) + "\n```")
    return re.sub(r"(?m)^(- .*)\n\n(?=- )", r"\1\n", "\n\n".join(found))
