"""hooke why --report: the steps around a blow-up, what it grows by, and the advised run, in a headless browser."""

import cmath
import json
import math
import shutil
import subprocess
from pathlib import Path

import pytest
from conftest import CLI, SIX_PARTICLES
from pages import (
    ABOUT,
    TITLE,
    browse,
    check_planted_faults,
    check_same,
    data_of,
    fetches,
    needs_browser,
    needs_page,
)

ROOT = Path(__file__).resolve().parents[2]
EXPLODING = ROOT / "tests/cli/scenes/exploding"
SCENE = json.loads((ROOT / "examples/scenes/stiff-spring.json").read_text())
# The red of springs to blame on the two stages, and the scale that is stated, at frames of the film.
LOOK = """
play(false);
const seen = {};
for (const k of [0, last, ran.length - 1]) {
  show(k);
  seen[k] = ["bad", "good"].map((id) => {
    const canvas = document.getElementById(id), copy = document.createElement("canvas");
    Object.assign(copy, { width: canvas.width, height: canvas.height });
    const ctx = copy.getContext("2d", { willReadFrequently: true });
    ctx.drawImage(canvas, 0, 0);
    const { data } = ctx.getImageData(0, 0, canvas.width, canvas.height);
    let red = 0;
    for (let i = 0; i < data.length; i += 4) red += data[i] > 180 && data[i + 1] < 60 && data[i + 2] < 80 && data[i + 3] > 200;
    return [red, document.getElementById(`${id}-scale`).textContent, canvas.classList.contains("beyond")];
  });
}
document.getElementById("now").dataset.seen = JSON.stringify(seen);
for (const [id, set] of [["reach", 1], ["along", 0]])
  document.getElementById(id).dataset.places = JSON.stringify(Chart.getChart(id).data.datasets[set].data.map(({ x, y }) => [x, y]));
"""


def make(folder, *arguments):
    command = [CLI, "why", "scene.json", "--report", "page.html", "--json", *arguments]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240)
    assert (done.returncode, done.stderr) == (0, "")
    return (folder / "page.html").read_text(encoding="utf-8"), json.loads(done.stdout)


@pytest.fixture(scope="module")
def chain(tmp_path_factory):
    folder = tmp_path_factory.mktemp("why")
    (folder / "scene.json").write_text(json.dumps({**SCENE, "title": TITLE}))
    return make(folder, "--step", "2.5e-3")


@needs_page
def test_the_steps_and_their_growth(chain):
    data = data_of(chain[0])
    assert data["advice"] == chain[1]["advice"] and data["advice"][0]["command"].startswith("hooke run ")
    times = [frame["time"] for frame in data["frames"]]
    assert times == pytest.approx([2.5e-3 * k for k in range(len(times))], abs=1e-15) and times[data["last"]] == data["time"]
    assert data["advised"]["step"] == 1e-3
    assert [frame["time"] for frame in data["advised"]["frames"]] == pytest.approx(times, abs=5.1e-4)
    # the mode of the stiff spring hardly changes: the energy grows as it predicts
    value, at = data["energy"]["value"], data["energy"]["last"]
    measured, growth = (value[at + 20] / value[at]) ** 0.05, data["mode"]["growth"]
    assert measured == pytest.approx(growth**2, rel=0.05) and growth > 10
    assert data["limits"][0]["limit"] == pytest.approx(data["limit"], rel=1e-6)
    moves = [max(abs(x) for x in data["mode"]["move"][3 * k:3 * k + 3]) for k in range(8)]
    by_number = dict(zip(data["picture"]["particle"], moves))
    assert by_number[3] == 1 and by_number[4] == 1 and by_number[1] < 0.1


def step_of(method, h, k, c, x, v):
    """One step of x'' = -k x - c v."""
    if method == "symplectic-euler":
        v -= h * (k * x + c * v)
        return x + h * v, v
    if method in ("verlet", "shardlow"):
        brake = 1 if method == "verlet" else 1 / (1 + h * c / 2 + (h * c / 2) ** 2 / 2)
        v = brake * v - h / 2 * (k * x + (c * v if method == "verlet" else 0))
        x += h * v
        v -= h / 2 * k * x
        return x, v / (1 + h * c / 2) if method == "verlet" else brake * v
    order, y, sum_x, sum_v = {"heun": 2, "rk4": 4}[method], (x, v), x, v
    for j in range(1, order + 1):  # the exponential, cut off
        y = h / j * y[1], -h / j * (k * y[0] + c * y[1])
        sum_x, sum_v = sum_x + y[0], sum_v + y[1]
    return sum_x, sum_v


def growth_of(method, h, frequency, decay):
    (a, b), (c, d) = (step_of(method, h, frequency**2, 2 * decay, *unit) for unit in ((1.0, 0.0), (0.0, 1.0)))
    root = cmath.sqrt((a + d) ** 2 / 4 - (a * d - b * c))
    return max(abs((a + d) / 2 + root), abs((a + d) / 2 - root))


@needs_page
@pytest.mark.parametrize("method", ["symplectic-euler", "verlet", "shardlow", "heun", "rk4"])
def test_numbers_are_true(tmp_path, method):
    """Those of the answer; and what the page alone has: limits and growth are those of a mode of this frequency and decay."""
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    page, value = make(tmp_path, "--step", "2.5e-3", "--method", method)
    data = data_of(page)
    value["scene"] = data["scene"]  # a title there, the file here
    assert check_same(data, value) == ABOUT - {"scene"} | {"command", "rows", "energy", "stride", "last", "picture", "frames", "advised",
                                                           "limits", "mode"}
    for look in filter(lambda look: look["limit"], data["limits"]):
        mode = look["frequency"], look["decay"]
        assert growth_of(method, 0.999 * look["limit"], *mode) <= 1 + 1e-9 < growth_of(method, 1.001 * look["limit"], *mode)
        assert growth_of(method, data["step"], *mode) == pytest.approx(look["growth"], rel=1e-6)
    # two masses of 1 kg against each other: between them 10 N s/m, and on each the half of a soft spring of 0.9 m
    look = data["limits"][0]
    assert method == "heun" or look["decay"] == pytest.approx(10 + 0.5 / 0.9 / 2, rel=1e-4)
    assert method == "heun" or look["frequency"] == pytest.approx(math.sqrt(2e6), rel=1e-3)
    assert data["mode"]["growth"] in [look["growth"] for look in data["limits"] if look["time"] == data["mode"]["time"]]
    energy = data["energy"]["value"][data["energy"]["last"] - data["last"] * data["stride"]::data["stride"]]
    assert [frame["energy"] for frame in data["frames"]] == energy[:len(data["frames"])]


@needs_page
@needs_browser
def test_what_is_drawn(chain, tmp_path):
    seen = browse(tmp_path, chain[0], LOOK)
    assert seen.console == [] and fetches(chain[0]) == []
    assert seen.text["scene"] == TITLE
    assert seen.text["claims"].strip() == "".join(claim["text"] for claim in chain[1]["claims"])
    for one in chain[1]["advice"]:
        assert f"{one['change']}{one['command'] or ''}" in seen.text["advice"]
    first, within, after = json.loads(seen.attributes["now"]["data-seen"]).values()
    for red, _, _ in (*first, *within, *after):
        assert red > 50
    assert [stage[1:] for stage in first] == [["scale 1 : 1", False], ["scale 1 : 1", False]]
    assert after[0][1].startswith("zoomed out 1 : ") and after[0][2] and after[1][1:] == ["scale 1 : 1", False]
    assert all(seen.drawn(name)["lines"] >= 0 for name in ("energy", "reach", "along", "picture"))
    assert seen.drawn("picture")["arrows"] == 2
    data = data_of(chain[0])
    looks, places = data["limits"], {name: json.loads(seen.drawn(name)["places"]) for name in ("reach", "along")}
    assert places["reach"] == [[data["step"] * look["frequency"], data["step"] * look["decay"]] for look in looks]
    assert places["along"] == [[look["time"], look["limit"]] for look in looks]
    growth = data["mode"]["growth"]
    assert f"energy, by the mode that limits{growth**2:.4g} times" in seen.text["rates"]
    assert f"its amplitude in a step{growth:.4g} times" in seen.text["left"]
    check_planted_faults(tmp_path, chain[0])


@needs_page
def test_whole_groups_of_a_large_scene_are_drawn(tmp_path):
    """A net of which every k-th spring is drawn is a maze: groups are drawn as they fit, else particles alone."""
    cloth = {"kind": "cloth", "name": "cloth", "origin": [0, 0, 0], "edges": [[1, 0, 0], [0, 0, 1]], "size": [34, 34], "mass": 0.2,
             "pinned": "top", "structural": {"stiffness": 60}, "shear": {"stiffness": 10}, "bend": {"stiffness": 1}}
    grid = [[0.1 * x, 0.1 * y, 0.1 * z] for x in range(5) for y in range(5) for z in range(5)]
    pairs = [[a, b] for b in range(len(grid)) for a in range(b)]
    joined = {"particles": {"position": grid, "mass": [0.01] * len(grid), "pinned": [0]},
              "springs": [{"name": "all", "between": pairs, "stiffness": 10}]}
    for scene, drawn, seen in (({"parts": [cloth]}, 2 * 34 * 33 + 2 * 33 * 33, 34 * 34), (joined, 0, len(grid))):
        run = {"method": "symplectic-euler", "step": 5e-3, "duration": 0.5, "every": 0.05}
        (tmp_path / "scene.json").write_text(json.dumps({"hooke": 1, "gravity": [0, -9.81, 0], "run": run} | scene))
        data = data_of(make(tmp_path)[0])
        springs = {one["number"] for one in data["blame"] if one["force"] is None}
        assert set(data["picture"]["spring"]) == set(range(drawn)) | springs and len(springs) < 1000
        assert len(data["picture"]["particle"]) == seen


@pytest.mark.check
@needs_page
@needs_browser
def test_parts_are_surfaces(tmp_path):
    """The middle of a cell, between its springs, has the colour of the cloth."""
    scene = json.loads((ROOT / "examples/scenes/cloth-16.json").read_text())
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    look = """{ play(false); show(0); axes = "xz"; show(0);
      const { width, height } = document.getElementById("bad"), ctx = document.getElementById("bad").getContext("2d");
      const middle = ctx.getImageData(width / 2 + 0.014 * height, height / 2, 1, 1).data;
      const outside = ctx.getImageData(5, 5, 1, 1).data;
      document.getElementById("now").dataset.seen = JSON.stringify([triangles.length, [...middle], [...outside]]); }"""
    seen = browse(tmp_path, make(tmp_path, "--step", "2ms")[0], look)
    count, (red, _, blue, cover), outside = json.loads(seen.attributes["now"]["data-seen"])
    assert count == 3 * 2 * 15 * 15 and outside[3] == 0
    assert cover > 0 and blue > red + 20


@pytest.mark.check
@needs_page
@needs_browser
def test_one_mode_and_one_factor(tmp_path):
    """Words and lines have the growth of the mode that is drawn, also where that of other times is another."""
    (tmp_path / "scene.json").write_text((ROOT / "examples/scenes/cloth-16.json").read_text())
    page, _ = make(tmp_path, "--step", "1ms", "--duration", "1", "--every", "0.1")
    data, seen = data_of(page), browse(tmp_path, page)
    growth, time = data["mode"]["growth"], data["mode"]["time"]
    above = [look for look in data["limits"] if look["limit"] < data["step"]]
    assert above[0]["time"] == time and above[0]["growth"] == growth > 1
    assert max(look["growth"] for look in above) > 1.001 * growth
    assert f"its amplitude in a step{growth:.4g} timesfrozen att = {time:.5g} s" in seen.text["left"]
    assert f"energy, by the mode that limits{growth**2:.4g} times" in seen.text["rates"]


@pytest.mark.check
@needs_page
@needs_browser
@pytest.mark.parametrize("kind", ["collapsing", "forward-euler-string", "gaining-strand", "cvode-cable",
                                  "backward-euler-cable", "strong-drag"])
def test_every_cause_has_its_page(tmp_path, kind):
    shutil.copy(EXPLODING / f"{kind}.json", tmp_path / "scene.json")
    page, value = make(tmp_path, "--budget", "4s")
    seen = browse(tmp_path, page)
    assert seen.console == []
    claims = value["claims"]
    assert claims[0]["key"] == "cause" and seen.text["claims"].strip() == "".join(claim["text"] for claim in claims)
    assert ("hidden" in seen.attributes["film"]) == (kind == "cvode-cable")


@needs_page
def test_no_page_where_nothing_blew_up(hooke, write, tmp_path):
    answer = hooke("why", write(SIX_PARTICLES), "--report", "page.html")
    assert answer.code == 0 and "did not blow up" in answer.err
    assert not (tmp_path / "page.html").exists()
