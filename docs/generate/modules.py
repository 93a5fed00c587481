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
    found = {}
    for names in re.findall(r"^\s*use \w+, only:(.*)$", "\n".join(lines), re.MULTILINE):
        for name in names.split(","):
            outside, _, inside = (word.strip() for word in name.partition("=>"))
            found[inside or outside] = outside
    return found


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
    bound_to = re.findall(r"^\s*procedure :: (\w+) => (\w+)\s*(?:!.*)?$", "\n".join(lines), re.MULTILINE)
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


def entries(lines: list[str], outside: dict[str, str]) -> list[tuple[str, str, str]]:
    """(name, comment, code) of every public type and procedure."""
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
            found.append((outside.get(match["name"], match["name"]), "\n".join(comment), "\n".join(code)))
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


def module(lines: list[str], outside: dict[str, str]) -> str:
    found = entries(lines, outside)
    if not found:
        return ""
    pieces = [f"## {re.search(r'^module (.+)$', chr(10).join(lines), re.MULTILINE)[1]}", intro(lines)]
    for name, comment, code in found:
        pieces += [f"### {name}", markdown(comment), f"```text\n{code}\n```"]
    return "\n\n".join(filter(None, pieces))


def with_comments_of_headers(queries: str, root: Path) -> str:
    """The generated modules, with the comments of the functions in C that they call."""
    for path in (root / "include/hooke").glob("*.h"):
        for comment, declarations in headers.entries(path.read_text("utf-8")):
            for name in [name for one in declarations for name in headers.names_in(one)][:1]:
                above = "".join(f"  ! {line}\n" for line in comment.splitlines())
                head = rf"^(?=  (?:function|subroutine) {name.replace('hooke_', '', 1)}\()"
                queries = re.sub(head, lambda _, above=above: above, queries, flags=re.MULTILINE)
    return queries


def page(root: Path, made: Path) -> str:
    """`made` is the folder of the generated modules."""
    folder = root / "bindings/fortran"
    queries = "\n".join(path.read_text("utf-8") for path in sorted(made.glob("queries*.f90")))
    queries = with_comments_of_headers(queries, root)
    front = logical_lines((folder / "hooke.f90").read_text("utf-8"))
    files = sorted([*set(folder.glob("*.f90")) - {folder / "hooke.f90"}, made / "forces.f90", made / "observers.f90"])
    others = [logical_lines(path.read_text("utf-8")) for path in files]
    others += map(logical_lines, re.findall(r"^! What [^\n]*\nmodule .*?^end module", queries, re.DOTALL | re.MULTILINE))
    pieces = ["# Fortran reference", "The types and procedures that `use hooke` brings, with their comments. [The Fortran "
              "interface](../fortran.md) is the way in.", EXAMPLE, intro(front)]
    return "\n\n".join(filter(None, pieces + [module(lines, exported(front)) for lines in others])) + "\n"


EXAMPLE = """Their library is the one that the program uses:

```console
$ hooke --version
```"""
