"""Translates the routines of LAPACK that the library calls, and all that they call, into one file in C:
`python translate.py f2c lapack-3.11.0 lapack.c`. What f2c cannot read is in rest.c."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

CALLED = ["dgeev", "dsyev", "dsyevx", "dstevx"]
REST = {"disnan", "xerbla"}


def source_of(sources: Path, name: str) -> Path | None:
    return next((p for folder in ("SRC", "BLAS/SRC") if (p := sources / folder / f"{name}.f").exists()), None)


def calls_of(text: str) -> set[str]:
    code = "\n".join(line for line in text.lower().splitlines() if not line.startswith(("*", "c", "!")))
    code = re.sub(r"\n {5}\S", " ", code)
    externals = ",".join(re.findall(r"^\s+external\s+(.*)$", code, re.MULTILINE))
    return {name for name in re.findall(r"\bcall\s+(\w+)", code) + re.split(r"\W+", externals) if name}


def in_fortran_77(name: str, text: str) -> str:
    """Without EXIT and CYCLE, which f2c does not know."""
    labels = iter(range(901, 999))

    def leave(found: re.Match[str]) -> str:
        label = next(labels)
        return f"{found[1]}GO TO {label}{found[2]}\n  {label} CONTINUE"

    text = re.sub(r"(IF\(.*\) )EXIT(\n\s+END DO)", leave, text)
    if name == "dlaqr5":
        text = re.sub(r"^(     \$\s+)CYCLE$", r"\1GO TO 80", text, flags=re.MULTILINE)
    return text


def as_called(text: str) -> str:
    """With routines that return nothing where the library calls them, as those of Fortran do."""
    for name in CALLED:
        begin, end = text.index(f"/* Subroutine */ int {name}_("), text.index(f"}} /* {name}_ */")
        text = text[:begin] + re.sub(r"\breturn 0;", "return;", text[begin:end].replace("int", "void", 1)) + text[end:]
    return text


def main(f2c: str, sources: Path, out: Path) -> None:
    texts: dict[str, str] = {}
    wanted = list(CALLED)
    while wanted:
        name = wanted.pop()
        path = source_of(sources, name)
        if name in texts or name in REST or path is None:
            continue
        texts[name] = in_fortran_77(name, path.read_text(encoding="latin-1"))
        wanted += calls_of(texts[name])
    joined = "\n".join(texts[name] for name in sorted(texts))
    done = subprocess.run([f2c, "-a", "-A"], input=joined, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit(done.stderr)
    out.write_text(as_called(done.stdout), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]))
