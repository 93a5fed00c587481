"""hooke study --report: the page in a headless browser, with what it drew, its words, and no fault in the console."""

import copy
import json
import re
import shutil
import subprocess
from html.parser import HTMLParser

import pytest

from conftest import CLI, MINIMAL, STIFF_PAIR

BROWSER = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])), None)
VERSION = subprocess.run([CLI, "--version"], capture_output=True, text=True, check=True).stdout
DRAWS = not re.search(r"Chart\.js +not in this build", VERSION)

needs_page = pytest.mark.skipif(MINIMAL or not DRAWS, reason="this build writes no reports: it has no Chart.js")
needs_browser = pytest.mark.skipif(BROWSER is None, reason="there is no Chromium to open the page with")

TITLE = "a pair </script><script>throw 1</script><!-- \"&amp;\" \\ \u00b5"
METHODS = ["forward-euler", "symplectic-euler", "rk4", "cvode-adams"]
# Symplectic Euler diverges at 0.1, and rk4 reaches the floor of the reference.
STEPS = "0.1,0.05,0.02,0.01,0.005,1e-5"

# Reads the pixels of a diagram inside its axes: how many have the colour of each method.
COUNT_PIXELS = """
for (const id of ["work-precision", "convergence", "error-over-time", "energy-over-time"]) {
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
PRESS = """document.querySelector('[data-key="force_evaluations"]').click();"""


class Page(HTMLParser):
    """The page as the browser has it after its scripts: attributes and text of the elements that have an id."""

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
        """What the page says that Chart.js drew: a dictionary of counts."""
        data = {key[5:]: value for key, value in self.attributes[name].items() if key.startswith("data-")}
        return {key: int(value) for key, value in data.items() if value.isdigit()} | {
            key: value for key, value in data.items() if not value.isdigit()}


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """The page of a study as text, with the same study as JSON."""
    folder = tmp_path_factory.mktemp("study")
    scene = copy.deepcopy(STIFF_PAIR)
    scene["title"] = TITLE
    scene["run"].update(duration=2, every=0.1)
    (folder / "scene.json").write_text(json.dumps(scene))
    command = [CLI, "study", "scene.json", "--methods", ",".join(METHODS), "--steps", STEPS, "--want", "0.01",
               "--report", "page.html", "--json"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240)
    assert (done.returncode, done.stderr) == (0, "")
    return (folder / "page.html").read_text(encoding="utf-8"), json.loads(done.stdout)


def browse(folder, page, script="", body=""):
    """Opens the page, with a script and markup added at its end, and gives it back as it is afterwards."""
    added = body + (f"<script>{script}</script>" if script else "")
    (folder / "page.html").write_text(page.replace("</body>", added + "</body>"), encoding="utf-8")
    command = [BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
               "--disable-background-networking", "--disable-component-update", "--disable-sync",
               f"--user-data-dir={folder}/profile", "--force-color-profile=srgb", "--window-size=1200,1000",
               "--virtual-time-budget=5000", "--enable-logging=stderr", "--dump-dom", f"file://{folder}/page.html"]
    done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=200)
    assert done.returncode == 0, done.stderr
    return Page(done.stdout, [line for line in done.stderr.splitlines() if "CONSOLE" in line])


def rows_with(value, **wanted):
    return [row for row in value["rows"] if all(row[key] == want for key, want in wanted.items())]


@needs_page
@needs_browser
def test_what_is_drawn(study, tmp_path):
    page, value = study
    seen = browse(tmp_path, page, COUNT_PIXELS)
    assert seen.console == []
    diverged = rows_with(value, status="diverged")
    near = [row for row in value["rows"] if row["error"] is not None and
            row["error"] <= 10 * value["reference"]["agreement"]]
    assert diverged and near, "the scene should show both"

    costs = seen.drawn("work-precision")
    assert costs["across"] == "wall time [s]"
    assert (costs["lines"], costs["points"]) == (len(METHODS), len(value["rows"]))
    assert (costs["crosses"], costs["hollow"], costs["outside"]) == (len(diverged), len(near), 0)

    steps = seen.drawn("convergence")
    fixed = [row for row in value["rows"] if row["step"] is not None]
    orders = [order for order in value["orders"].values() if order["order"] is not None]
    assert (steps["lines"], steps["points"], steps["outside"]) == (3, len(fixed), 0)
    assert steps["crosses"] == len([row for row in diverged if row["step"] is not None])
    assert steps["slopes"] == len(orders) > 0

    for name in ("error-over-time", "energy-over-time"):
        times = seen.drawn(name)
        assert (times["lines"], times["outside"]) == (len(METHODS), 0)
        assert times["points"] == 20 * len(METHODS)  # all frames but the first, where all are 0
    for name, count in {"work-precision": 4, "convergence": 3, "error-over-time": 4, "energy-over-time": 4}.items():
        pixels = [int(n) for n in seen.drawn(name)["pixels"].split()]
        assert min(pixels[:count]) > 100, f"{name}: {pixels} pixels of the methods' colours"


@needs_page
@needs_browser
def test_cost_can_be_switched(study, tmp_path):
    page, value = study
    seen = browse(tmp_path, page, PRESS)
    costs = seen.drawn("work-precision")
    assert seen.console == []
    assert costs["across"] == "force evaluations"
    assert (costs["lines"], costs["points"], costs["outside"]) == (len(METHODS), len(value["rows"]), 0)


@needs_page
@needs_browser
def test_words(study, tmp_path):
    page, value = study
    seen = browse(tmp_path, page)
    assert seen.text["scene"] == TITLE
    chosen = value["recommendation"]
    assert chosen["command"] in seen.text["recommendation"]
    assert chosen["method"] in seen.text["recommendation"]
    for name in value["reference"]["methods"]:
        assert name in seen.text["reference"]
    assert VERSION.split()[1] in seen.text["machine"]
    for row in value["rows"]:
        assert seen.text["rows"].count(row["method"]) == len(rows_with(value, method=row["method"]))
    assert seen.text["rows"].count("diverged") == len(rows_with(value, status="diverged"))


@needs_page
@needs_browser
def test_planted_faults(study, tmp_path):
    """A fault in a script is seen, and the page refuses to fetch anything."""
    page, _ = study
    seen = browse(tmp_path, page, "throw new Error('planted');", '<img src="http://127.0.0.1:9/planted.png">')
    assert any("planted" in line and "Error" in line for line in seen.console)
    assert any("Content Security Policy" in line for line in seen.console)


@needs_page
def test_nothing_is_fetched(study):
    page, _ = study
    code = re.sub(r"/\*.*?\*/", "", page, flags=re.DOTALL)
    assert not re.findall(r"https?://\S{0,40}", code)
    assert not re.findall(r"<(?:link|img|iframe|object|embed)\b|<script[^>]+src|@import|url\(", page)
    assert "{{" not in re.sub(r"<script>.*?</script>", "", page, flags=re.DOTALL)


@needs_page
def test_places_that_cannot_be_written(hooke, write):
    scene = write(STIFF_PAIR)
    assert hooke("study", scene, "--report", "nowhere/page.html").code == 5
    assert hooke("study", scene, "--report", "/dev/null").code == 5
    answer = hooke("study", scene, "--report", scene)
    assert answer.code == 2 and "the scene itself" in answer.err


@pytest.mark.skipif(DRAWS, reason="this build writes reports")
def test_not_in_this_build(hooke, write):
    answer = hooke("study", write(STIFF_PAIR), "--report", "page.html")
    assert answer.code == 6
    assert "libjs-chart.js" in answer.err
