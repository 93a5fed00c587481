"""Writes the C reference from the headers: every comment, and below it its declarations."""

from __future__ import annotations

import re
from pathlib import Path

from words import markdown

TOKEN = re.compile(
    r"/\*(?P<comment>.*?)\*/"
    r"|^\#define[ ]+(?P<define>\w+[ ]+\S.*?)$"
    r"|^(?P<declaration>(?:HOOKE_API|typedef)\b[^;{]*;)",
    re.DOTALL | re.MULTILINE | re.VERBOSE,
)
SECTION = re.compile(r"\s*-{4}\s*(?P<title>.*?)\s*-{4}(?P<text>.*)", re.DOTALL)
EXAMPLE = """#include <hooke.h>
#include <stdio.h>

int main(void) {
  printf("hooke %s, ABI %d, loops for %s\\n", hooke_version(), hooke_abi(), hooke_build_fact("instructions"));
  return hooke_abi() != HOOKE_ABI;
}
"""


def lines_of(comment: str) -> str:
    """The text of a comment without its stars."""
    return "\n".join(re.sub(r"^\s*\* ?", "", line).rstrip() for line in comment.strip().splitlines())


def names_in(declaration: str) -> list[str]:
    function = re.match(r"HOOKE_API[\s\S]*?\b(\w+)\(", declaration) or re.match(r"typedef \w+ (\w+)\(", declaration)
    return [function[1] if function else re.findall(r"(\w+);", declaration)[-1]]


def without_prefix(declaration: str) -> str:
    prefix = "HOOKE_API "
    if not declaration.startswith(prefix):
        return declaration
    return declaration.removeprefix(prefix).replace("\n" + " " * len(prefix), "\n")


def entries(text: str) -> list[tuple[str, list[str]]]:
    """(comment, declarations) in order. Declarations without a blank line between them share a comment."""
    found: list[tuple[str, list[str]]] = []
    comment, end = "", 0
    for token in TOKEN.finditer(text):
        gap = text[end : token.start()]
        near = gap.count("\n") == 1 and not gap.strip()
        if token["comment"] is not None:
            comment = token["comment"]
            if "\n" not in gap.strip(" ") and found and gap.strip(" ") == "":
                comment = ""  # a comment at the end of a line is part of it
        elif token["declaration"]:
            declaration = token["declaration"]
            if near and not comment and found and found[-1][1]:
                found[-1][1].append(declaration)
            else:
                found.append((comment, [declaration]))
            comment = ""
        end = token.end()
        if token["comment"] is not None and comment and SECTION.match(comment):
            found.append((comment, []))
            comment = ""
    return [(lines_of(words), declarations) for words, declarations in found]


def defines(text: str) -> list[str]:
    found = re.findall(r"^#define +(\w+) +(\S[^/\n]*?) *(?:/\* *(.*?) *\*/)?$", text, re.MULTILINE)
    return [f"| `{name}` | `{value}` | {words} |" for name, value, words in found if name != "HOOKE_API"]


def header(path: Path, root: Path) -> str:
    text = path.read_text("utf-8")
    intro = re.search(r"/\*(.*?)\*/", text, re.DOTALL)
    body = text[intro.end() :]
    name = path.relative_to(root).as_posix()
    summary = re.sub(r"^\S+ - ", "", lines_of(intro[1]))
    pieces = [f"## {name}", markdown(summary[0].upper() + summary[1:])]
    rows = defines(body)
    if rows:
        pieces.append("\n".join(["| constant | value | |", "| --- | --- | --- |", *rows]))
    for comment, declarations in entries(body):
        section = SECTION.match(comment)
        if section and not declarations:
            title, rest = section["title"], markdown(section["text"].strip("\n"))
            pieces += [f"**{title[0].upper()}{title[1:]}**"] + ([rest] if rest else [])
            continue
        names = [name for declaration in declarations for name in names_in(declaration)]
        pieces.append("### " + ", ".join(f"`{name}`" for name in names))
        if comment:
            pieces.append(markdown(comment))
        pieces.append("```c prototypes\n" + "\n".join(map(without_prefix, declarations)) + "\n```")
    return "\n\n".join(pieces)


def page(root: Path) -> str:
    include = root / "include"
    order = re.findall(r'#include "(hooke/\w+\.h)"', (include / "hooke.h").read_text("utf-8"))
    pieces = [
        "# C reference",
        "Every public header with its comments, which are the contract. [The C interface](../c.md) is the way in; "
        "`#include <hooke.h>` brings all of them.",
        "```c\n" + EXAMPLE + "```",
    ]
    return "\n\n".join(pieces + [header(include / name, include) for name in order]) + "\n"
