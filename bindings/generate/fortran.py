"""Writes the generated part of the Fortran module: python bindings/generate/fortran.py FOLDER

FOLDER/c.f90 has the interfaces of C: a module hooke_c_<header> for each header, and in it hooke_state_create() as
c_state_create(). Pointers to numbers and text are optional arguments: an absent one is passed as NULL. FOLDER/hooke.f90 is
bindings/fortran/hooke.template.f90 with the procedures that only convert arguments and results (procedures.py), and the
types of callbacks (callbacks.py)."""

import re
import sys
from pathlib import Path

import callbacks
import headers
import procedures

HAND = Path(__file__).resolve().parents[1] / "fortran"

NUMBERS = {"double": "real(c_double)", "int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)",
           "char": "character(kind=c_char)"}


def argument(kind, what, callbacks):
    """The declaration of a parameter of a type such as "const double *"."""
    const, plain, stars = re.fullmatch(r"(const )?(\w+) ?(\**)", kind).groups()
    if plain in callbacks:
        return f"type(c_funptr), value :: {what}"
    if plain == "void" or plain.startswith("hooke_"):
        return f"type(c_ptr), {'intent(out)' if stars == '**' else 'value'} :: {what}"
    intent = f"intent({'in' if const else 'inout'}), optional :: {what}(*)" if stars else f"value :: {what}"
    return f"{NUMBERS[plain]}, {intent}"


def interface(function, callbacks):
    """One function as lines of Fortran."""
    result, name, parameters = function
    returned = "type(c_ptr)" if "*" in result else NUMBERS.get(result)
    kind = "function" if returned else "subroutine"
    title = f"{kind} c_{headers.short(name)}({', '.join(what for _, what in parameters)}) bind(c, name=\"{name}\")"
    return procedures.written(kind, f"{returned} {title}" if returned else title,
                              ["import", *(argument(*parameter, callbacks) for parameter in parameters)])


def statuses(text):
    """{name: declaration} of the statuses that a header defines."""
    found = re.findall(r"^#define (HOOKE_\w+) +\(?(-?\d+)\)?(?: +/\* (.*) \*/)?$", text, re.MULTILINE)
    return {name.lower(): f"  integer, parameter :: {name.lower()} = {value}{f' ! {doc}' if doc else ''}"
            for name, value, doc in found if name != "HOOKE_ABI"}


def module(header, text, callbacks):
    body = [line for function in headers.declared(text) for line in interface(function, callbacks)]
    kinds = [k for k in ("c_char", "c_double", "c_funptr", "c_int32_t", "c_int64_t", "c_ptr")
             if any(re.search(rf"\b{k}\b", line) for line in body)]
    return "\n".join([f"module hooke_c_{header}", f"  use, intrinsic :: iso_c_binding, only: {', '.join(kinds)}",
                      "  implicit none", "", *statuses(text).values(), "  interface", *body, "  end interface", "end module", ""])


def interfaces(public):
    """The text of c.f90, from {header: text}."""
    callbacks = headers.callback_types("".join(public.values()))
    return "\n".join(["! Made from the headers in include/hooke by bindings/generate/fortran.py.",
                      *(module(Path(header).stem, text, callbacks) for header, text in public.items())])


def bindings(short, made, template, functions):
    """The procedures of a type, made and by hand; those that C has not and a generic name has are private."""
    own = [*made, *re.findall(rf"^  .*(?:subroutine|function) ({short}_\w+)\(self", template, re.MULTILINE)]
    generic = re.findall(r"\w+", " ".join(re.findall(r"generic :: \w+ => (.*)", template)))
    names = [name[len(short) + 1:] for name in own]
    hidden = {name for name in names if name in generic and f"hooke_{short}_{name}" not in functions}
    return ["  contains", *(f"    procedure{', private' * (name in hidden)} :: {name} => {short}_{name}" for name in names),
            f"    procedure, private :: assign => assign_{short}", "    generic :: assignment(=) => assign", ""]


def completed(template, public, base):
    """The text of hooke.f90, from that of its template, {header: text}, and a module whose procedures are not made here."""
    types = re.findall(r"^(  type, extends\(hooke_handle\) :: (\w+)\n)((?:    type.*\n|    real.*\n)*)", template, re.MULTILINE)
    parts = {name: re.findall(r"type\(hooke_\w+\) :: (\w+)", inside) for _, name, inside in types}
    by_hand = re.findall(r"^  .*?(?:subroutine|function) (?:hooke_)?(\w+)\(", template + base, re.MULTILINE)
    made = procedures.all_of(public, parts, by_hand)
    of_callbacks, interfaces, calls = callbacks.module(public)
    shown = [*statuses(public["base.h"]), *parts, *callbacks.TYPES, *(f"hooke_{name}" for name in made[None])]
    uses = "".join(f"  use hooke_c_{Path(header).stem}\n" for header in public)
    text = template.replace("  implicit none\n", f"{uses}  implicit none\n", 1)
    text = text.replace("  private\n", "".join(["  private\n", *(f"  public :: {name}\n" for name in shown)]), 1)
    for head, type_, inside in types:
        bound = bindings(headers.short(type_), made[type_], template, headers.functions("".join(public.values())))
        text = text.replace(head + inside, head + inside + "\n".join(bound), 1)
    text = text.replace("\ncontains\n", "\n".join(["", *of_callbacks, *interfaces, "", "contains", ""]), 1)
    lines = [line for type_ in parts for line in procedures.assigning(type_)]
    lines += [*(line for of_type in made.values() for one in of_type.values() for line in one), *calls]
    return text.replace("\nend module\n", "\n".join(["", *lines, "end module", ""]))


if __name__ == "__main__":
    public, folder = headers.public(), Path(sys.argv[1])
    template, base = ((HAND / name).read_text(encoding="utf-8") for name in ("hooke.template.f90", "base.f90"))
    headers.write(folder / "c.f90", interfaces(public))
    headers.write(folder / "hooke.f90", completed(template, public, base))
