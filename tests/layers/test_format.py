"""C sources are as clang-format would write them."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
WANTED = 14  # other versions format some code differently
FOLDERS = ["include", "src", "cli", "bench", "examples", "tests"]


def formatter():
    for name in (f"clang-format-{WANTED}", "clang-format"):
        program = shutil.which(name)
        if program:
            version = subprocess.run([program, "--version"], capture_output=True, text=True).stdout
            if re.search(rf"version {WANTED}\.", version):
                return program
    return None


PROGRAM = formatter()
pytestmark = pytest.mark.skipif(PROGRAM is None, reason=f"clang-format {WANTED} is not installed")


def complaints(*files):
    style = f"--style=file:{ROOT / '.clang-format'}"
    result = subprocess.run([PROGRAM, "--dry-run", "-Werror", style, *files], capture_output=True, text=True)
    return result.returncode, result.stderr


def test_sources():
    files = [str(p) for f in FOLDERS for p in sorted((ROOT / f).rglob("*.[ch]"))]
    assert files
    code, text = complaints(*files)
    assert code == 0, text


def test_planted(tmp_path):
    bad = tmp_path / "bad.c"
    bad.write_text("int main( void )\n{\n      return 0; }\n")
    code, text = complaints(str(bad))
    assert code != 0 and "bad.c" in text
