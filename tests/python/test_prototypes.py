"""The table of prototypes compared with the public headers: every function, with the right result and arguments."""

import ctypes
import re

import headers
import pytest
from conftest import ROOT

from hooke import _library, _prototypes
from hooke._library import lib
from hooke._prototypes import PROTOTYPES

FUNCTIONS, CALLBACKS = (
    {name: (result, [kind for kind, _ in parameters]) for text in headers.public().values()
     for result, name, parameters in headers.declared(text, lead)}
    for lead in ("HOOKE_API", "typedef")
)  # fmt: skip
SCALARS = {"double": ctypes.c_double, "int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64}


def c_type(words):
    """("hooke_state", 1) for "const hooke_state *"."""
    match = re.fullmatch(r"(?:const )?(\w+) ?(\**)", words)
    assert match, words
    return match.group(1), len(match.group(2))


def expected(words):
    kind, stars = c_type(words)
    if kind in CALLBACKS:
        return getattr(_prototypes, kind.removeprefix("hooke_").upper())
    if kind in SCALARS:
        return ctypes.POINTER(SCALARS[kind]) if stars else SCALARS[kind]
    if kind == "char":
        return ctypes.c_char_p
    if kind == "void":
        return ctypes.c_void_p if stars else None
    handle = getattr(_prototypes, kind.removeprefix("hooke_").upper())
    return handle if stars == 1 else ctypes.POINTER(handle)


def test_the_parser_sees_the_headers():
    text = "".join(path.read_text() for path in (ROOT / "include/hooke").glob("*.h"))
    assert len(FUNCTIONS) == len(re.findall(r"^HOOKE_API ", text, re.MULTILINE)) > 100
    assert FUNCTIONS["hooke_state_copy"] == ("int32_t", ["const hooke_state *", "hooke_state *"])


def test_the_table_names_exactly_the_public_functions():
    assert set(PROTOTYPES) == set(FUNCTIONS)


def test_what_returns_outcomes_returns_a_status():
    assert {PROTOTYPES[name][0] for name in _library.OUTCOMES} == {_prototypes.STATUS}


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_a_prototype_is_that_of_the_header(name):
    result, parameters = FUNCTIONS[name]
    row = PROTOTYPES[name]
    assert list(row[1:]) == [expected(words) for words in parameters]
    answers = result == "int32_t" and re.search(r"_is_|^hooke_abi$|_stop_value$|_see$", name)
    if result == "int32_t" and not answers:
        assert row[0] is _prototypes.STATUS
    else:
        assert row[0] == expected(result)


@pytest.mark.parametrize("name", sorted(CALLBACKS))
def test_a_callback_type_is_that_of_the_header(name):
    result, parameters = CALLBACKS[name]
    callback = getattr(_prototypes, name.removeprefix("hooke_").upper())
    assert callback._restype_ is ctypes.c_int32 and result == "int32_t"

    def passed(words):  # arrays and states come as addresses
        kind, stars = c_type(words)
        return ctypes.c_void_p if stars and kind != "char" else expected(words)

    assert list(callback._argtypes_) == [passed(words) for words in parameters]


def test_every_prototype_is_installed():
    for name, (result, *arguments) in PROTOTYPES.items():
        function = getattr(lib, name)
        function = getattr(function, "__wrapped__", function)
        status = result is _prototypes.STATUS
        assert list(function.argtypes) == arguments
        assert function.restype is (ctypes.c_int32 if status else result)
        assert hasattr(function, "errcheck") == status or not status


def test_the_abi_is_that_of_the_headers():
    header = (ROOT / "include/hooke/base.h").read_text()
    assert re.search(r"#define HOOKE_ABI +(\d+)", header).group(1) == str(_library.ABI)
    assert lib.hooke_abi() == _library.ABI


def test_a_wrong_name_is_an_error():
    with pytest.raises(AttributeError):
        lib.hooke_no_such_function()
    with pytest.raises(AttributeError):
        lib.hooke_no_such_function = 1


def test_a_handle_of_another_kind_is_refused(system):
    state = system.state()
    with pytest.raises(ctypes.ArgumentError):
        lib.hooke_system_particle_count(state._handle)
