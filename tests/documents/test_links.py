"""No internal link of README.md, CONTRIBUTING.md, SECURITY.md, CHANGELOG.md, docs/ and the references is broken."""

from pathlib import Path

import links
import pytest
from pages import ROOT, SITE

DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "SECURITY.md", ROOT / "CHANGELOG.md",
             *sorted((ROOT / "docs").rglob("*.md")), *sorted((ROOT / "bindings").rglob("*.md"))]


def test_links_lead_somewhere():
    found = [links.complaints(document, ROOT) for document in DOCUMENTS]
    found += [links.complaints(page, SITE) for page in (SITE / "reference").iterdir()]
    missing = [line for lines, _ in found for line in lines]
    print("not followed:", *sorted({address for _, addresses in found for address in addresses}), sep="\n  ")
    assert not missing, "\n".join(missing)


def test_every_page_is_in_the_index():
    index = (ROOT / "docs/index.md").read_text(encoding="utf-8")
    listed = {target.partition("#")[0] for target in links.targets(index)}
    pages = {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").rglob("*.md")} - {"index.md"}
    assert pages <= listed, f"not in docs/index.md: {sorted(pages - listed)}"


def test_pictures_are_small_and_seen():
    seen = {Path(target).name for page in DOCUMENTS for target in links.targets(page.read_text(encoding="utf-8"))}
    for picture in (ROOT / "docs/images").iterdir():
        assert picture.stat().st_size < (1.5e6 if picture.suffix == ".gif" else 150e3), picture.name
        assert picture.name in seen, f"no page shows {picture.name}"


PAGE = "# A page\n\n## Safe `h*w` steps, (first)\n\n## Twice\n\n## Twice\n"


@pytest.mark.parametrize("anchor", ["a-page", "safe-hw-steps-first", "twice", "twice-1"])
def test_anchors(anchor):
    assert anchor in links.anchors(PAGE)


@pytest.mark.parametrize("target", ["no.md", "#no", "page.md#no", "../../etc/passwd", "images/no.png"])
@pytest.mark.parametrize("text", ["[words]({})\n", "![words]({})\n", "| a |\n| --- |\n| [words]({}) |\n"])
def test_planted(tmp_path, text, target):
    page = tmp_path / "page.md"
    page.write_text(PAGE + text.format(target), encoding="utf-8")
    assert links.complaints(page, tmp_path)[0]


@pytest.mark.parametrize("text", ["[words](page.md#twice-1)", "[words](#a-page)", "`[words](no.md)`", "```\n[a](no.md)\n```"])
def test_fine(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(PAGE + text + "\n", encoding="utf-8")
    assert not links.complaints(page, tmp_path)[0]
