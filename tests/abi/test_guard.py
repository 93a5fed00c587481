"""The guard of builds that check handles stands for every function of the headers, and the test of it calls each one."""

import importlib.util
import os
import re
from pathlib import Path

import headers

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
HINT = "\nrun: python src/guard/make_guard.py"


def maker():
    spec = importlib.util.spec_from_file_location("make_guard", ROOT / "src/guard/make_guard.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_made_files_are_those_of_the_headers():
    for path, text in maker().texts().items():
        assert path.read_text() == text, f"{path.relative_to(ROOT)} is not what the headers say{HINT}"


def test_every_function_and_every_handle_is_there():
    calls = (ROOT / "src/guard/calls.inc").read_text()
    bad = (ROOT / "tests/data/handle_calls.inc").read_text()
    handles = 0
    for header in (ROOT / "include/hooke").glob("*.h"):
        for name in headers.functions(header.read_text()):
            line = re.search(rf"^CALL\w*\(.*\b{name.removeprefix('hooke_')}, .*$", calls, re.MULTILINE)
            assert line, f"{name} is not guarded{HINT}"
            count = len(re.findall(r"hooke_\w+ \*(?!\*)\w+", re.search(r", \((.*?)\), ", line.group()).group(1)))
            callbacks = len(re.findall(r"hooke_(?:force|force_product|drive|rate|observer|progress|warning|comparison_frame) \*",
                                       line.group()))
            assert len(re.findall(r"(?:IS|MAY_BE)\(", line.group())) == count - callbacks, line.group()
            assert len(re.findall(rf"\b{name}, \(", bad)) == count - callbacks, name
            handles += count - callbacks
    assert handles > 200
