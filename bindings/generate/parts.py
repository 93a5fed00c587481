"""The module of the Python package with the methods that add parts to a scene, one a kind, from the schema of scenes."""

import json
import keyword
import textwrap
from pathlib import Path

SCHEMA = Path(__file__).resolve().parents[2] / "examples/scene.schema.json"
INTRO = '''"""Parts of a scene: pieces that are generated rather than listed, one method a kind; made from
examples/scene.schema.json by bindings/generate/parts.py."""

from __future__ import annotations

from typing import Any, TypedDict, TypeVar, Union

from ._types import Numbers, Path, Pins

Quantity = Union[float, str]  #: a number, or one with a unit: "200g"
S = TypeVar("S", bound="Parts")
'''
CLASS = '''

class Parts:
    """The methods of a scene that add parts.

    Every part takes a `name` (the default is its kind and its number among the parts) and either `mass`, its total
    [kg], or `density`; an overdamped scene without gravity needs neither. `pinned` pins particles: numbers within the
    part, or words. A family of springs is a dict, ``dict(stiffness=50, damping=0.01)``, see `Springs`; a family that
    is not given has no springs. Springs follow the strain law, so that a finer part of the same material stretches
    equally. Each method returns the scene, for the next call.
    """

    def _part(self: S, kind: str, given: dict[str, Any]) -> S:
        raise NotImplementedError
'''
# What the keys of a part do not say.
NOTES = {
    "cloth": "Particle (r, c) has the number ``r*nu + c`` within the cloth, whose `size` is (nu, nv).",
    "lattice": "Numbers within it run along x first, then y, then z.",
    "mesh": "The scene keeps the vertices of a file, not its name.",
    "strand": "A strand of hair, after Selle, Lentine and Fedkiw (2008).",
}
# Keys whose values are dicts, with the class of these, its description, and the kind and key that has it in the schema.
DICTS = {
    "Springs": ("A family of springs of a part.", "rope", "stretch"),
    "Transform": ("From the coordinates of a mesh to metres.", "mesh", "transform"),
}
TYPES = {"integer": "int", "number": "float", "boolean": "bool", "string": "str"}


def resolved(schema, definitions):
    return definitions[schema["$ref"].rpartition("/")[2]] if "$ref" in schema else schema


def type_of(key, schema):
    if key in ("pinned", "file"):
        return {"pinned": "Pins", "file": "Path"}[key]
    if key == "transform" or schema.get("$ref", "").endswith("/family"):
        return "Springs" if key != "transform" else "Transform"
    kind = schema.get("type", "array")
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
    """The method that adds a part of a kind."""
    keys = {key: inside for key, inside in schema["properties"].items() if key not in ("kind", "name")}
    required = [key for key in keys if key in schema["required"]]
    optional = [f"{argument(key)}: {type_of(key, keys[key])} | None = None" for key in keys if key not in required]
    arguments = ["self: S", "name: str | None = None", "*", *(f"{argument(key)}: {type_of(key, keys[key])}" for key in required),
                 *optional]
    note = [f"        {NOTES[kind]}", ""] if kind in NOTES else []
    return ["", f"    def {kind}(", *(f"        {one}," for one in arguments), "    ) -> S:",
            f'        """Adds a {kind} and returns the scene.', "", *note, *described(keys, "        "), '        """',
            f'        return self._part("{kind}", locals())']


def module():
    """The text of the module."""
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    definitions, kinds = schema["$defs"], schema["properties"]["parts"]["items"]["properties"]["kind"]["enum"]
    lines = [line for name in DICTS for line in dictionary(name, definitions)]
    methods = [line for kind in kinds for line in method(kind, definitions[kind])]
    return INTRO + "\n".join(lines) + "\n" + CLASS + "\n".join(methods) + "\n"
