"""hooke compare: rows, table, file, and rows that diverge."""

import json
import time

import h5py
import pytest
from conftest import ENDLESS, METHODS, SIX_PARTICLES, STIFF_PAIR, interrupt
from test_study_watched import DOUBLE

pytestmark = pytest.mark.everything

ROW = ["method", "step", "rtol", "error", "error_max", "error_final", "energy_drift", "force_evaluations", "steps",
       "wall_seconds", "status", "atol", "linear_iterations", "wall_median", "repeats", "near_floor", "near_energy_floor",
       "error_step", "timed_alone"]


def rows_of(value):
    return {row["method"]: row for row in value["rows"]}


def test_json_has_exactly_the_keys(hooke, write):
    scene = write(SIX_PARTICLES)
    answer = hooke("compare", scene, "--json")
    assert (answer.code, answer.err) == (0, "")
    value = answer.json
    assert set(value) == {"scene", "duration", "frames", "reference", "rows", "orders", "recommendation", "statistics",
                          "budget_spent", "wants", "claims"}
    assert (value["scene"], value["duration"], value["frames"]) == (scene, 0.5, 11)
    assert value["recommendation"] is value["statistics"] is None and value["reference"]["growth_seen"] is None
    assert value["reference"]["ended"] == "agreed"
    assert len(set(value["reference"]["methods"])) == 2
    assert 0 < value["reference"]["agreement"] < 1e-8 and value["reference"]["trusted_until"] == 0.5
    assert value["reference"]["methods"][0].startswith("cvode-")
    assert [row["method"] for row in value["rows"]] == METHODS
    for row in value["rows"]:
        assert list(row) == ROW
        assert row["status"] == "finished" and row["repeats"] == 1 and row["wall_median"] == row["wall_seconds"]
        assert isinstance(row["steps"], int) and isinstance(row["force_evaluations"], int)
        assert 0 < row["wall_seconds"] < 60
        fixed = not row["method"].startswith("cvode-")
        assert (row["step"], row["rtol"]) == ((1e-3, None) if fixed else (None, 1e-6))


def test_no_step_is_needed_without_a_method_that_takes_one(hooke, write):
    scene = write(SIX_PARTICLES, step=None)
    assert hooke("compare", scene, "--methods", "cvode-bdf").code == 0
    hooke("compare", scene, code=2, err="no step")
    assert hooke("compare", write(SIX_PARTICLES, duration=None)).code == 2


def test_a_row_that_diverges_stays_as_a_row(hooke, write):
    scene = write(STIFF_PAIR, duration=50)
    answer = hooke("compare", scene, "--json")
    assert (answer.code, answer.err) == (0, "")
    rows = rows_of(answer.json)
    for euler in METHODS[:2]:
        assert rows[euler]["status"] == "diverged"
        assert rows[euler]["error"] is None
    for cvode in METHODS[-2:]:
        assert rows[cvode]["status"] == "finished"
        assert rows[cvode]["error"] > 0
    words = hooke("compare", scene)
    assert words.code == 0
    for line in words.out.splitlines():
        if line.startswith("forward-euler") and "e+" not in line:
            assert "diverged" in line or "-" in line.split()


def test_an_overdamped_scene_is_compared_by_the_methods_that_suit_it(hooke, write):
    springs = [{"between": [[0, 1]], "law": "length", "rest_length": 1, "stiffness": 10}]
    particles = {"position": [[0, 0, 0], [1.5, 0, 0]], "mass": [1, 1], "pinned": [0]}
    scene = write({"hooke": 1, "dynamics": "overdamped", "drag": 2, "particles": particles, "springs": springs,
                   "run": {"step": 1e-2, "duration": 1}})  # fmt: skip
    answer = hooke("compare", scene, "--json")
    assert answer.code == 0, answer.err
    methods = list(rows_of(answer.json))
    assert "forward-euler" in methods and "cvode-bdf" in methods and "symplectic-euler" not in methods
    hooke("compare", scene, "--methods", "symplectic-euler", code=3, err="overdamped")


def test_a_motion_that_nobody_knows_to_the_end(hooke, write):
    """Of a double pendulum: the first look ends where its two runs part, and says that it does not know why."""
    scene = write(DOUBLE, duration=60, every=0.5, step=2e-3)
    value = hooke("compare", scene, "--methods", "rk4", "--json").json
    until = value["reference"]["trusted_until"]
    assert 5 < until < 55 and value["reference"]["ended"] == "parted"
    assert value["rows"][0]["status"] == "finished" and 0 < value["rows"][0]["error"] < 3
    words = hooke("compare", scene, "--methods", "rk4").out
    told = " ".join(words.split())
    assert f"errors and energy drift are known up to {until:g} s of 60 s: its two runs part after that" in told
    assert "chaotic" not in words
    assert "--ensemble" not in words and "--want 1mm" in words
    head = next(line for line in words.splitlines() if line.startswith("at t [s]"))
    assert float(head.split()[-1]) == until


@pytest.mark.parametrize("option", ["--want=1mm", "--steps=1ms", "--points=6", "--budget=1s", "--once"])
def test_options_of_a_ladder_are_not_taken(hooke, write, option):
    hooke("compare", write(SIX_PARTICLES), option, code=2, err="there is no option")


def test_watched_quantities(hooke, write):
    value = hooke("compare", write(SIX_PARTICLES), "--methods", "rk4,verlet", "--watch", "3.y,energy", "--json").json
    assert [watched["quantity"] for watched in value["reference"]["watched"]] == ["3.y", "energy"]
    errors = {row["method"]: row["watched"][0]["error"] for row in value["rows"]}
    assert 0 < errors["rk4"] < 1e-3 * errors["verlet"]


def test_table_shows_error_over_time_and_the_cost(hooke, write):
    scene = write(SIX_PARTICLES)
    answer = hooke("compare", scene)
    assert (answer.code, answer.err) == (0, "")
    rows = rows_of(hooke("compare", scene, "--json").json)
    assert answer.out.splitlines()[1] == "reference       errors are known over the whole run, 0.5 s"
    for word in ["[m]", "[J]", "[s]", "force", "wall time"]:
        assert word in answer.out, word
    head = next(line for line in answer.out.splitlines() if line.startswith("at t [s]"))
    assert [float(word) for word in head.split()[-5:]] == [0.1, 0.2, 0.3, 0.4, 0.5]
    for method, row in rows.items():
        over_time, cost = [line.replace("*", " ").split() for line in answer.out.splitlines() if line.startswith(method)]
        assert float(over_time[-1]) == pytest.approx(row["error_final"], rel=1e-3)
        assert len(over_time) == 6
        assert str(row["force_evaluations"]) in cost and cost[-1] == "finished"
    assert max(map(len, answer.out.splitlines())) <= 140


def test_file_holds_everything(hooke, write, tmp_path):
    answer = hooke("compare", write(SIX_PARTICLES), "--json", "-o", "out.h5")
    assert answer.code == 0
    with h5py.File(tmp_path / "out.h5") as file:
        for name in ["all", *METHODS]:
            assert file[f"/particles/{name}/position/value"].shape == (11, 6, 3), name
        assert file["study/error"][:].tolist() == [row["error"] for row in answer.json["rows"]]
        assert file["hooke/status"][()] == b"finished"
        reference = file["/particles/all/position/value"][:]
        for row in answer.json["rows"]:
            moved = file[f"/particles/{row['method']}/position/value"][:, :5] - reference[:, :5]
            error = max((frame**2).sum() / 5 for frame in moved) ** 0.5
            assert row["error"] == pytest.approx(error, rel=1e-12)


def test_a_table_and_a_page(hooke, write, tmp_path):
    assert hooke("compare", write(SIX_PARTICLES), "-o", "out.csv", "--report", "page.html", "--quiet").code == 0
    lines = (tmp_path / "out.csv").read_text().splitlines()
    assert lines[0].startswith("method,step,rtol,error,") and [line.split(",")[0] for line in lines[1:]] == METHODS
    assert '"ended":"agreed"' in (tmp_path / "page.html").read_text()


@pytest.mark.parametrize("output, code", [("no/such/folder/out.h5", 5), ("scene.json", 2)])
def test_output_that_cannot_be_written(hooke, write, output, code):
    hooke("compare", write(SIX_PARTICLES), "-o", output, code=code, err=output, out="")


@pytest.mark.check
def test_ctrl_c_is_130_and_keeps_the_rows(start, write, tmp_path):
    """Nothing replaces an older file before there is a row."""
    (tmp_path / "out.h5").write_text("precious")
    process = start("compare", write(ENDLESS, every=1e4), "--json", "-o", "out.h5")
    interrupt(process, 2)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert out.startswith(b"{") and b"interrupted; kept: the 0 rows" in err
    assert (tmp_path / "out.h5").read_text() == "precious"


@pytest.mark.check
def test_ctrl_c_while_motions_are_made(start, write, tmp_path):
    """The results are printed, and an older file stays."""
    (tmp_path / "out.h5").write_text("precious")
    words = ["--methods", "verlet", "--duration", "20", "--every", "1", "--step", "5e-6", "--json", "-o", "out.h5"]
    process = start("compare", write(SIX_PARTICLES), *words)
    while not list(tmp_path.glob("*.part")):
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    interrupt(process)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130 and b"interrupted; nothing is written" in err
    assert json.loads(out)["rows"][0]["status"] == "finished"
    assert (tmp_path / "out.h5").read_text() == "precious" and not list(tmp_path.glob("*.part"))
