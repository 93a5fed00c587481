"""Parser for the declarations of the public headers. All generators use this one parser; they need Python 3.8."""

import re
from pathlib import Path

INCLUDE = Path(__file__).resolve().parents[2] / "include"

NUMBERS = {"double", "int32_t", "int64_t"}
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


def functions(text):
    """Names of the functions declared with HOOKE_API."""
    return {name for _, name, _ in declared(text)}


def opaque_types(text):
    return {m.group(1) for _, s in statements(text) if (m := re.fullmatch(rf"typedef struct ({NAME}) \1", s))}


def callback_types(text):
    return {name for _, name, _ in declared(text, "typedef")}


def counts(parameters, fixed=()):
    """{array: how many numbers or rows it has} of the parameters of a function, where another one says so."""
    found, count = {}, None
    for kind, what in parameters:
        if kind == "int64_t":
            count = what if re.fullmatch(r"(\w+_)?count|samples", what) else None
        elif count and (kind == "const int64_t *" or kind.endswith("double *")) and what not in fixed:
            found[what] = count
    return found


def is_status(result, name):
    """Whether the result of a function is a status: every int32_t is, except answers (yes or no) and these numbers."""
    return result == "int32_t" and "_is_" not in name and name not in NUMBER_RESULTS


def write(path, text):
    """Writes a file unless it has this text already, so that nothing is recompiled."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def value_complaint(words, opaque, callbacks, is_result=False):
    """The fault of a parameter (or result) such as "const double *q"."""
    match = re.fullmatch(r"((?:const )?\w+) ?((?:\*(?: ?const\b)? ?)*) ?(\w*)", words)
    if not match:
        return f"`{words}` is not a plain value or pointer"
    kind, stars = match.group(1).split()[-1], match.group(2).count("*")
    if kind in NUMBERS:
        return None
    if kind == "void" and (stars or is_result):
        return None
    if kind == "char" or kind in opaque or kind in callbacks:
        return None if stars else f"`{words}`: {kind} by value"
    return f"`{words}`: the type {kind} does not belong in the interface"


def signature_complaints(text, opaque, callbacks):
    """Statements of a header that are not part of the allowed language."""
    found = []
    for line, words in statements(text):
        match = re.fullmatch(rf"(?:HOOKE_API|typedef) ([^(]*?)\b{NAME} ?\((.*)\)", words)
        if re.fullmatch(rf"typedef struct ({NAME}) \1", words):
            continue
        if not match:
            found.append(f"line {line}: `{words}` is not a function with HOOKE_API, a callback or an opaque struct")
            continue
        values = [] if match.group(2) == "void" else match.group(2).split(",")
        complaints = [value_complaint(match.group(1).strip(), opaque, callbacks, is_result=True)]
        complaints += [value_complaint(v.strip(), opaque, callbacks) for v in values]
        found += [f"line {line}: {c}" for c in complaints if c]
    return found
