"""Writes bindings/fortran/c/<header>.f90, the interfaces of C as Fortran sees them, from include/hooke/<header>.h.

    python bindings/fortran/make_interfaces.py

hooke_state_create() is called c_state_create() there. Pointers to numbers and text are optional arguments: one that is
absent arrives as NULL."""

import re
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/abi"))

import headers  # noqa: E402

NUMBERS = {"double": "real(c_double)", "int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)"}
WIDTH = 120


def argument(words, callbacks):
    """(name, declaration without the name, is an array) of one parameter such as "const double *q"."""
    const, kind, stars, name = re.fullmatch(r"(const )?(\w+) ?(\**)(\w+)", words).groups()
    intent = "intent(in)" if const else "intent(inout)"
    if kind in callbacks:
        return name, "type(c_funptr), value", False
    if kind == "void" or kind.startswith("hooke_"):
        return name, "type(c_ptr), intent(out)" if stars == "**" else "type(c_ptr), value", False
    if kind == "char":
        return name, f"character(kind=c_char), {intent}, optional", True
    return (name, f"{NUMBERS[kind]}, {intent}, optional", True) if stars else (name, f"{NUMBERS[kind]}, value", False)


def result(words):
    """Type of a result, None where there is none."""
    if "*" in words:
        return "type(c_ptr)"
    return None if words == "void" else NUMBERS[words]


def interface(words, callbacks):
    """One function as lines of Fortran."""
    kind, name, inside = re.fullmatch(r"HOOKE_API ([^(]*?)\b(hooke_\w+) ?\((.*)\)", words).groups()
    arguments = [] if inside == "void" else [argument(a.strip(), callbacks) for a in inside.split(",")]
    returned = result(kind.strip())
    what = f"{returned} function" if returned else "subroutine"
    short = "c_" + name.removeprefix("hooke_")
    lines = textwrap.wrap(f'{what} {short}({", ".join(a[0] for a in arguments)}) bind(c,name="{name}")', WIDTH - 4)
    lines = [line.replace("bind(c,", "bind(c, ") for line in lines]
    lines = [line + " &" for line in lines[:-1]] + lines[-1:]
    lines = ["    " + ("  " if k else "") + line for k, line in enumerate(lines)] + ["      import"]
    for declaration in dict.fromkeys(a[1] for a in arguments):
        names = ", ".join(n + ("(*)" if array else "") for n, d, array in arguments if d == declaration)
        lines.append(f"      {declaration} :: {names}")
    return lines + [f"    end {'function' if returned else 'subroutine'}"]


def module(header, callbacks):
    text = header.read_text(encoding="utf-8")
    body = [line for _, words in headers.statements(text) if words.startswith("HOOKE_API ")
            for line in interface(words, callbacks)]
    kinds = [k for k in ("c_char", "c_double", "c_funptr", "c_int32_t", "c_int64_t", "c_ptr")
             if any(re.search(rf"\b{k}\b", line) for line in body)]
    return "\n".join([f"! Made from include/hooke/{header.name} by make_interfaces.py.",
                      f"module hooke_c_{header.stem}",
                      f"  use, intrinsic :: iso_c_binding, only: {', '.join(kinds)}",
                      "  implicit none", "", "  interface", *body, "  end interface", "end module", ""])


def modules():
    """Text of each file that is to be there, by its name."""
    files = sorted((ROOT / "include/hooke").glob("*.h"))
    callbacks = headers.callback_types("".join(f.read_text(encoding="utf-8") for f in files))
    return {f.stem + ".f90": module(f, callbacks) for f in files}


def main():
    folder = ROOT / "bindings/fortran/c"
    wanted = modules()
    for old in folder.glob("*.f90"):
        if old.name not in wanted:
            old.unlink()
    for name, text in wanted.items():
        (folder / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
