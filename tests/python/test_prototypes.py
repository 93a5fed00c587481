"""The table of prototypes against the public headers: every function, with the right result and arguments."""

import ctypes
import re
import sys

import pytest
from conftest import ROOT

from hooke import _library, _prototypes
from hooke._library import lib
from hooke._prototypes import PROTOTYPES

sys.path.insert(0, str(ROOT / "tests/abi"))
from headers import statements

STATEMENTS = [
    words
    for path in sorted((ROOT / "include/hooke").glob("*.h"))
    for _, words in statements(path.read_text())
]
# int32_t results that are no status
PLAIN_NUMBERS = {
    "hooke_abi",
    "hooke_options_is_set",
    "hooke_system_is_committed",
    "hooke_method_is_adaptive",
    "hooke_method_is_built",
    "hooke_integrator_stop_value",
    "hooke_estimate_see",
}
OUTCOMES = {
    "hooke_integrator_run",
    "hooke_integrator_resume",
    "hooke_integrator_step",
    "hooke_verify_run",
    "hooke_comparison_run",
    "hooke_study_run",
    "hooke_study_recommend",
    "hooke_study_pick",
    "hooke_measurement_run",
    "hooke_needs_find",
    "hooke_needs_refine",
}
SCALARS = {"double": ctypes.c_double, "int32_t": ctypes.c_int32, "int64_t": ctypes.c_int64}


def declared(lead):
    """Name: (result, parameters) of all declarations that begin with HOOKE_API or typedef."""
    found = {}
    for words in STATEMENTS:
        match = re.fullmatch(rf"{lead} ([^(]*?)\b(hooke_[a-z0-9_]+) ?\((.*)\)", words)
        if match:
            parameters = [] if match.group(3) == "void" else match.group(3).split(",")
            found[match.group(2)] = match.group(1).strip(), [parameter.strip() for parameter in parameters]
    return found


FUNCTIONS, CALLBACKS = declared("HOOKE_API"), declared("typedef")


def c_type(words):
    """("hooke_state", 1) for "const hooke_state *state"."""
    match = re.fullmatch(r"(?:const )?(\w+) ?(\**) ?(?:const )?\w*", words)
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
    assert FUNCTIONS["hooke_state_copy"] == ("int32_t", ["const hooke_state *from", "hooke_state *to"])


def test_the_table_names_exactly_the_public_functions():
    assert set(PROTOTYPES) == set(FUNCTIONS)
    assert set(PROTOTYPES) == set((ROOT / "tests/abi/symbols.txt").read_text().split())


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
def test_a_prototype_is_that_of_the_header(name):
    result, parameters = FUNCTIONS[name]
    row = PROTOTYPES[name]
    assert list(row[1:]) == [expected(words) for words in parameters]
    if result == "int32_t" and name not in PLAIN_NUMBERS:
        assert row[0] is (_prototypes.OUTCOME if name in OUTCOMES else _prototypes.STATUS)
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
        status = result in (_prototypes.STATUS, _prototypes.OUTCOME)
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
