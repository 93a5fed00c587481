"""Writes the reference of the scene format from the option tables of the library and the schema."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

INTRO = """# Scene reference

Every key of a scene: what is allowed, its unit and its default. [Scenes](../scene.md) explains them; the tables here are
those that the library checks by. The same tables in Python:

```python
import hooke

print(hooke.part_kinds())
print(hooke.describe("cloth"))
```

Any array of numbers may stand in a file instead ([numbers from a file](../scene.md#numbers-from-a-file))."""


def cell(text: str) -> str:
    return re.sub(r"(\||<(?=[a-zA-Z/!?]))", r"\\\1", text)


def table(rows: list[list[str]]) -> str:
    head = ["key", "meaning", "allowed", "unit", "default"]
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows])


def option_rows(rows: Any, families: set[str] = frozenset()) -> list[list[str]]:
    found, first = [], {}  # of each family
    for row in rows:
        chosen = first.setdefault(row.name.rpartition(".")[0], row).name
        default = "required" if row.required else f"`{row.default}`" if row.default else ""
        allowed = "[a family of springs](#families-of-springs)" if row.name in families else row.allowed
        words = f"{row.doc}; with {row.by or chosen} `{row.only}`" if row.only else row.doc
        found.append([f"`{row.name}`", cell(words), cell(allowed or row.type), cell(row.unit), default])
    return found


def allowed(schema: dict[str, Any], definitions: dict[str, Any]) -> str:
    """The values that a piece of the schema allows, in a few words."""
    if "$ref" in schema:
        name = schema["$ref"].removeprefix("#/$defs/")
        named = {"dataset": "", "index": "the number of a particle", "particle": "a number, or [\"part\", number]"}
        return named[name] if name in named else allowed(definitions[name], definitions)
    if "oneOf" in schema:
        return " or ".join(filter(None, (allowed(one, definitions) for one in schema["oneOf"])))
    if "const" in schema or "enum" in schema:
        return " or ".join(json.dumps(word) for word in schema.get("enum", [schema.get("const")]))
    if schema.get("type") == "array":
        items = schema.get("items") or {}
        if items.get("minItems") == items.get("maxItems") == 2:
            return f"pairs of: {allowed(items['items'], definitions)}"
        return f"an array of: {allowed(items, definitions)}" if items else "an array"
    bound = f" >= {schema['minimum']}" if "minimum" in schema else ""
    bound = f" > {schema['exclusiveMinimum']}" if "exclusiveMinimum" in schema else bound
    kind = "number" if "number" in schema.get("type", "") else schema.get("type", "")  # with its unit in a string, too
    return {"number": "a number", "integer": "a whole number", "string": "a text", "object": "an object"}.get(
        kind, "") + bound


BELOW = ("particles", "springs", "bending", "anchors", "parts", "bodies", "driven", "loads", "obstacles", "run")


def schema_rows(schema: dict[str, Any], definitions: dict[str, Any], names: Sequence[str],
                below: Sequence[str] = ()) -> list[list[str]]:
    required = schema.get("required", [])
    found = []
    for name in names:
        one = schema["properties"][name]
        words = one.get("description") or definitions.get(one.get("$ref", "")[8:], {}).get("description", "")
        what = f"[below](#{name})" if name in below else cell(allowed(one, definitions))
        found.append([f"`{name}`", cell(words), what, "", "required" if name in required else ""])
    return found


def parts() -> list[str]:
    import hooke

    pieces, members = [], {}  # of families of springs, whose names depend on the part
    for kind in hooke.part_kinds():
        rows = hooke.Options.for_part(kind).rows
        families = {row.name.split(".")[0] for row in rows if row.name.endswith(".stiffness")}
        own = [row for row in rows if row.name.split(".")[0] not in families or row.name in families]
        for row in rows:
            family, _, member = row.name.partition(".")
            if family in families and member:
                members.setdefault(member, row._replace(name=member))
        first = ["`kind`", f'`"{kind}"`', f'"{kind}"', "", "required"]
        name = ["`name`", "of the part, and the first word of the names of its groups", "a text", "", "its kind and number"]
        pieces += [f"### {kind}", table([first, name, *option_rows(own, families)])]
    return [*pieces, "### Families of springs", "Of every part, each under its own name. A family that is absent has no "
            "springs.", table(option_rows(members.values()))]


def page(root: Path) -> str:
    import hooke

    schema = json.loads((root / "examples/scene.schema.json").read_text("utf-8"))
    definitions = schema["$defs"]
    keys = schema_rows(schema, definitions, ["hooke"]) + option_rows(hooke.options_of("scene").rows)
    pieces = [INTRO, "## Keys", table(keys + schema_rows(schema, definitions, BELOW, BELOW))]
    for name in BELOW:
        pieces.append(f"## {name}")
        if name == "run":
            pieces.append("Defaults for the command line and for Python, which override them.")
        if name == "parts":
            pieces += parts()
            continue
        rows = hooke.options_of(name).rows
        own = [key for key in definitions[name]["properties"] if key not in {row.name for row in rows}]
        pieces.append(table(schema_rows(definitions[name], definitions, own) + option_rows(rows)))
    return "\n\n".join(pieces) + "\n"
