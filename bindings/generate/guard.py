"""Writes the tables of the guard for every public function: python bindings/generate/guard.py FOLDER

FOLDER/guard/calls.inc, the functions, their texts and their handles, for src/guard/guard.c; FOLDER/guard/names.h,
other names for the functions that they call, included by every file of the library; FOLDER/handle_calls.inc, a bad
call for each handle of each function, for the tests."""

import re
import sys
from pathlib import Path

import headers

# Options may be NULL, which means the defaults, except in these functions.
NEED_OPTIONS = {"hooke_options_copy", "hooke_options_row_count", "hooke_options_row", "hooke_options_row_number"}
# Texts that may be NULL, by the names of their parameters; and those that need the function's name as well.
OPTIONAL_TEXTS = {"command", "folder", "run", "scene", "scene_text", "title"}
MAY_BE_NO_TEXT = {("hooke_estimate_pick", "method"), ("hooke_record_write_xdmf", "path"),
                  ("hooke_measurement_label", "text"), ("hooke_measurement_table", "kind"),
                  ("hooke_step_bound", "method")}
REFUSED = {"double": "NAN", "int32_t": "HOOKE_BAD_CALL", "int64_t": "-1"}
MADE_BY = "/* made from the headers in include/hooke by bindings/generate/guard.py */\n"


def handle(kind, types):
    """Type of the handle that a parameter is; None for other parameters."""
    match = re.fullmatch(r"(?:const )?(hooke_\w+) \*", kind)
    return match.group(1) if match and match.group(1) in types else None


def refused(result, name):
    """Return value of a function for a bad handle; None if it returns nothing."""
    if "*" in result:
        return "NULL"
    return "0" if "_is_" in name and result == "int32_t" else REFUSED.get(result)


def may_be_null(name, kind):
    """Whether a handle may be NULL, or is checked by the function itself."""
    if (name, kind) == ("hooke_measurement_run", "hooke_state"):
        return True  # the initial state
    return name.endswith(("_destroy", "_close")) or (kind == "hooke_options" and name not in NEED_OPTIONS)


def may_be_no_text(name, what):
    named = what == "name" and name.startswith(("hooke_system_add_", "hooke_scene_"))
    return named or what in OPTIONAL_TEXTS or (name, what) in MAY_BE_NO_TEXT


def check_of_text(result, name, what):
    """A bad text argument: NULL for a function that returns a status, an unknown word for others."""
    return f"TEXT({what})" if result == "int32_t" and "_is_" not in name else f"WORD({what})"


def call(function, types):
    result, name, parameters = function
    value = refused(result, name)
    declared = ", ".join(f"{kind}{'' if kind.endswith('*') else ' '}{what}" for kind, what in parameters) or "void"
    kinds = [(handle(kind, types), what) for kind, what in parameters]
    checks = [f"{'MAY_BE' if may_be_null(name, kind) else 'IS'}({what}, {kind}, {value or ''})"
              for kind, what in kinds if kind]
    checks += [check_of_text(result, name, what) for kind, what in parameters
               if kind == "const char *" and not may_be_no_text(name, what)]
    checks = [f"MADE({what})" for kind, what in parameters if kind.endswith("**") and handle(kind[:-1], types)] + checks
    arguments = ", ".join(what for _, what in parameters)
    head = f"CALL({result}, " if value else "CALL_VOID("
    return f"{head}{name[len('hooke_'):]}, ({declared}), ({arguments}), {' '.join(checks)})"


def bad_calls(function, types):
    """A line for each handle: the others are valid, and the other arguments do not matter."""
    result, name, parameters = function
    kinds = [handle(kind, types) for kind, _ in parameters]
    value = refused(result, name)
    how = {None: "NOTHING", "NULL": "NULL_POINTER", "NAN": "NOT_A_NUMBER"}.get(value, "NUMBER")
    for place, (_, what) in enumerate(parameters):
        if kinds[place] is None:
            continue
        given = [f"GOOD({k})" if k and p < place else f"BAD({k})" if p == place else zero(parameters[p][0])
                 for p, k in enumerate(kinds)]
        first = next((k for k in kinds[:place] if k), "hooke_system")
        yield (f'BAD_CALL({how}, {value or 0}, {kinds[place]}, {int(may_be_null(name, kinds[place]))}, "{first}", {what}, '
               f'{name}, ({", ".join(given)}))')


def zero(kind):
    return "NULL" if kind.endswith("*") else "0"


def texts(public):
    """{path: text} of all generated files, from {header: text}."""
    types = headers.opaque_types("".join(public.values()))
    every = [function for text in public.values() for function in headers.declared(text)]
    includes = "".join(f'#include "hooke/{header}"\n' for header in public)
    names = "".join(f"#define {name} hooke_unchecked_{name[len('hooke_'):]}\n" for _, name, _ in every)
    return {
        "guard/calls.inc": MADE_BY + includes + "\n".join(call(f, types) for f in every) + "\n",
        "guard/names.h": MADE_BY + "#ifndef HOOKE_GUARD_NAMES_H\n#define HOOKE_GUARD_NAMES_H\n\n"
                         f"#define HOOKE_API /* only the guard's own are exported */\n{names}\n#endif\n",
        "handle_calls.inc": MADE_BY + "\n".join(line for f in every for line in bad_calls(f, types)) + "\n",
    }


if __name__ == "__main__":
    for path, text in texts(headers.public()).items():
        headers.write(Path(sys.argv[1]) / path, text)
