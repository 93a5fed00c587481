"""hooke limit --report: regions of stability with the eigenvalues, and the limiting mode, in a headless browser."""

import copy
import json
import math
import subprocess
from pathlib import Path

import pytest
from conftest import CLI, SIX_PARTICLES
from pages import (
    ABOUT,
    TITLE,
    VERSION,
    browse,
    check_planted_faults,
    check_same,
    count_pixels,
    data_of,
    fetches,
    needs_browser,
    needs_page,
)

ROOT = Path(__file__).resolve().parents[2]
METHODS = ["forward-euler", "symplectic-euler", "verlet", "shardlow", "heun", "rk4", "backward-euler", "tr-bdf2",
           "implicit-midpoint"]
SCENE = json.loads((ROOT / "examples/scenes/stiff-spring.json").read_text())
COLOURS = {"blue": "#0057b8", "red": "#b00020"}  # of arrows, of limiting springs
# The numbers in the diagrams, and pixels of the colours of the picture.
LOOK = """
for (const id of ["plane", "reach"]) {
  const sets = Chart.getChart(id).data.datasets.filter((set) => set.list);
  Chart.getChart(id).canvas.dataset.places = JSON.stringify(sets.map((set) => set.data.map(({ x, y }) => [x, y])));
}
const { ctx, chartArea: area, currentDevicePixelRatio: scale } = Chart.getChart("picture");
const bytes = ctx.getImageData(area.left * scale, area.top * scale, area.width * scale, area.height * scale).data;
for (const [name, colour] of Object.entries(COLOURS_SEEN)) {
  const want = [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
  let count = 0;
  for (let k = 0; k < bytes.length; k += 4) count += want.every((value, i) => bytes[k + i] === value);
  document.getElementById("picture").dataset[name] = count;
}
""".replace("COLOURS_SEEN", json.dumps(COLOURS))


def press(key):
    return f"""document.querySelector('[data-key="{key}"]').click();"""


def make(folder, scene, *arguments):
    """The page of a limit as text, with the same limit as JSON."""
    (folder / "scene.json").write_text(json.dumps(scene))
    command = [CLI, "limit", "scene.json", "--report", "page.html", "--json", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240)
    assert (done.returncode, done.stderr) == (0, "")
    return (folder / "page.html").read_text(encoding="utf-8"), json.loads(done.stdout)


def places(seen, name):
    inside, crosses = json.loads(seen.drawn(name)["places"])
    return [complex(*point) for point in inside], crosses


def pairs(flat):
    return [complex(*pair) for pair in zip(flat[::2], flat[1::2])]


@pytest.fixture(scope="module")
def chain(tmp_path_factory):
    return make(tmp_path_factory.mktemp("limit"), {**SCENE, "title": TITLE})


@needs_page
def test_numbers_are_those_of_the_answer(chain):
    # a title there, the file here
    data = data_of(chain[0])
    assert check_same(data, chain[1] | {"scene": data["scene"]}) == ABOUT - {"scene"} | {"unlimited", "reach", "region", "picture"}


@needs_page
def test_the_regions_are_those_of_the_methods(chain):
    rows = {row["method"]: row for row in data_of(chain[0])["rows"]}
    assert [method for method in rows if "region" in rows[method]] == ["forward-euler", "heun", "rk4"]
    assert [method for method in rows if "reach" in rows[method]] == METHODS[:6]
    for z in pairs(rows["forward-euler"]["region"]):
        assert abs(abs(1 + z) - 1) < 1e-12
    for z in pairs(rows["heun"]["region"]):
        assert abs(abs(1 + z + z**2 / 2) - 1) < 1e-11
    for z in pairs(rows["rk4"]["region"]):
        assert abs(abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) - 1) < 1e-11
    for z in pairs(rows["symplectic-euler"]["reach"]):
        assert abs(z.real**2 + 4 * z.imag - 4) < 1e-12
    for method in ("verlet", "shardlow"):
        for z in pairs(rows[method]["reach"])[:150]:
            assert abs(z.real - 2) < 1e-12
    # the faster root of x'' + 2 d x' + w^2 x = 0 at the edge of the interval -2..0, or both on the circle
    for z in pairs(rows["forward-euler"]["reach"])[1:]:
        w, d = z.real, z.imag
        assert abs(w * w - 2 * d) < 1e-9 if d <= w else abs(d + math.sqrt(d * d - w * w) - 2) < 1e-9


@needs_page
@needs_browser
def test_what_is_drawn(chain, tmp_path):
    page, value = chain
    seen = browse(tmp_path, page, LOOK + count_pixels(["plane", "reach"]))
    assert seen.console == []
    modes = {name: [mode[name] for mode in data_of(page)["modes"]] for name in ("real", "imaginary", "frequency")}
    swinging = sum(imaginary > 0 for imaginary in modes["imaginary"])
    assert swinging > 0 and max(modes["frequency"]) == pytest.approx(value["frequency_max"], rel=1e-6)
    plane, reach, picture = (seen.drawn(name) for name in ("plane", "reach", "picture"))
    assert (plane["regions"], plane["points"], plane["crosses"]) == (3, len(modes["real"]) + swinging, 0)
    assert (reach["regions"], reach["points"], reach["crosses"]) == (6, len(modes["real"]), 0)
    assert (plane["outside"], reach["outside"], picture["outside"]) == (0, 0, 0)
    step = SCENE["run"]["step"]
    fastest = max(places(seen, "plane")[0], key=abs)
    assert abs(fastest) == pytest.approx(step * max(modes["frequency"]), rel=1e-9)
    for name, drawn in (("plane", [0, 4, 5]), ("reach", [0, 1, 2, 4, 5])):  # shardlow is below verlet
        pixels = [int(n) for n in seen.drawn(name)["pixels"].split()]
        assert min(pixels[k] for k in drawn) > 100, f"{name}: {pixels} pixels of the methods' colours"
    # one spring of seven is limiting, and its two ends move
    assert (picture["springs"], picture["blamed"], picture["view"]) == (7, 1, "xy")
    assert all(drawn["lines"] > 0 for drawn in (plane, reach))
    assert picture["arrows"] == 2 and all(int(seen.attributes["picture"][f"data-{name}"]) > 0 for name in COLOURS)


@needs_page
@needs_browser
@pytest.mark.parametrize("method", ["symplectic-euler", "verlet", "rk4"])
def test_at_its_limit_a_mode_is_on_the_edge(chain, tmp_path, method):
    page, value = chain
    seen = browse(tmp_path, page, press(method) + LOOK)
    assert seen.console == []
    z, crosses = places(seen, "plane")
    modes, _ = places(seen, "reach")
    assert crosses == []
    if method == "rk4":
        growth = [abs(1 + h + h**2 / 2 + h**3 / 6 + h**4 / 24) for h in z]
        assert max(growth) == pytest.approx(1, abs=1e-6)
    if method == "verlet":
        assert max(mode.real for mode in modes) == pytest.approx(2, rel=1e-6)
    if method == "symplectic-euler":
        assert max(mode.real**2 + 4 * mode.imag for mode in modes) == pytest.approx(4, rel=1e-3)
    predicted = {row["method"]: row["predicted"] for row in value["rows"]}
    says = seen.text["stepped"]
    assert f"just at the limit of {method}" in says
    blown = says.split("blows up by ")[1].rstrip(".").split(", ")
    assert blown == [name for name in METHODS if predicted[name] is not None and predicted[name] < predicted[method]]


@needs_page
@needs_browser
def test_beyond_the_edge(tmp_path):
    scene = {**SCENE, "run": {**SCENE["run"], "step": 0.02}}
    page, _ = make(tmp_path, scene, "--predict")
    seen = browse(tmp_path, page, LOOK)
    assert seen.console == []
    plane, reach = seen.drawn("plane"), seen.drawn("reach")
    assert (plane["crosses"], reach["crosses"]) == (2, 1) and plane["outside"] == reach["outside"] == 0
    assert "blows up by forward-euler, symplectic-euler, verlet, shardlow, heun, rk4." in seen.text["stepped"]


@needs_page
@needs_browser
def test_views_of_the_scene(chain, tmp_path):
    seen = browse(tmp_path, chain[0], press("xz") + press("mode") + LOOK)
    assert seen.console == []
    picture = seen.drawn("picture")
    assert (picture["view"], picture["across"], picture["springs"]) == ("xz", "x [m]", 7)
    assert all(int(seen.attributes["picture"][f"data-{name}"]) > 0 for name in COLOURS)


@needs_page
@needs_browser
def test_words(chain, tmp_path):
    page, value = chain
    seen = browse(tmp_path, page)
    assert seen.text["scene"] == TITLE
    assert seen.text["claims"].strip() == "".join(claim["text"] for claim in value["claims"])
    assert "springs7springs drawn7springs left out0" in seen.text["about"] and "mode in group stiff100.0 %" in seen.text["about"] and "1414.25 rad/s" in seen.text["about"]
    assert "No line: backward-euler" in seen.text["unbounded"]
    assert "spring 6" in seen.text["blame"] and "3 and 4" in seen.text["blame"] and "stiff" in seen.text["blame"]
    assert VERSION.split()[1] in seen.text["machine"] and "LAPACK" in seen.text["machine"]
    for row in value["rows"]:
        assert row["method"] in seen.text["rows"]
        assert not row["note"] or any(row["method"] in claim["text"] and claim["text"].endswith(row["note"]) for claim in value["claims"])
    assert "no step" in seen.text["rows"] and "none" in seen.text["rows"] and "measured" in seen.text["rows"]


@needs_page
@needs_browser
def test_a_large_scene(tmp_path):
    scene = json.loads((ROOT / "examples/scenes/cloth-64.json").read_text())
    page, _ = make(tmp_path, scene, "--predict")
    assert len(page) < 800_000
    picture = data_of(page)["picture"]
    assert len(picture["spring"]) == len(picture["ends"]) / 2
    assert set(range(8064)) <= set(picture["spring"])  # all of the group cloth.structural
    springs = {one["number"] for one in data_of(page)["blame"] if one["force"] is None}
    assert springs and springs <= set(picture["spring"])
    assert len(picture["position"]) == len(picture["move"]) == 3 * len(picture["particle"])
    assert max(picture["ends"]) == len(picture["particle"]) - 1
    seen = browse(tmp_path, page, LOOK)
    assert seen.console == []
    drawn = seen.drawn("picture")
    count = len(picture["spring"])
    assert 8064 <= count == int(drawn["springs"]) <= 9000 and (drawn["arrows"], drawn["view"]) == (300, "xz")
    assert f"springs left out{picture['springs'] - count:,}" in seen.text["about"]
    assert "measured" not in seen.text["rows"]


@needs_page
@needs_browser
def test_along_and_nothing_that_limits(tmp_path):
    scene = copy.deepcopy(SIX_PARTICLES)
    page, _ = make(tmp_path, scene, "--along")
    seen = browse(tmp_path, page)
    assert seen.console == [] and "smallest met" in seen.text["rows"]
    assert data_of(page)["time"] == scene["run"]["duration"]
    page, _ = make(tmp_path, scene, "--predict", "--methods", "backward-euler")
    seen = browse(tmp_path, page)
    assert seen.console == [] and "at t = 0 s, nothing limits the step of any of these methods" in seen.text["claims"]
    assert seen.drawn("picture")["arrows"] == 0 and "blame" not in seen.text["blame"]
    del scene["springs"], scene["run"]["method"]
    page, _ = make(tmp_path, scene, "--predict")
    seen = browse(tmp_path, page)
    assert seen.console == [] and "hidden" in seen.attributes["stability"] and "hidden" in seen.attributes["mode"]


@needs_page
@needs_browser
def test_sealed(chain, tmp_path):
    assert fetches(chain[0]) == []
    check_planted_faults(tmp_path, chain[0])
