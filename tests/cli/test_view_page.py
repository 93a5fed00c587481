"""The page of hooke view in a headless browser: it draws, plays, turns, and states what it shows."""

import io
import json
import os
import re
import subprocess

import pytest
from browser import Browser
from conftest import CLI, STIFF_PAIR
from pages import BROWSER
from test_view import CLOTH, DRAWS

np = pytest.importorskip("numpy")

pytestmark = [pytest.mark.skipif(not DRAWS or os.environ.get("HOOKE_PRESET") == "asan", reason="drawn in other builds"),
              pytest.mark.skipif(BROWSER is None, reason="there is no Chromium to open the page with")]

SPACE, LEFT, RIGHT, HOME, END = (" ", 32), ("ArrowLeft", 37), ("ArrowRight", 39), ("Home", 36), ("End", 35)
SHIFT = 8


def make(folder, scene, code=0, *options, **run):
    scene = {**scene, "run": {**scene["run"], **run}}
    (folder / "scene.json").write_text(json.dumps(scene))
    assert subprocess.run([CLI, "run", "scene.json", "-o", "out.h5", "-q"], cwd=folder, capture_output=True).returncode == code
    assert subprocess.run([CLI, "view", "out.h5", "-o", "page.html", "-q", *options], cwd=folder).returncode == 0
    return folder / "page.html"


@pytest.fixture(scope="module")
def opened():
    opened = Browser()
    yield opened
    opened.close()


@pytest.fixture
def browser(opened):
    opened.dark(False)
    opened.size(700, 620)
    return opened


@pytest.fixture(scope="module")
def cloth(tmp_path_factory):
    return make(tmp_path_factory.mktemp("cloth"), CLOTH, duration=0.4)


@pytest.fixture
def page(browser, cloth):
    browser.open(cloth)
    yield browser
    assert browser.console == []


def seen(browser, name="picture"):
    """The pixels of an element; of the picture without overlays."""
    image = pytest.importorskip("matplotlib.image")
    browser.run('for (const id of ["legend", "axes", "thinned"]) at(id).style.visibility = "hidden"')
    return (image.imread(io.BytesIO(browser.picture(name)))[5:-5, 5:-5, :3] * 255).round().astype(int)


def ink(picture, background=(255, 255, 255)):
    """Number of pixels that are not background."""
    return int((np.abs(picture - background).max(axis=2) > 40).sum())


def frame(browser):
    return browser.run("Number(document.body.dataset.frame)")


def test_it_draws(page):
    first = seen(page)
    assert 2000 < ink(first) < 0.5 * first.shape[0] * first.shape[1]
    edge = np.concatenate([first[3:8, 3:-3].reshape(-1, 3), first[3:-3, 3:8].reshape(-1, 3)])
    assert (edge == 255).all(), "all of it fits"
    assert page.run("document.title").startswith("hooke view: a scene </script>")
    assert "symplectic-euler, step 1e-4 s" in page.run('at("lead").textContent')
    assert "all 41 frames; all springs" in page.run('at("shown").textContent')
    assert page.run('[...at("marks").children].map((item) => item.textContent).join()') == "pinned,driven"
    assert page.run('at("alert").hidden && at("thinned").hidden && at("missing").hidden')
    assert page.run("[data.strain_low < 0, chart.data.datasets.length, chart.data.datasets[0].data.length]") == [True, 3, 41]


def test_scrubbing(page):
    first = seen(page)
    page.run('at("frame").value = 30; at("frame").dispatchEvent(new Event("input"))')
    later = seen(page)
    assert (np.abs(first - later).max(axis=2) > 40).sum() > 500
    assert frame(page) == 30 and page.run('at("now").textContent').startswith("frame 30 / 40 ")
    cursor = page.run('at("cursor").getBoundingClientRect().left - at("energy").getBoundingClientRect().left')
    assert cursor == pytest.approx(page.run("chart.scales.x.getPixelForValue(0.3)"), abs=1.5)
    page.run("show(0, true)")
    assert (seen(page) == first).all()
    left, right, top = page.run("""(({ left, top }) => [0, 0.2].map((t) => left + chart.scales.x.getPixelForValue(t)).concat(top +
        40))(at("energy").getBoundingClientRect())""")
    page.drag(right, top, 0, 0)
    assert frame(page) == 20
    page.drag(right, top, left - right, 0)
    assert frame(page) == 0


def test_keys(page):
    for key, modifiers, expected in ((RIGHT, 0, 1), (RIGHT, SHIFT, 11), (LEFT, 0, 10), (END, 0, 40), (RIGHT, 0, 40), (HOME, 0, 0)):
        page.press(*key, modifiers)
        assert frame(page) == expected
    page.press(*SPACE)
    assert page.run("playing") and page.run('at("play").textContent') == "Pause"
    page.run("new Promise((done) => setTimeout(done, 400))")
    page.press(*SPACE)
    assert not page.run("playing") and frame(page) > 0


def test_a_link_to_a_frame(page, cloth):
    page.open(f"{cloth}#frame=12")
    assert frame(page) == 12


def test_turning_and_fitting(page):
    first = seen(page)
    page.drag(350, 250, 100, 30)
    turned = seen(page)
    assert (np.abs(first - turned).max(axis=2) > 40).sum() > 1000
    page.press("f", 70)
    assert 2000 < ink(seen(page))


def test_the_camera_stands_upright(page):
    assert page.run("picture.camera.up.toArray()") == [0, 0, 1]


def test_dark(page):
    page.dark(True)
    picture = seen(page)
    assert (picture[4, 4] == [0x14, 0x18, 0x1C]).all() and ink(picture, (0x14, 0x18, 0x1C)) > 2000


def test_small_screens(page, cloth):
    page.size(360, 640, True, 2)
    page.open(cloth)
    assert page.run("document.documentElement.scrollWidth") == 360
    assert ink(seen(page)) > 2000
    boxes = page.run("""[...at("controls").querySelectorAll("button, select, output, input")].map((e) =>
        e.getBoundingClientRect()).filter((b) => b.width > 0).map((b) => [b.left, b.top, b.right, b.bottom])""")
    for k, a in enumerate(boxes):
        for b in boxes[:k]:
            assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1], "controls lie over each other"


def test_colours_of_strain(browser, tmp_path):
    """A spring that swings about its rest length: orange when it is long, blue when it is short."""
    browser.open(make(tmp_path, STIFF_PAIR, step=0.001, duration=0.2, every=0.001))
    strains = browser.run("data.time.map((t, k) => bytesOfFrame(k)[6 * data.particles])")
    for k, code in enumerate(strains):
        assert code == pytest.approx(127 + 127 * np.cos(np.sqrt(1000) * 0.001 * k), abs=3)
    for strongest, red_over_blue in ((0, True), (int(np.argmin(strains)), False)):
        browser.run(f"show({strongest}, true)")
        picture = seen(browser)
        rows = picture[: int(0.7 * len(picture))].reshape(-1, 3)
        coloured = rows[np.abs(rows[:, 0] - rows[:, 2]) > 60]
        assert len(coloured) > 300 and ((coloured[:, 0] > coloured[:, 2]) == red_over_blue).mean() > 0.95


def test_a_run_that_diverged(browser, tmp_path):
    browser.open(make(tmp_path, CLOTH, 4, step=0.02, every=0.02, duration=2))
    assert re.match(r"The run diverged. These are the frames up to then, t = \S+ s of 2 s", browser.run('at("alert").textContent'))
    assert browser.run('!at("alert").hidden') and ink(seen(browser)) > 1000
    browser.press(*END)
    assert browser.console == []


def test_one_frame_and_no_spring(browser, tmp_path):
    dust = {"hooke": 1, "particles": {"position": [[0, 0, 0]], "mass": 1},
            "run": {"method": "rk4", "step": 1, "duration": 1, "every": 1}}
    browser.open(make(tmp_path, dust))
    assert browser.run('at("scale").hidden') and 20 < ink(seen(browser)) < 200
    browser.press(*SPACE)
    assert browser.console == []


def test_fewer_springs_while_it_moves(page):
    """Where drawing is slow, every k-th spring is drawn, and the page says so, until the picture stands still."""
    all_of_them = ink(seen(page))
    page.run("enough = 4; thin(enough)")
    page.settle()
    assert page.run("[picture.drawnSprings(), picture.lines.geometry.drawRange.count / 6]") == [27, 27]
    assert page.run('at("thinned").textContent').startswith("While it moves, every 4th spring is drawn")
    assert page.run('!at("thinned").hidden') and ink(seen(page)) < 0.6 * all_of_them
    page.run("play(); pause()")
    assert page.run("picture.stride") == 1 and page.run('at("thinned").hidden')
    # only slow drawing causes it, and only with many springs
    page.run("for (let k = 0; k < 20; k++) keepUp(100); data.springs = 1e5; enough = 1; costs = []")
    page.run("for (let k = 0; k < 6; k++) keepUp(20)")
    assert page.run("enough") == 1
    for cost, expected in ((100, 2), (70, 4), (45, 7), (44, 7), (20, 7)):
        page.run(f"costs = []; for (let k = 0; k < 6; k++) keepUp({cost})")
        assert page.run("enough") == expected


def test_without_webgl(browser, cloth, tmp_path):
    text = cloth.read_text(encoding="utf-8").replace("<body>", """<body><script>
        HTMLCanvasElement.prototype.getContext = ((old) => function (kind, ...more) {
          return kind.includes("webgl") ? null : old.call(this, kind, ...more); })(HTMLCanvasElement.prototype.getContext);
        </script>""")
    (tmp_path / "page.html").write_text(text, encoding="utf-8")
    browser.open(tmp_path / "page.html")
    assert browser.run('!at("missing").hidden') and ink(seen(browser, "energy")) > 300
    browser.press(*RIGHT)
    assert frame(browser) == 1


def test_planted_faults(browser, cloth, tmp_path):
    """A fault in a script is detected, and the page refuses to fetch anything."""
    text = cloth.read_text(encoding="utf-8").replace("</body>", """<img src="http://127.0.0.1:9/planted.png">
        <script>throw new Error("planted");</script></body>""")
    (tmp_path / "page.html").write_text(text, encoding="utf-8")
    browser.open(tmp_path / "page.html")
    found = json.dumps(browser.console)
    assert "Error: planted" in found and "Content Security Policy" in found
