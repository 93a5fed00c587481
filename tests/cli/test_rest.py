"""hooke rest: words, JSON, exit codes."""

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import SIX_PARTICLES
from pages import browse, data_of, needs_browser, needs_page

SCENES = Path(__file__).parents[2] / "examples" / "scenes"
HANGING = {
    "hooke": 1,
    "gravity": [0, -10, 0],
    "particles": {"position": [[0, 0, 0], [1, 0, 0]], "mass": 2, "pinned": [0]},
    "springs": [{"name": "cord", "between": [[0, 1]], "law": "length", "stiffness": 100, "rest_length": 1}],
    "run": {"method": "verlet", "step": 1e-3, "duration": 1},
}
KEYS = ["scene", "status", "residual", "largest_force", "minimum", "zero_modes", "moved", "steps", "iterations"]
KEYS += ["force_evaluations", "watched", "modes", "claims"]


def test_a_weight_hangs(hooke, write):
    answer = hooke("rest", write(HANGING), "--json", "--final", "--watch", "cord:0.tension,1.y")
    assert (answer.code, answer.err) == (0, "")
    value = answer.json
    assert list(value) == [*KEYS, "final"] and value["status"] == "at rest"
    assert value["final"]["velocity"] == [[0, 0, 0], [0, 0, 0]]
    assert value["final"]["position"][1] == pytest.approx([0, -1.2, 0], abs=1e-9)
    assert value["largest_force"] == pytest.approx(20, rel=1e-9) and value["residual"] < 1e-7
    assert [(one["quantity"], one["unit"]) for one in value["watched"]] == [("cord:0.tension", "N"), ("1.y", "m")]
    assert [one["value"] for one in value["watched"]] == pytest.approx([20, -1.2], rel=1e-9)


def test_words(hooke, write):
    words = hooke("rest", write(HANGING), "--watch", "1.y", "--final").out
    assert "forces are in equilibrium to" in words
    assert ("each raises it" in words) != ("is least here is not known" in words)  # without LAPACK
    assert "1.y" in words and "particle x y z [m]" in words
    assert len(hooke("rest", write(SIX_PARTICLES), "-q").out.splitlines()) <= 3


def test_what_falls_has_exit_7(hooke, write):
    scene = {**HANGING, "springs": [], "run": HANGING["run"]}
    answer = hooke("rest", write(scene), "--json")
    assert answer.code == 7 and answer.json["status"] == "none" and answer.json["minimum"] is None
    assert "the scene falls along 0 -1 0" in answer.json["claims"][0]["text"]


def test_what_is_not_found_is_said_so(hooke):
    answer = hooke("rest", SCENES / "cloth-64.json", "--json", "--budget", "1ms")
    assert answer.code == 7 and answer.json["claims"][0]["of"] == "unknown"


def test_nothing_to_watch(hooke, write):
    hooke("rest", write(HANGING), "--watch", "7.y", code=3, err="particles 0 to 1")


def test_a_scene_that_starts_at_rest(hooke, write, tmp_path):
    """Its parts are kept, nothing moves, and --from-rest is the same to the bit; what falls starts nowhere."""
    scene, out = SCENES / "cantilever.json", tmp_path / "rest.json"
    assert hooke("rest", scene, "-o", out).code == 0
    written = json.loads(out.read_text())
    assert written["parts"] and len(written["start"]["position"]) == 17 and "velocity" not in written["start"]
    runs = [hooke("run", *words, "--duration", "0.1", "--final", "--json").json for words in ((out,), (scene, "--from-rest"))]
    assert runs[0]["final"] == runs[1]["final"] and runs[0]["energy"] == runs[1]["energy"]
    hooke("limit", scene, "--at", out, "--from-rest", code=2, err="--at and --from-rest are two states")
    moved = np.abs(np.array(runs[0]["final"]["position"]) - written["start"]["position"]).max()
    assert moved < 1e-9  # 9 mm from the undeformed start
    falls = hooke("run", write({**HANGING, "springs": []}), "--from-rest")
    assert falls.code == 7 and "falls" in falls.err


@pytest.mark.check
def test_a_search_without_end_ends_after_counted_work(hooke):
    """A flag in the wind: nothing tells how far it is from rest. The work is counted, so that both end at the same place."""
    answers = [hooke("rest", SCENES / "flag.json", "--json") for _ in range(2)]
    assert answers[0].out == answers[1].out and answers[0].code == 7
    value = answers[0].json
    assert f"{value['steps']} steps" in value["claims"][0]["text"] and f"{value['residual']:.6g} N is left" in value["claims"][0]["text"]


@needs_page
@needs_browser
def test_the_page_shows_tensions_and_modes(hooke, write, tmp_path):
    hanging = {**HANGING, "particles": {"position": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "mass": 2, "pinned": [0]},
               "springs": [{**HANGING["springs"][0], "between": [[0, 1], [1, 2]]}]}
    hooke("rest", write(hanging), "--watch", "1.y", "--report", tmp_path / "rest.html")
    page = (tmp_path / "rest.html").read_text()
    assert data_of(page)["picture"]["tension"] == pytest.approx([40, 20], rel=1e-9)
    seen = browse(tmp_path, page, """const colours = () => { const { data, options } = Chart.getChart("picture");
        const { segment } = data.datasets.find(({ role }) => role === "state");
        return [0, 3].map((p0DataIndex) => segment.borderColor({ p0DataIndex })).join(" ") + data.datasets.some(({ role }) => role === "mode"); };
        const still = colours();
        document.querySelector('#mode [data-key="0"]').click();
        document.getElementById("picture").dataset.said = `${still} ${colours()}`;""")
    pulls = "rgb(176 0 32) rgb(172 88 108)"
    assert seen.drawn("picture")["said"] == f"{pulls}false {pulls}true" and not seen.console
    assert "1 and 2" in seen.text["tensions"] and "-1.4 m" in seen.text["about"]
