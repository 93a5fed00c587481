"""hooke needs: keys, exit codes, the lean scene compared with the full one, resolutions, and the page."""

import copy
import json
import pathlib
import subprocess

import pytest
from conftest import CLI, MINIMAL, SIX_PARTICLES, interrupt
from pages import (
    ABOUT,
    DRAWS,
    TITLE,
    VERSION,
    browse,
    check_same,
    data_of,
    fetches,
    needs_browser,
    needs_page,
)

pytestmark = pytest.mark.everything

# A cloth with a corner released, whose bending matters and whose drag does not, and a rope far away.
SCENE = {
    "hooke": 1,
    "title": TITLE,
    "gravity": [0, -9.81, 0],
    "drag": 1e-7,
    "parts": [
        {"kind": "cloth", "name": "cloth", "origin": [0, 0, 0], "edges": [[0.4, 0, 0], [0, 0, 0.4]], "size": [5, 5],
         "mass": 0.1, "pinned": "top", "structural": {"stiffness": 40, "damping": 0.05},
         "bend": {"stiffness": 20, "damping": 0.05}},
        {"kind": "rope", "name": "rope", "from": [9, 0, 0], "to": [9.4, 0, 0], "segments": 4, "mass": 0.1,
         "pinned": "start", "stretch": {"stiffness": 100, "damping": 0.05}},
    ],
    "run": {"method": "symplectic-euler", "step": 1e-3, "duration": 0.2, "every": 0.02},
}
RESTING = pathlib.Path(__file__).parent / "scenes" / "needs" / "balanced-mass.json"
WATCH = ("--want", "3mm", "--watch", "cloth")
COST = {"wall_seconds", "springs", "step_limit", "unlimited", "particles", "step", "rtol", "atol", "force_evaluations",
        "steps", "step_error"}
WHOLE = {"want", "error_unit", "method", "method_picked", "duration", "judged_until", "runs", "watched", "spread", "note", "claims"}
BLUE, RED = "#7fb2e5", "#b00020"  # of the full scene, of the lean one
GREEN, ORANGE = "#1b7f4d", "#c2410c"  # unneeded and needed ingredients
LOOK = """
for (const [id, colours] of Object.entries(COLOURS)) {
  const { ctx, chartArea: area, currentDevicePixelRatio: scale } = Chart.getChart(id);
  const bytes = ctx.getImageData(area.left * scale, area.top * scale, area.width * scale, area.height * scale).data;
  const count = (colour) => {
    const want = [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16));
    let seen = 0;
    for (let k = 0; k < bytes.length; k += 4) seen += want.every((value, i) => bytes[k + i] === value);
    return seen;
  };
  document.getElementById(id).dataset.pixels = JSON.stringify(colours.map(count));
}
const bars = Chart.getChart("changes");
bars.canvas.dataset.ends = JSON.stringify(bars.data.labels.map((label, i) => [label,
  Math.max(...bars.data.datasets.map((set, k) => (set.data[i] === null ? -1 : bars.scales.x.getValueForPixel(
    bars.getDatasetMeta(k).data[i].x))))]));
""".replace("COLOURS", json.dumps({"picture": [BLUE, RED], "changes": [GREEN, ORANGE], "costs": [GREEN, ORANGE]}))


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """The folder of one search, and its output."""
    if MINIMAL:
        pytest.skip("the minimal build reads no scenes")
    folder = tmp_path_factory.mktemp("needs")
    (folder / "scene.json").write_text(json.dumps(SCENE))
    report = ["--report", "out.html"] if DRAWS else []
    command = [CLI, "needs", "scene.json", *WATCH, "-o", "lean.json", "--json", *report]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240)
    assert (done.returncode, done.stderr) == (0, "")
    return folder, json.loads(done.stdout)


def row_of(answer, name):
    (row,) = [row for row in answer["rows"] if row["without"] == name]
    return row


def test_keys(found):
    _, answer = found
    assert set(answer) == WHOLE | {"full", "wants", "rows", "degrees", "lean", "parts"} and answer["parts"] == []
    assert (answer["want"], answer["method"], answer["duration"]) == (3e-3, "symplectic-euler", 0.2)
    assert answer["judged_until"] == pytest.approx(0.2)
    assert set(answer["full"]) == COST | {"own_error", "moved"} and answer["full"]["step_error"] <= 3e-4
    assert answer["full"]["own_error"] <= answer["full"]["step_error"] and answer["full"]["moved"] > 0.03
    assert next(claim["key"] for claim in answer["claims"]) == "lean" and {claim["of"] for claim in answer["claims"]} == {"whole"}
    assert all(set(row) == COST | {"without", "kind", "error", "needed", "left_out", "note", "timed_alone"} for row in answer["rows"])
    assert set(answer["lean"]) == COST | {"scene", "without", "error", "full", "times_less", "other_method", "other_seconds",
                                           "changed", "note", "command"}
    assert set(answer["lean"]["full"]) == COST | {"error"}
    assert (answer["lean"]["scene"], answer["lean"]["command"]) == ("lean.json", "hooke run lean.json")
    names = [row["without"] for row in answer["rows"]]
    assert {"cloth.structural", "cloth.bend", "damping", "drag", "gravity", "rope", "half the resolution of cloth"} <= set(names)
    for row in answer["rows"]:
        assert row["needed"] is (row["error"] > 3e-3), row
    assert row_of(answer, "gravity")["needed"] and row_of(answer, "cloth.structural")["needed"]
    assert row_of(answer, "rope")["error"] == 0 and not row_of(answer, "drag")["needed"]
    assert "rope" in answer["lean"]["without"] and set(answer["lean"]["without"]) <= set(names)


@needs_page
def test_numbers_are_those_of_the_answer(found):
    folder, answer = found
    page = data_of((folder / "out.html").read_text(encoding="utf-8"))
    alone = check_same(page, answer | {"command": answer["lean"]["command"]})
    assert alone == ABOUT | {"particles", "picture"}


def test_the_lean_scene_is_as_far_off_as_it_says(found):
    h5py, np = pytest.importorskip("h5py"), pytest.importorskip("numpy")
    folder, answer = found
    fine = str(answer["full"]["step"] / 16)
    paths = []
    for scene, options in (("scene.json", ["--step", fine]), ("lean.json", [])):
        done = subprocess.run([CLI, "run", scene, *options, "-o", "out.h5", "--json"], cwd=folder, capture_output=True,
                              text=True, timeout=240)
        assert done.returncode == 0, done.stderr
        with h5py.File(folder / "out.h5") as file:
            paths.append(file["particles/all/position/value"][:, :25])
    assert json.loads(done.stdout)["springs"] == answer["lean"]["springs"] < answer["full"]["springs"]
    assert json.loads(done.stdout)["steps"] == answer["lean"]["steps"]
    distance = np.sqrt(((paths[0] - paths[1]) ** 2).sum(axis=2))
    # an upper estimate: of two errors that add up at worst
    assert distance.max() <= answer["lean"]["error"] <= distance.max() + 2 * answer["full"]["own_error"]
    assert answer["lean"]["error"] <= 3e-3


def test_words(hooke, write):
    answer = hooke("needs", write(SCENE), *WATCH)
    assert answer.code == 0 and answer.err == ""
    assert "nothing (the full scene)" in answer.out and "these ingredients can be left out together: " in answer.out
    assert "-o LEAN.json" in answer.out


def test_usage(hooke, write):
    scene = write(SIX_PARTICLES)
    answer = hooke("needs", scene)
    assert answer.code == 2 and "--want 1mm" in answer.err
    assert hooke("needs", scene, "--want", "1kg").code == 2
    assert hooke("needs", scene, "--want", "1mm", "--step", "1ms").code == 2
    assert hooke("needs", scene, "--want", "1mm", "--refine", "-o", "lean.json").code == 2
    assert hooke("needs", scene, "--want", "1mm", "-o", scene).code == 2
    answer = hooke("needs", scene, "--want", "1mm", "--watch", "nobody")
    assert answer.code == 3 and "edges" in answer.err and "0 to 5" in answer.err
    assert hooke("needs", scene, "--want", "1mm", "--watch", "4-9").code == 3
    assert hooke("needs", scene, "--want", "0").code == 2
    assert hooke("needs", scene, "--want", "1mm", "--refine").code == 3  # no part has a resolution
    assert hooke("needs", write(SIX_PARTICLES, duration=None), "--want", "1mm").code in (2, 3)
    answer = hooke("needs", scene, "--want", "0.5", "--duration", "0.1", "-o", "nowhere/lean.json")
    assert answer.code == 5 and "nowhere" in answer.err


def test_refine(hooke, write):
    answer = hooke("needs", write(SCENE), "--want", "1cm", "--watch", "rope", "--refine", "--json")
    assert answer.code == 0, answer.err
    assert set(answer.json) == WHOLE | {"full", "wants", "parts", "rows", "degrees", "lean"} and answer.json["lean"] is None
    cloth, rope = answer.json["parts"]
    for part in (cloth, rope):
        assert set(part) == {"part", "cells", "change", "change_fine", "order", "error", "factor", "wanted", "note"}
    assert (cloth["part"], cloth["cells"], rope["part"], rope["cells"]) == ("cloth", [4, 4], "rope", [4])
    assert rope["change"] > rope["change_fine"] > 0 and 0.25 < rope["order"] < 4.5 and rope["note"] == ""
    assert rope["error"] == pytest.approx(rope["change"] * 2 ** rope["order"] / (2 ** rope["order"] - 1))
    assert 10 ** -2 >= rope["error"] / rope["factor"] ** rope["order"] * 0.999 and len(rope["wanted"]) == 1
    assert cloth["order"] is None and "the error of the step" in cloth["note"]
    told = [claim for claim in answer.json["claims"] if claim["key"] == "resolution"]
    assert [claim["of"] for claim in told] == ["whole" if part["factor"] else "unknown" for part in (cloth, rope)]
    assert cloth["error"] is None and "nan" not in told[0]["text"] and cloth["note"] in told[0]["text"]
    assert f"rope has 4 cells, which leaves {rope['error']:.3g} m; an error of at most 0.01 m asks for {rope['wanted'][0]}" == told[1]["text"]
    assert "2N to 4N" in hooke("needs", "scene.json", "--want", "1cm", "--watch", "rope", "--refine").out


def long_scene():
    scene = copy.deepcopy(SCENE)
    scene["parts"][0]["size"] = [33, 33]
    scene["run"].update(duration=2, every=0.02)
    return scene


@pytest.mark.parametrize("wait", [0.0, 0.2])
def test_interrupted(start, write, tmp_path, wait):
    more = ["--report", "out.html"] if DRAWS else []
    process = start("needs", write(long_scene()), "--want", "1mm", "--duration", "2", "--json", *more)
    interrupt(process, wait)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130, err
    answer = json.loads(out)
    assert answer["lean"] is None and b"kept" in err
    if DRAWS:
        page = (tmp_path / "out.html").read_text(encoding="utf-8")
        data = data_of(page)
        assert len(data["rows"]) == len(answer["rows"]) and "picture" not in data and data["claims"] == answer["claims"]
    told = answer["claims"][0]
    assert (told["key"], told["of"]) == ("lean", "unknown") and "not looked at: " in told["text"] and "gravity" in told["text"]


@needs_page
@needs_browser
def test_what_is_drawn(found, tmp_path):
    folder, answer = found
    page = (folder / "out.html").read_text(encoding="utf-8")
    data = data_of(page)
    assert [row["without"] for row in data["rows"]] == [row["without"] for row in answer["rows"]]
    seen = browse(tmp_path, page, LOOK)
    assert seen.console == []
    changes, costs, picture = (seen.drawn(name) for name in ("changes", "costs", "picture"))
    needed = [row["without"] for row in answer["rows"] if row["needed"]]
    left_out = answer["lean"]["without"]
    assert (changes["bars"], changes["needed"], changes["left_out"]) == (len(answer["rows"]), len(needed), len(left_out))
    assert (costs["bars"], costs["full"], costs["lean"]) == (len(answer["rows"]) + 3, 2, 1)
    assert float(changes["mark"]) == 3e-3 and float(costs["mark"]) == answer["full"]["wall_seconds"]
    ends = json.loads(changes["ends"])
    sizes = [row_of(answer, name)["error"] for name, _ in ends]
    assert sizes == sorted(sizes, reverse=True)
    for (_, end), size in zip(ends, sizes):
        assert end == pytest.approx(size, rel=1e-6) or size < min(end for _, end in ends)
    for drawn in (changes, costs, picture):
        assert min(json.loads(drawn["pixels"])) > 50, drawn
    # the watched cloth: 40 structural springs and 30 bends
    assert (picture["springs"], picture["particles"]) == (70, 25) and picture["view"] in ("xy", "xz", "zy")
    assert seen.text["scene"] == TITLE and "hooke run lean.json" in seen.text["claims"]
    assert all(name in seen.text["claims"] for name in left_out)
    assert all(row["without"] in seen.text["rows"] for row in answer["rows"]) and "all that is left out" in seen.text["rows"]
    assert "hidden" in seen.attributes["resolution"] and VERSION.split()[1] in seen.text["machine"]
    assert fetches(page) == []


@needs_page
def test_the_picture_has_both(found):
    np = pytest.importorskip("numpy")
    folder, answer = found
    data = data_of((folder / "out.html").read_text(encoding="utf-8"))
    picture = data["picture"]
    full, lean = (np.reshape(picture[name], (-1, 3)) for name in ("position", "lean"))
    assert sorted(picture["particle"]) == list(range(25)) and sum(picture["held"]) == 5
    assert picture["springs"] == 70 == len(picture["spring"]) and max(picture["ends"]) == 24
    held = np.flatnonzero(picture["held"])
    np.testing.assert_allclose(full[held], lean[held], atol=1e-6)
    apart = np.sqrt(((full - lean) ** 2).sum(axis=1)).max()
    assert 0 < apart <= answer["lean"]["error"] + 1e-5 and np.ptp(full[:, 1]) > 0.05


@needs_page
@needs_browser
def test_other_pages(hooke, write, tmp_path):
    assert hooke("needs", write(SCENE), "--want", "1cm", "--watch", "rope", "--refine", "--report", "out.html").code == 0
    seen = browse(tmp_path, (tmp_path / "out.html").read_text(encoding="utf-8"))
    assert seen.console == [] and "hidden" not in seen.attributes["resolution"]
    for name in ("changed", "cost", "laid", "all"):
        assert "hidden" in seen.attributes[name]
    assert "rope" in seen.text["parts"] and "4 \u00d7 4" in seen.text["parts"] and "rope has 4 cells" in seen.text["claims"]
    # all is needed: there is no picture; a single particle is drawn as a point
    scene = copy.deepcopy(SIX_PARTICLES)
    scene["drag"] = 1e-9
    assert hooke("needs", write(scene), "--want", "1cm", "--duration", "0.1", "--every", "0.01", "--watch", "3",
                 "--report", "out.html").code == 0
    seen = browse(tmp_path, (tmp_path / "out.html").read_text(encoding="utf-8"))
    assert seen.console == [] and "drag" in seen.text["claims"] and "0 of 0 between watched" in seen.text["about"]
    assert (seen.drawn("picture")["springs"], seen.drawn("picture")["points"]) == (0, 2)
    # nothing moves
    assert hooke("needs", RESTING, "--want", "1cm", "--report", "out.html").code == 0
    seen = browse(tmp_path, (tmp_path / "out.html").read_text(encoding="utf-8"))
    assert seen.console == [] and "nothing moves" in seen.text["claims"] and "cannot be told" in seen.text["claims"]
    assert (seen.drawn("changes")["needed"], seen.drawn("changes")["unknown"]) == (2, 3)


@needs_page
@needs_browser
def test_a_stopped_page(start, write, tmp_path):
    process = start("needs", write(long_scene()), "--want", "1mm", "--report", "out.html", "-q")
    interrupt(process, 0.1)
    assert process.wait(timeout=60) == 130
    seen = browse(tmp_path, (tmp_path / "out.html").read_text(encoding="utf-8"))
    assert seen.console == [] and "no lean scene was found" in seen.text["claims"] and "gravity" in seen.text["claims"]


def test_the_method_is_named_with_who_chose_it(hooke, write):
    scene = json.loads(RESTING.read_text())
    for left_out, how in (((), ""), (("method", "step"), ", picked,")):
        scene["run"] = {key: value for key, value in scene["run"].items() if key not in left_out}
        told, found = (hooke("needs", write(scene), "--want", "1cm", *more) for more in ((), ("--json",)))
        assert f"by {found.json['method']}{how} the time step puts the full scene off" in told.out
        assert found.json["method_picked"] == bool(left_out)


def test_every_name_that_is_left_out_is_told_whole(hooke, write):
    scene = copy.deepcopy(SIX_PARTICLES)
    names = [f"\u00e9\U0001f600{'x' * 150}{k}" for k in range(8)]
    scene["springs"] += [{"name": name, "between": [[1, 3]] * 9, "stiffness": 1e-9} for name in names]
    told = hooke("needs", write(scene), "--want", "1cm", "--duration", "0.1", "--method", "verlet", "--json").json
    claim = next(claim for claim in told["claims"] if claim["key"] == "lean")
    assert set(names) <= set(told["lean"]["without"]) and all(name in claim["text"] for name in names)


STIFF_SPRING = pathlib.Path(__file__).parents[2] / "examples/scenes/stiff-spring.json"


def chain(stiffness, gravity=(0, -9.81, 0)):
    count = len(stiffness) + 1
    return {"hooke": 1, "gravity": gravity,
            "particles": {"position": [[k, 0, 0] for k in range(count)], "mass": 1, "pinned": [0, count - 1]},
            "springs": [{"name": "all", "between": [[k, k + 1] for k in range(count - 1)], "stiffness": stiffness,
                         "damping": 0.5, "rest_scale": 1}],
            "run": {"method": "verlet", "step": 5e-4, "duration": 0.5, "every": 0.05}}


def test_what_lacks_the_wanted_quantity_is_needed(hooke):
    answer = hooke("needs", STIFF_SPRING, "--want", "soft:max.tension=20%,1m", "--method", "verlet", "--duration", "0.5", "--json")
    row = row_of(answer.json, "soft")
    assert row["needed"] and row["error"] is None and row["note"] == "it is without what is wanted"


@pytest.mark.parametrize("want", ["period:4.y=1%", "energy=1%", "4=1%"])
def test_no_part_of_nothing_is_wanted(hooke, write, want):
    scene = write(chain([100] * 9, gravity=(0, 0, 0)))
    for verb in ("needs", "study"):
        answer = hooke(verb, scene, "--want", want)
        assert answer.code == 3 and f"{want[:-3]}: no run tells whether it is within 1 % of its largest value" in answer.err


def test_errors_are_told_of_a_recommended_run_alone(hooke):
    answer = hooke("needs", STIFF_SPRING, "--want", "stiff:max.tension=20%", "--method", "verlet", "--duration", "1", "--json").json
    assert answer["lean"]["error"] is None and answer["wants"] == []
    assert not [claim for claim in answer["claims"] if claim["key"] == "error"]


def test_the_stiffest_springs_are_asked_whatever_has_no_stiffness(hooke, write):
    stiffness = [0] + [100, 100, 5000] * 9 + [100] * 12 + [1e7]
    answer = hooke("needs", write(chain(stiffness)), "--want", "5cm", "--json").json
    single = [row["quantity"] for row in answer["degrees"] if ":" in row["quantity"]]
    assert single == [f"all:{k}.stiffness" for k in (*range(3, 22, 3), len(stiffness) - 1)]


def test_a_strip_is_made_coarser_along_it(hooke, write):
    scene = copy.deepcopy(SCENE)
    scene["parts"] = [{"kind": "cloth", "name": "c", "edges": [[0.05, 0, 0], [0, 0, 0.5]], "size": [2, 21], "mass": 0.2,
                       "pinned": [0, 1], "structural": {"stiffness": 50, "damping": 0.01},
                       "shear": {"stiffness": 5, "damping": 0.01}}]
    names = [row["without"] for row in hooke("needs", write(scene), "--want", "10cm", "--json").json["rows"]]
    assert any(name.startswith("all but 1 x ") and name.endswith(" of 1 x 20 cells of c") for name in names), names
