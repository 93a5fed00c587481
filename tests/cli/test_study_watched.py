"""hooke study: watched quantities, and statistics of ensembles."""

import csv
import math

import h5py
import pytest

pytestmark = pytest.mark.everything

DOUBLE = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "particles": {"position": [[0, 0, 0], [1, 0.2, 0], [2, 0.5, 0.3]], "mass": 1, "pinned": [0]},
    "springs": [{"name": "rods", "between": [[0, 1], [1, 2]], "stiffness": 200}],
}
WATCH = ["2.y", "rods:1.tension", "energy", "period:1.x"]


def test_errors_of_watched_quantities(hooke, write, tmp_path):
    words = ["--duration", 8, "--every", 0.05, "--methods", "verlet,cvode-adams", "--watch", ",".join(WATCH)]
    scene = write(DOUBLE)
    answer = hooke("study", scene, *words, "--json", "-o", "rows.csv")
    assert (answer.code, answer.err) == (0, "")
    reference = answer.json["reference"]["watched"]
    assert [(item["quantity"], item["unit"]) for item in reference] == list(zip(WATCH, ["m", "N", "J", "s"]))
    assert all(0 < item["agreement"] < 1e-4 for item in reference)
    for row in answer.json["rows"]:
        assert [item["quantity"] for item in row["watched"]] == WATCH
        error = [item["error"] for item in row["watched"]]
        assert 0 < error[0] <= row["error_max"] and math.isclose(error[2], row["energy_drift"], abs_tol=1e-12)
    coarse, *_, fine = [row for row in answer.json["rows"] if row["method"] == "verlet"]
    assert all(10 * b["error"] < a["error"] for a, b in zip(coarse["watched"], fine["watched"]))
    assert answer.json["statistics"] is None
    with open(tmp_path / "rows.csv") as file:
        table = list(csv.DictReader(file))
    for row, line in zip(answer.json["rows"], table):
        assert [float(line[name]) for name in WATCH] == [item["error"] for item in row["watched"]]
    out = hooke("study", scene, *words, "--ensemble", 2).out
    assert "rods:1.tension [N]" in out and "errors are known over the whole run" in out


@pytest.mark.parametrize("watch, message", [("9.y", "particles 0 to 2"), ("rods:2.length", "springs 0 to 1"),
                                            ("poles:0.length", "allowed: rods"), ("speed", "nothing to watch")])  # fmt: skip
def test_what_cannot_be_watched(hooke, write, watch, message):
    answer = hooke("study", write(DOUBLE), "--duration", 1, "--watch", watch)
    assert answer.code == 3 and message in answer.err


def test_statistics_of_which_no_run_came_to_its_end(hooke, write):
    """A run takes longer than the budget."""
    words = ["--duration", 20000, "--every", 5, "--methods", "rk4", "--steps", "1ms", "--ensemble", 4, "--budget", "0.2s"]
    found = hooke("study", write(DOUBLE), *words, "--json").json["statistics"]
    assert found["from"] is None and found["until"] is None
    assert found["quantities"][0]["reference"]["mean"] is None
    out = hooke("study", write(DOUBLE), *words).out
    assert "none came to its end" in out and "nan" not in out


@pytest.mark.check
def test_statistics_of_chaos(hooke, write, tmp_path):
    words = ["--duration", 40, "--every", 0.1, "--methods", "rk4,backward-euler", "--steps", "2ms", "--watch", "2.y"]
    scene = write(DOUBLE)
    answer = hooke("study", scene, *words, "--ensemble", 6, "--json", "-o", "study.h5", "--report", "page.html")
    assert (answer.code, answer.err) == (0, "")
    found = answer.json["statistics"]
    trusted = answer.json["reference"]["trusted_until"]
    assert 5 < trusted < found["from"] <= trusted + 0.11 and found["until"] == 40 and found["members"] == 6
    assert [item["quantity"] for item in found["quantities"]] == ["kinetic", "potential", "energy", "2.y"]
    for item in found["quantities"]:
        assert item["reference"]["members"] == 6 and item["reference"]["bias"] is None
        assert set(item["methods"]) == {"rk4", "backward-euler"}
        assert item["methods"]["rk4"]["step"] == 2e-3 and abs(item["methods"]["rk4"]["bias"]) < 6
    assert found["quantities"][2]["methods"]["backward-euler"]["bias"] < -5, "it loses energy"
    with h5py.File(tmp_path / "study.h5") as file:
        group = file["study/statistics"]
        assert group["method"][:].tolist() == [b"reference", b"rk4", b"backward-euler"]
        assert group["mean"][1, 3] == found["quantities"][3]["methods"]["rk4"]["mean"]
        assert file["study/watched/error"].shape == (2, 1)
    page = (tmp_path / "page.html").read_text()
    assert '"statistics":{"members":6,"from":' in page and '"watched":[{"quantity":"2.y","unit":"m"' in page
    out = hooke("study", scene, *words, "--ensemble", 2).out
    assert "of 2 runs of each method" in " ".join(out.split()) and "standard errors" in out
    assert "--ensemble 16" in hooke("study", scene, *words).out
