"""The pages of the references are complete against the sources."""

import re

from pages import ROOT, SITE, make_reference

PAGES = {path.stem: path.read_text(encoding="utf-8") for path in (SITE / "reference").iterdir()}


def test_every_reference_is_named_where_they_are_looked_for():
    named = re.findall(r"`reference/([\w-]+)\.md`", (SITE / "reference.md").read_text(encoding="utf-8"))
    assert sorted(named) == sorted(PAGES)


def test_every_public_function_is_there():
    text = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "include/hooke").glob("*.h"))
    symbols = re.findall(r"^HOOKE_API [^(]*\b(hooke_\w+)\(", text, re.MULTILINE)
    titles = "\n".join(re.findall(r"^### .*$", PAGES["c"], re.MULTILINE))
    assert symbols and not [s for s in symbols if f"`{s}`" not in titles]


def test_every_option_of_every_part_is_there():
    import hooke

    for kind in hooke.part_kinds():
        section = PAGES["scene"].split(f"\n### {kind}\n")[1].split("\n### ")[0]
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
