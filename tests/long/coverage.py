"""Lines and branches of src/ that the tests of a build with --coverage reached: python tests/long/coverage.py BUILD [PATH ...]

Prints the totals and a table of the files, those with most left first; with files or folders the lines and branches of these
that are left, and their kind. A loop that is compiled for several instruction sets counts once, a branch of it as reached
if one of them took it.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# Where the compiler sees no other path: unreachable while the program is correct.
NEVER = re.compile(r"\bassert\(|__builtin_unreachable")
# Checks for a failure of an earlier call: of memory, of a file, of a library.
FAILURE = re.compile(r"\bstatus\b|\bresult\b|(?<!->)\berror\b|\berrno\b|== NULL|!= NULL|< 0\b|NO_MEMORY|_new\(|\? HOOKE_OK")
# What everything rests on: what is left there is of a kind, the first that fits its line, whose reason is in
# docs/notes/reliability.md.
CORE = ("src/kernel", "src/integrate", "src/measure/estimate")
KINDS = {
    "failures": FAILURE,
    "refusals by libraries": re.compile(r"ARK_|CV_|CVode|ARKode|ARKStep|stepper|created\b|where\(|x->factor\)"),
    "other builds and processors": re.compile(r"is_built|->steps\b|__get_cpuid|KEEPS_AVX"),
    "parts of what failed": re.compile(r"\bfine\b|\bspare\b|no_space|no_memory|\bcontent\b|own->(y|linear|nonlinear)\b|renew\(|inverse_mass;"),
    "numbers that fail": re.compile(r"INFINITY|isfinite|isnan|isinf|NAN\b|broken|curvature|least \?|converged|residual|_FINE|NOT_FINITE"),
}


class Source:
    """Execution count of each line, and of each branch of each line."""

    def __init__(self) -> None:
        self.lines: dict[int, int] = defaultdict(int)
        self.branches: dict[tuple[int, int], int] = defaultdict(int)

    def reached(self) -> tuple[int, int, int, int]:
        return (
            sum(1 for count in self.lines.values() if count),
            len(self.lines),
            sum(1 for count in self.branches.values() if count),
            len(self.branches),
        )


def read(build: Path) -> dict[str, Source]:
    """By path from the root."""
    objects = sorted(str(path) for path in (build / "CMakeFiles").rglob("*.gcno"))
    if not objects:
        raise SystemExit(f"{build} was not compiled with --coverage")
    sources: dict[str, Source] = defaultdict(Source)
    for first in range(0, len(objects), 50):
        command = ["gcov", "--json-format", "--stdout", "--branch-probabilities", *objects[first : first + 50]]
        told = subprocess.run(command, cwd=build, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True).stdout
        for document in told.decode().splitlines():
            for file in json.loads(document)["files"] if document.startswith("{") else []:
                path = (build / file["file"]).resolve()
                if path.is_relative_to(ROOT / "src"):
                    add(sources[str(path.relative_to(ROOT))], file["lines"], path.read_text().splitlines())
    return sources


def add(source: Source, lines: list[dict], text: list[str]) -> None:
    for line in lines:
        number = line["line_number"]
        if NEVER.search(text[number - 1]):
            continue
        source.lines[number] += line["count"]
        for k, branch in enumerate(line["branches"]):
            if not branch["throw"]:
                source.branches[number, k] += branch["count"]


def totals(sources: dict[str, Source]) -> tuple[int, int, int, int]:
    parts = [source.reached() for source in sources.values()]
    return tuple(sum(part[k] for part in parts) for k in range(4))  # type: ignore[return-value]


def left_by_kind(sources: dict[str, Source]) -> dict[str, int]:
    count: dict[str, int] = defaultdict(int)
    for path, source in sources.items():
        text = (ROOT / path).read_text().splitlines()
        for (line, _), taken in source.branches.items():
            if not taken:
                count[kind_of(text[line - 1])] += 1
    return count


def kind_of(line: str) -> str:
    return next((kind for kind, words in KINDS.items() if words.search(line)), "others")


def table(sources: dict[str, Source]) -> str:
    rows = []
    for path, source in sources.items():
        lines, of_lines, branches, of_branches = source.reached()
        if of_lines:
            rows.append((of_branches - branches + of_lines - lines, path, lines, of_lines, branches, of_branches))
    told = [f"{'lines left':>10} {'of':>6} {'branches left':>14} {'of':>6}  file"]
    for _, path, lines, of_lines, branches, of_branches in sorted(rows, reverse=True):
        told.append(f"{of_lines - lines:>10} {of_lines:>6} {of_branches - branches:>14} {of_branches:>6}  {path}")
    return "\n".join(told)


def left(source: Source, text: list[str]) -> str:
    told = []
    for number in sorted(source.lines):
        taken = [count > 0 for (line, _), count in sorted(source.branches.items()) if line == number]
        if not source.lines[number]:
            told.append(f"{number:>5} line      {text[number - 1]}")
        elif not all(taken):
            told.append(f"{number:>5} {taken.count(False)} of {len(taken)}    {text[number - 1]}  [{kind_of(text[number - 1])}]")
    return "\n".join(told)


def below(sources: dict[str, Source], path: str) -> dict[str, Source]:
    return {file: source for file, source in sources.items() if file == path or file.startswith(path.rstrip("/") + "/")}


def main(build: str, *paths: str) -> None:
    sources = read(Path(build).resolve())
    for file, source in sorted(pair for path in paths for pair in below(sources, path).items()):
        if told := left(source, (ROOT / file).read_text().splitlines()):
            print(f"{file}\n{told}\n")
    if paths:
        return
    lines, of_lines, branches, of_branches = totals(sources)
    print(f"lines {lines} of {of_lines}, {100 * lines / of_lines:.2f} %")
    print(f"branches {branches} of {of_branches}, {100 * branches / of_branches:.2f} %")
    for room in CORE:
        _, _, taken, of_taken = totals(below(sources, room))
        kinds = sorted(left_by_kind(below(sources, room)).items(), key=lambda pair: -pair[1])
        print(f"branches of {room}: {taken} of {of_taken}; left: {', '.join(f'{count} {kind}' for kind, count in kinds) or 'none'}")
    failures = left_by_kind(sources)["failures"]
    print(f"branches left where failures are looked for: {failures}; elsewhere: {of_branches - branches - failures}")
    print(table(sources))


if __name__ == "__main__":
    main(*sys.argv[1:])
