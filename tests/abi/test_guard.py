"""The guard covers every function of the headers, and its test calls each one with each of its handles bad."""

import os
import re
from pathlib import Path

import headers

MADE = Path(os.environ["HOOKE_BUILD_DIR"]) / "generated"


def test_every_function_and_every_handle_is_there():
    calls = (MADE / "guard/calls.inc").read_text()
    bad = (MADE / "handle_calls.inc").read_text()
    handles = 0
    for text in headers.public().values():
        for name in headers.functions(text):
            line = re.search(rf"^CALL\w*\(.*\b{name.removeprefix('hooke_')}, .*$", calls, re.MULTILINE)
            assert line, f"{name} is not guarded"
            count = len(re.findall(r"hooke_\w+ \*(?!\*)\w+", re.search(r", \((.*?)\), ", line.group()).group(1)))
            callbacks = len(re.findall(r"hooke_(?:force|force_product|drive|rate|observer|progress|warning|comparison_frame) \*",
                                       line.group()))
            assert len(re.findall(r"(?:IS|MAY_BE)\(", line.group())) == count - callbacks, line.group()
            assert len(re.findall(rf"\b{name}, \(", bad)) == count - callbacks, name
            handles += count - callbacks
    assert handles > 150
