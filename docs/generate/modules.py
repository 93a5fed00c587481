"""The Fortran reference, from the comments of the modules: those right above a type or a procedure."""

from __future__ import annotations

import re
from pathlib import Path

from words import markdown

PROCEDURE = re.compile(r"^(?!end\b)(?P<head>[^!\"'=]*?\b(?:subroutine|function)\s+(?P<name>\w+)\b.*)$", re.IGNORECASE)
TYPE = re.compile(r"^type\b(?!\s*\()[^:]*?(?:::)?\s*(?P<name>\w+)\s*(?:!.*)?$", re.IGNORECASE)
END = re.compile(r"^end\s*(?:subroutine|function|type|interface)?\b", re.IGNORECASE)


def logical_lines(text: str) -> list[str]:
    """Lines with what is continued joined."""
    return re.sub(r"&\s*\n\s*&?", "", text).splitlines()


def public_names(lines: list[str]) -> set[str]:
    """Names that the module gives away, and those that its types are bound to."""
    found: set[str] = set()
    for line in lines:
        code = line.split("!")[0]
        listed = re.match(r"\s*public\s*::\s*(.*)", code) or re.match(
            r"\s*(?:procedure(?:\(\w+\))?|generic)\s*(?:,\s*(?!private)\w+\s*)*::\s*(.*)", code)
        if listed:
            found |= set(re.findall(r"\w+", listed[1]))
        bound = re.match(r"\s*(?:integer|real|type).*\bpublic\b.*::\s*(\w+)", code)
        if bound:
            found.add(bound[1])
    return found


def dummies(lines: list[str], start: int) -> list[str]:
    """The declarations of arguments and result below the head of a procedure."""
    found = []
    for line in lines[start + 1 :]:
        words = line.split("!")[0].strip()
        if END.match(words):
            break
        if "intent(" in words or re.match(r"(class|procedure)\(", words):
            if not words.startswith("class(") or " self" not in words:
                found.append("  " + words)
    return found


def entries(lines: list[str]) -> list[tuple[str, str, str]]:
    """(name, comment, code) of every type and procedure that may be used."""
    public, comment, found = public_names(lines), [], []
    for number, line in enumerate(lines):
        words = line.strip()
        if "---- for the other modules" in words:
            break
        if words.startswith("!"):
            comment.append(re.sub(r"^![>!]? ?", "", words))
            continue
        match = PROCEDURE.match(words) or TYPE.match(words)
        if match and match["name"] in public and "bind(c" not in words.lower():
            code = [words, *dummies(lines, number)] if "head" in match.groupdict() else bound(lines, number)
            found.append((match["name"], "\n".join(comment), "\n".join(code)))
        comment = []
    return found


def bound(lines: list[str], start: int) -> list[str]:
    """A type with the names of what it can do."""
    found = [lines[start].strip()]
    for line in lines[start + 1 :]:
        words = line.strip()
        if re.match(r"end\s*type", words):
            break
        if words and "private" not in words.split("::")[0]:
            found.append("  " + words)
    return found


def module(path: Path) -> str:
    text = path.read_text("utf-8")
    lines = logical_lines(text)
    start = next(k for k, line in enumerate(lines) if re.match(r"\s*module \w+", line))
    intro = "\n".join(re.sub(r"^![>!]? ?", "", line) for line in lines[:start] if line.startswith("!"))
    pieces = [f"## {lines[start].split()[1]}", markdown(intro)]
    for name, comment, code in entries(lines[start + 1 :]):
        pieces += [f"### {name}", markdown(comment), f"```text\n{code}\n```"]
    return "\n\n".join(filter(None, pieces))


def page(root: Path) -> str:
    """"" while there is no module."""
    paths = sorted((root / "bindings/fortran").glob("*.f90"))
    paths.sort(key=lambda path: path.name != "hooke.f90")
    if not paths:
        return ""
    pieces = ["# Fortran reference", "The public types and procedures of the modules, with their comments. [The Fortran "
              "interface](../fortran.md) is the way in; `use hooke` brings all of them.", EXAMPLE]
    return "\n\n".join(pieces + [module(path) for path in paths]) + "\n"


EXAMPLE = """```console
$ hooke --version
```"""
