"""Release builds are hardened: checked calls and canaries, relocation tables that are read-only before anything runs,
position-independent programs, and marks for control-flow protection."""

import os
import platform
import re
import subprocess

import pytest

LIBRARY, ARCHIVE, PROGRAM = (os.environ.get(f"HOOKE_{name}") for name in ("LIBRARY", "STATIC_LIBRARY", "CLI"))
LINKED = [file for file in (LIBRARY, PROGRAM) if file]

pytestmark = pytest.mark.skipif(os.environ["HOOKE_HARDENING"] != "ON" or not os.environ["HOOKE_READELF"],
                                reason="this build is not hardened")


def readelf(*arguments):
    command = [os.environ["HOOKE_READELF"], "-W", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("file", LINKED)
def test_the_loader_leaves_nothing_writable(file):
    assert re.search(r"\bGNU_RELRO\b", readelf("-l", file))
    assert re.search(r"\(FLAGS_1\) .*\bNOW\b", readelf("-d", file))


@pytest.mark.skipif(not PROGRAM, reason="no program in this build")
def test_the_program_has_no_fixed_address():
    assert re.search(r"\(FLAGS_1\) .*\bPIE\b", readelf("-d", PROGRAM))


@pytest.mark.parametrize("file", LINKED)
def test_canaries_and_checked_calls(file):
    symbols = readelf("--dyn-syms", file)
    assert "__stack_chk_fail" in symbols and re.search(r"__v?snprintf_chk", symbols)


@pytest.mark.skipif(platform.machine() != "x86_64", reason="marks of x86-64")
def test_all_code_is_marked():
    """Each object is marked; a linked file is marked only if the C library's own objects are."""
    notes = re.split(r"^File: ", readelf("-n", ARCHIVE), flags=re.MULTILINE)[1:]
    assert len(notes) > 100
    assert [note.partition("\n")[0] for note in notes if not re.search(r"x86 feature: IBT, SHSTK", note)] == []
