"""The module of the Python package with the methods that add parts, groups and drives to a scene, from the schema of
scenes."""

import json
import keyword
import textwrap
from pathlib import Path

SCHEMA = Path(__file__).resolve().parents[2] / "examples/scene.schema.json"
INTRO = '''"""Parts of a scene, one method a kind, and what it lists: groups and drives; made from examples/scene.schema.json by
bindings/generate/parts.py."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, TypedDict, TypeVar, Union

from ._signature import takes
from ._types import IntArray, Numbers, Particle, Path, Pins

__all__ = ["Curve", "Springs", "Transform"]

Quantity = Union[float, str]  #: a number, or one with a unit: "200g"
S = TypeVar("S", bound="Parts")
'''
CLASS = '''

class Parts:
    """The methods of a scene that add parts, groups and drives.

    Every part takes a `name` (the default is its kind and its number among the parts) and either `mass`, its total
    [kg], or `density`; an overdamped scene without gravity needs neither. `pinned` pins particles: numbers within the
    part, or words. A family of springs is a dict, ``dict(stiffness=50, damping=0.01)``, see `Springs`; a family that
    is not given has no springs. Springs follow the strain law, so that a finer part of the same material stretches
    equally. Each method returns the scene, for the next call.
    """

    def _part(self: S, kind: str, given: dict[str, Any]) -> S:
        raise NotImplementedError

    def _group(self: S, kind: str, what: str, given: dict[str, Any]) -> S:
        raise NotImplementedError
'''
# What the keys of a part do not say.
NOTES = {
    "cloth": "Particle (r, c) has the number ``r*nu + c`` within the cloth, whose `size` is (nu, nv).",
    "lattice": "Numbers within it run along x first, then y, then z.",
    "mesh": "The scene keeps the vertices of a file, not its name.",
    "bending": "The energy of a triple a, b, c is c/2 |q_a - 2 q_b + q_c|^2.",
    "driven": "By ``amplitude * sin(2 pi frequency t + phase)`` about where they are, or a smooth curve through `position`.",
    "strand": "A strand of hair, after Selle, Lentine and Fedkiw (2008).",
}
# Keys whose values are dicts, with the class of these, its description, and the kind and key that has it in the schema.
DICTS = {
    "Springs": ("A family of springs of a part.", "rope", "stretch"),
    "Curve": ("The tension of springs: a table, of `strain` or of `elongation`, or `coefficients`.", "springs", "curve"),
    "Transform": ("From the coordinates of a mesh to metres.", "mesh", "transform"),
    "Scale": ("A factor that follows time.", "springs", "rest_scale"),
}
# What methods add that is not "a <kind>".
ADDED = {"springs": "a group of springs", "bending": "a group of triples that resist bending", "driven": "prescribed motion",
         "anchors": "a group of springs from a particle to a fixed point", "bodies": "existing particles as one rigid body",
         "loads": "a force on particles",
         "obstacles": "a plane, a sphere or a cylinder that pushes particles out"}
# Keys with the particles of what a scene lists, each a number or ("part", number), and their types.
LISTS = {"springs": "between", "bending": "triples", "anchors": "particles", "bodies": "particles", "driven": "particles",
         "loads": "particles", "obstacles": "particles"}
PARTICLES = {"between": "Sequence[Sequence[Particle]] | IntArray", "triples": "Sequence[Sequence[Particle]] | IntArray",
             "particles": "Particle | Sequence[Particle] | IntArray"}
TYPES = {"integer": "int", "number": "float", "boolean": "bool", "string": "str", "object": "dict[str, Quantity]"}


def resolved(schema, definitions):
    of = next((way for way in schema.get("oneOf", []) if way.get("$ref", "").endswith("/scale")), schema)
    return definitions[of["$ref"].rpartition("/")[2]] if "$ref" in of else schema


def type_of(key, schema):
    if key in ("pinned", "file", *PARTICLES):
        return {"pinned": "Pins", "file": "Path", **PARTICLES}[key]
    if key.capitalize() in DICTS:
        return key.capitalize()
    if schema.get("$ref", "").endswith("/family"):
        return "Springs"
    if any(way.get("$ref", "").endswith("/scale") for way in schema.get("oneOf", [])):
        return "float | Scale"
    kind = schema.get("type", "string" if "enum" in schema else "array")
    return "Quantity" if isinstance(kind, list) else TYPES.get(kind, "Numbers")


def shape(schema):
    """Of an array, as NumPy has it; "" for other values."""
    ways = [way for way in [schema, *schema.get("oneOf", [])] if way.get("type") == "array"]
    if not ways:
        return ""
    bounds = {way.get("minItems") for way in ways} | {way.get("maxItems", "n") for way in ways}
    columns = ways[0]["items"].get("maxItems")
    return f" ({bounds.pop() if len(bounds) == 1 else 'n'}, {columns or ''})".replace(", )", ",)")


def described(keys, indent):
    """The descriptions of keys, as lines of a docstring."""
    for key, schema in keys.items():
        words = ", ".join(f'"{word}"' for way in schema.get("oneOf", []) for word in way.get("enum", []))
        line = f"`{argument(key)}`{shape(schema)}: {schema['description']}{f' ({words})' if words else ''}"
        yield from textwrap.wrap(f"- {line}", 118, initial_indent=indent, subsequent_indent=f"{indent}  ")


def argument(key):
    return f"{key}_" if keyword.iskeyword(key) else key


def dictionary(name, definitions):
    """The class of a dict."""
    words, kind, key = DICTS[name]
    keys = resolved(definitions[kind]["properties"][key], definitions)["properties"]
    return ["", "", f"class {name}(TypedDict, total=False):", f'    """{words}', "", *described(keys, "    "), '    """', "",
            *(f"    {key}: {type_of(key, schema)}" for key, schema in keys.items())]


def method(kind, schema):
    """The method that adds a part of a kind, or a member of a list."""
    keys = {key: inside for key, inside in schema["properties"].items() if key not in ("kind", "name")}
    needed = schema.get("required", ())
    required = [f"{argument(key)}: {type_of(key, keys[key])}" for key in keys if key in needed and key != "motion"]
    optional = [f"{argument(key)}: {type_of(key, keys[key])} | None = None" for key in keys if key not in needed]
    if "motion" in keys and kind != "obstacles":
        first = keys["motion"].get("default", "harmonic")
        arguments = ["self: S", *required, "*", f'motion: str = "{first}"', *(one for one in optional if "motion:" not in one)]
    else:
        named = ["name: str | None = None"] if "name" in schema["properties"] else []
        arguments = ["self: S", *named, "*", *required, *optional]
    note = [f"        {NOTES[kind]}", ""] if kind in NOTES else []
    call = f'_group("{kind}", "{LISTS[kind]}", locals())' if kind in LISTS else f'_part("{kind}", locals())'
    return ["", "    @takes()", f"    def {kind}(", *(f"        {one}," for one in arguments), "    ) -> S:",
            f'        """Adds {ADDED.get(kind, f"a {kind}")} and returns the scene.', "", *note, *described(keys, "        "),
            '        """', f"        return self.{call}"]


def module():
    """The text of the module."""
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    definitions, kinds = schema["$defs"], schema["properties"]["parts"]["items"]["properties"]["kind"]["enum"]
    lines = [line for name in DICTS for line in dictionary(name, definitions)]
    methods = [line for kind in [*kinds, *LISTS] for line in method(kind, definitions[kind])]
    return INTRO + "\n".join(lines) + "\n" + CLASS + "\n".join(methods) + "\n"
