"""The declarations of C in bindings/fortran and in the headers, both as plain tuples, for comparison."""

import re

import headers

C_KINDS = {"double": "real(c_double)", "int32_t": "integer(c_int32_t)", "int64_t": "integer(c_int64_t)",
           "char": "character(c_char)"}


def statements(text):
    """Statements of Fortran in lower case, comments out, continued lines joined."""
    lines = [re.sub(r"!.*", "", line).rstrip() for line in text.lower().splitlines()]
    joined = re.sub(r"\s*&\s*\n\s*", " ", "\n".join(lines))
    return [line.strip() for line in joined.splitlines() if line.strip()]


def c_value(words, callbacks, pointers):
    """(type, how it is passed) of a parameter such as "const double *q", in matching Fortran."""
    match = re.fullmatch(r"(const )?(\w+) ?(\**) ?\w*", words.strip())
    const, kind, stars = match.groups()
    if kind in callbacks:
        return "type(c_funptr)", "value"
    if kind == "void" or kind in pointers:
        return "type(c_ptr)", "out" if stars == "**" else "value"
    if stars:
        return C_KINDS[kind], "in" if const else "inout"
    return C_KINDS[kind], "value"


def of_headers(texts):
    """{name: (result, [argument, ...])} of the functions in headers."""
    everything = "".join(texts)
    callbacks, pointers = headers.callback_types(everything), headers.opaque_types(everything)
    found = {}
    for text in texts:
        for _, words in headers.statements(text):
            match = re.fullmatch(r"HOOKE_API (.*?)\b(hooke_\w+) ?\((.*)\)", words)
            if match:
                kind, name, inside = match.groups()
                arguments = [] if inside == "void" else [c_value(a, callbacks, pointers) for a in inside.split(",")]
                result = "type(c_ptr)" if "*" in kind else None if kind.strip() == "void" else C_KINDS[kind.strip()]
                found[name] = (result, arguments)
    return found


def declarations(lines):
    """{name: (type, how it is passed)} of the declarations in one interface."""
    found = {}
    for line in lines:
        left, _, right = line.partition("::")
        words = [w.strip() for w in re.split(r",(?![^(]*\))", left)]
        kind = words[0].replace("character(kind=c_char)", "character(c_char)")
        intents = [m.group(1) for w in words if (m := re.fullmatch(r"intent\((\w+)\)", w))]
        how = "value" if "value" in words else intents[0] if intents else "inout"
        for name in re.split(r",(?![^(]*\))", right):
            shape = re.fullmatch(r"\s*(\w+)\s*(\(\*\))?\s*", name)
            scalar = kind.startswith("type(") or how == "value"
            fits = bool(shape.group(2)) != scalar and (scalar or "optional" in words)
            found[shape.group(1)] = (kind, how) if fits else (kind, "neither a value nor an optional array")
    return found


def of_fortran(text):
    """{name in C: (result, [argument, ...])} of the interfaces in one module."""
    found, lines = {}, statements(text)
    for number, line in enumerate(lines):
        match = re.fullmatch(r'(?:(.*?) )?(function|subroutine) (\w+)\((.*?)\) bind\(c, ?name="(\w+)"\)', line)
        if match:
            result, kind, _, inside, name = match.groups()
            end = lines.index(f"end {kind}", number)
            known = declarations([w for w in lines[number + 1:end] if "::" in w])
            arguments = [known.get(a.strip(), (None, "not declared")) for a in inside.split(",") if a.strip()]
            found[name] = (result, arguments)
    return found


def complaints(have, want):
    """Faults of the interfaces `have` for the functions `want`."""
    found = [f"- {n}: no interface" for n in sorted(want.keys() - have.keys())]
    found += [f"+ {n}: no such function" for n in sorted(have.keys() - want.keys())]
    for name in sorted(have.keys() & want.keys()):
        if have[name] != want[name]:
            found.append(f"! {name}: is {have[name]}, to be {want[name]}")
    return found


def shortened(name):
    return "c_" + name.removeprefix("hooke_")


def called(texts):
    """Names that the modules use outside of their use statements."""
    lines = [line for text in texts for line in statements(text) if not line.startswith("use")]
    return {name for line in lines for name in re.findall(r"\bc_\w+", line)}
