"""Writes, from include/hooke/*.h, what the guard needs to know of every public function:

    python src/guard/make_guard.py

src/guard/calls.inc, the functions, their texts and their handles, for guard.c; src/guard/names.h, other names for the
functions that they call, included by every file of the library; tests/data/handle_calls.inc, a bad call for each handle of
each function."""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/abi"))

import headers  # noqa: E402

# Handles that may be NULL, or that the function itself answers for, besides those of functions that destroy or close:
# (function, parameter).
MAY_BE_NULL = {
    ("cost_create", "run"), ("cost_create", "options"),
    ("limit_create", "run"), ("limit_create", "options"),
    ("study_create", "options"),
    ("view_create", "options"), ("verify_create", "options"), ("verify_create", "limits"),
    ("scene_load_within", "limits"), ("scene_parse_within", "limits"),
    ("scene_write", "run"), ("scene_of_system", "run"),
    ("options_set_number", "options"), ("options_set_numbers", "options"), ("options_set_text", "options"),
    ("options_unset", "options"), ("options_is_set", "options"), ("options_number_count", "options"),
    ("options_numbers", "options"), ("options_number", "options"), ("options_text", "options"),
    ("system_add_altitude", "options"), ("system_add_anchors", "options"),
    ("system_add_part", "options"), ("mesh_set", "options"),
    ("integrator_create", "options"), ("integrator_create_first_order", "options"), ("comparison_create", "options"),
    ("system_add_springs", "options"), ("needs_create", "run"), ("needs_create", "options"), ("study_create", "run"),
    ("study_pick", "run"), ("estimate_pick", "run"), ("estimate_refine", "run"),
    ("why_create_kept", "run"), ("mesh_read", "options"),
    ("scene_options_apply", "options"), ("why_advice_apply", "run"),
}
# Texts that may be NULL: (function, parameter).
MAY_BE_NO_TEXT = {
    ("system_add_springs", "name"), ("system_add_bending", "name"), ("system_add_altitude", "name"),
    ("system_add_anchors", "name"),
    ("system_add_part", "name"), ("estimate_pick", "method"),
    ("scene_parse", "name"), ("scene_parse", "folder"),
    ("scene_parse_within", "name"), ("scene_parse_within", "folder"),
    ("scene_of_system", "title"), ("scene_of_system", "name"), ("scene_of_system", "folder"),
    ("scene_write", "title"), ("trajectory_create", "scene_text"), ("comparison_file_create", "scene_text"),
    ("study_write_h5", "scene_text"), ("view_write", "title"), ("record_write_xdmf", "path"),
    ("study_write_report", "scene"), ("study_write_report", "command"), ("limit_write_report", "scene"),
    ("needs_write_report", "scene"), ("needs_write_report", "command"),
    ("checkpoint_write", "run"), ("checkpoint_read", "run"),
}
REFUSED = {"double": "NAN", "int32_t": "HOOKE_BAD_CALL", "int64_t": "-1"}
MADE_BY = "made from the headers in include/hooke by src/guard/make_guard.py"


def functions():
    """(result, name without hooke_, [(type, name)]) of every public function, in the order of the headers."""
    for header in sorted((ROOT / "include/hooke").glob("*.h")):
        for _, words in headers.statements(header.read_text(encoding="utf-8")):
            match = re.fullmatch(r"HOOKE_API ([^(]*?)\bhooke_(\w+) ?\((.*)\)", words)
            if match:
                result, name, inside = match.groups()
                parameters = [] if inside == "void" else [re.fullmatch(r"(.*?)(\w+)", p.strip()).groups()
                                                          for p in inside.split(",")]
                yield result.strip(), name, [(kind.strip(), what) for kind, what in parameters]


def opaque():
    return {t for h in (ROOT / "include/hooke").glob("*.h") for t in headers.opaque_types(h.read_text(encoding="utf-8"))}


def handle(kind, types):
    """The type that a parameter is a handle of; None for other parameters."""
    match = re.fullmatch(r"(?:const )?(hooke_\w+) \*", kind)
    return match.group(1) if match and match.group(1) in types else None


def refused(result, name):
    """What a function returns for a bad handle; None where it returns nothing."""
    if "*" in result:
        return "NULL"
    return "0" if "_is_" in name and result == "int32_t" else REFUSED.get(result)


def may_be_null(name, what):
    return name.endswith(("_destroy", "_close")) or (name, what) in MAY_BE_NULL


def check_of_text(result, name, what):
    """A text is refused by a function that returns a status, and to others a word that they do not know."""
    return f"TEXT({what})" if result == "int32_t" and "_is_" not in name else f"WORD({what})"


def call(function, types):
    result, name, parameters = function
    value = refused(result, name)
    declared = ", ".join(f"{kind}{'' if kind.endswith('*') else ' '}{what}" for kind, what in parameters) or "void"
    checks = [f"{'MAY_BE' if may_be_null(name, what) else 'IS'}({what}, {handle(kind, types)}, {value or ''})"
              for kind, what in parameters if handle(kind, types)]
    checks += [check_of_text(result, name, what) for kind, what in parameters
               if kind == "const char *" and (name, what) not in MAY_BE_NO_TEXT]
    if any(check.startswith("TEXT") for check in checks):
        checks = [f"MADE({what})" for kind, what in parameters if handle(kind.removesuffix("*"), types)] + checks
    arguments = ", ".join(what for _, what in parameters)
    head = f"CALL({result}, " if value else "CALL_VOID("
    return f"{head}{name}, ({declared}), ({arguments}), {' '.join(checks)})"


def bad_calls(function, types):
    """A line for each handle: the others are good, and what else there is does not matter."""
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
        yield (f'BAD_CALL({how}, {value or 0}, {kinds[place]}, {int(may_be_null(name, what))}, "{first}", {what}, '
               f'hooke_{name}, ({", ".join(given)}))')


def zero(kind):
    return "NULL" if kind.endswith("*") else "0"


def texts():
    """{path: text} of all that is written."""
    types = opaque()
    every = list(functions())
    names = "\n".join(f"#define hooke_{name} hooke_unchecked_{name}" for _, name, _ in every)
    return {
        ROOT / "src/guard/calls.inc": f"/* {MADE_BY} */\n" + "\n".join(call(f, types) for f in every) + "\n",
        ROOT / "src/guard/names.h":
            f"/* {MADE_BY} */\n#ifndef HOOKE_GUARD_NAMES_H\n#define HOOKE_GUARD_NAMES_H\n\n"
            f"/* clang-format off */\n#define HOOKE_API /* only the guard's own are exported */\n{names}\n"
            "/* clang-format on */\n\n#endif\n",
        ROOT / "tests/data/handle_calls.inc":
            f"/* {MADE_BY} */\n" + "\n".join(line for f in every for line in bad_calls(f, types)) + "\n",
    }


if __name__ == "__main__":
    for path, text in texts().items():
        path.write_text(text, encoding="utf-8")
