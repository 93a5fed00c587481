"""Writes the Fortran reference from the comments right above types and procedures. Generated procedures have
the comments of the headers."""

from __future__ import annotations

import re
from pathlib import Path

import headers
from words import markdown

PROCEDURE = re.compile(r"^(?!end\b)(?P<head>[^!\"'=]*?\b(?:subroutine|function)\s+(?P<name>\w+)\b.*)$", re.IGNORECASE)
TYPE = re.compile(r"^type\b(?!\s*\()[^:]*?(?:::)?\s*(?P<name>\w+)\s*(?:!.*)?$", re.IGNORECASE)
END = re.compile(r"^end\s*(?:subroutine|function|type|interface)?\b", re.IGNORECASE)


def logical_lines(text: str) -> list[str]:
    """Lines, with continued ones joined."""
    return re.sub(r"&\s*\n\s*&?", "", text).splitlines()


def exported(lines: list[str]) -> dict[str, str]:
    """Names that `use hooke` brings: {name in its module: public name}."""
    renamed = re.findall(r"(hooke_\w+) => (\w+)", "\n".join(line for line in lines if line.startswith("  use ")))
    public = re.findall(r"hooke_\w+", "\n".join(line for line in lines if line.startswith("  public ::")))
    return {**{name: name for name in public}, **{inside: outside for outside, inside in renamed}}


def bound_names(lines: list[str]) -> set[str]:
    """Bindings of types to procedures, and the interfaces of deferred ones."""
    found: set[str] = set()
    for line in lines:
        words = line.split("!")[0]
        if match := re.match(r"\s*(?:procedure(?:\((\w+)\))?|generic)\s*(?:,\s*\w+\s*)*::\s*(.*)", words):
            found |= set(re.findall(r"\w+", match[2])) | ({match[1]} if match[1] else set())
    return found


def names_of(lines: list[str]) -> dict[str, str]:
    """Names by which users call procedures, where they differ."""
    bound_to = re.findall(r"^\s*procedure(?:, private)? :: (\w+) => (\w+)\s*(?:!.*)?$", "\n".join(lines), re.MULTILINE)
    return {inside: outside for outside, inside in bound_to}


def dummies(lines: list[str], start: int) -> list[str]:
    """Declarations of the arguments and the result of a procedure."""
    found = []
    for line in lines[start + 1 :]:
        words = line.split("!")[0].strip()
        if END.match(words):
            break
        if "intent(" in words or re.match(r"(class|procedure)\(", words):
            if not words.startswith("class(") or " self" not in words:
                found.append("  " + words)
    return found


def entries(lines: list[str], outside: dict[str, str]) -> list[tuple[str, str, str, str]]:
    """(name in its module, name, comment, code) of every public type and procedure."""
    bound_to, comment, found = bound_names(lines), [], []
    outside = {**names_of(lines), **outside}
    for number, line in enumerate(lines):
        words = line.strip()
        if "---- for the other modules" in words:
            break
        if words.startswith("!"):
            comment.append(re.sub(r"^![>!]? ?", "", words))
            continue
        match = PROCEDURE.match(words) or TYPE.match(words)
        is_type = match is not None and "head" not in match.groupdict() and match["name"].startswith("hooke_")
        known = match is not None and (match["name"] in outside or match["name"] in bound_to or is_type)
        known = known and not match["name"].startswith("assign")  # assignment needs no entry
        if match and known and "bind(c" not in words.lower():
            code = [words, *dummies(lines, number)] if "head" in match.groupdict() else bound(lines, number)
            found.append((match["name"], outside.get(match["name"], match["name"]), "\n".join(comment), "\n".join(code)))
        comment = []
    return found


def bound(lines: list[str], start: int) -> list[str]:
    """A type with the names of its procedures."""
    found = [lines[start].strip()]
    for line in lines[start + 1 :]:
        words = line.strip()
        if re.match(r"end\s*type", words):
            break
        if words and "private" not in words.split("::")[0]:
            found.append("  " + words)
    return found


def intro(lines: list[str]) -> str:
    """The comment above a module."""
    start = next(k for k, line in enumerate(lines) if re.match(r"\s*module \w+", line))
    return markdown("\n".join(re.sub(r"^![>!]? ?", "", line) for line in lines[:start] if line.startswith("!")))


def with_comments_of_headers(text: str, root: Path) -> str:
    """The module, in which made procedures have the comments of the functions in C that they call."""
    comments = {}
    for path in (root / "include/hooke").glob("*.h"):
        for comment, declarations in headers.entries(path.read_text("utf-8")):
            for declaration in declarations[:1]:
                comments[headers.names_in(declaration)[0]] = "".join(f"  ! {line}\n" for line in comment.splitlines())

    def commented(match: re.Match[str]) -> str:
        calls = [f"hooke_{name}" for name in re.findall(r"\bc_(\w+)\(", match[0]) if f"hooke_{name}" in comments]
        return "\n" + (comments[calls[-1]] if calls else "") + match[0][1:]

    return re.sub(r"^\n  (?:function|subroutine) .*?^  end", commented, text, flags=re.DOTALL | re.MULTILINE)


def page(root: Path, made: Path) -> str:
    """`made` is the folder of the generated modules."""
    lines = logical_lines(with_comments_of_headers((made / "hooke.f90").read_text("utf-8"), root))
    base = logical_lines((root / "bindings/fortran/base.f90").read_text("utf-8"))
    found = entries(lines, exported(lines)) + [one for one in entries(base, exported(lines)) if one[0] != one[1]]
    types = [name for name, _, _, code in found if code.startswith("type")]
    rest = "Procedures of no type"
    of_type: dict[str, list[str]] = {name: [] for name in [*types, rest]}
    for inside, name, comment, code in found:
        owner = max((t for t in types if f"hooke_{inside}".startswith(f"{t}_") or inside == t), key=len, default=rest)
        pieces = [f"### {name}" * (name != owner), markdown(comment), f"```text\n{code}\n```"]
        of_type[owner].append("\n\n".join(filter(None, pieces)))
    pieces = ["# Fortran reference", "The types and procedures that `use hooke` brings, with their comments. [The Fortran "
              "interface](../fortran.md) is the way in.", EXAMPLE, intro(lines)]
    return "\n\n".join([*pieces, *("\n\n".join([f"## {title}", *words]) for title, words in of_type.items())]) + "\n"


EXAMPLE = """Their library is the one that the program uses:

```console
$ hooke --version
```"""
