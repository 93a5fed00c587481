"""Writes the tables of the guard for every public function: python bindings/generate/guard.py FOLDER

FOLDER/guard/calls.inc, the functions, their texts, arrays and handles, for src/guard/guard.c; FOLDER/guard/names.h,
other names for the functions that they call, included by every file of the library."""

import sys
from pathlib import Path

import headers

# Options may be NULL, which means the defaults, except in these functions.
NEED_OPTIONS = {"hooke_options_copy", "hooke_options_row_count", "hooke_options_row", "hooke_options_row_number",
                "hooke_probes_create", "hooke_step_settle"}
# Texts, arrays, callbacks and places for results that may be NULL, by the names of their parameters; and those that need
# the function's name as well.
OPTIONAL = {"folder", "run", "scene_text", "title", "count", "ctx", "damping", "dfdq", "dfdv", "first", "observer", "product",
            "progress", "rest_length", "stiffness", "told", "velocity", "warning"}
OPTIONAL_IN = {("hooke_estimate_pick", "method"), ("hooke_record_write_xdmf", "path"), ("hooke_measurement_label", "text"),
               ("hooke_measurement_json", "table"), ("hooke_measurement_table", "kind"), ("hooke_step_bound", "method"),
               ("hooke_system_members", "particles"), ("hooke_system_add_members", "particles"),
               ("hooke_system_add_obstacle", "particles"), ("hooke_system_body_particles", "particles"),
               ("hooke_system_with_force", "force"),
               *((f"hooke_{name}", what) for what in "qv"
                 for name in ("integrator_get", "integrator_put", "system_energy", "system_energy_at"))}
# Handles that a callback takes for its `ctx`, by the names of their parameters.
BY_CONTEXT = {"estimate": "hooke_measurement"}
REFUSED = {"double": "NAN", "int32_t": "HOOKE_BAD_CALL", "int64_t": "-1"}
MADE_BY = "/* made from the headers in include/hooke by bindings/generate/guard.py */\n"


def handle(kind, what, types):
    """Type of the handle that a parameter is; None for other parameters."""
    if kind == "void *" and what != "ctx":
        return BY_CONTEXT[what]
    return headers.object_of(kind) if headers.object_of(kind) in types else None


def refused(result, name):
    """Return value of a function for a bad handle; None if it returns nothing."""
    if "*" in result:
        return "NULL"
    return "0" if "_is_" in name and result == "int32_t" else REFUSED.get(result)


def may_be_null(name, kind):
    """Whether a handle may be NULL, or is checked by the function itself."""
    if (name, kind) == ("hooke_measurement_run", "hooke_state"):
        return True  # the initial state
    if (name, kind) == ("hooke_estimate_follow", "hooke_measurement"):
        return True  # none any more
    return name.endswith(("_destroy", "_close")) or (kind == "hooke_options" and name not in NEED_OPTIONS)


def is_optional(name, what):
    named = what == "name" and name.startswith(("hooke_system_add_", "hooke_scene_"))
    return named or what in OPTIONAL or (name, what) in OPTIONAL_IN


def check_of_text(result, name, what):
    """A bad text argument: NULL for a function that returns a status, an unknown word for others."""
    return f"TEXT({what})" if result == "int32_t" and "_is_" not in name else f"WORD({what})"


def required(function, types):
    """(parameter, count) of arrays, callbacks and places that have to be there unless the count, a parameter or 1, is 0."""
    _, name, parameters = function
    counts = headers.counts(parameters)
    free = {what for kind, what in parameters if kind == "const char *" or handle(kind, what, types) or is_optional(name, what)}
    return [(what, counts.get(what, "1")) for kind, what in parameters
            if kind.endswith("**") or (kind.endswith("*") and what not in free)]


def call(function, types):
    result, name, parameters = function
    value = refused(result, name)
    no_array = "HOOKE_BAD_VALUE" if value == "HOOKE_BAD_CALL" else value or ""
    declared = ", ".join(f"{kind}{'' if kind.endswith('*') else ' '}{what}" for kind, what in parameters) or "void"
    kinds = [(handle(kind, what, types), what) for kind, what in parameters]
    checks = [f"{'MAY_BE' if may_be_null(name, kind) else 'IS'}({what}, {kind}, {value or ''})"
              for kind, what in kinds if kind]
    checks += [check_of_text(result, name, what) for kind, what in parameters
               if kind == "const char *" and not is_optional(name, what)]
    checks = [f"MADE({what})" for kind, what in parameters if kind.endswith("**") and handle(kind[:-1], what, types)] + checks
    checks += [f"GIVEN({what}, {count}, {no_array})" for what, count in required(function, types)]
    arguments = ", ".join(what for _, what in parameters)
    head = f"CALL({result}, " if value else "CALL_VOID("
    return f"{head}{headers.short(name)}, ({declared}), ({arguments}), {' '.join(checks)})"


def texts(public):
    """{path: text} of all generated files, from {header: text}."""
    types = headers.opaque_types("".join(public.values()))
    every = [function for text in public.values() for function in headers.declared(text)]
    includes = "".join(f'#include "hooke/{header}"\n' for header in public)
    names = "".join(f"#define {name} hooke_unchecked_{headers.short(name)}\n" for _, name, _ in every)
    return {
        "guard/calls.inc": MADE_BY + includes + "\n".join(call(f, types) for f in every) + "\n",
        "guard/names.h": f"{MADE_BY}#pragma once\n\n#define HOOKE_API /* only the guard's own are exported */\n{names}",
    }


if __name__ == "__main__":
    for path, text in texts(headers.public()).items():
        headers.write(Path(sys.argv[1]) / path, text)
