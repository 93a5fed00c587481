"""Where addresses have 32 bits, or double precision is rounded twice, the library does not compile, and says why."""

import os
import platform
import subprocess
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])


def compile_with(*flags):
    command = [os.environ["HOOKE_CC"], "-std=c17", "-ffreestanding", "-fsyntax-only", f"-I{ROOT}/include", f"-I{ROOT}/src", *flags,
               "-include", "core/memory.h", "-xc", os.devnull]
    return subprocess.run(command, capture_output=True, text=True)


def test_this_machine():
    assert compile_with().returncode == 0


@pytest.mark.skipif(platform.machine() != "x86_64", reason="flags of x86-64")
@pytest.mark.parametrize("flag", ["-m32", "-mx32"])
def test_others(flag):
    done = compile_with(flag)
    assert done.returncode != 0 and "hooke needs addresses of 64 bits" in done.stderr, done.stderr


def test_registers_of_more_digits():
    """As the compiler describes x87."""
    done = compile_with("-U__FLT_EVAL_METHOD__", "-D__FLT_EVAL_METHOD__=2")
    assert done.returncode != 0 and "rounds twice" in done.stderr, done.stderr
