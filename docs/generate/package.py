"""Writes the Python reference from the docstrings of the public names of the package."""

from __future__ import annotations

import inspect
import re
import types
from typing import Any

from words import WIDTH, markdown

EXAMPLE = """import hooke

result = hooke.run("examples/scenes/oscillator.json", method="verlet", step=1e-3, duration=1)
assert result.status == "finished"
print(result.state.q, result.counts["steps"])
help(hooke.Result)
"""


def signature(name: str, value: Any) -> str:
    try:
        found = inspect.signature(value)
    except (TypeError, ValueError):
        return name
    parameters = [one for word, one in found.parameters.items() if word != "self"]
    text = name + str(found.replace(parameters=parameters))
    if len(text) > WIDTH:  # one line for each
        one_by_one = [str(found.replace(parameters=[p], return_annotation=found.empty))[1:-1] for p in parameters]
        ended = text[text.rindex(")") :]
        star = next((k for k, p in enumerate(parameters) if p.kind is p.KEYWORD_ONLY), None)
        one_by_one = [words.removeprefix("*, ") for words in one_by_one]
        if star is not None and not any(p.kind is p.VAR_POSITIONAL for p in parameters):
            one_by_one.insert(star, "*")
        text = f"{name}(\n    " + ",\n    ".join(one_by_one) + f",\n{ended}"
    return re.sub(r"ForwardRef\((.*?)\)", r"\1", text).replace("'", "")


def block(text: str) -> str:
    return f"```python prototypes\n{text}\n```"


def documented(value: Any) -> str:
    return markdown(inspect.getdoc(value) or "")


def own(value: type, word: str) -> str | None:
    """The docstring of a member, if the class itself has one."""
    member = inspect.getattr_static(value, word)
    if isinstance(member, (staticmethod, classmethod)):
        member = member.__func__
    text = getattr(member, "__doc__", None)
    return inspect.cleandoc(text) if text else None


def members(name: str, value: type) -> list[str]:
    """Public methods and properties of hooke's own classes, in the order of the source."""
    pieces = []
    for word in dict.fromkeys(w for c in reversed(value.__mro__) if c.__module__.startswith("hooke") for w in vars(c)):
        member = inspect.getattr_static(value, word)
        if word.startswith("_"):
            continue
        if isinstance(member, property):
            pieces.append(f"- **`{word}`** {' '.join((own(value, word) or '').split())}".rstrip())
        elif isinstance(member, (types.FunctionType, staticmethod, classmethod)):
            pieces += [block(signature(f"{name}.{word}", getattr(value, word))), markdown(own(value, word) or "")]
    return [piece for piece in pieces if piece]


def one(name: str, value: Any) -> str:
    pieces = [f"### hooke.{name}"]
    if isinstance(value, types.ModuleType):
        pieces.append(documented(value))
        for word, function in vars(value).items():
            if not word.startswith("_") and getattr(function, "__module__", "") == value.__name__:
                pieces += [block(signature(f"{name}.{word}", function)), documented(function)]
    elif isinstance(value, type) and issubclass(value, BaseException):
        bases = ", ".join(base.__name__ for base in value.__mro__[1:-1] if base not in (BaseException, object))
        pieces += [documented(value), f"Is a {bases}."]
    elif isinstance(value, type):
        pieces += [block(signature(name, value)), documented(value), *members(name, value)]
    else:
        pieces += [block(signature(name, value)), documented(value)]
    return join(pieces)


def join(pieces: list[str]) -> str:
    """Joins paragraphs with blank lines between them, and the items of a list without."""
    text = ""
    for piece in filter(None, pieces):
        near = piece.startswith("- ") and text.splitlines()[-1:] and text.splitlines()[-1].startswith("- ")
        text += ("\n" if near else "\n\n") + piece if text else piece
    return text


def page() -> str:
    import hooke

    found = {name: getattr(hooke, name) for name in hooke.__all__}
    groups = {
        "Functions": [n for n, v in found.items() if isinstance(v, types.FunctionType)],
        "Classes": [n for n, v in found.items() if isinstance(v, type) and not issubclass(v, BaseException)],
        "Exceptions": [n for n, v in found.items() if isinstance(v, type) and issubclass(v, BaseException)],
    }
    groups["Others"] = [n for n in found if not any(n in names for names in groups.values())]
    pieces = [
        "# Python reference",
        "What `import hooke` brings, with its docstrings; `help(hooke.run)` prints the same. [The Python "
        "interface](../python.md) is the way in.",
        "```python\n" + EXAMPLE + "```",
    ]
    for title, names in groups.items():
        if names:
            pieces.append(f"## {title}")
            pieces += [one(name, found[name]) for name in names]
    return "\n\n".join(pieces) + "\n"
