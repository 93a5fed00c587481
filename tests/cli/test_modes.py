"""hooke modes: words, JSON, a frame of a trajectory, files, and the page on which modes play."""

import json
from pathlib import Path

import pytest
from conftest import SIX_PARTICLES
from pages import browse, data_of, fetches, needs_browser, needs_page

CASES = Path(__file__).parents[1] / "data" / "cases"
pytestmark = pytest.mark.everything


@pytest.mark.parametrize("name, omegas", [
    ("three-degrees-of-freedom", [0.32430323, 0.89922849, 1.97978506]),
    ("fixed-free", [0.6945927107, 2, 3.0641777725, 3.7587704831]),
])
def test_known_frequencies(hooke, name, omegas):
    found = hooke("modes", CASES / f"{name}.json", "--json").json
    assert [mode["omega"] for mode in found["modes"]] == pytest.approx(omegas, rel=2e-6)
    assert found["zero_modes"] == 2 * len(omegas)  # they move along a line alone
    assert all(sum(abs(group["share"]) for group in mode["groups"]) == pytest.approx(1) for mode in found["modes"])
    assert all(len(mode["shape"]) == 3 * (len(omegas) + 1) for mode in found["modes"])


def test_words_of_a_state_that_is_not_at_rest(hooke, write):
    scene = write(SIX_PARTICLES)
    told = hooke("modes", scene, "--count", 2).out
    assert "not at rest: a force of " in told and "zero-modes" in told and "rad/s" in told
    hooke("run", scene, "-o", "out.h5", "--step", "1e-3")
    first, last, start = (hooke("modes", scene, "--json", *at).json for at in (["--at", "out.h5:0"], ["--at", "out.h5"], []))
    assert first["time"] == 0 and last["time"] == 0.5
    assert [mode["omega"] for mode in first["modes"]] == [mode["omega"] for mode in start["modes"]]
    assert [mode["omega"] for mode in last["modes"]] != [mode["omega"] for mode in start["modes"]]
    assert "velocities" in [claim["key"] for claim in last["claims"]]
    assert hooke("modes", scene, "--step", "1e-3").code == 2  # no option of a run
    assert hooke("modes", scene, "--count", 0).code == 2 == hooke("modes", scene, "--at", "out.h5:x").code


def test_an_overdamped_scene_has_rates(hooke, write):
    chain = {"hooke": 1, "dynamics": "overdamped", "drag": 2, "particles": {"position": [[0, 0, 0], [1, 0, 0]], "pinned": [0]},
             "springs": [{"between": [[0, 1]], "stiffness": 12, "law": "length", "rest_length": 0.5}],
             "run": {"method": "cvode-bdf", "duration": 1}}
    found = hooke("modes", write(chain), "--json").json
    assert [mode["growth"] for mode in found["modes"]] == pytest.approx([-3, -3, -6])  # T/(r gamma), k/gamma
    assert [mode["omega"] for mode in found["modes"]] == [None] * 3


@needs_page
@needs_browser
def test_modes_play_on_the_page(hooke, write, tmp_path):
    hooke("modes", write(SIX_PARTICLES), "--report", tmp_path / "modes.html")
    page = (tmp_path / "modes.html").read_text()
    seen = browse(tmp_path, page, """document.querySelector('#mode [data-key="2"]').click();
        document.querySelector('#running [data-key="stop"]').click();
        const places = () => JSON.stringify(Chart.getChart("picture").data.datasets.find(({ role }) => role === "mode").data);
        looking.redraw(0); const still = places(); looking.redraw(1);
        document.getElementById("picture").dataset.moved = still !== places();""")
    assert seen.drawn("picture")["mode"] == 2 and seen.drawn("picture")["moved"] == "true"
    assert seen.drawn("picture")["outside"] == 0 and not seen.console and not fetches(page)
    assert seen.text["modes"].count("edges 100 %") == len(data_of(page)["modes"]) == 6
    assert json.dumps(data_of(page)["claims"])[3:40] and "Mode 2:" in seen.text["said"]
