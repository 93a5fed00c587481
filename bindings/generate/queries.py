"""Fortran procedures that only pass numbers, texts and objects that have such procedures. A type that extends
hooke_system_queries has one for every C function hooke_system_<name>() with such arguments and results that no
hand-written procedure calls."""

import re

import guard
import headers

COUNTS = {"count", "size", "steps", "stride"}  # other whole numbers are indices, and count from 1 in Fortran
SIMPLE = {"double", "int32_t", "int64_t", "const char *"}
RESULTS = {"int32_t", "int64_t", "double", "const char *", "void"}
# Procedures of Fortran that ask a query of C for one word, by the names that they would have in C, with their results.
WORDS = {
    "hooke_system_spring_count": ("int64_t", "hooke_system_count", "springs"),
    "hooke_integrator_wall_seconds": ("double", "hooke_integrator_number", "wall_seconds"),
    "hooke_integrator_diverged_at": ("double", "hooke_integrator_number", "diverged_at"),
    "hooke_integrator_stop_value": ("int32_t", "hooke_integrator_count", "stop_value"),
    "hooke_trajectory_run": ("const char *", "hooke_trajectory_text", "run"),
    "hooke_trajectory_origin": ("const char *", "hooke_trajectory_text", "origin"),
    "hooke_scene_title": ("const char *", "hooke_scene_text", "title"),
    "hooke_scene_text": ("const char *", "hooke_scene_text", "text"),
    "hooke_record_frame_count": ("int64_t", "hooke_record_count", "frames"),
    "hooke_record_good_frame_count": ("int64_t", "hooke_record_count", "good_frames"),
}


def called(texts):
    """C functions, as c_<name>, that the modules use outside of their use statements."""
    lines = re.sub(r"&\s*\n\s*", " ", re.sub(r"!.*", "", "\n".join(texts))).splitlines()
    return {name for line in lines if not line.strip().startswith("use ") for name in re.findall(r"\bc_\w+", line)}


def argument(name, kind, what):
    """(declaration, argument passed to C, statements before the call) of one parameter."""
    if kind.endswith("*") and kind != "const char *":
        intent = "in" if kind.startswith("const") else "inout"
        return f"class({kind.split()[-2]}_queries), intent({intent}) :: {what}", f"{what}%address()", []
    if kind == "double":
        return f"real(c_double), intent(in) :: {what}", what, []
    if kind == "const char *" and guard.is_optional(name, what):
        return (f"character(*), intent(in), optional :: {what}", f"c_{what}",
                [f"character(:), allocatable :: c_{what}", f"call to_c_if({what}, c_{what})"])
    if kind == "const char *":
        return f"character(*), intent(in) :: {what}", f"to_c({what})", []
    number = f"int({what}, c_{kind})" if kind == "int32_t" or what in COUNTS else f"zero_based({what})"
    return f"integer, intent(in) :: {what}", number, []


def answer(result, name, whats):
    """(type, conversion from C) of the result of a function."""
    if result == "const char *":
        return "character(:), allocatable", "to_text({})"
    if result == "double":
        named = [what for what in whats if what in ("what", "column")]
        return "real(c_double)", f"to_number({{}}, {named[0]})" if named else "{}"
    if result == "int64_t":
        return ("integer", "to_integer({})") if name.endswith(("_count", "_size")) else ("integer(c_int64_t)", "{}")
    return ("logical", "{} == 1") if "_is_" in name else ("integer", "int({})")


def procedure(function):
    """One procedure as lines."""
    result, name, ((own, _), *parameters) = function
    short, of = name[len("hooke_"):], own.split()[-2]
    whats = [what for _, what in parameters]
    arguments = [argument(name, kind, what) for kind, what in parameters]
    head = [f"class({of}_queries), intent({'in' if own.startswith('const') else 'inout'}) :: self", *(a[0] for a in arguments)]
    call = f"c_{short}({', '.join(['self%address()', *(a[1] for a in arguments)])})"
    first, then = [a[2][0] for a in arguments if a[2]], [a[2][1] for a in arguments if a[2]]
    if headers.is_status(result, name):
        kind, whats = "subroutine", [*whats, "status"]
        head.append("integer, intent(out), optional :: status")
        objects = [passed.split("%")[0] for _, passed, _ in arguments if passed.endswith("%address()")]
        body = [f"if (self%is_missing({', '.join(['status', *objects])})) return", *then, f"call accept({call}, status)"]
    elif result == "void":
        kind, body = "subroutine", [*then, f"call {call}"]
    else:
        kind, (of_result, made) = "function", answer(result, name, whats)
        first = [f"{of_result} :: found", *first]
        body = [*then, f"found = {made.format(call)}"]
    title = f"{kind} {short}({', '.join(['self', *whats])}){' result(found)' if kind == 'function' else ''}"
    return [f"  {title}", *(f"    {line}" for line in [*head, *first, *body]), f"  end {kind}", ""]


def of_word(name):
    """One procedure of WORDS as lines."""
    result, query, word = WORDS[name]
    short, of = name[len("hooke_"):], "_".join(name.split("_")[:2])
    kind, made = answer(result, name, [])
    call = f'c_{query[len("hooke_"):]}(self%address(), to_c("{word}"))'
    return [f"  function {short}(self) result(found)", f"    class({of}_queries), intent(in) :: self",
            f"    {kind} :: found", f"    found = {made.format(call)}", "  end function", ""]


def objects_of(function, types):
    """The types of those parameters, but the first, that are objects with procedures here."""
    return [kind.split()[-2] for kind, _ in function[2][1:] if re.fullmatch(rf"(const )?({'|'.join(types)}) \*", kind)]


def is_query(function, type_, types, by_hand):
    result, name, parameters = function
    mine = name.startswith(type_ + "_") and parameters and parameters[0][0] in (f"{type_} *", f"const {type_} *")
    return (mine and result in RESULTS
            and sum(kind in SIMPLE for kind, _ in parameters[1:]) + len(objects_of(function, types)) == len(parameters) - 1
            and name not in WORDS and not name.endswith(("_destroy", "_close"))
            and "c_" + name[len("hooke_"):] not in by_hand)


def module(type_, types, public, by_hand):
    found = {header: [f for f in headers.declared(text) if is_query(f, type_, types, by_hand)] for header, text in public.items()}
    words = [name for name in WORDS if name.startswith(type_ + "_")]
    names = [name for functions in found.values() for _, name, _ in functions] + words
    uses = [f"  use hooke_c_{header[:-2]}" for header, functions in found.items() if functions]
    others = {other for functions in found.values() for f in functions for other in objects_of(f, types)} - {type_}
    uses += [f"  use hooke_queries_of_{other[len('hooke_'):]}, only: {other}_queries" for other in sorted(others)]
    bound = [f"    procedure :: {name[len(type_) + 1:]} => {name[len('hooke_'):]}" for name in names]
    return ["", f"! What {type_} does as the functions of C of the same names; numbers of things count from 1 here.",
            f"module hooke_queries_of_{type_[len('hooke_'):]}",
            "  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t",
            "  use hooke_base, only: accept, to_c, to_c_if, to_integer, to_number, to_text, zero_based", *uses,
            "  use hooke_handles, only: hooke_handle", "  implicit none", "  private", f"  public :: {type_}_queries", "",
            f"  type, extends(hooke_handle) :: {type_}_queries", "  contains", *bound, "  end type", "", "contains", "",
            *(line for functions in found.values() for f in functions for line in procedure(f)),
            *(line for name in words for line in of_word(name)), "end module"]


def modules(public, texts):
    """The text of queries.f90, from {header: text} and the hand-written modules in their order."""
    types = re.findall(r"extends\((hooke_\w+)_queries\)", "\n".join(texts))
    # what estimates and views call of a measurement, hooke_measurement still needs
    by_hand = {type_: called([text for text in texts if type_ != "hooke_measurement" or "hooke_measurement_queries" in text])
               for type_ in types}
    return "\n".join(["! Made from the headers in include/hooke by bindings/generate/queries.py.",
                      *(line for type_ in types for line in module(type_, types, public, by_hand[type_]))])
