"""The pages of docs/reference are what docs/make_reference.py makes of the sources."""

import importlib.util
import os
import re
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
BUILD = Path(os.environ["HOOKE_BUILD_DIR"])

spec = importlib.util.spec_from_file_location("make_reference", ROOT / "docs/make_reference.py")
make_reference = importlib.util.module_from_spec(spec)
spec.loader.exec_module(make_reference)


@pytest.fixture(scope="module")
def pages():
    return make_reference.pages(BUILD)


def test_pages_are_as_they_are_made(pages):
    late = [name for name, text in pages.items()
            if text and (ROOT / f"docs/reference/{name}.md").read_text(encoding="utf-8") != text]
    assert not late, f"out of date: {late}; python docs/make_reference.py build/release writes them again"


def test_every_public_function_is_there(pages):
    symbols = [s for s in (ROOT / "tests/abi/symbols.txt").read_text(encoding="utf-8").split() if s.startswith("hooke_")]
    titles = "\n".join(re.findall(r"^### .*$", pages["c"], re.MULTILINE))
    assert symbols and not [s for s in symbols if f"`{s}`" not in titles]


def test_every_option_of_every_part_is_there(pages):
    import hooke

    for kind in hooke.part_kinds():
        section = pages["scene"].split(f"\n### {kind}\n")[1].split("\n### ")[0]
        for row in hooke.Options.for_part(kind).rows:
            assert f"`{row.name}`" in section or "." in row.name, row.name


def test_a_change_of_a_comment_is_noticed(tmp_path):
    header = tmp_path / "include/hooke/one.h"
    header.parent.mkdir(parents=True)
    (tmp_path / "include/hooke.h").write_text('#include "hooke/one.h"\n')
    text = "/* hooke/one.h - one thing. */\n\n/* Makes one.\n * Twice. */\nHOOKE_API int32_t hooke_one(double x,\n                          double y);\n"
    header.write_text(text)
    before = make_reference.headers.page(tmp_path)
    assert "### `hooke_one`\n\nMakes one. Twice.\n\n```c prototypes\nint32_t hooke_one(double x,\n                double y);\n```" in before
    header.write_text(text.replace("Twice", "Once"))
    assert make_reference.headers.page(tmp_path) != before
