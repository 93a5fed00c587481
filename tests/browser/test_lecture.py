"""The figures of docs/lecture.md in Chromium, wide and on a phone: each is drawn, and every slider and the drags move it."""

import re
import time

import pytest
from browser import NO_WEBGL, Browser
from conftest import ROOT
from pages import BROWSER

LECTURE = ROOT / "build/playground/lecture.js"
pytestmark = [pytest.mark.skipif(not LECTURE.exists(), reason="the playground is not built (`make playground`)"),
              pytest.mark.skipif(BROWSER is None, reason="there is no Chromium to open the page with")]
NAMES = re.findall(r"images/lecture-(\w+)\.svg", (ROOT / "docs/lecture.md").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    page = tmp_path_factory.mktemp("lecture") / "lecture.html"
    pictures = "".join(f'<p><img src="{ROOT}/docs/images/lecture-{name}.svg"></p>' for name in NAMES)
    page.write_text(f'<!DOCTYPE html><meta name="viewport" content="width=device-width"><style>{(ROOT / "docs/site.css").read_text("utf-8")}</style>'
                    f'{pictures}<script defer src="{LECTURE}"></script>', encoding="utf-8")
    browser = Browser(NO_WEBGL)
    browser.page = page
    yield browser
    browser.close()


def wait(browser, condition, seconds=60):
    end = time.monotonic() + seconds
    while not browser.run(condition):
        assert time.monotonic() < end, (condition, browser.console)
        time.sleep(0.1)


def draw_all(browser):
    browser.open(browser.page)
    for name in NAMES:
        browser.run(f"(document.querySelector('img[src*=\"lecture-{name}.\"]') || document.body).scrollIntoView()")
        wait(browser, f"document.querySelector('#figure-{name} svg') !== null")


def seen(name):
    return f"document.querySelector('#figure-{name}').firstChild.innerHTML + document.querySelector('#figure-{name} p').textContent"


def test_every_slider_moves_its_figure(browser):
    draw_all(browser)
    moved = 0
    for name in NAMES:
        inputs = f"document.querySelectorAll('#figure-{name} input, #figure-{name} select')"
        for k in range(browser.run(f"{inputs}.length")):
            before = browser.run(seen(name))
            browser.run(f"""(() => {{ const input = {inputs}[{k}];
              if (input.options) input.selectedIndex = (input.selectedIndex + 1) % input.options.length;
              else input.value = Number(input.value) > 500 ? 300 : 700;
              input.dispatchEvent(new Event("input")); }})()""")
            wait(browser, f"{seen(name)} !== {before!r}")
            assert "NaN" not in browser.run(seen(name)), (name, k)
            moved += 1
    assert moved == 26 and browser.console == []


def test_the_step_turns_red_at_the_limit(browser):
    draw_all(browser)
    for value, bad in ((1000, True), (0, False)):
        browser.run(f"(() => {{ const input = document.querySelector('#figure-stiff input'); input.value = {value}; input.oninput(); }})()")
        wait(browser, f"document.querySelector('#figure-stiff').classList.contains('bad') === {str(bad).lower()}")


def test_a_point_is_dragged(browser):
    draw_all(browser)
    browser.run("document.querySelector('#figure-plane').scrollIntoView()")
    left, top, width = browser.run("(({ left, top, width }) => [left, top, width])(document.querySelector('#figure-plane svg').getBoundingClientRect())")
    before = browser.run(seen("plane"))
    browser.drag(left + 0.6 * width, top + 0.35 * width, -0.1 * width, 0.02 * width)
    wait(browser, f"{seen('plane')} !== {before!r}")


def test_it_fits_a_phone(browser):
    browser.size(358, 800, mobile=True)
    draw_all(browser)
    assert browser.run("document.documentElement.scrollWidth") <= 358 and browser.console == []
    browser.size(1200, 900)
