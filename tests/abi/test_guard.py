"""The guard covers every function of the headers."""

import os
import re
from pathlib import Path

import guard
import headers

MADE = Path(os.environ["HOOKE_BUILD_DIR"]) / "generated"
PUBLIC = "".join(headers.public().values())
HANDLES, CALLBACKS = headers.opaque_types(PUBLIC), headers.callback_types(PUBLIC)
CALLS = (MADE / "guard/calls.inc").read_text()


def test_every_function_and_every_handle_is_there():
    handles = 0
    for _, name, parameters in headers.declared(PUBLIC):
        line = re.search(rf"^CALL\w*\(.*\b{name.removeprefix('hooke_')}, .*$", CALLS, re.MULTILINE)
        assert line, f"{name} is not guarded"
        # a void * that is no context of the caller's is a handle, too
        taken = [what for kind, what in parameters
                 if re.sub(r"const | \*$", "", kind) in HANDLES or (kind == "void *" and what != "ctx")]
        assert re.findall(r"(?:IS|MAY_BE)\((\w+)", line.group()) == taken, line.group()
        handles += len(taken)
    assert handles > 150


def test_every_pointer_is_checked_or_may_be_null():
    """Whatever else is a pointer: an array, a callback, a place for a result."""
    for _, name, parameters in headers.declared(PUBLIC):
        line = re.search(rf"^CALL\w*\(.*\b{name.removeprefix('hooke_')}, .*$", CALLS, re.MULTILINE).group()
        checked = re.findall(r"(?:IS|MAY_BE|TEXT|WORD|GIVEN)\((\w+)", line)
        for kind, what in parameters:
            is_handle = what in re.findall(r"(?:IS|MAY_BE)\((\w+)", line)
            may = guard.is_optional(name, what) and not is_handle and not kind.endswith("**")
            assert checked.count(what) == (kind.endswith("*") and not may), (name, what)


def test_only_texts_may_be_null_of_which_the_headers_say_so():
    """A comment says so in a sentence with the name of the parameter; "NULL for" and "NULL past" are of results."""
    texts, said, function_of = [], {}, re.compile(r"/\*(.*?)\*/|HOOKE_API [^;()]*?\b(hooke_\w+)\(", re.DOTALL)
    for header in headers.public().values():
        comment = ""
        for words, name in function_of.findall(header):
            said[name] = comment = comment if name else " ".join(words.replace("\n *", " ").split())
        texts += [(name, what) for _, name, parameters in headers.declared(header)
                  for kind, what in parameters if kind == "const char *"]

    def allows(name, what):
        sentences = re.split(r"(?<=\.) ", said[name])
        return any(f"`{what}`" in sentence and re.search(r"NULL(?! for| past)", sentence) for sentence in sentences)

    assert len(texts) > 60
    assert {text for text in texts if guard.is_optional(*text)} == {text for text in texts if allows(*text)}


def test_every_type_of_handle_is_registered():
    """Each is made as a handle and refused as one, and no other is."""
    sources = "".join(path.read_text() for path in (Path(os.environ["HOOKE_SOURCE_DIR"]) / "src").glob("**/*.c"))
    assert set(re.findall(r'hk_handle_new\("(\w+)"', sources)) == HANDLES
    assert set(re.findall(r"\b(?:IS|MAY_BE)\(\w+, (\w+)", CALLS)) == HANDLES
    assert set(guard.BY_CONTEXT.values()) <= HANDLES
    assert len(HANDLES) >= 8 and len(CALLBACKS) >= 7
