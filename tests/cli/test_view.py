"""hooke view: the contents of the page, compared with its file."""

import base64
import json
import os
import re
import time
from pathlib import Path

import pytest
from conftest import CLI, MINIMAL, SIX_PARTICLES, STIFF_PAIR
from pages import TITLE, VERSION, fetches

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")

DRAWS = not MINIMAL and not re.search(r"(Chart|three)\.js +not in this build", VERSION)
needs_view = pytest.mark.skipif(not DRAWS, reason="this build writes no pages: it has no three.js")

CLOTH = {
    "hooke": 1,
    "title": TITLE,
    "gravity": [0, 0, -9.81],
    "particles": {"position": [[0.5, 0.3, 0], [0.55, 0.3, 0]], "mass": 1},
    "parts": [{"kind": "cloth", "origin": [0, 0, 0], "edges": [[0.4, 0, 0], [0, 0, 0.6]], "size": [5, 7], "mass": 0.1,
               "pinned": ["top"], "structural": {"stiffness": 20, "damping": 0.01}, "shear": {"stiffness": 5}}],
    "driven": [{"particles": [36], "motion": "harmonic", "amplitude": [0, 0.1, 0], "frequency": 2}],
    "run": {"method": "symplectic-euler", "step": 1e-4, "duration": 0.1, "every": 0.01},
}
MARKS = {"free": 0, "pinned": 1, "driven": 2, "loose": 3}


class View:
    """Contents of a page, decoded as by its script."""

    def __init__(self, page):
        self.page = page
        self.data = json.loads(self.element("data"))
        fixed = base64.b64decode(self.element("fixed"), validate=True)
        springs = self.data["springs"]
        self.ends = np.frombuffer(fixed, "<u4", 2 * springs).reshape(-1, 2)
        self.marks = np.frombuffer(fixed, "u1", offset=8 * springs)
        text = self.element("frames")
        length, rest = divmod(len(text), self.data["frames"])
        assert rest == 0 and len(self.marks) == self.data["particles"]
        self.frames = [base64.b64decode(text[k * length:(k + 1) * length], validate=True) for k in range(self.data["frames"])]

    def element(self, name):
        start = self.page.index(f'id="{name}">') + len(f'id="{name}">')
        return self.page[start:self.page.index("</script>", start)]

    def positions(self, k):
        low, high = np.array(self.data["box"][k]).reshape(2, 3)
        shares = np.frombuffer(self.frames[k], "<u2", 3 * len(self.marks)).reshape(-1, 3) / 65535
        return low + (high - low) * shares, (high - low) / 131070

    def elongations(self, k):
        """[m], as the upper halves of floats."""
        halves = np.frombuffer(self.frames[k], "<u2", offset=6 * len(self.marks))
        return (halves.astype("<u4") << 16).view("<f4").astype(float)

    def floats(self, key):
        return np.frombuffer(base64.b64decode(self.data[key], validate=True), "<f4")


def look(hooke, folder, *options, source="out.h5"):
    answer = hooke("view", source, "-o", "page.html", *options)
    assert answer.code == 0, answer.err
    return View((folder / "page.html").read_text(encoding="utf-8")), answer


def elongations_of(file, k):
    q, ends = file["particles/all/position/value"][k], file["connectivity/springs"]
    return np.linalg.norm(q[ends[:, 0]] - q[ends[:, 1]], axis=1) - file["hooke/rest_length"]


def strains_of(file, k):
    return elongations_of(file, k) / file["hooke/rest_length"]


@pytest.fixture
def cloth(hooke, write):
    assert hooke("run", write(CLOTH), "-o", "out.h5").code == 0
    return "out.h5"


@needs_view
def test_the_page_holds_the_trajectory(hooke, cloth, tmp_path):
    view, answer = look(hooke, tmp_path)
    data = view.data
    assert answer.out == "" and "11 of 11 frames, 106 of 106 springs\n" in answer.err
    assert (data["title"], data["method"], data["step"], data["status"]) == (TITLE, "symplectic-euler", 1e-4, "finished")
    assert data["gravity"] == [0, 0, -9.81] and data["duration"] == 0.1
    with h5py.File(tmp_path / "out.h5") as file:
        q = file["particles/all/position/value"][:]
        assert data["time"] == list(file["particles/all/position/time"])
        for name in ("kinetic", "potential", "total"):
            assert data[name] == list(file[f"observables/{name}_energy/value"])
        assert np.array_equal(view.ends, file["connectivity/springs"])  # every particle is shown, at its own position
        assert list(view.marks[:2]) == [MARKS["loose"]] * 2 and view.marks[-1] == MARKS["driven"]
        assert list(view.marks[2:7]) == [MARKS["pinned"]] * 5 and set(view.marks[7:-1]) == {MARKS["free"]}
        largest = max(np.abs(strains_of(file, k)).max() for k in range(11))
        r = data["strain"]
        assert 0.1 * largest < r < 5 * largest and re.fullmatch("[125]0*", f"{r * 1e12:.0f}")
        for k in range(11):
            places, allowed = view.positions(k)
            assert (np.abs(places - q[k]) <= allowed * 1.000001).all()
            exact = elongations_of(file, k)
            rounding = np.abs(view.elongations(k) - exact)  # 8 significant bits, but for what the difference of lengths loses
            assert (rounding <= 2**-8 * np.abs(exact) + 1e-15).all() and (k == 0 or rounding.max() > 2**-11 * np.abs(exact).max())
        assert np.array_equal(view.floats("rest_length"), file["hooke/rest_length"][:].astype("<f4"))
        groups = [(group["name"], group["count"], group["pull_only"]) for group in data["groups"]]
        assert groups == [("cloth0.structural", 58, False), ("cloth0.shear", 48, False)]
        assert view.floats("stiffness") * view.floats("rest_length") == pytest.approx(58 * [20] + 48 * [5], rel=1e-6)
        assert data["strain_high"] == pytest.approx(max(strains_of(file, k).max() for k in range(11)), rel=1e-9)


@needs_view
def test_watched_quantities_over_the_frames_shown(hooke, cloth, tmp_path):
    view, _ = look(hooke, tmp_path, "--watch", "36.y,cloth0.structural:7.length,energy", "--frames", 6)
    shown = view.data["frame"]
    with h5py.File(tmp_path / "out.h5") as file:
        q, (head, tail) = file["particles/all/position/value"][:][shown], file["connectivity/springs"][7]
        expected = [q[:, 36, 1], np.linalg.norm(q[:, head] - q[:, tail], axis=1), file["observables/total_energy/value"][:][shown]]
    assert [(each["name"], each["unit"]) for each in view.data["watched"]] == [
        ("36.y", "m"), ("cloth0.structural:7.length", "m"), ("energy", "J")]
    assert len(shown) == 6
    assert np.allclose([each["values"] for each in view.data["watched"]], expected, rtol=1e-15)
    for words, said in [("period:36.y", "over time there is 36.y"), ("36.q", "nothing to watch")]:
        answer = hooke("view", cloth, "--watch", words, "-o", "none.html")
        assert answer.code == 3 and said in answer.err and not (tmp_path / "none.html").exists()


@needs_view
def test_obstacles_are_where_they_are_at_each_frame(hooke, write, tmp_path):
    """One point of what stays; of what moves, one a frame, by its sine; no obstacle widens the box of the particles."""
    ground = {"shape": "plane", "point": [0, 0, -9], "normal": [0, 0, 4], "stiffness": 10}
    ball = {"shape": "sphere", "center": [0.2, 0, -5], "radius": "2 m", "stiffness": 10, "motion": "harmonic",
            "amplitude": [0, 0.5, 0], "frequency": 3}
    assert hooke("run", write({**CLOTH, "obstacles": [ground, ball]}), "-o", "out.h5").code == 0
    data = look(hooke, tmp_path, "--frames", "6")[0].data
    assert data["obstacles"][0] == {"shape": "plane", "direction": [0, 0, 1], "radius": 0, "point": [0, 0, -9]}
    points = np.array(data["obstacles"][1].pop("point")).reshape(-1, 3)
    assert data["obstacles"][1] == {"shape": "sphere", "direction": [0, 0, 0], "radius": 2} and data["frames"] == 6
    time = np.array(data["time"])
    assert np.allclose(points, np.stack([0 * time + 0.2, 0.5 * np.sin(6 * np.pi * time), 0 * time - 5], axis=1), 0, 1e-15)
    assert np.array(data["box"])[:, 2].min() > -1


@needs_view
def test_the_page_fetches_nothing(hooke, cloth, tmp_path):
    view, _ = look(hooke, tmp_path)
    library = (Path(CLI).parent / "share/hooke/three.js").read_text(encoding="utf-8")
    assert library in view.page
    # XML names, which no browser fetches, and a paper that a shader of three.js refers to
    names, paper = "http://www.w3.org/", "https://graphics.stanford.edu/papers/envmap/"
    assert [found for found in fetches(view.page.replace(library, "")) if not found.startswith(names)] == []
    assert [found for found in re.findall(r"https?:\S+", library) if not found.startswith((names, paper))] == []
    assert view.page.count("default-src 'none'") == 1
    assert view.page.lower().count("<script") == view.page.lower().count("</script>") == 19


@needs_view
def test_a_damaged_frame_is_skipped(hooke, cloth, tmp_path):
    with h5py.File(tmp_path / "out.h5", "r+") as file:
        file["particles/all/position/value"][4, 7, 1] += 1e-3
    view, answer = look(hooke, tmp_path, "--json")
    assert "1 damaged frame is skipped" in answer.err and (answer.json["damaged"], answer.json["frames"]) == (1, 10)
    assert view.data["frame"] == [0, 1, 2, 3, 5, 6, 7, 8, 9, 10] and len(view.data["time"]) == 10
    with h5py.File(tmp_path / "out.h5", "r+") as file:
        assert view.data["time"] == [file["particles/all/position/time"][k] for k in view.data["frame"]]
        file["particles/all/position/value"][:, 7, 1] += 1e-3
        file["particles/all/position/value"][4, 7, 1] += 1
    hooke("view", "out.h5", "-o", "page.html", code=3, err=("frame 10 of ", "is damaged"))


@needs_view
def test_a_scene_is_run_first(hooke, write, tmp_path):
    hooke("view", write(CLOTH, name="cloth.json"), code=0, err="cloth.html: ")
    view = View((tmp_path / "cloth.html").read_text(encoding="utf-8"))
    assert (view.data["frames"], view.data["method"], view.data["step"]) == (11, "symplectic-euler", 1e-4)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cloth.html", "cloth.json"]
    hooke("view", write(SIX_PARTICLES), "--want", "1cm", "-o", "page.html", code=0, err="picked for an error of 1cm")
    # options of a run have the scene of a trajectory run anew
    assert hooke("run", write(CLOTH), "-o", "out.h5").code == 0
    assert look(hooke, tmp_path, "--step", "2e-4")[0].data["step"] == 2e-4
    hooke("view", write(STIFF_PAIR), "-o", "page.html", code=4, err="the run diverged")
    assert View((tmp_path / "page.html").read_text(encoding="utf-8")).data["status"] == "diverged"


@needs_view
def test_opening_it(hooke, cloth, tmp_path):
    browser = tmp_path / "browser"
    browser.write_text('#!/bin/sh\necho "$1" > opened.tmp && mv opened.tmp opened\n')
    browser.chmod(0o755)
    answer = hooke("view", cloth, "--open", env={**os.environ, "BROWSER": str(browser)})
    assert answer.code == 0 and (tmp_path / "out.html").exists()
    for _ in range(100):
        if (tmp_path / "opened").exists():
            break
        time.sleep(0.05)
    assert (tmp_path / "opened").read_text() == "out.html\n"


@needs_view
def test_frames_after_divergence(hooke, write, tmp_path):
    assert hooke("run", write(STIFF_PAIR), "-o", "out.h5", "--past-divergence", "--no-why").code == 4
    view, _ = look(hooke, tmp_path)
    with h5py.File(tmp_path / "out.h5") as file:
        assert view.data["good_frames"] == file["hooke/beyond"][0] < view.data["frames"]
        assert view.data["time_good"] == file["particles/all/position/time"][view.data["good_frames"] - 1]


@needs_view
def test_so_many_frames_after_divergence(hooke, write, tmp_path):
    """30 unless told otherwise, of a file that has more and of a scene, whose run is told of as 'hooke run' does."""
    scene = write(STIFF_PAIR, step=0.0635, every=0.0635, duration=12.7)  # slowly
    assert hooke("run", scene, "-o", "out.h5", "--past-divergence", "--no-why").code == 4
    with h5py.File(tmp_path / "out.h5") as file:
        good, there = int(file["hooke/beyond"][0]), len(file["particles/all/position/time"])
    assert there > good + 40
    for words, after in (((), 30), (("--beyond", "40"), 40), (("--beyond", "0"), 0)):
        view, answer = look(hooke, tmp_path, *words)
        assert view.data["frame"] == list(range(good + after)) and view.data["frames_there"] == there
        assert f"{good + after} of {there} frames" in answer.err and "--beyond allow more" in answer.err
        answer = hooke("view", scene, "-o", "page.html", *words)
        data = View((tmp_path / "page.html").read_text(encoding="utf-8")).data
        assert answer.code == 4 and (data["good_frames"], data["frames_there"]) == (good, good + after)
        told = answer.err.splitlines()[1:]
        assert re.match("hooke view: the run diverged after t = ", told[0]) and told[1].startswith("try: hooke run scene.json --step ")
        assert told[2] == "see: hooke why scene.json --report why.html"
        kept = f", and {after} after it diverged, which are no physics" if after else ""
        assert re.fullmatch(rf"kept: {good} frames up to t = \S+ s in page.html{kept}", told[3]) and len(told) == 4
        assert (data["title"], data["file"], data["why"]) == ("scene.json", "scene.json", told[2][5:])
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.h5", "out.xdmf", "page.html", "scene.json"]


@needs_view
def test_what_is_left_out(hooke, cloth, tmp_path):
    view, answer = look(hooke, tmp_path, "--frames", "4", "--springs", "20", "--json")
    value = answer.json
    assert (value["frames"], value["frames_there"], value["frame_stride"]) == (4, 11, 4)
    assert (value["springs"], value["springs_there"], value["spring_stride"]) == (18, 106, 6)
    assert value["bytes"] == (tmp_path / "page.html").stat().st_size and value["output"] == "page.html"
    assert "4 of 11 frames, every 4th, 18 of 106 springs, every 6th; --frames, --springs, --size and --beyond allow more" in answer.err
    assert view.data["time"] == pytest.approx([0, 0.04, 0.08, 0.1])
    with h5py.File(tmp_path / "out.h5") as file:
        springs, q = file["connectivity/springs"][::6], file["particles/all/position/value"]
        for place, frame in enumerate([0, 4, 8, 10]):
            places, allowed = view.positions(place)
            for side in (0, 1):
                assert (np.abs(places[view.ends[:, side]] - q[frame][springs[:, side]]) <= allowed * 1.000001).all()
    assert (view.marks == MARKS["pinned"]).sum() == 5 and (view.marks == MARKS["loose"]).sum() == 2


@needs_view
def test_the_size_of_the_page(hooke, write, tmp_path):
    assert hooke("run", write(CLOTH, every=5e-4), "-o", "out.h5").code == 0
    whole = look(hooke, tmp_path, "--json")[1].json
    size = (whole["bytes"] - 3e4) / 1e6
    less = look(hooke, tmp_path, "--json", "--size", f"{size:.4f}")[1].json
    assert whole["frames"] == 201 and 60 < less["frames"] < 200 and less["bytes"] <= size * 1e6
    answer = hooke("view", "out.h5", "-o", "page.html", "--size", "1")
    assert answer.code == 3 and re.search(r"allow 1\.\d MB or more", answer.err)
    assert hooke("view", "out.h5", "-o", "page.html", "--size", re.search(r"allow (\S+) MB", answer.err)[1]).code == 0


@needs_view
def test_runs_that_ended_early(hooke, write, start, tmp_path):
    assert hooke("run", write(STIFF_PAIR), "-o", "out.h5").code == 4
    view, _ = look(hooke, tmp_path)
    assert view.data["status"] == "diverged" and view.data["duration"] == 100 and view.data["time_last"] < 100
    # a file with space for more frames than written, which was not closed
    assert hooke("run", write(SIX_PARTICLES), "-o", "out.h5").code == 0
    with h5py.File(tmp_path / "out.h5", "a") as file:
        file["particles/all/position/time"][7:] = np.nan
        file["hooke/status"][()] = b"running"
    view, answer = look(hooke, tmp_path, "--json")
    assert (view.data["status"], answer.json["status"], answer.json["frames_there"]) == ("running", "running", 7)


@needs_view
def test_files_without_rest_lengths(hooke, cloth, tmp_path):
    with h5py.File(tmp_path / "out.h5", "a") as file:
        del file["hooke/rest_length"], file["hooke/file_check"]
    view, _ = look(hooke, tmp_path)
    assert view.data["by_first_frame"] and set(view.elongations(0)) == {0} and len(set(view.elongations(10))) > 5


@needs_view
def test_what_is_refused(hooke, write, tmp_path):
    scene = write(SIX_PARTICLES, duration=0.1)
    assert hooke("run", scene, "-o", "out.h5").code == 0
    (tmp_path / "other.txt").write_text("words")
    for source, words in (("other.txt", "other.txt:1:1: words is not JSON here"), ("nothing.h5", "nothing.h5: cannot be opened")):
        answer = hooke("view", source, "-o", "page.html", "--json")
        assert answer.code == 3 and words in answer.json["error"]["message"]
    assert hooke("compare", scene, "--methods", "rk4", "-o", "several.h5").code == 0
    hooke("view", "several.h5", "-o", "page.html", code=3, err="holds several runs")
    answer = hooke("view", "out.h5", "-o", "out.h5")
    assert answer.code == 2
    assert hooke("view", "out.h5", "-o", "nowhere/page.html").code == 5
    assert hooke("view", "out.h5", "-o", "page.html", "--frames", "1").code == 2
    with h5py.File(tmp_path / "out.h5", "a") as file:
        file["connectivity/springs"][3] = [2, 77]
    hooke("view", "out.h5", "-o", "page.html", code=3, err="masses or springs are not those that were written")
    with h5py.File(tmp_path / "out.h5", "a") as file:
        del file["hooke/file_check"]
    hooke("view", "out.h5", "-o", "page.html", code=3, err="/connectivity/springs")
    assert not (tmp_path / "page.html").exists()


@needs_view
def test_several_are_refused_before_anything_is_written(hooke, cloth, tmp_path):
    paths, content = [tmp_path / f"{k}.h5" for k in range(9)], (tmp_path / cloth).read_bytes()
    for path in paths:
        path.write_bytes(content)
    first, second = paths[:2]
    os.link(second, tmp_path / "twin.html")
    for words, message in [
        ((first, second, "-o", second), "its name has to end in .html"),
        ((first, second, "-o", "twin.html"), "twin.html: is read, too, and would be replaced"),
        ((first, second), "several inputs need -o"),
        ((*paths, "-o", "page.html"), "9 inputs at once; allowed: up to 8"),
        ((first, second, "-o", "page.html", "--step", "1e-4"), "leave out the options of a run"),
    ]:
        hooke("view", *words, code=2, err=message)
    assert second.read_bytes() == content and not (tmp_path / "page.html").exists()
    told = hooke("view", first, second, "-o", "page.html", "--json").json
    assert [view["trajectory"] for view in told["views"]] == [str(first), str(second)] and told["output"] == "page.html"


@needs_view
def test_scenes_beside_a_trajectory(hooke, cloth, write, tmp_path):
    """Each is run as it says; a scene that is refused, or blows up, is told, and nothing stays but the page."""
    scenes = [str(write(CLOTH, name, **more)) for name, more in (("one.json", {}), ("two.json", {"step": 2e-4, "every": 0.02}))]
    there = set(tmp_path.iterdir())
    told = hooke("view", scenes[0], cloth, scenes[1], "-o", "page.html", "--json").json
    assert [(view["trajectory"], view["frames"]) for view in told["views"]] == [(scenes[0], 11), (cloth, 11), (scenes[1], 6)]
    slow = write(CLOTH, "slow.json", duration=1e6)  # nothing is run before all are known to be there
    hooke("view", slow, "nothing.h5", "-o", "none.html", code=3, err="nothing.h5: cannot be opened")
    hooke("view", slow, write({"hooke": 1}, "wrong.json"), "-o", "none.html", code=3, err="wrong.json")
    stiff = write(STIFF_PAIR, "stiff.json", duration=10)
    for several in ((stiff, scenes[0]), (stiff, stiff)):
        told = hooke("view", *several, "-o", "stiff.html")
        assert told.code == 4 and told.err.count(f"{stiff}: the run diverged") == several.count(stiff)
    assert set(tmp_path.iterdir()) - there == {tmp_path / name for name in ("page.html", "stiff.json", "stiff.html", "slow.json", "wrong.json")}


def test_help(hooke):
    answer = hooke("view", "--help", "all")
    assert answer.code == 0 and "usage: hooke view SCENE [options]" in answer.out
    assert "--frames" in answer.out and "[MB]" in answer.out and "--step" in answer.out
    hooke("view", code=2, err="no scene given")


@pytest.mark.skipif(DRAWS, reason="this build writes pages")
def test_not_built(hooke, tmp_path):
    (tmp_path / "out.h5").write_bytes(b"\x89HDF\r\n\x1a\n")
    assert hooke("view", "out.h5", "-o", "page.html").code == (6 if MINIMAL else 3)


@pytest.mark.everything
def test_the_companion(hooke, write, tmp_path):
    """It is written with the output; if the name does not suit it, or belongs to another file, the run says so, and
    succeeds."""
    scene = write(SIX_PARTICLES, duration=0.1)
    assert hooke("run", scene, "-o", "out.h5").err == ""
    assert (tmp_path / "out.xdmf").read_text().count("<Time ") == 3
    (tmp_path / "notes.xdmf").write_text("my notes")
    answer = hooke("run", scene, "-o", "notes.h5")
    assert answer.code == 0 and "is no XDMF" in answer.err and (tmp_path / "notes.xdmf").read_text() == "my notes"
    answer = hooke("run", scene, "-o", "a:b.h5")
    assert answer.code == 0 and "ASCII without colons" in answer.err and (tmp_path / "a:b.h5").exists()
    (tmp_path / "folder.xdmf").mkdir()
    hooke("run", scene, "-o", "folder.h5", code=5, err="folder.xdmf")
