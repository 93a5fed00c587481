"""Pages of reports in a headless browser, and their reports of what was drawn."""

import atexit
import functools
import json
import os
import re
import shutil
import subprocess
from html.parser import HTMLParser

import pytest
from conftest import CLI, MINIMAL

BROWSER = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])), None)
VERSION = subprocess.run([CLI, "--version"], capture_output=True, text=True, check=True).stdout
DRAWS = not re.search(r"Chart\.js +not in this build", VERSION)

needs_page = pytest.mark.skipif(MINIMAL or not DRAWS, reason="this build writes no reports: it has no Chart.js")
needs_browser = pytest.mark.skipif(BROWSER is None or os.environ.get("HOOKE_PRESET") == "asan",
                                   reason="there is no Chromium to open the page with, or it is drawn in other builds")

TITLE = "a scene </script><script>throw 1</script><!-- \"&amp;\" \\ \u00b5"

# Counts the pixels of a diagram inside its axes that have the colour of each method.
COUNT_PIXELS = """
for (const id of IDS) {
  const chart = Chart.getChart(id), { left, top, width, height } = chart.chartArea, scale = chart.currentDevicePixelRatio;
  const { data } = chart.ctx.getImageData(left * scale, top * scale, width * scale, height * scale);
  const seen = {};
  for (let k = 0; k < data.length; k += 4) {
    const name = "#" + [0, 1, 2].map((i) => data[k + i].toString(16).padStart(2, "0")).join("");
    seen[name] = (seen[name] || 0) + 1;
  }
  chart.canvas.dataset.pixels = methods.map((method) => seen[colourOf(method)] || 0).join(" ");
}
"""


class Page(HTMLParser):
    """The page after its scripts: attributes and text of the elements with an id."""

    def __init__(self, dom, console):
        super().__init__()
        self.console, self.attributes, self.text, self.open = console, {}, {}, []
        self.feed(dom)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.open.append((tag, values.get("id")))
        if "id" in values:
            self.attributes[values["id"]] = values
            self.text[values["id"]] = ""

    def handle_endtag(self, tag):
        while self.open and self.open.pop()[0] != tag:
            pass

    def handle_data(self, data):
        for _, name in self.open:
            if name:
                self.text[name] += data

    def drawn(self, name):
        """Counts of what Chart.js drew, as the page reports them."""
        data = {key[5:]: value for key, value in self.attributes[name].items() if key.startswith("data-")}
        return {key: int(value) for key, value in data.items() if value.isdigit()} | {
            key: value for key, value in data.items() if not value.isdigit()}


@functools.cache
def opened():
    """One browser for all pages of a process: to start it takes longer than to open a page."""
    from browser import NO_WEBGL, Browser

    browser = Browser(NO_WEBGL)
    atexit.register(browser.close)
    browser.size(1200, 1000)
    return browser


def browse(folder, page, script="", body=""):
    """Opens the page with a script and markup added at its end, and returns its state afterwards."""
    added = body + (f"<script>{script}</script>" if script else "")
    (folder / "page.html").write_text(page.replace("</body>", added + "</body>"), encoding="utf-8")
    browser = opened()
    browser.open(folder / "page.html")
    browser.settle()
    return Page(browser.run("document.documentElement.outerHTML"), [json.dumps(one) for one in browser.console])


def count_pixels(diagrams):
    """The script that counts them."""
    return COUNT_PIXELS.replace("IDS", json.dumps(diagrams))


def fetches(page):
    """Parts of the text of a page that would fetch something, or were left unfilled."""
    code = re.sub(r"/\*.*?\*/", "", page, flags=re.DOTALL)
    return (re.findall(r"https?://\S{0,40}", code)
            + re.findall(r"<(?:link|img|iframe|object|embed)\b|<script[^>]+src|@import|url\(", page)
            + re.findall(r"\{\{", re.sub(r"<script>.*?</script>", "", page, flags=re.DOTALL)))


def data_of(page):
    start = page.index('id="data">') + len('id="data">')
    return json.loads(page[start : page.index("</script>", start)])


def check_same(page, value, path=""):
    """What a page tells under the names of an answer in JSON is the same; returns the names that the page alone has."""
    if isinstance(page, dict) and isinstance(value, dict):
        alone = {key for key in page if key not in value}
        return alone.union(*(check_same(page[key], value[key], f"{path}.{key}") for key in page if key in value))
    if isinstance(page, list) and isinstance(value, list):
        assert len(page) == len(value), path
        return set().union(*(check_same(*pair, f"{path}[]") for pair in zip(page, value)))
    assert page == value, path
    return set()


# What every page has beside the answer.
ABOUT = {"scene", "date", "machine", "versions"}


def check_planted_faults(folder, page):
    """A fault in a script is detected, and the page refuses to fetch anything."""
    seen = browse(folder, page, "throw new Error('planted');", '<img src="http://127.0.0.1:9/planted.png">')
    assert any("planted" in line and "Error" in line for line in seen.console)
    assert any("Content Security Policy" in line for line in seen.console)
