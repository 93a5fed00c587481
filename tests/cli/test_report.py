"""hooke study --report: the page in a headless browser, its drawings, its words, and no fault in the console."""

import copy
import json
import subprocess

import pytest
from conftest import CLI, STIFF_PAIR
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

METHODS = ["forward-euler", "symplectic-euler", "rk4", "cvode-adams"]
# Symplectic Euler diverges at 0.1, and rk4 reaches the floor of the reference.
STEPS = "0.1,0.05,0.02,0.01,0.005,1e-5"

DIAGRAMS = ["work-precision", "convergence", "error-over-time", "energy-over-time"]
# What is drawn for a row, at its place.
PLACES = """
for (const id of ["work-precision", "convergence"]) {
  const points = Chart.getChart(id).data.datasets.flatMap((set) => set.data.filter((point) => point && point.row && point.row.error !== null));
  document.getElementById(id).dataset.places = JSON.stringify(points.map(({ x, y, row }) => [row.method, row.step, row.rtol, x, y]));
}
"""
PRESS = """document.querySelector('[data-key="force_evaluations"]').click();"""


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    """The page of a study as text, with the same study as JSON."""
    folder = tmp_path_factory.mktemp("study")
    scene = copy.deepcopy(STIFF_PAIR)
    scene["title"] = TITLE
    scene["run"].update(duration=2, every=0.1)
    (folder / "scene.json").write_text(json.dumps(scene))
    command = [CLI, "study", "scene.json", "--methods", ",".join(METHODS), "--steps", STEPS, "--want", "0.01",
               "--watch", "1.x,energy", "--report", "page.html", "--json"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240)
    assert (done.returncode, done.stderr) == (0, "")
    return (folder / "page.html").read_text(encoding="utf-8"), json.loads(done.stdout)


def rows_with(value, **wanted):
    return [row for row in value["rows"] if all(row[key] == want for key, want in wanted.items())]


@needs_page
def test_numbers_are_those_of_the_answer(study):
    data, value = data_of(study[0]), study[1]
    curves = {"error_max_at": "error_max", "energy_drift_at": "energy_drift"}
    # a title there, the file here
    answer = value | {"scene": data["scene"], "command": value["recommendation"]["command"]}
    assert check_same(data, answer) == ABOUT - {"scene"} | {"time", "curves"}
    for row, drawn in zip(data["rows"], data["curves"]):
        for curve, largest in curves.items():
            assert len(drawn[curve]) == len(data["time"]) == value["frames"]
            assert row[largest] is None or max(drawn[curve]) == row[largest]


@needs_page
@needs_browser
def test_what_is_drawn(study, tmp_path):
    page, value = study
    seen = browse(tmp_path, page, PLACES + count_pixels(DIAGRAMS))
    assert seen.console == []
    diverged = rows_with(value, status="diverged")
    near = [row for row in value["rows"] if row["error"] is not None and
            row["error"] <= 10 * value["reference"]["agreement"]]
    assert diverged and near, "the scene should show both"

    costs = seen.drawn("work-precision")
    assert costs["across"] == "wall time [s]"
    assert (costs["lines"], costs["points"]) == (len(METHODS), len(value["rows"]))
    assert (costs["crosses"], costs["hollow"], costs["outside"]) == (len(diverged), len(near), 0)

    steps = seen.drawn("convergence")
    fixed = [row for row in value["rows"] if row["step"] is not None]
    orders = [order for order in value["orders"].values() if order["order"] is not None]
    assert (steps["lines"], steps["points"], steps["outside"]) == (3, len(fixed), 0)
    assert steps["crosses"] == len([row for row in diverged if row["step"] is not None])
    assert steps["slopes"] == len(orders) > 0

    for name, across in {"work-precision": "wall_seconds", "convergence": "step"}.items():
        places = {tuple(place) for place in json.loads(seen.drawn(name)["places"])}
        rows = [row for row in value["rows"] if row["error"] is not None and row[across] is not None]
        rows += [value["recommendation"]] * (name == "work-precision")
        assert places == {(row["method"], row["step"], row["rtol"], row[across], row["error"]) for row in rows}

    for name in ("error-over-time", "energy-over-time"):
        times = seen.drawn(name)
        assert (times["lines"], times["outside"]) == (len(METHODS), 0)
        assert times["points"] == 20 * len(METHODS)  # all frames but the first, where all are 0
    for name, count in {"work-precision": 4, "convergence": 3, "error-over-time": 4, "energy-over-time": 4}.items():
        pixels = [int(n) for n in seen.drawn(name)["pixels"].split()]
        assert min(pixels[:count]) > 100, f"{name}: {pixels} pixels of the methods' colours"


@needs_page
@needs_browser
def test_cost_can_be_switched(study, tmp_path):
    page, value = study
    seen = browse(tmp_path, page, PRESS)
    costs = seen.drawn("work-precision")
    assert seen.console == []
    assert costs["across"] == "force evaluations"
    assert (costs["lines"], costs["points"], costs["outside"]) == (len(METHODS), len(value["rows"]), 0)


@needs_page
@needs_browser
def test_words(study, tmp_path):
    page, value = study
    seen = browse(tmp_path, page)
    assert seen.text["scene"] == TITLE
    chosen = value["recommendation"]
    assert seen.text["claims"].strip() == "".join(claim["text"] for claim in value["claims"]) + chosen["command"]
    for name in value["reference"]["methods"]:
        assert name in seen.text["about"]
    assert VERSION.split()[1] in seen.text["machine"]
    for row in value["rows"]:
        assert seen.text["rows"].count(row["method"]) == len(rows_with(value, method=row["method"]))
    assert seen.text["rows"].count("diverged") == len(rows_with(value, status="diverged"))


@needs_page
@needs_browser
def test_sealed(study, tmp_path):
    assert fetches(study[0]) == []
    check_planted_faults(tmp_path, study[0])
