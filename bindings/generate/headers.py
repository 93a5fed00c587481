"""Parser for the declarations of the public headers. All generators use this one parser; they need Python 3.8."""

import re
from pathlib import Path

INCLUDE = Path(__file__).resolve().parents[2] / "include"

NUMBERS = ("double", "int32_t", "int64_t")
VECTORS = ("gravity", "amplitude", "momentum", "angular_momentum")  # arrays of three numbers
NAME = r"hooke_[a-z0-9_]+"
# Results of type int32_t that are neither a status nor a yes or no; the last one is the result of a callback.
NUMBER_RESULTS = {"hooke_abi", "hooke_estimate_see"}


def statements(text):
    """Top-level statements of a header as (line, text), comments and preprocessor lines left out."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.DOTALL)
    text = re.sub(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.MULTILINE)
    text = text.replace('extern "C" {', " " * 12)
    text = re.sub(r"^}[ \t]*$", " ", text, flags=re.MULTILINE)
    start = 0
    for part in text.split(";"):
        words = " ".join(part.split())
        if words:
            lead = len(part) - len(part.lstrip())
            yield text.count("\n", 0, start + lead) + 1, words
        start += len(part) + 1


def public(include=INCLUDE):
    """{header: text} of the public headers, by name."""
    return {path.name: path.read_text(encoding="utf-8") for path in sorted((include / "hooke").glob("*.h"))}


def declared(text, lead="HOOKE_API"):
    """(result, name, [(type, name)]) of every function declared with HOOKE_API, or of every callback with `typedef`."""
    for _, words in statements(text):
        match = re.fullmatch(rf"{lead} ([^(]*?)\b({NAME}) ?\((.*)\)", words)
        if match:
            result, name, inside = match.groups()
            parameters = [] if inside == "void" else [re.fullmatch(r"(.*?)(\w+)", p.strip()).groups()
                                                      for p in inside.split(",")]
            yield result.strip(), name, [(kind.strip(), what) for kind, what in parameters]


def short(name):
    """state_time of hooke_state_time."""
    return name[len("hooke_"):]


def functions(text):
    """Names of the functions declared with HOOKE_API."""
    return {name for _, name, _ in declared(text)}


def opaque_types(text):
    return {m.group(1) for _, s in statements(text) if (m := re.fullmatch(rf"typedef struct ({NAME}) \1", s))}


def callback_types(text):
    return {name for _, name, _ in declared(text, "typedef")}


def counts(parameters):
    """{array: how many numbers or rows it has} of the parameters of a function, where another one says so."""
    found, count = {}, None
    for kind, what in parameters:
        if kind == "int64_t":
            count = what if re.fullmatch(r"(\w+_)?count|samples", what) else None
        elif count and (kind == "const int64_t *" or kind.endswith("double *")) and what not in VECTORS:
            found[what] = count
    return found


def object_of(kind):
    """The type of an object that is passed or returned, or of a callback; None for other types."""
    match = re.fullmatch(rf"(?:const )?({NAME}) \*", kind)
    return match.group(1) if match else None


def is_status(result, name):
    """Whether the result of a function is a status: every int32_t is, except answers (yes or no) and these numbers."""
    return result == "int32_t" and "_is_" not in name and name not in NUMBER_RESULTS


def write(path, text):
    """Writes a file unless it has this text already, so that nothing is recompiled."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")
