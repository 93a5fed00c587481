"""Writes the generated modules of the Python package: python bindings/generate/prototypes.py FOLDER makes
FOLDER/_prototypes.py, with the prototypes of all public functions, FOLDER/parts.py (parts.py) and FOLDER/_keywords.py
(keywords.py)"""

import sys
from pathlib import Path

import headers
import keywords
import parts

INTRO = '''"""Every function of the library with the types of its result and arguments; made from the headers in include/hooke by
bindings/generate/prototypes.py.

Handles are pointers to types without members, so that a state cannot be passed where a system is expected. Arguments of
callbacks that are arrays or states arrive as plain addresses, which is quicker than typed pointers.
"""

from __future__ import annotations

from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_int32, c_int64, c_void_p
from typing import Any


class STATUS(c_int32):
    """Marks a result that is a status."""


def _handle(name: str) -> Any:
    return POINTER(type(name, (Structure,), {}))


INT32, INT64, DOUBLE, TEXT, ADDRESS = c_int32, c_int64, c_double, c_char_p, c_void_p
DOUBLES, INTEGERS = POINTER(c_double), POINTER(c_int64)

'''
TYPES = {"int32_t": "INT32", "int64_t": "INT64", "double": "DOUBLE", "double *": "DOUBLES", "int64_t *": "INTEGERS",
         "char *": "TEXT", "void *": "ADDRESS", "void": "None"}


def short(name):
    """STATE for hooke_state."""
    return headers.short(name).upper()


def argument(kind):
    """Name of a type such as "const double *" in Python."""
    plain = kind.replace("const ", "")
    return TYPES.get(plain) or (f"POINTER({short(plain[:-3])})" if plain.endswith("**") else short(plain[:-2]))


def passed(kind):
    """The same in a callback: arrays and handles are addresses."""
    return "ADDRESS" if kind.endswith("*") and "char" not in kind else argument(kind)


def row(result, name, parameters):
    first = "STATUS" if headers.is_status(result, name) else argument(result)
    return f'    "{name}": ({", ".join([first, *(argument(kind) for kind, _ in parameters)])},),'


def module(public):
    """The text of the module, from {header: text}."""
    text = "".join(public.values())
    return INTRO + "\n".join([
        *(f'{short(name)} = _handle("{name}")' for name in sorted(headers.opaque_types(text))), "",
        *(f"{short(name)} = CFUNCTYPE({', '.join(map(passed, [result, *(kind for kind, _ in parameters)]))})"
          for result, name, parameters in headers.declared(text, "typedef")), "",
        "# name: (result, argument, argument, ...)", "PROTOTYPES = {",
        *(row(*function) for function in headers.declared(text)), "}", ""])


if __name__ == "__main__":
    headers.write(Path(sys.argv[1]) / "_prototypes.py", module(headers.public()))
    headers.write(Path(sys.argv[1]) / "parts.py", parts.module())
    headers.write(Path(sys.argv[1]) / "_keywords.py", keywords.module())
