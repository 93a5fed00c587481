"""The page of hooke view in a headless browser: it draws, plays, turns, and states what it shows."""

import base64
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


def still(page):
    """The same page, which does not begin to play."""
    return f"{page}#frame=0"


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
    browser.open(still(cloth))
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
    assert page.run('[...at("marks").children].filter((item) => item.clientWidth > 0).map((item) => item.textContent).join()') == "pinned,driven"
    assert page.run('at("alert").hidden && at("thinned").hidden && at("missing").hidden')
    assert page.run("[data.strain_low < 0, energies.chart.data.datasets.length, energies.chart.data.datasets[0].data.length]") == [True, 3, 41]


def test_scrubbing(page):
    first = seen(page)
    page.run('at("frame").value = 30; at("frame").dispatchEvent(new Event("input"))')
    later = seen(page)
    assert (np.abs(first - later).max(axis=2) > 40).sum() > 500
    assert frame(page) == 30 and page.run('at("now").textContent').startswith("frame 30 / 40 ")
    cursor = page.run('at("cursor").getBoundingClientRect().left - at("energy").getBoundingClientRect().left')
    assert cursor == pytest.approx(page.run("energies.chart.scales.x.getPixelForValue(0.3)"), abs=1.5)
    page.run("show(0, true)")
    assert (seen(page) == first).all()
    left, right, top = page.run("""(({ left, top }) => [0, 0.2].map((t) => left + energies.chart.scales.x.getPixelForValue(t)).concat(top +
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
    page.open(still(cloth))
    assert page.run("document.documentElement.scrollWidth") == 360
    assert ink(seen(page)) > 2000
    boxes = page.run("""[...at("controls").querySelectorAll("button, select, output, input")].map((e) =>
        e.getBoundingClientRect()).filter((b) => b.width > 0).map((b) => [b.left, b.top, b.right, b.bottom])""")
    for k, a in enumerate(boxes):
        for b in boxes[:k]:
            assert a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1], "controls lie over each other"


def test_colours_of_strain(browser, tmp_path):
    """A spring that swings about its rest length: orange when it is long, blue when it is short."""
    browser.open(still(make(tmp_path, STIFF_PAIR, step=0.001, duration=0.2, every=0.001)))
    strains = browser.run("data.time.map((t, k) => run.bytesOfFrame(k)[6 * data.particles])")
    for k, code in enumerate(strains):
        assert code == pytest.approx(127 + 127 * np.cos(np.sqrt(1000) * 0.001 * k), abs=3)
    for strongest, red_over_blue in ((0, True), (int(np.argmin(strains)), False)):
        browser.run(f"show({strongest}, true)")
        picture = seen(browser)
        rows = picture[: int(0.7 * len(picture))].reshape(-1, 3)
        coloured = rows[np.abs(rows[:, 0] - rows[:, 2]) > 60]
        assert len(coloured) > 300 and ((coloured[:, 0] > coloured[:, 2]) == red_over_blue).mean() > 0.95


def test_a_run_that_diverged(browser, tmp_path):
    browser.open(still(make(tmp_path, CLOTH, 4, step=0.02, every=0.02, duration=2)))
    assert re.fullmatch(r"The run diverged after t = \S+ s of 2 s, by symplectic-euler, step 0.02 s. Why, and what to do: hooke why out.h5",
                        browser.run('at("alert").textContent'))
    assert browser.run('!at("alert").hidden') and ink(seen(browser)) > 1000
    browser.press(*END)
    assert browser.console == []


def test_frames_after_divergence(browser, tmp_path):
    """However wide they are, the picture shows them as large as the scene was, and as a frame before once it is back there; energies
    have an axis of powers of ten."""
    (tmp_path / "scene.json").write_text(json.dumps({**CLOTH, "driven": [], "run": {**CLOTH["run"], "step": 0.02, "every": 0.02, "duration": 2}}))
    assert subprocess.run([CLI, "view", "scene.json", "-q"], cwd=tmp_path, capture_output=True).returncode == 4
    browser.open(still(tmp_path / "scene.html"))
    after = browser.run("data.frames_there - data.good_frames")
    assert after == 30 and f"Frames after that, {after} here, show how it blows up, and are no physics." in browser.run('at("alert").textContent')
    assert browser.run('at("alert").textContent').endswith("Why, and what to do: hooke why scene.json --report why.html")

    def across(picture):
        rows, columns = np.nonzero(np.abs(picture - 255).max(axis=2) > 40)
        return np.ptp(rows) / len(picture), np.ptp(columns) / picture.shape[1]

    browser.run("for (const id of ['legend', 'axes', 'zoomed']) at(id).style.visibility = 'hidden'")
    first, camera = seen(browser), "JSON.stringify(picture.angle())"
    before, wide = browser.run(camera), browser.run("data.box.map(widthOf).map((width) => width / widthOf(data.box[0]))")
    assert wide[-1] > 1e6 and browser.run('at("zoomed").textContent') == ""
    for frame_ in (np.argmax(np.array(wide) > 20), len(wide) - 1):
        browser.run(f"show({frame_}, true)")
        tall, broad = across(seen(browser))
        assert max(tall, broad) > 0.3 and tall < 0.98 and broad < 0.98, (frame_, tall, broad)
        assert browser.run('at("now").textContent.endsWith("after it diverged")') == (frame_ >= len(wide) - 30)
        said = re.fullmatch(r"(\S+) times as wide as before; the picture zooms out", browser.run('at("zoomed").textContent'))
        assert float(said[1]) == pytest.approx(wide[frame_] * browser.run("widthOf(data.box[0]) / widthOf(picture.home)"), rel=0.06)
        places = np.array(browser.run("[...Array(data.particles).keys()].map((k) => positionOf(k))"))
        size = browser.run(f"widthOf(data.box[{frame_}])")
        assert np.ptp(places, axis=0).max() == pytest.approx(size, rel=1e-4)
    browser.run("show(0, true)")
    assert (seen(browser) == first).all() and browser.run(camera) == before
    y = browser.run("(({ type, min, max, ticks }) => [type, min, max, ticks.map(({ label }) => label)])(energies.chart.scales.y)")
    most = browser.run("largest(data.total)")
    assert y[0] == "logarithmic" and y[2] / 10 <= most <= y[2] and y[1] < browser.run("data.kinetic[5]")
    assert 3 <= len(y[3]) <= 8 and all(re.fullmatch(r"1e[+-]\d+", label) for label in y[3])
    assert browser.run("energies.chart.data.datasets.every(({ data }) => data.every(({ y }) => y === null || y > 0))")
    assert browser.console == []


def test_one_frame_and_no_spring(browser, tmp_path):
    dust = {"hooke": 1, "particles": {"position": [[0, 0, 0]], "mass": 1},
            "run": {"method": "rk4", "step": 1, "duration": 1, "every": 1}}
    browser.open(still(make(tmp_path, dust)))
    assert browser.run('at("scale").hidden') and 20 < ink(seen(browser)) < 200
    browser.press(*SPACE)
    assert browser.console == []


def test_fewer_springs_while_it_moves(page):
    """Where drawing is slow, every k-th spring is drawn, and that is said, until it stands still again."""
    page.run('at("look").value = "springs"; at("tint").checked = true; relook()')
    all_of_them = ink(seen(page))
    page.run("enough = 4; thin(enough)")
    page.settle()
    assert page.run("picture.lines.geometry.drawRange.count / 6") == 27
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
    browser.open(still(tmp_path / "page.html"))
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


# ---- surfaces, picks, files ----


def test_it_opens_playing_where_the_most_is_seen(browser, cloth):
    browser.open(cloth)
    assert browser.run("playing") and browser.run('at("play").textContent') == "Pause"
    assert browser.run("picture.fullest([0, 40])") in (0, 40)
    assert browser.run("""new Promise((done) => { const until = performance.now() + 20000, first = shown;
        const wait = () => (shown !== first || performance.now() > until ? done(shown !== first) : setTimeout(wait, 50)); wait(); })""")
    assert browser.console == []


def colour(picture):
    """The mean of what is not background."""
    return picture[np.abs(picture - 255).max(axis=2) > 40].mean(axis=0)


def test_surfaces_and_springs(page):
    surface = seen(page)
    page.run('at("look").value = "springs"; relook()')
    springs = seen(page)
    assert ink(surface) > 1.15 * ink(springs) > 2000
    assert page.run("[picture.surface.visible, picture.lines.geometry.drawRange.count / 6]") == [False, 106]
    assert page.run('at("scale").hidden')
    page.run('at("tint").checked = true; relook()')
    assert page.run('!at("scale").hidden') and (np.abs(seen(page) - springs).max(axis=2) > 40).sum() > 500
    page.run('at("look").value = "both"; relook()')
    assert page.run("[picture.surface.visible, picture.lines.geometry.drawRange.count / 6]") == [True, 106]
    # smooth normals: that of a corner is the mean of its triangles', and a flat cloth has one normal
    page.run('at("look").value = "surface"; at("tint").checked = false; relook()')
    normal = np.array(page.run("[...picture.surface.geometry.attributes.normal.array]")).reshape(-1, 3)[2:]
    assert (np.abs(normal[:, [0, 2]]) < 1e-3 * np.abs(normal[:, 1:2])).all()


BODIES = {
    "lattice": {"kind": "lattice", "origin": [0, 0, 0], "edges": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "size": [3, 4, 5], "mass": 1,
                "structural": {"stiffness": 100}},
    "rope": {"kind": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 8, "mass": 0.1, "pinned": ["start"],
             "stretch": {"stiffness": 100}},
}


@pytest.mark.parametrize("kind, triangles, segments", [("lattice", 2 * 2 * (2 * 3 + 2 * 4 + 3 * 4), 0), ("rope", 0, 8)])
def test_bodies(browser, tmp_path, kind, triangles, segments):
    scene = {"hooke": 1, "gravity": [0, -1, 0], "parts": [BODIES[kind]],
             "run": {"method": "verlet", "step": 1e-3, "duration": 0.2, "every": 0.01}}
    browser.open(still(make(tmp_path, scene)))
    assert browser.run("[picture.triangles.length / 3, picture.segments.length / 2]") == [triangles, segments]
    assert ink(seen(browser)) > 300 and browser.console == []
    if kind == "lattice":  # every side looks outwards
        outwards = browser.run("""(() => { const { normal, position } = picture.surface.geometry.attributes, sums = [];
            const middle = [0, 1, 2].map((a) => position.array.reduce((s, x, k) => s + (k % 3 === a ? x : 0), 0) / position.count);
            for (let k = 0; k < position.count; k++) sums.push([0, 1, 2].reduce((s, a) =>
              s + normal.array[3 * k + a] * (position.array[3 * k + a] - middle[a]), 0));
            return sums; })()""")
        assert min(outwards) >= 0 and sum(value > 0 for value in outwards) == 3 * 4 * 5 - 1 * 2 * 3


def test_obstacles(browser, tmp_path):
    """Solids without lines, by day and by night: the ball, which the picture has room for, moves with its frame; the plane and
    the roller, which have no end, are as long as what is seen."""
    scene = {"hooke": 1, "parts": [BODIES["lattice"]], "run": {"method": "verlet", "step": 1e-3, "duration": 1, "every": 0.25},
             "obstacles": [{"shape": "plane", "point": [5, -2, 0], "normal": [0, 2, 0], "stiffness": 1},
                           {"shape": "sphere", "center": [-3, 0.5, 0.5], "radius": 1, "stiffness": 1, "motion": "table",
                            "time": [0, 1], "position": [[0, 0, 0], [0, 2, 0]]},
                           {"shape": "cylinder", "point": [3, 0, 9], "axis": [0, 0, 1], "radius": 0.5, "stiffness": 1}]}
    browser.open(still(make(tmp_path, scene)))
    plain = ink(seen(browser))
    home, radius = browser.run("[picture.home, picture.radius]")
    assert np.allclose(home, [-4, -0.5, -0.5, 1, 3.5, 1.5]) and radius == 2.5
    places = {}
    for frame in (0, 2):
        browser.run(f"show({frame})")
        places[frame] = np.array(browser.run(
            "picture.obstacles.map(({ position }) => position.toArray().map((x, k) => x * picture.radius + picture.centre[k]))"))
    assert np.allclose(places[0], [[-1.5, -2.0575, 0.5], [-3, 0.5, 0.5], [3, 0, 0.5]])
    assert np.allclose(places[2] - places[0], [[0, 0, 0], [0, 1, 0], [0, 0, 0]])
    model, corners = read_model(browser)
    assert [mesh["name"] for mesh in model["meshes"]].count("obstacle") == 3
    assert np.allclose(np.linalg.norm(corners[-2] + model["extras"]["origin"] - [-3, 1.5, 0.5], axis=1), 0.98, atol=1e-5)
    disc, ball, roller = browser.run("picture.obstacles.map(({ scale }) => scale.toArray().map((x) => x * picture.radius))")
    assert disc[0] > 0.5 * np.hypot(5, 4) and ball == pytest.approx([0.98] * 3) and roller == pytest.approx([0.48, 2.4, 0.48])
    browser.run("show(0); for (const mesh of picture.obstacles) mesh.visible = false; draw()")
    assert ink(seen(browser)) < 0.3 * plain
    browser.run("for (const mesh of picture.obstacles) mesh.visible = true; draw()")
    greys = {}
    for dark in (False, True):
        browser.dark(dark)
        greys[dark] = np.median(seen(browser)[-60:, 200:400].reshape(-1, 3), axis=0)
        assert np.ptp(greys[dark]) < 12  # no colour of its own
    assert greys[False].mean() > 130 > 90 > greys[True].mean() > 30 and browser.console == []


def test_picking(page):
    page.run("show(10, true)")
    x, y = page.run("projector()(20).slice(0, 2)")
    left, top = page.run('(({ left, top }) => [left, top])(at("picture").getBoundingClientRect())')
    page.drag(left + x, top + y, 0, 0)
    q = page.run("positionOf(20)")
    text = page.run('at("picked").textContent')
    assert page.run('!at("picked").hidden') and text.startswith("particle 20") and f"x {q[0]:.5g}"[:6] in text
    page.run("pick({ of: 0, spring: 30 })")
    text = page.run('at("picked").textContent')
    ends = page.run("[run.ends[60], run.ends[61]]")
    assert f"spring 30, between particles {ends[0]} and {ends[1]}, group cloth0.structural" in text
    assert "strain" in text and "elastic tension" in text
    page.run("pick({ of: 0, particle: 20 })")
    assert page.run("[...at('quantity').options].map((option) => option.value)") == ["x", "y", "z"]
    page.drag(left + 5, top + 5, 0, 0)
    assert page.run('at("picked").hidden && at("picked-course").hidden')


def test_tension_over_time(browser, tmp_path):
    """That of every spring in every frame is the one that the file has, to the 8 bits that the page states; a cable has none
    where it is slack."""
    h5py = pytest.importorskip("h5py")
    scene = {"hooke": 1, "particles": {"position": [[0, 0, 0], [1, 0, 0], [3, 0, 0]], "velocity": [[0, 0, 0], [2, 0, 0], [0, 1, 0]],
                                       "mass": [1, 2, 3]},
             "springs": [{"name": "cable", "between": [[0, 1]], "law": "length", "stiffness": 3, "rest_length": 0.9, "compression": False},
                         {"name": "pair", "between": [[1, 2], [0, 2]], "law": "length", "stiffness": [40, 7000], "rest_length": [2.001, 0]}],
             "run": {"method": "rk4", "step": 1e-3, "duration": 1, "every": 0.01}}
    browser.open(still(make(tmp_path, scene)))
    with h5py.File(tmp_path / "out.h5") as file:
        q, ends = file["particles/all/position/value"][:], file["connectivity/springs"][:]
    elongations = np.linalg.norm(q[:, ends[:, 0]] - q[:, ends[:, 1]], axis=2) - [0.9, 2.001, 0]
    tensions = elongations * [3, 40, 7000]
    tensions[:, 0] = np.maximum(tensions[:, 0], 0)
    for k in range(3):
        browser.run(f'pick({{ of: 0, spring: {k} }}); at("quantity").value = "elastic tension"; drawCourse()')
        shown = np.array(browser.run("course.chart.data.datasets[0].data.map(({ y }) => y)"))
        assert (np.abs(shown - tensions[:, k]) <= 2**-8 * np.abs(tensions[:, k]) + 1e-6 * np.ptp(tensions[:, k])).all()
        assert "each to 0.4 %" in browser.run('at("quantity-words").textContent')
    assert (tensions[:, 0] == 0).any() and (shown > 0).all()
    assert browser.run("[...at('quantity').options].map((option) => option.value)") == ["elastic tension", "length"]  # no strain
    assert browser.console == []


def read_model(page):
    """The frame as glTF, and the corners of its meshes; what it says of itself is true."""
    model = json.loads(page.run("JSON.stringify(modelOf())"))
    buffer = base64.b64decode(model["buffers"][0]["uri"].split(",")[1])
    assert model["asset"]["version"] == "2.0" and len(buffer) == model["buffers"][0]["byteLength"]

    def numbers(accessor):
        one = model["accessors"][accessor]
        view, size = model["bufferViews"][one["bufferView"]], {"VEC3": 3, "SCALAR": 1}[one["type"]]
        kind = {5126: "<f4", 5125: "<u4"}[one["componentType"]]
        assert view["byteOffset"] % 4 == 0 and view["byteLength"] == 4 * size * one["count"]
        return np.frombuffer(buffer, kind, size * one["count"], view["byteOffset"]).reshape(-1, size)

    all_corners = []
    for mesh in model["meshes"]:
        (primitive,) = mesh["primitives"]
        corners = numbers(primitive["attributes"]["POSITION"])
        limits = model["accessors"][primitive["attributes"]["POSITION"]]
        assert np.allclose(corners.min(axis=0), limits["min"]) and np.allclose(corners.max(axis=0), limits["max"])
        index = numbers(primitive["indices"]).ravel() if "indices" in primitive else np.arange(len(corners))
        assert index.max() < len(corners) and len(index) % {1: 2, 4: 3}[primitive["mode"]] == 0
        if "NORMAL" in primitive["attributes"]:
            assert np.allclose(np.linalg.norm(numbers(primitive["attributes"]["NORMAL"]), axis=1), 1, atol=1e-5)
        assert model["materials"][primitive["material"]]["name"] == mesh["name"]
        all_corners.append(corners)
    return model, all_corners


def test_files_to_keep(page):
    assert page.run("""new Promise((done) => { picture.draw();
        at("picture").toBlob((blob) => done([blob.type, blob.size > 3000])); })""") == ["image/png", True]
    video = page.run("""new Promise((done) => { download = (blob, ending) => done([blob.type.split(";")[0], blob.size > 3000, ending]);
        at("speed").selectedIndex = 7; saveVideo(); })""")
    assert video == ["video/webm", True, ".webm"]
    page.run("pause(); show(10, true)")
    model, corners = read_model(page)
    assert [node["name"] for node in model["nodes"]] == ["springs", "surface"]
    q = np.array([page.run(f"positionOf({k})") for k in (0, 20)]) - model["extras"]["origin"]
    assert np.allclose(corners[0][[0, 20]], q, atol=1e-6)


# ---- several trajectories ----


PAGES = "frames.map((frame) => frame.contentWindow)"


def test_trajectories_beside_one_another_play_and_turn_together(browser, tmp_path):
    long, short = (tmp_path / name for name in ("long", "short"))
    for folder, duration in ((long, 0.4), (short, 0.2)):
        folder.mkdir()
        make(folder, CLOTH, duration=duration)
    page = tmp_path / "both.html"
    assert subprocess.run([CLI, "view", short / "out.h5", long / "out.h5", "-o", page, "-q"]).returncode == 0
    browser.size(1000, 620)
    browser.open(page)

    def words(name, what="textContent"):
        browser.settle()
        return browser.run(f"{PAGES}.map((page) => page.document.getElementById('{name}').{what})")

    def press(which, key):
        browser.run(f"void {PAGES}[{which}].dispatchEvent(new KeyboardEvent('keydown', {{ key: '{key}' }}))")

    def axes():
        return [[round(float(number), 6) for number in re.findall(r'="(-?[0-9][^"]*)"', text)] for text in words("axes", "innerHTML")]

    assert words("play") == ["Play", "Pause"]  # the longer one leads
    press(1, "End")
    assert words("play") == ["Play", "Play"]
    assert [re.search(r"t = (.*) s", text)[1] for text in words("now")] == ["0.2", "0.4"]
    press(0, "Home")
    assert [re.search(r"t = (.*) s", text)[1] for text in words("now")] == ["0", "0"]
    before = axes()
    assert before[0] == before[1]
    assert browser.run("frames.every(({ offsetHeight, contentDocument }) => offsetHeight === contentDocument.body.offsetHeight)")
    browser.drag(750, 200, 100, 60)
    after = axes()
    assert after[0] == after[1] != before[0]
    assert browser.console == []


def test_trajectories_beside_one_another_have_the_same_axes(browser, tmp_path):
    """Time, energy, strain and the extent in space: a strand of half the length is drawn half as long."""
    folders = [tmp_path / name for name in ("whole", "half")]
    for folder, length in zip(folders, (2, 1)):
        folder.mkdir()
        scene = {"hooke": 1, "springs": [{"between": [[0, 1]], "stiffness": 10 * length, "law": "length", "rest_length": 0.9 * length}],
                 "particles": {"position": [[0, 0, 0], [length, 0, 0]], "mass": 1},
                 "run": {"method": "rk4", "step": 1e-3, "duration": 0.2 * length, "every": 0.02}}
        make(folder, scene)
    page = tmp_path / "both.html"
    assert subprocess.run([CLI, "view", *(folder / "out.h5" for folder in folders), "-o", page, "-q"]).returncode == 0
    browser.size(1000, 620)
    browser.open(page)
    browser.run(f"{PAGES}.forEach((page) => {{ page.pause(); page.show(0, true); }})")
    browser.settle()
    shared = browser.run(PAGES + """.map((page) => { const { x, y } = Object.values(page.Chart.instances)[0].scales;
        return [x.min, x.max, y.min, y.max, page.run.data.strain]; })""")
    assert shared[0] == shared[1] and shared[0][:2] == [0, 0.4]
    assert shared[0][3] >= 0.999 * 0.5 * 20 * 0.2**2 > 3 * 0.5 * 10 * 0.1**2  # the larger of both
    top, bottom = browser.run("(({ top, bottom }) => [top, bottom])(leader.document.getElementById('stage').getBoundingClientRect())")
    drawn = pytest.importorskip("matplotlib.image").imread(io.BytesIO(browser.picture()))[int(top) + 40:int(bottom) - 60, :, :3]
    inked = (drawn < 0.8).any(axis=(0, 2))  # a column with something of the strand
    lengths = [np.ptp(np.nonzero(inked[half])[0]) for half in (np.s_[20:480], np.s_[520:980])]
    assert 100 < lengths[0] < 450 and lengths[0] / lengths[1] == pytest.approx(2, rel=0.05)
    assert browser.console == []


@pytest.mark.check
def test_distances_from_the_first_run(browser, tmp_path):
    """Those of the positions in the files, in lines that are longer by a factor, of the same particles at the same times alone."""
    h5py, paths, far = pytest.importorskip("h5py"), [], []
    for name, scene, more in (("full", CLOTH, {}), ("lean", CLOTH, {"method": "backward-euler", "step": 0.01}), ("other", STIFF_PAIR, {"step": 0.01, "duration": 1})):
        make(tmp_path, scene, **more)
        paths.append((tmp_path / "out.h5").rename(tmp_path / f"{name}.h5"))
    with h5py.File(paths[0]) as full, h5py.File(paths[1]) as lean:
        a, b = (file["particles/all/position/value"][:] for file in (full, lean))
        far = np.linalg.norm(a - b, axis=-1).max(axis=1)
    page, k = tmp_path / "both.html", len(far) // 2
    assert subprocess.run([CLI, "view", *paths, "-o", page, "-q"]).returncode == 0
    browser.size(1000, 700)
    browser.open(page)
    browser.run(f"frames[0].contentWindow.show({k}, true)")
    browser.settle()
    course = browser.run("""Object.values(frames[1].contentWindow.Chart.instances).find(({ canvas }) => canvas.parentNode.id === "apart-course")
        .data.datasets[0].data.map(({ y }) => y)""")
    assert course == pytest.approx(far, abs=2e-5) and max(course) > 1e-3
    drawn = pytest.importorskip("matplotlib.image").imread(io.BytesIO(browser.picture()))[150:400, :, :3]
    dark = [(drawn[:, part] < 0.25).all(axis=2).sum() for part in (np.s_[:480], np.s_[510:])]
    assert dark[1] > dark[0] + 200
    told = [browser.run(f"frames[{k}].contentDocument.getElementById('apart').textContent") for k in range(3)]
    now, most = (float(number) for number in re.findall(r"([0-9.e-]+) m \(particle", told[1]))
    assert now == pytest.approx(course[k], rel=0.05) and most == pytest.approx(max(course), rel=0.05)  # as far as rounding allows
    assert told[0] == "" and told[2] == "not compared with full.h5: other particles" and browser.console == []


@pytest.mark.check
def test_trajectories_over_one_another(browser, tmp_path):
    """Each in its colour where it is alone; a picked spring has a line for each of them."""
    paths = []
    for name, run in (("long", {"duration": 0.4}), ("short", {"duration": 0.2, "method": "backward-euler", "step": 0.01})):
        (tmp_path / name).mkdir()
        make(tmp_path / name, CLOTH, **run)
        paths.append(tmp_path / name / "out.h5")
    page = tmp_path / "both.html"
    assert subprocess.run([CLI, "view", *paths, "-o", page, "-q"]).returncode == 0
    browser.size(1000, 700)
    browser.open(page)
    browser.run("leader.pause(); leader.show(40, true)")
    browser.press("o", 79)
    assert browser.run("[over.checked, frames.map((frame) => frame.hidden)]") == [True, [False, True]]
    legend = browser.run("[...leader.document.getElementById('runs').children].map((item) => item.textContent)")
    assert legend == ["out.h5: symplectic-euler, step 1e-4 s", "out.h5: backward-euler, step 0.01 s, until t = 0.2 s"]
    squares = [browser.run(f"leader.document.getElementById('{name}').lastChild.firstChild.style.background") for name in ("runs", "apart")]
    assert squares == ["rgb(213, 94, 0)"] * 2
    browser.run("leader.document.getElementById('look').value = 'springs'; leader.relook()")
    image = pytest.importorskip("matplotlib.image").imread(io.BytesIO(browser.picture()))[110:400, 40:-40, :3]
    red, blue = image[..., 0] - image[..., 2] > 0.2, image[..., 2] - image[..., 0] > 0.2
    assert red.sum() > 500 and blue.sum() > 500
    browser.run("leader.pick({ of: 0, spring: 30 })")
    lines = browser.run("""Object.values(leader.Chart.instances).find(({ canvas }) => canvas.parentNode.id === "course").data.datasets
        .map(({ data, borderColor }) => [borderColor, data.length])""")
    assert lines == [["#0072b2", 41], ["#d55e00", 21]]
    browser.run("void leader.dispatchEvent(new KeyboardEvent('keydown', { key: 'o' }))")
    assert browser.run("[over.checked, frames.map((frame) => frame.hidden)]") == [False, [False, False]]
    assert browser.run("leader.document.getElementById('runs').children.length") == 0 and browser.console == []
