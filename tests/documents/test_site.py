"""`make docs`: the site is built without a warning, has every page, plays and typesets, and loads nothing from elsewhere."""

import html.parser
import json
import re
import shutil
import subprocess
import sys

import pytest
from pages import BUILD, ROOT, SITE, script

VERSION = subprocess.run([BUILD / "hooke", "--version"], capture_output=True, text=True).stdout
BROWSER = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])), None)

LOADS = {"img": "src", "script": "src", "iframe": "src", "source": "src", "video": "src", "object": "data", "embed": "src"}
LOADED_LINKS = {"stylesheet", "icon", "preload", "prefetch", "modulepreload", "preconnect", "dns-prefetch", "manifest"}


class Loads(html.parser.HTMLParser):
    """Everything that a browser fetches to show a page."""

    def __init__(self, text):
        super().__init__()
        self.found = re.findall(r"@import\s+['\"]([^'\"]+)|url\(['\"]?([^'\")]+)", text)
        self.found = [a or b for a, b in self.found]
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag in LOADS and attributes.get(LOADS[tag]):
            self.found.append(attributes[LOADS[tag]])
        if tag == "link" and LOADED_LINKS & set((attributes.get("rel") or "").split()):
            self.found.append(attributes.get("href") or "")


def elsewhere(text):
    return [address for address in Loads(text).found if re.match(r"(?!data:)[a-z]+:|//", address, re.IGNORECASE)]


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    script("make_playing").write(BUILD, SITE)
    done = subprocess.run(
        [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-d", folder / "doctrees", "-c", ROOT / "docs", SITE, folder / "html"],
        capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr.strip(), done.stdout + done.stderr
    return folder / "html"


def test_every_page_is_there_and_found(site):
    index = (site / "searchindex.js").read_text(encoding="utf-8")
    for page in SITE.rglob("*.md"):
        name = page.relative_to(SITE).with_suffix("")
        assert (site / f"{name}.html").exists(), name
        assert f'"{name}"' in index, f"{name} is not in the search"


@pytest.mark.parametrize("word, page", [("explod", "why"), ("explod", "stability"), ("instal", "install"), ("jupyt", "python"), ("contact", "questions"),
                                        ("cite", "questions"), ("wind", "c")])
def test_the_search_leads_to_the_answer(site, word, page):
    """By the words of the index, which are stems."""
    text = (site / "searchindex.js").read_text(encoding="utf-8")
    index = json.loads(text[len("Search.setIndex("):-1])
    found = [index[kind].get(word, []) for kind in ("terms", "titleterms")]
    pages = {index["docnames"][k] for one in found for k in ([one] if isinstance(one, int) else one)}
    assert {page, "questions"} <= pages


def test_nothing_is_loaded_from_elsewhere(site):
    for path in [*site.rglob("*.html"), *site.rglob("*.css")]:
        text = path.read_text(encoding="utf-8")
        assert not elsewhere(text), f"{path.name}: {elsewhere(text)}"


@pytest.mark.skipif(re.search(r"(HDF5|LAPACK|Chart\.js|three\.js) +not in this build", VERSION) is not None, reason="this build has no pages")
def test_the_tutorial_plays_its_explosions(site):
    played = re.findall(r'<iframe class="(\w+)" src="([^"#]+)', (site / "tutorial.html").read_text(encoding="utf-8"))
    assert played == [("view", "tutorial-euler.html"), ("why", "tutorial-why.html"), ("why", "tutorial-cloth.html")]
    for _, page in played:
        text = (site / page).read_text(encoding="utf-8")
        assert "diverged" in text and "default-src 'none'" in text


def test_formulas_are_typeset(site, tmp_path):
    """KaTeX is with every page that has formulas, understands all of them, and finds a planted fault."""
    formulas = []
    for page in site.rglob("*.html"):
        text = page.read_text(encoding="utf-8")
        found = re.findall(r'<(?:span|div) class="math">(.*?)</(?:span|div)>', text, re.DOTALL)
        assert not found or "katex/katex.min.js" in text or not (site / "_static/katex").exists()
        formulas += found
    assert len(formulas) > 150
    if BROWSER is None or not (site / "_static/katex").exists():
        pytest.skip("there is no Chromium, or no KaTeX")
    listed = "\n".join(f'<span class="math">{formula}</span>' for formula in [*formulas, r"\planted{"])
    (tmp_path / "all.html").write_text(f"""<!DOCTYPE html><meta charset="utf-8">{listed}
        <script src="{site}/_static/katex/katex.min.js"></script><script>
        for (const formula of document.querySelectorAll(".math")) katex.render(formula.textContent, formula, {{ throwOnError: false }});
        </script>""", encoding="utf-8")
    command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path}/profile", "--dump-dom"]
    drawn = subprocess.run([*command, f"file://{tmp_path}/all.html"], capture_output=True, text=True, timeout=60).stdout
    assert drawn.count('class="katex"') == len(formulas) and drawn.count('class="katex-error"') == 1


@pytest.mark.parametrize(
    "text",
    [
        '<script src="https://example.org/a.js"></script>',
        '<link rel="stylesheet" href="//example.org/a.css">',
        '<img src="http://example.org/a.png">',
        "<style>@import 'https://example.org/a.css';</style>",
        "@font-face { src: url(https://example.org/a.woff2) }",
    ],
)
def test_planted(text):
    assert elsewhere(text)


@pytest.mark.parametrize("text", ['<a href="https://example.org">out</a>', '<img src="data:image/png;base64,AA==">', '<img src="a.png">'])
def test_fine(text):
    assert not elsewhere(text)
