"""The playground in Chromium, from a file: it runs, blows up by one drag, says why, and is set right; bits, errors, links."""

import json
import math
import time

import pytest
from browser import Browser
from conftest import ROOT
from pages import BROWSER
from test_same_bits import native

import hooke

PAGE = ROOT / "build/playground/live.html"
pytestmark = [pytest.mark.skipif(not PAGE.exists(), reason="the playground is not built (`make playground`)"),
              pytest.mark.skipif(BROWSER is None, reason="there is no Chromium to open the page with")]


@pytest.fixture(scope="module")
def browser():
    browser = Browser()
    yield browser
    browser.close()


def wait(browser, condition, seconds=60):
    end = time.monotonic() + seconds
    while not browser.run(condition):
        state = browser.run("JSON.stringify(document.body.dataset) + at('verdict-words').textContent + at('why-words').textContent")
        assert time.monotonic() < end, f"{condition}: {state}, {browser.console}"
        time.sleep(0.2)


def begin(browser, fragment=""):
    browser.open(f"{PAGE}{fragment}")
    wait(browser, "Number(document.body.dataset.time) > 0.02")


def test_a_cloth_blows_up_and_is_set_right(browser):
    begin(browser)
    assert browser.run("document.body.dataset.verdict") == "safe"
    if browser.run("predicts"):
        wait(browser, "document.body.dataset.advice === 'limit'")
        assert browser.run("Number(document.body.dataset.limit) >= boundNow()")
    browser.run("at('step').value = 1000 * shareOf(1.6 * boundNow()); at('step').oninput()")
    wait(browser, "ended !== null")
    assert browser.run("document.body.dataset.verdict") == "blown" and "blew up" in browser.run("at('verdict-words').textContent")
    assert browser.run("energies.gone.length") > 5  # the explosion is seen step by step
    if browser.run("predicts"):
        wait(browser, "document.body.dataset.advice === 'why'")
        assert "largest stable one of symplectic-euler" in browser.run("at('why-words').textContent")
    browser.run("at('cure').click()")
    wait(browser, "ended === null && Number(document.body.dataset.time) > 0.1")
    assert browser.run("[document.body.dataset.verdict !== 'blown', energies.gone.length]") == [True, 0]
    assert browser.run("performance.getEntriesByType('resource').filter(({ name }) => !name.startsWith('blob:')).length") == 0
    assert browser.console == []


def test_an_error_stands_at_its_place(browser):
    begin(browser)
    browser.run("""at('text').value = at('text').value.replace('"mass": 1', '"mass": -1'); at('text').dispatchEvent(new Event('input'))""")
    wait(browser, "!at('trouble').hidden")
    words = browser.run("at('trouble').textContent")
    line, source, caret = words.splitlines()[0], *words.splitlines()[2:4]
    assert line.startswith("line 8:") and "mass" in line and source[len(caret) - 1:].startswith("-1"), words
    assert browser.run("document.querySelector('#numbers b').textContent") == "8"
    shown = browser.run("Number(document.body.dataset.time)")
    wait(browser, f"Number(document.body.dataset.time) > {shown} + 0.01")  # what was right goes on


def test_another_scene_is_drawn(browser):
    """A strand is a tube, a chain lines: pixels of neither are those of the paper, in the picture that was made anew."""
    begin(browser)
    for scene in ("curl", "stiff-spring"):
        browser.run(f"at('scenes').value = '{scene}'; document.body.dataset.heard = ''; at('scenes').onchange()")
        wait(browser, "document.body.dataset.heard === 'frame' && picture.uniforms.size.value.x > 0")
        assert browser.run("picture.uniforms.size.value.x === Math.floor(at('picture').clientWidth * Math.min(devicePixelRatio, 2))")
        drawn = """(() => { picture.draw(); const gl = picture.renderer.getContext(), { drawingBufferWidth: w, drawingBufferHeight: h } = gl;
          const bytes = new Uint8Array(4 * w * h); gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
          let seen = 0; for (let k = 0; k < bytes.length; k += 4) seen += bytes[k] !== bytes[0] || bytes[k + 2] !== bytes[2];
          return seen; })()"""
        assert browser.run(drawn) > 2000


def test_a_ball_under_a_cloth(browser):
    """Obstacles are drawn, those that move where the library says they are at the time of the frame."""
    begin(browser, "#open=ball-under-cloth")
    assert browser.run("picture.obstacles.map(({ position, scale }) => [...position.toArray(), scale.x > 0.1])")[0][3]
    assert browser.run("Array.from(scene.obstacles[0].point)") == [0] * browser.run("3 * scene.box.length")
    browser.run("""(() => { const given = JSON.parse(at('text').value);
      Object.assign(given.obstacles[0], { motion: 'table', time: [0, 1e3], position: [[0, 0, 0], [0, -200, 0]] });
      document.body.dataset.heard = ''; openScene({ text: JSON.stringify(given) }); })()""")
    wait(browser, "document.body.dataset.heard === 'frame' && Number(document.body.dataset.time) > 0.02")
    for _ in range(3):
        time_, y, drawn = browser.run("""[Number(document.body.dataset.time), scene.obstacles[0].point[3 * scene.live + 1],
          picture.obstacles[0].position.y * picture.radius + picture.centre[1]]""")
        assert y == pytest.approx(-0.2 * time_, abs=1e-12) and drawn == pytest.approx(y, abs=1e-6)
    assert browser.console == []


def test_an_address_opens_an_example(browser):
    begin(browser, "#open=rope")
    assert browser.run("[at('scenes').value, JSON.parse(at('text').value).title]") == ["rope", "a rope let go from horizontal"]


def test_the_step_is_on_the_first_screen_of_a_phone(browser):
    """The site has 230 of 844 pixels above the frame."""
    browser.size(358, 800, mobile=True)
    begin(browser, "#front")
    assert browser.run("at('step').getBoundingClientRect().bottom") < 844 - 230
    browser.size(1200, 900)


def test_a_link_holds_the_scene(browser):
    begin(browser)
    browser.run("at('stiffness').value = 5; at('stiffness').oninput(); at('method').value = 'rk4'; at('method').onchange()")
    browser.run("at('text').value = at('text').value.replace('16 x 16', 'sixteen'); copyLink()")
    wait(browser, "location.hash.startsWith('#scene=')")
    begin(browser, browser.run("location.hash"))
    assert browser.run("[at('text').value.includes('sixteen'), at('stiffness').value, method()]") == [True, "5", "rk4"]


def test_bits_in_the_browser(browser):
    begin(browser)
    runs = [{"scene": f"{scene}.json", "method": method, "step": 1e-4, "pieces": [3, 40]}
            for scene, method in (("cloth-16", "symplectic-euler"), ("curl", "verlet"), ("mesh", "backward-euler"))]
    script = """new Promise((done) => {
      const more = `ANSWERS.bits = ({ text, method, step, pieces }) => {
        const run = new Live(library, text);
        run.use(method, step);
        pieces.forEach((steps) => run.take(steps));
        const bytes = [run.position, run.velocity].flatMap((part) => [...new Uint8Array(part.slice().buffer)]);
        return { is: "bits", hex: bytes.map((byte) => byte.toString(16).padStart(2, "0")).join("") };
      };`;
      at("worker").textContent += more;
      const worker = newWorker(), runs = RUNS, found = [];
      worker.onmessage = ({ data }) => {
        if (data.is !== "ready") found.push(data.hex || data.message);
        const run = runs[found.length];
        if (!run) return done(found);
        worker.postMessage({ do: "bits", ...run, text: scenes[run.scene.replace(".json", "")] });
      };
    })"""
    assert browser.run(script.replace("RUNS", json.dumps(runs))) == [native(run) for run in runs]


def test_a_small_study(browser):
    """The library's own: its errors are those of the program, whose reference is another; each method has its order; the
    page says what the library says of it, with what such a reference does not see; the front is the front."""
    begin(browser)
    browser.run("openScene({ text: scenes['six-particles'] })")
    wait(browser, "document.body.dataset.heard === 'frame' && at('text').value === scenes['six-particles']")
    browser.run("at('study-begin').click()")
    wait(browser, "['done', 'failed'].includes(document.body.dataset.study)")
    assert not browser.run("playing") and browser.run("document.body.dataset.study") == "done"
    rows, agreement = browser.run("[studied.rows, studied.reference.agreement]")
    assert len(rows) > 50 and 0 < agreement < 1e-8
    told, claims = browser.run("[[...at('study-words').children].map((line) => line.textContent), studied.claims]")
    assert told == [claim["text"] for claim in claims] and [claim["key"] for claim in claims][:2] == ["reference", "floor"]
    assert claims[0]["text"] == "errors are known over the whole run, 5 s"
    floor = claims[1]["text"]
    assert "by rk4, agrees with itself in steps of" in floor and "an error that both make alike is not seen" in floor
    scene = hooke.Scene.load(ROOT / "examples/scenes/six-particles.json")
    for method, order in (("symplectic-euler", 1), ("verlet", 2), ("rk4", 4), ("tr-bdf2", 2)):
        clear = [row for row in rows if row["method"] == method and row["error"] is not None and not row["near_floor"]]
        coarser, finest = sorted(clear, key=lambda row: -row["step"])[-2:]
        assert math.log2(coarser["error"] / finest["error"]) == pytest.approx(order, rel=0.2), method
        here = hooke.compare(scene, methods=[method], step=finest["step"], duration=5, every=0.25).rows["error"][0]
        assert finest["error"] == pytest.approx(here, rel=1e-3, abs=2 * agreement), method
    whole = [(row["wall_seconds"], max(row["error"], agreement), row["front"]) for row in rows if row["error"] is not None]
    for time_, error, front in whole:
        beaten = any(t <= time_ and e <= error and (t, e) != (time_, error) for t, e, _ in whole)
        assert front != beaten
    browser.run("document.querySelector('#study-rows button').click()")
    wait(browser, "playing && !ended && Number(document.body.dataset.time) > 0.1")
    assert browser.run("[method(), stepNow()]") == [rows[0]["method"], rows[0]["step"]]
    browser.run("at('mass').value = 3; at('mass').oninput()")
    assert browser.run("at('study-result').hidden") and browser.console == []
