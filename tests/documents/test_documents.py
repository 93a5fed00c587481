"""The code in README.md and docs/ compiles and runs, block after block in one folder that has the example scenes."""

import json
import os
import shutil

import blocks
import outputs
import pytest
from pages import ROOT, SITE, script
from PIL import Image

PAGES = sorted(SITE.rglob("*.md"))
DOCUMENTS = [ROOT / "README.md", ROOT / "bindings/python/README.md", *PAGES]


def name_of(document):
    return str(document.relative_to(SITE.parent if SITE in document.parents else ROOT))


@pytest.fixture
def folder(tmp_path):
    for scenes in ("examples/scenes", "tests/cli/scenes/needs"):
        shutil.copytree(ROOT / scenes, tmp_path / scenes)
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
        ("console", "$ hooke --version\nhooke 0.0.0\n...\n"),
        ("console", "$ hooke no-such-verb # exit 2\nhooke: there is a verb 'no-such-verb'...\n"),
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
        ("console", "$ hooke --version\nhooke ...\n...\n$ git clone something\n"),
        ("sh", "hooke no-such-verb # exit 2\nhooke \\\n  --version | cat\n"),
        ("text", "anything\n"),
        ("c prototypes", "int32_t hooke_abi(void);\n"),
        ("console", "$ hooke no-such-verb # exit 2\nhooke: there is no verb 'no-such-verb'...\n"),
        ("console", "$ hooke --version\nhooke 0...\n...\n$ hooke no-such-verb # exit 2\n...\n"),
    ],
)
def test_fine(kind, text, folder):
    (block,) = blocks.blocks("fine.md", f"```{kind}\n{text}```\n")
    assert blocks.complaint(block, folder) is None


def test_unclosed_block():
    with pytest.raises(ValueError):
        blocks.blocks("bad.md", "```c\nint main(void) {}\n")


TABLE = """method        step    error  steps  wall time
               [s]      [m]              [s]
rk4         0.0002   0.0123   1000     0.0107  finished
...

cvode-bdf        -  6.3e-09    309     0.0234  finished

chosen in wall time 0.2 s (median 0.3 s), 1000 steps
"""


@pytest.mark.parametrize(
    "shown, printed, agrees",
    [
        ("0.0107", "17", True),  # a time
        ("0.0234", "1", True),
        ("0.2 s (median 0.3 s)", "4e-05 s (median 1 s)", True),
        ("...", "heun  1  2  3  4  finished", True),
        ("...\n", "", True),
        ("0.0123", "0.01234", True),
        ("0.0123", "0.0124", False),
        ("1000     0.0107", "1001     0.0107", False),
        ("6.3e-09    309", "4.1e-09    350", True),  # of a method of SUNDIALS
        ("6.3e-09", "1.3e-09", False),
        ("0.0123", "nan", False),
        ("finished\n\nchosen", "finished and more\n\nchosen", False),
        ("), 1000 steps", "), 1001 steps", False),
        ("method  ", "a line before\nmethod  ", False),
        ("1000 steps\n", "1000 steps\nand a line after\n", False),
    ],
)
def test_outputs_agree_but_for_times(shown, printed, agrees):
    assert shown in TABLE
    assert outputs.same(TABLE, TABLE.replace(shown, printed, 1)) == agrees


def test_packages_are_those_that_are_installed():
    packages = script("make_packages")
    text = packages.PAGE.read_text(encoding="utf-8")
    assert packages.written(text) == text and "libhdf5-dev" in text


def test_every_example_scene_is_in_the_gallery():
    page = (ROOT / "docs/gallery.md").read_text(encoding="utf-8")
    for scene in (ROOT / "examples/scenes").glob("*.json"):
        assert f"\n## {scene.stem}\n" in page and f"](images/gallery-{scene.stem}.png)" in page, scene.stem


def test_the_film_is_of_a_step_above_the_limit_and_one_below(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "docs")
    film = script("make_film")
    done = blocks.execute([os.environ["HOOKE_CLI"], "limit", film.SCENE, "--predict", "--methods", "symplectic-euler", "--json"], ROOT)
    limit = json.loads(done.stdout)["rows"][0]["predicted"]
    text = " ".join(DOCUMENTS[0].read_text(encoding="utf-8").split())
    for side, (words, step) in zip((1, -1), film.RUNS.items(), strict=True):
        assert side * (step - limit) > 0 and words in text and f"{1e3 * step:g} ms" in words
    with Image.open(film.FILM) as picture:
        assert picture.n_frames == len(film.SHOWN) and picture.width == len(film.RUNS) * film.SIZE[0]
