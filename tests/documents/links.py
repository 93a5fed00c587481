"""Links and headings of a Markdown document, as on a repository site."""

import re
from pathlib import Path

from markdown_it import MarkdownIt

PARSER = MarkdownIt("commonmark").enable("table")


def slug(title):
    """The anchor of a heading: lower case, blanks to hyphens, without punctuation."""
    return re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-")


def inline(tokens):
    for token in tokens:
        if token.children:
            yield from token.children


def plain(token):
    return "".join(child.content for child in token.children if child.type in ("text", "code_inline"))


def anchors(text):
    tokens, found = PARSER.parse(text), set()
    for heading, title in zip(tokens, tokens[1:]):
        if heading.type == "heading_open":
            name, number = slug(plain(title)), 0
            while (name if number == 0 else f"{name}-{number}") in found:
                number += 1
            found.add(name if number == 0 else f"{name}-{number}")
    return found


def targets(text):
    """The targets of links and pictures."""
    for token in inline(PARSER.parse(text)):
        target = token.attrGet("href") or token.attrGet("src")
        if target:
            yield target


def complaints(document, root):
    """Broken links of the document, and external links, which are not followed."""
    document, missing, outside = Path(document), [], []
    text = document.read_text(encoding="utf-8")
    for target in targets(text):
        if re.match(r"[a-z]+:", target):
            outside.append(target)
            continue
        name, _, anchor = target.partition("#")
        path = (document.parent / name).resolve() if name else document.resolve()
        if not path.exists() or root.resolve() not in path.parents:
            missing.append(f"{document.relative_to(root)}: {target}: there is no such file")
        elif anchor and anchor not in anchors(path.read_text(encoding="utf-8")):
            missing.append(f"{document.relative_to(root)}: {target}: there is no such heading")
    return missing, outside
