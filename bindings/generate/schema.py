"""Writes examples/scene.schema.json, from scene.template.json and the option tables of the library, and options.json
(keywords.py), of the build in build/release if no other is in PYTHONPATH: python bindings/generate/schema.py"""

import json
import sys
from pathlib import Path

import keywords

ROOT = Path(__file__).resolve().parents[2]
TEMPLATE = Path(__file__).with_name("scene.template.json")
SCHEMA = ROOT / "examples/scene.schema.json"
LARGEST = 1e300  # a bound that means none
QUANTITY = r"^[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?[ \t]*[A-Za-z]+([/ ^A-Za-z0-9]*[A-Za-z0-9])?$"
WIDTH = 110


def named(name):
    return {"$ref": f"#/$defs/{name}"}


def number(value):
    return int(value) if float(value).is_integer() else float(value)


def scalar(row):
    """Bounds hold for numbers; the pattern is that of strings, where a number may have a unit."""
    schema = {"type": "integer" if row.whole else "number"}
    if row.low is not None and row.low > -LARGEST:
        schema["exclusiveMinimum" if row.above_low else "minimum"] = number(row.low)
    if row.high is not None and row.high < LARGEST:
        schema["maximum"] = number(row.high)
    if row.name == "pinned" and not row.words:  # explicit particles, which may have names
        schema["type"] = ["integer", "string"]
    return {**schema, "type": ["number", "string"], "pattern": QUANTITY} if row.units else schema


def array(items, least, most):
    bounds = {"minItems": least, "maxItems": most}
    return {"type": "array", "items": items, **{key: bound for key, bound in bounds.items() if bound}}


def numbers(row):
    """An array, or one in a file; or the other values that the table accepts."""
    items = {"oneOf": [scalar(row), {"enum": row.words}]} if row.word_lists else scalar(row)
    if row.max_count == -1:
        return {"oneOf": [{"enum": row.words}, array({"enum": row.words}, 0, 0)]}
    rows, width = array(items, row.columns, row.columns) if row.columns else items, row.columns or 1
    ways = [array(rows, (row.min_count or 0) // width, (row.max_count or 0) // width), named("dataset")]
    if row.flat:
        ways.insert(0, rows)
    if (row.min_count, row.max_count, row.columns) == (1, None, None):
        ways.insert(0, scalar(row))
    if row.words:
        ways.insert(0, {"enum": row.words})
    return {"oneOf": ways}


def value(row, methods):
    if row.name in ("method", "file"):
        return {"enum": methods} if row.name == "method" else named("path")
    return {"number": scalar, "numbers": numbers, "choice": lambda row: {"enum": row.words},
            "flag": lambda _: {"type": "boolean"}, "text": lambda _: {"type": "string"}}[row.type](row)


def default(row):
    if row.type in ("choice", "text") or row.default in row.words:
        return row.default
    if row.type == "flag":
        return row.default == "true"
    values = [number(float(word)) for word in row.default.split(",")]
    return values if row.max_count else values[0]


def members(rows, family):
    return [row._replace(name=row.name.partition(".")[2]) for row in rows if row.name.startswith(family + ".")]


def ways(rows):
    """What holds for each word of the choices that others belong to, and, where one is not given, without it."""
    for choice in rows:
        own = [row for row in rows if row.only and (row.by or rows[0].name) == choice.name]
        for word in choice.words if own else []:
            refused = {row.name: False for row in own if word not in row.only.split()}
            given = {} if choice.required or choice.default else {"required": [choice.name]}
            yield {"if": {**given, "properties": {choice.name: {"const": word}}},
                   "then": {"required": [row.name for row in own if row.required and row.name not in refused],
                            "properties": refused}}
        if own and not choice.required and not choice.default:
            yield {"if": {"not": {"required": [choice.name]}}, "then": {"properties": {row.name: False for row in own}}}


class Tables:
    """Objects of the schema from tables of options, each with its part of the template."""

    def __init__(self, template, methods):
        self.template, self.methods = template["$defs"], methods

    def inner(self, rows, family):
        inside = members(rows, family)
        names = {row.name for row in inside}
        if "mean" in names:
            self.scale = self.table(inside, {})
            return named("scale")
        springs = names >= {"damping", "damping_ratio"}
        found = self.table(inside, self.template["family"] if springs else {})
        return named("family") if springs and found == self.family else found

    def value(self, rows, row):
        """A number, or numbers, may have a family in their place."""
        if row.type == "family":
            return self.inner(rows, row.name)
        schema = value(row, self.methods)
        if not members(rows, row.name):
            return schema
        return {"oneOf": [*schema.get("oneOf", [schema]), self.inner(rows, row.name)]}

    def table(self, rows, template, **own):
        properties = {**own, **template.get("properties", {})}
        everything, rows = rows, [row for row in rows if "." not in row.name]
        for row in rows:
            schema = self.value(everything, row)
            schema = {**schema, "default": default(row)} if row.default else schema
            properties[row.name] = {**schema, "description": row.doc + (f" [{row.unit}]" if row.unit else "")}
        required = [*(["kind"] if own else []), *template.get("required", []),
                    *(row.name for row in rows if row.required and not row.only)]
        one = {"not": {"required": ["mass", "density"]}} if "density" in properties else {}
        chosen = {"allOf": [*ways(rows)]} if any(row.only for row in rows) else {}
        return {"type": "object", "additionalProperties": False, **({"required": required} if required else {}), **one, **chosen,
                **{key: words for key, words in template.items() if key not in ("required", "properties")},
                "properties": properties}


def schema():
    import hooke

    template = json.loads(TEMPLATE.read_text(encoding="utf-8"))
    definitions, kinds = template["$defs"], hooke.part_kinds()
    tables = Tables(template, [method.name for method in hooke.methods()])
    rows = {kind: hooke.Options.for_part(kind).rows for kind in kinds}
    tables.family = tables.table(members(rows["rope"], "stretch"), definitions["family"])
    name = {"type": "string", "description": "of the part, and the first word of its groups"}
    parts = {kind: tables.table(rows[kind], definitions.get(kind, {}), kind={"const": kind}, name=name) for kind in kinds}
    objects = {name: tables.table(hooke.options_of(name).rows, definitions[name])
               for name in ("particles", "springs", "bending", "anchors", "bodies", "driven", "loads", "obstacles",
                            "run")}
    keys, version = tables.table(hooke.options_of("scene").rows, {})["properties"], template["properties"].pop("hooke")
    template["properties"] = {"hooke": version, **keys, **template["properties"]}
    template["properties"]["parts"]["items"] = {
        "type": "object", "required": ["kind"], "properties": {"kind": {"enum": kinds}},
        "allOf": [{"if": {"properties": {"kind": {"const": kind}}}, "then": named(kind)} for kind in kinds]}
    template["$defs"] = {**definitions, **objects, "scale": tables.scale, "family": tables.family, **parts}
    return template


def laid_out(value, indent=0, lead=0):
    """JSON in which everything that fits is on one line."""
    line = json.dumps(value, ensure_ascii=False)
    if len(line) + indent + lead < WIDTH or not isinstance(value, (dict, list)):
        return line
    keys = [json.dumps(key) + ": " for key in value] if isinstance(value, dict) else [""] * len(value)
    values = value.values() if isinstance(value, dict) else value
    inside = [" " * (indent + 2) + key + laid_out(one, indent + 2, len(key)) for key, one in zip(keys, values)]
    first, last = "{}" if isinstance(value, dict) else "[]"
    return f"{first}\n" + ",\n".join(inside) + f"\n{' ' * indent}{last}"


if __name__ == "__main__":
    sys.path.append(str(ROOT / "build/release/python"))
    SCHEMA.write_text(laid_out(schema()) + "\n", encoding="utf-8")
    keywords.TABLES.write_text(laid_out(keywords.tables()) + "\n", encoding="utf-8")
