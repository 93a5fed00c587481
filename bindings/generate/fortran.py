"""Writes the generated part of the Fortran module: python bindings/generate/fortran.py FOLDER

FOLDER/queries.f90 and queries_of_runs.f90 have the procedures that only convert arguments and results (queries.py),
FOLDER/forces.f90 and observers.f90 the types of callbacks (callbacks.py). FOLDER/c.f90 has the interfaces of C: a module
hooke_c_<header> for each header, and in it hooke_state_create() as c_state_create(). Pointers to numbers and text are
optional arguments: an absent one is passed as NULL."""

import re
import sys
import textwrap
from pathlib import Path

import callbacks
import headers
import queries

HAND = Path(__file__).resolve().parents[1] / "fortran"

NUMBERS = {"double": "real(c_double)", "int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)"}
WIDTH = 120


def argument(kind, callbacks):
    """(declaration without the name, is an array) of a parameter of a type such as "const double *"."""
    const, plain, stars = re.fullmatch(r"(const )?(\w+) ?(\**)", kind).groups()
    intent = "intent(in)" if const else "intent(inout)"
    if plain in callbacks:
        return "type(c_funptr), value", False
    if plain == "void" or plain.startswith("hooke_"):
        return "type(c_ptr), intent(out)" if stars == "**" else "type(c_ptr), value", False
    if plain == "char":
        return f"character(kind=c_char), {intent}, optional", True
    return (f"{NUMBERS[plain]}, {intent}, optional", True) if stars else (f"{NUMBERS[plain]}, value", False)


def result(words):
    """Type of a result; None if there is none."""
    if "*" in words:
        return "type(c_ptr)"
    return None if words == "void" else NUMBERS[words]


def interface(function, callbacks):
    """One function as lines of Fortran."""
    kind, name, parameters = function
    arguments = [(what, *argument(of, callbacks)) for of, what in parameters]
    returned = result(kind)
    what = f"{returned} function" if returned else "subroutine"
    short = "c_" + name[len("hooke_"):]
    lines = textwrap.wrap(f'{what} {short}({", ".join(a[0] for a in arguments)}) bind(c,name="{name}")', WIDTH - 4)
    lines = [line.replace("bind(c,", "bind(c, ") for line in lines]
    lines = [line + " &" for line in lines[:-1]] + lines[-1:]
    lines = ["    " + ("  " if k else "") + line for k, line in enumerate(lines)] + ["      import"]
    for declaration in dict.fromkeys(a[1] for a in arguments):
        names = ", ".join(n + ("(*)" if array else "") for n, d, array in arguments if d == declaration)
        lines.append(f"      {declaration} :: {names}")
    return lines + [f"    end {'function' if returned else 'subroutine'}"]


def module(header, text, callbacks):
    body = [line for function in headers.declared(text) for line in interface(function, callbacks)]
    kinds = [k for k in ("c_char", "c_double", "c_funptr", "c_int32_t", "c_int64_t", "c_ptr")
             if any(re.search(rf"\b{k}\b", line) for line in body)]
    return "\n".join([f"module hooke_c_{header}", f"  use, intrinsic :: iso_c_binding, only: {', '.join(kinds)}",
                      "  implicit none", "", "  interface", *body, "  end interface", "end module", ""])


def interfaces(public):
    """The text of c.f90, from {header: text}."""
    callbacks = headers.callback_types("".join(public.values()))
    return "\n".join(["! Made from the headers in include/hooke by bindings/generate/fortran.py.",
                      *(module(Path(header).stem, text, callbacks) for header, text in public.items())])


if __name__ == "__main__":
    public, folder = headers.public(), Path(sys.argv[1])
    sources = [HAND / name for name in (HAND / "sources.txt").read_text(encoding="utf-8").split()]
    by_hand = {path.name: path.read_text(encoding="utf-8") for path in sources if path.exists()}
    made = {"c.f90": interfaces(public), **queries.modules(public, by_hand)}
    made.update((f"{which}.f90", callbacks.module(which, public)) for which in callbacks.TYPES)
    for name, text in made.items():
        headers.write(folder / name, text)
