"""The code in README.md and docs/ compiles and runs, block after block in one folder that has the example scenes."""

import os
import shutil

import blocks
import pytest
from pages import ROOT, SITE

PAGES = sorted(SITE.rglob("*.md"))
DOCUMENTS = [ROOT / "README.md", ROOT / "bindings/python/README.md", *PAGES]


def name_of(document):
    return str(document.relative_to(SITE.parent if SITE in document.parents else ROOT))


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(ROOT / "examples/scenes", tmp_path / "examples/scenes")
    return tmp_path


@pytest.mark.parametrize("document", DOCUMENTS, ids=name_of)
def test_document(document, folder):
    found = blocks.blocks(name_of(document), document.read_text(encoding="utf-8"))
    complaints = [c for b in found if (c := blocks.complaint(b, folder))]
    assert not complaints, "\n\n".join(complaints)


@pytest.mark.parametrize("document", PAGES, ids=name_of)
def test_every_page_has_a_snippet_that_runs(document):
    found = blocks.blocks(name_of(document), document.read_text(encoding="utf-8"))
    assert any(blocks.runs(block) for block in found)


def test_readme_shows_every_language():
    kinds = {b.kind for b in blocks.blocks("README.md", DOCUMENTS[0].read_text(encoding="utf-8"))}
    assert {"c", "python"} <= kinds and kinds & {"console", "sh"}


FORTRAN = pytest.mark.skipif(not os.environ["HOOKE_FORTRAN"], reason="there is no Fortran compiler")
PROGRAM = "#include <hooke.h>\nint main(void) { return %s; }\n"


@pytest.mark.parametrize(
    "kind, text",
    [
        ("c", PROGRAM % "hooke_abi() + 1"),
        ("c", PROGRAM % "hooke_no_such_function()"),
        ("c", "int32_t status = hooke_scene_load(path, &scene);\n"),
        pytest.param("fortran", "use hooke\nerror stop hooke_version()\nend\n", marks=FORTRAN),
        pytest.param("fortran", "use hooke, only: hooke_no_such_name\nend\n", marks=FORTRAN),
        ("python", "import hooke\nhooke.no_such_name\n"),
        ("console", "$ hooke run no-such-scene.json\n"),
        ("sh", "hooke no-such-verb\n"),
        ("sh", "hooke --version # exit 2\n"),
        ("", "anything\n"),
        ("cpp", PROGRAM % "0"),
        ("c other", PROGRAM % "0"),
        ("console exact", "$ hooke --version\nhooke 0.0.0\n...\n"),
        ("console exact", "$ hooke no-such-verb # exit 2\nhooke: there is a verb 'no-such-verb'...\n"),
    ],
)
def test_planted(kind, text, folder):
    (block,) = blocks.blocks("bad.md", f"Text.\n\n```{kind}\n{text}```\n")
    assert blocks.complaint(block, folder)


@pytest.mark.parametrize(
    "kind, text",
    [
        ("c", PROGRAM % "hooke_abi() != HOOKE_ABI"),
        ("fortran", "use hooke\nif (hooke_abi() < 0) error stop\nend\n"),
        ("python", "import hooke\n"),
        ("console", "$ hooke --version\nhooke 0.2.0\n$ git clone something\n"),
        ("sh", "hooke no-such-verb # exit 2\nhooke \\\n  --version | cat\n"),
        ("text", "anything\n"),
        ("c prototypes", "int32_t hooke_abi(void);\n"),
        ("console exact", "$ hooke no-such-verb # exit 2\nhooke: there is no verb 'no-such-verb'...\n"),
        ("console exact", "$ hooke --version\nhooke 0...\n...\n$ hooke no-such-verb # exit 2\n...\n"),
    ],
)
def test_fine(kind, text, folder):
    (block,) = blocks.blocks("fine.md", f"```{kind}\n{text}```\n")
    assert blocks.complaint(block, folder) is None


def test_unclosed_block():
    with pytest.raises(ValueError):
        blocks.blocks("bad.md", "```c\nint main(void) {}\n")
