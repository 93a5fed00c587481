"""Writes a table of all public functions, with a caller of each from an array of arguments: public_calls.py FILE"""

import re
import sys
from pathlib import Path

import guard
import headers

PLAIN = {"int32_t": "SHORT", "int64_t": "WHOLE", "double": "NUMBER", "char": "TEXT", "void": "ADDRESS"}
RESULTS = {"int32_t": "whole", "int64_t": "whole", "double": "number", "void": None}


def kind(declared, what, types, callbacks):
    """(kind, type of a handle or callback) of a parameter."""
    plain = re.sub(r"^const | ?\*+$", "", declared)
    if guard.handle(declared, what, types):
        return "HANDLE", guard.handle(declared, what, types)
    if plain in types:
        return "MADE", plain
    if plain in callbacks:
        return "CALLBACK", plain
    if plain in ("double", "int64_t") and declared.endswith("*"):
        return ("" if declared.startswith("const") else "OUT_") + PLAIN[plain] + "S", plain
    return PLAIN[plain], plain


def argument(declared, place, kind):
    if kind == "CALLBACK":
        return f"({declared})a[{place}].callback"
    if declared.endswith("*"):
        return f"a[{place}].address"
    return f"({declared})a[{place}].{'number' if kind == 'NUMBER' else 'whole'}"


def row(function, types, callbacks):
    result, name, parameters = function
    required = {what for what, _ in guard.required(function, types)}
    kinds = [kind(declared, what, types, callbacks) for declared, what in parameters]

    def may_be_null(kind, of, what):
        if kind == "HANDLE":
            return guard.may_be_null(name, of)
        return guard.is_optional(name, what) if kind == "TEXT" else what not in required

    inside = ", ".join(argument(declared, place, kinds[place][0]) for place, (declared, _) in enumerate(parameters))
    into = RESULTS.get(result, "constant")
    call = f"result->{into} = {name}({inside})" if into else f"{name}({inside})"
    rows = ", ".join(f'{{{k}, {int(may_be_null(k, of, what))}, "{of}", "{what}"}}' for (k, of), (_, what) in zip(kinds, parameters))
    refusal = guard.refused(result, name)
    field = {"NULL": "constant", "NAN": "number"}.get(refusal, "whole")
    return (f"static void call_{name}(const union value *a, union value *result) {{\n  (void)a, (void)result;\n  {call};\n}}",
            f'{{"{name}", {int(headers.is_status(result, name))}, {len(parameters)}, call_{name}, {{.{field} = {refusal or 0}}}, {{{rows or "{0}"}}}}},')


def text():
    public = "".join(headers.public().values())
    types, callbacks = headers.opaque_types(public), headers.callback_types(public)
    callers, rows = zip(*(row(function, types, callbacks) for function in headers.declared(public)))
    return "\n".join([*callers, "static const struct function functions[] = {", *rows, "};", ""])


if __name__ == "__main__":
    headers.write(Path(sys.argv[1]), text())
