"""Writes the reference of the scene format from the option tables of the library and the schema."""

from __future__ import annotations

import json
import re
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


def option_rows(rows: Any, required: list[str], families: set[str] = frozenset()) -> list[list[str]]:
    found = []
    for row in rows:
        default = "required" if row.name in required else f"`{row.default}`" if row.default else ""
        allowed = "[a family of springs](#families-of-springs)" if row.name in families else row.allowed
        found.append([f"`{row.name}`", cell(row.doc), cell(allowed or row.type), cell(row.unit), default])
    return found


def allowed(schema: dict[str, Any], definitions: dict[str, Any]) -> str:
    """The values that a piece of the schema allows, in a few words."""
    if "$ref" in schema:
        name = schema["$ref"].removeprefix("#/$defs/")
        named = {"vector": "3 numbers", "vectors": "rows of 3 numbers", "dataset": "", "index": "the number of a particle",
                 "particle": "a number, or [\"part\", number]",
                 "positive numbers": "one or more numbers > 0", "numbers from 0": "one or more numbers >= 0"}
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


BELOW = ("particles", "springs", "bending", "anchors", "parts", "bodies", "driven", "run")


def schema_rows(schema: dict[str, Any], definitions: dict[str, Any], names: list[str] | None = None,
                below: tuple[str, ...] = ()) -> list[list[str]]:
    required = schema.get("required", [])
    found = []
    for name in names or schema["properties"]:
        one = schema["properties"][name]
        words = one.get("description") or definitions.get(one.get("$ref", "")[8:], {}).get("description", "")
        words, default = taken(words, r"[;,]? *default: (.+)$")
        words, unit = taken(words, r"[,;]? *(?:in )?\[(\S[^\]\"]*)\](?=,|$)")
        default = "required" if name in required else default or (f"`{one['default']}`" if "default" in one else "")
        what = f"[below](#{name})" if name in below else cell(allowed(one, definitions))
        found.append([f"`{name}`", cell(words), what, cell(unit), default])
    return found


def taken(words: str, pattern: str) -> tuple[str, str]:
    """The words without the match of the pattern, and the match."""
    match = re.search(pattern, words)
    return ((words[: match.start()] + words[match.end() :]).lstrip(", "), match[1]) if match else (words, "")


def parts(schema: dict[str, Any]) -> list[str]:
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
        required = schema["$defs"].get(kind, {}).get("required", [])
        pieces += [f"### {kind}", table([first, name, *option_rows(own, required, families)])]
    return [*pieces, "### Families of springs", "Of every part, each under its own name. A family that is absent has no "
            "springs.", table(option_rows(members.values(), schema["$defs"]["family"]["required"]))]


def page(root: Path) -> str:
    import hooke

    schema = json.loads((root / "examples/scene.schema.json").read_text("utf-8"))
    definitions = schema["$defs"]
    springs = schema_rows(definitions["springs"], definitions, ["name", "between"])
    pieces = [
        INTRO,
        "## Keys",
        table(schema_rows(schema, definitions, below=BELOW)),
        "## particles",
        table(schema_rows(definitions["particles"], definitions)),
        "## springs",
        table(springs + option_rows(hooke.Options.for_springs().rows, definitions["springs"]["required"])),
        "## bending",
        table(schema_rows(definitions["bending"], definitions, ["name", "triples"])
              + option_rows(hooke.Options.for_scene("bending").rows, definitions["bending"]["required"])),
        "## anchors",
        table(schema_rows(definitions["anchors"], definitions, ["name", "particles"])
              + option_rows(hooke.Options.for_anchors().rows, definitions["anchors"]["required"])),
        "## parts",
        *parts(schema),
        "## bodies",
        table(schema_rows(definitions["bodies"], definitions)),
        "## driven",
        *driven(definitions),
        "## run",
        "Defaults for the command line and for Python, which override them.",
        table(option_rows(hooke.Options.for_run().rows, [])),
    ]
    return "\n\n".join(pieces) + "\n"


def driven(definitions: dict[str, Any]) -> list[str]:
    shared, pieces = definitions["driven"], []
    for one in shared["oneOf"]:
        properties = {key: shared["properties"][key] if value is True else value for key, value in one["properties"].items()}
        rows = schema_rows({"properties": properties, "required": shared["required"] + one["required"]}, definitions)
        pieces += [f"### {one['properties']['motion']['const']}", table(rows)]
    return pieces
