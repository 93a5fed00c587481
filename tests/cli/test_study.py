"""hooke study: its reference against the truth, keys, ladders, recommendation, table, CSV, and interruptions."""

import csv
import json
import math
import shlex
import time
from pathlib import Path

import pytest
from conftest import ENDLESS, SIX_PARTICLES, STIFF_PAIR, interrupt

pytestmark = pytest.mark.everything

TOP = ["scene", "duration", "frames", "budget_spent", "reference", "rows", "orders", "recommendation", "statistics", "wants",
       "claims"]  # fmt: skip
ROW = ["method", "step", "rtol", "error", "error_max", "error_final", "energy_drift", "force_evaluations", "steps",
       "wall_seconds", "status"]  # fmt: skip
RECOMMENDATION = ["want", "method", "step", "rtol", "error", "wall_seconds", "command"]
FEW = ["--methods", "symplectic-euler,rk4,cvode-adams"]


def rows_of(value, method):
    return [row for row in value["rows"] if row["method"] == method]


def begins_with(value, keys):
    return list(value)[: len(keys)] == keys


def test_json_has_the_keys(hooke, write):
    scene = write(SIX_PARTICLES)
    answer = hooke("study", scene, "--duration", 1, "--points", 6, "--json", "--want", "1mm")
    assert (answer.code, answer.err) == (0, "")
    value = answer.json
    assert begins_with(value, TOP)
    assert (value["scene"], value["duration"]) == (scene, 1)
    assert begins_with(value["reference"], ["methods", "agreement", "trusted_until"])
    first, second = value["reference"]["methods"]
    assert first.startswith("cvode-") and second in ("rk8pd", "arkode-esdirk")
    assert 0 < value["reference"]["agreement"] < 1e-7
    assert value["reference"]["trusted_until"] == 1
    assert 0.1 < value["reference"]["growth_seen"] <= value["reference"]["growth"] < 1e4
    assert 0 <= value["reference"]["energy_agreement"] < 1e-6
    assert set(RECOMMENDATION) <= set(value["recommendation"])
    margin = value["recommendation"]["margin"]
    assert 0 < margin["error_low"] <= value["recommendation"]["error"] <= margin["error_high"] <= 1e-3
    for change in ["stiffness", "start"]:
        held, error = margin["holds_" + change], margin["error_" + change]
        assert held is None or error is None or held == (error <= 1e-3), change

    methods = list(dict.fromkeys(row["method"] for row in value["rows"]))
    assert {"forward-euler", "symplectic-euler", "cvode-bdf", "cvode-adams"} <= set(methods)
    for method in methods:
        rows = rows_of(value, method)
        assert len(rows) >= 6, method
        assert all(begins_with(row, ROW) and row["repeats"] > 0 for row in rows)
        adaptive = rows[0]["step"] is None
        ladder = [row["rtol" if adaptive else "step"] for row in rows]
        assert ladder == sorted(ladder, reverse=True) and all(row["step" if adaptive else "rtol"] is None for row in rows)
        finished = [row for row in rows if row["status"] == "finished"]
        assert finished[0]["error"] > 10 * finished[-1]["error"] > 0, "finer is not more accurate"
        assert finished[0]["steps"] < finished[-1]["steps"]
        for row in finished:
            assert 0 <= row["error_final"] <= row["error"] < row["error_max"]
            assert 0 < row["wall_seconds"] < 10
        assert (method in value["orders"]) == (not adaptive)
    for method, order in value["orders"].items():
        assert begins_with(order, ["order", "low", "high"])
        assert order["low"] <= order["order"] <= order["high"]
        assert order["theory"] - 0.15 < order["order"] < order["theory"] + 0.25, method


def test_csv_reads_back_to_the_same_bits(hooke, write, tmp_path):
    (tmp_path / "rows.csv").write_text("of old")
    answer = hooke("study", write(SIX_PARTICLES), "--json", "-o", "rows.csv", *FEW)
    assert answer.code == 0
    with open(tmp_path / "rows.csv") as file:
        table = list(csv.DictReader(file))
    rows = answer.json["rows"]
    assert len(table) == len(rows) >= 18
    for line, row in zip(table, rows):
        for key, value in row.items():
            if value is None:
                assert line[key] == ""
            elif isinstance(value, str):
                assert line[key] == value
            else:
                assert float(line[key]) == value, key
        assert float(line["wall_median"]) >= float(line["wall_seconds"]) and int(line["repeats"]) >= 1
        near = row["error"] is not None and row["error"] <= 10 * answer.json["reference"]["agreement"]
        assert line["near_floor"] == str(int(near))
        floor = 10 * answer.json["reference"]["energy_agreement"]
        assert line["near_energy_floor"] == str(int(row["energy_drift"] is not None and row["energy_drift"] <= floor))
    assert [path.name for path in tmp_path.iterdir() if path.name.startswith("rows")] == ["rows.csv"]


def test_recommended_command_gives_the_error_that_was_promised(hooke, write, tmp_path):
    scene = write(SIX_PARTICLES, name="a scene.json", duration=2, every=0.05, atol_velocity=1e-5)
    tight = ["--method", "cvode-adams", "--rtol", "1e-11", "--atol", "1e-13", "--duration", "1s", "--final", "--json"]
    right = hooke("run", scene, *tight).json["final"]["position"]
    for methods in ["verlet", "cvode-adams"]:
        value = hooke("study", scene, "--json", "--duration", "1000ms", "--want", "0.2 mm", "--methods", methods).json
        found = value["recommendation"]
        assert found["met"] is True and found["note"] == "" and found["want"] == 2e-4
        assert found["method"] == methods and 0 < found["error"] <= 2e-4
        words = shlex.split(found["command"])
        assert words[:3] == ["hooke", "run", scene] and "--duration" in words
        assert all(option not in words for option in ["--want", "--methods", "--json"])
        run = hooke(*words[1:], "--json", "--final").json
        assert run["time"] == 1 and run["method"] == methods
        assert run.get("step") == found["step"] and run.get("rtol") == found["rtol"]
        squares = [math.dist(*pair) ** 2 for pair in zip(run["final"]["position"][:5], right)]  # the last is pinned
        assert 0.01 * found["error"] < math.sqrt(sum(squares) / 5) < 1.05 * found["error"]
        assert run["force_evaluations"] == found["force_evaluations"]


EXAMPLES = Path(__file__).resolve().parents[2] / "examples/scenes"
PAIRS = [
    ("six-particles", 1, "symplectic-euler", 1e-2),
    ("six-particles", 1, "rk4", 1e-6),
    pytest.param("rope", 1, "symplectic-euler,rk4", 1e-2, marks=pytest.mark.check),
    ("oscillator", 5, "cvode-adams", 2e-2),
]


@pytest.mark.parametrize("name, duration, methods, want", PAIRS)
def test_a_ladder_four_times_as_fine_has_nothing_much_cheaper(hooke, name, duration, methods, want):
    scene = EXAMPLES / f"{name}.json"
    every = json.loads(scene.read_text())["run"]["every"]
    words = ["study", scene, "--duration", duration, "--json", "--methods"]
    found = hooke(*words, methods, "--want", want).json["recommendation"]
    assert found["met"] is True and 0.01 * want < found["error"] <= want
    if found["step"]:
        parts = sorted({round(2 ** (k / 4)) for k in range(48)})
        ladder = ["--steps", ",".join(repr(every / m) for m in parts if every / m > found["step"] / 3)]
    else:
        ladder = ["--tolerances", ",".join(repr(0.1 * 10 ** (-k / 4)) for k in range(20))]
    finer = hooke(*words, found["method"], *ladder).json
    fits = [row["force_evaluations"] for row in finer["rows"] if row["error"] is not None and row["error_max"] <= want]
    assert len(fits) >= 3
    assert 0.5 * min(fits) <= found["force_evaluations"] <= 1.3 * min(fits)


def test_numbers_of_no_run_are_null(hooke, write):
    """Forward Euler diverges at every step on an undamped spring: nothing comes close, and nothing is claimed to."""
    words = ["study", write(STIFF_PAIR, duration=5, every=0.25), "--methods", "forward-euler", "--steps", "250ms"]
    value = hooke(*words, "--want", "1mm", "--json").json
    assert [row["status"] for row in value["rows"]] == ["diverged"]
    found = value["recommendation"]
    assert found["met"] is False and found["want"] == 1e-3
    for key in ["method", "step", "rtol", "atol", "error", "wall_seconds", "force_evaluations", "command"]:
        assert found[key] is None, key
    assert "no run finished" in found["note"] and "forward-euler diverged" in found["note"]
    answer = hooke(*words, "--want", "1mm")
    assert answer.code == 7 and "no run finished" in answer.out and "closest  " not in answer.out
    assert "nan" not in answer.out


def test_a_recommendation_looks_beyond_the_ladder(hooke, write):
    """Coarser than its first row, and finer than one that diverges."""
    scene = write(STIFF_PAIR, duration=10, every=0.25)
    words = ["study", scene, "--methods", "symplectic-euler", "--json", "--want"]
    found = hooke(*words, "5cm", "--steps", "1ms,0.5ms").json["recommendation"]
    assert found["met"] is True and 1.5e-3 < found["step"] <= 0.0625 and found["error"] <= 0.05
    found = hooke(*words, "5cm", "--steps", "250ms").json["recommendation"]
    assert found["met"] is True and 1.5e-3 < found["step"] <= 0.0625 and 0.005 < found["error"] <= 0.05


def test_what_cannot_be_had_is_said(hooke, write):
    scene = write(SIX_PARTICLES)
    words = ["study", scene, "--methods", "forward-euler", "--want", "1um"]
    found = hooke(*words, "--json").json["recommendation"]
    assert found["met"] is False and found["command"] is None and found["note"]
    assert found["error"] > 1e-6
    answer = hooke(*words)
    assert answer.code == 7
    claims = {claim["key"]: claim["text"] for claim in hooke(*words, "--json").json["claims"]}
    assert claims["recommendation"].startswith("no run is recommended for an error of at most 1e-06 m: ")
    assert claims["closest"].startswith(f"the closest is forward-euler in steps of {found['step']:.6g} s: its error is {found['error']:.3g} m")
    assert hooke("study", scene, *FEW, "--json").json["recommendation"] is None


def test_ladders_of_ones_own(hooke, write):
    scene = write(SIX_PARTICLES)
    value = hooke("study", scene, *FEW, "--steps", "5ms, 1ms,0.5 ms", "--tolerances", "1e-4,1e-7", "--json").json
    assert [row["step"] for row in rows_of(value, "rk4")] == [5e-3, 1e-3, 5e-4]
    assert [row["rtol"] for row in rows_of(value, "cvode-adams")] == [1e-4, 1e-7]
    value = hooke("study", scene, *FEW, "--points", 8, "--json").json
    assert len(rows_of(value, "cvode-adams")) == 8


def test_table_marks_what_cannot_be_told_apart_and_what_diverged(hooke, write):
    scene = write(STIFF_PAIR, duration=4, every=0.25)
    words = ["study", scene, "--methods", "rk4", "--steps", "250ms,10ms,0.05ms"]
    answer, value = hooke(*words), hooke(*words, "--json").json
    assert (answer.code, answer.err) == (0, "")
    assert [row["status"] for row in value["rows"]] == ["diverged", "finished", "finished"]
    assert value["rows"][0]["error"] is None
    assert value["rows"][2]["error"] < 10 * value["reference"]["agreement"] < value["rows"][1]["error"]
    lines = [line for line in answer.out.splitlines() if line.startswith("rk4") and "theory" not in line][:3]
    assert lines[0].endswith("diverged") and "*" not in lines[0]
    assert "*" not in lines[1] and "*" in lines[2]
    for word in ["reference", "floor", "growth", "[m]", "[J]", "wall time", "order", "--want"]:
        assert word in answer.out, word
    assert max(map(len, answer.out.splitlines())) <= 140


# Four masses on undamped springs, thrown: a small displacement grows more than ten thousandfold in 15 s.
CHAIN = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "particles": {
        "position": [[0, 0, 0], [0.3, 0, 0], [0.6, 0.1, 0], [0.9, 0.1, 0.1], [1.2, 0.3, 0]],
        "mass": 1,
        "pinned": [0],
    },
    "springs": [{"between": [[0, 1], [1, 2], [2, 3], [3, 4]], "stiffness": 300}],
    "run": {"duration": 15, "every": 0.1},
}


@pytest.mark.check
def test_chaos_is_called_so_and_what_is_known_for_a_part_of_the_run_is_not_met(hooke, write):
    words = ["study", write(CHAIN), "--methods", "cvode-adams", "--tolerances", "1e-6,1e-8", "--want", "1mm"]
    answer = hooke(*words, "--json")
    found, reference = answer.json["recommendation"], answer.json["reference"]
    assert 1 < reference["trusted_until"] < 12 and answer.code == 7
    assert reference["growth_seen"] > 1e4 and reference["growth"] is None and reference["ended"] == "rounding"
    assert found["met"] is None and found["error"] <= 1e-3 and found["command"]
    answer = hooke(*words)
    until = f"{reference['trusted_until']:.6g} s"
    claims = {claim["key"]: claim for claim in hooke(*words, "--json").json["claims"]}
    assert claims["recommendation"]["of"] == claims["reference"]["of"] == claims["margin"]["of"] == "part"
    text = claims["recommendation"]["text"]
    assert f"at most 0.001 m up to {found['until']:.6g} s is " in text and text.endswith("of what comes later nothing is known")
    assert f"known up to {until} of 15 s: this motion is chaotic" in claims["reference"]["text"]
    assert answer.code == 7 and "this motion is chaotic" in " ".join(answer.out.split())
    late = [*words, "--duration", "20", "--every", "20"]  # nothing but the start is trusted
    answer = hooke(*late, "--json")
    value = answer.json
    assert answer.code == 7 and value["reference"]["trusted_until"] == 0
    assert value["recommendation"]["method"] is None and value["recommendation"]["met"] is None
    assert "no error is known" in hooke(*late).out
    calm = hooke("study", write(SIX_PARTICLES), *FEW).out
    assert "chaotic" not in calm and "errors are known over the whole run" in calm


def test_budget_that_is_spent_is_said(hooke, write):
    scene = write(SIX_PARTICLES)
    words = ["study", scene, "--steps", "1ms,1ns", "--methods", "verlet", "--duration", "1s", "--budget", "2s"]
    value = hooke(*words, "--json").json
    assert value["budget_spent"] is True
    assert [row["step"] for row in value["rows"]] == [1e-3]
    assert "the budget is spent" in hooke(*words).out


# 64 particles so stiffly damped that the second integrator needs minutes, with a frame every few of its steps.
DAMPED_CLOTH = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "parts": [
        {
            "kind": "cloth",
            "origin": [0, 0, 0],
            "edges": [[1, 0, 0], [0, -0.8, 0.6]],
            "size": [8, 8],
            "mass": 0.2,
            "pinned": "top",
            "structural": {"stiffness": 1e5, "damping": 200},
            "shear": {"stiffness": 1e5, "damping": 200},
            "bend": {"stiffness": 1e5, "damping": 200},
        }
    ],
    "run": {"duration": 1, "every": 5e-4},
}


@pytest.mark.check
def test_reference_keeps_to_its_share_of_the_budget(hooke, write):
    """Its result is used, and reported as a part."""
    scene = write(DAMPED_CLOTH, duration=10)
    words = ["study", scene, "--methods", "backward-euler", "--budget", "6s", "--want", "1cm"]
    begun = time.monotonic()
    answer = hooke(*words, "--json")
    value = answer.json
    assert answer.code == (0 if value["recommendation"]["met"] else 7) and time.monotonic() - begun < 30
    assert value["budget_spent"] is True and 0 < value["reference"]["trusted_until"] < 10
    assert value["reference"]["ended"] == "time"
    assert 0 < value["reference"]["agreement"] < 1e-3
    assert value["reference"]["growth"] is None or value["reference"]["growth"] > 0
    out = " ".join(hooke(*words).out.split())
    assert "there was no time to check the reference beyond that" in out and "the budget is spent" in out
    assert "chaotic" not in out and "the whole run" not in out


def test_a_budget_too_small_for_any_reference(hooke, write):
    words = ["study", write(DAMPED_CLOTH, duration=100, every=100), "--budget", "1us"]
    answer = hooke(*words, "--json")
    assert answer.code == 3 and answer.json["error"]["exit"] == 3
    for word in ["budget", "is too small", "larger budget", "shorter duration"]:
        assert word in answer.json["error"]["message"] and word in answer.err, word
    assert hooke(*words).out == ""


@pytest.mark.check
def test_ctrl_c_while_the_reference_is_checked(start, write):
    """The first integrator takes a second or two, the second many times as long."""
    process = start("study", write(DAMPED_CLOTH, duration=4), "--json")
    time.sleep(6)
    begun = time.monotonic()
    value = interrupted(process, 0)
    assert time.monotonic() - begun < 10
    assert value["rows"] == [] and value["reference"]["agreement"] is None


@pytest.mark.parametrize(
    "words, code, wanted",
    [
        (["--want", "1parsec"], 2, "allowed: m, km, cm, mm, um, nm, angstrom, in, ft"),
        (["--want", "1s"], 2, "no unit 's'"),
        (["--want", "0mm"], 2, "> 0"),
        (["--want", "mm"], 2, "a number > 0 [m]"),
        (["--budget", "5m"], 2, "allowed: s, ms, us, ns, ps, fs, min, h"),
        (["--points", "5"], 2, ">= 6"),
        (["--methods", "rk5"], 2, "did you mean rk4?"),
        (["--methods", "rk4,rk4"], 2, "named twice"),
        (["--methods", "verlet,velocity-verlet"], 2, "verlet is named twice"),
        (["--methods", "euler"], 2, "did you mean one of forward-euler, symplectic-euler, backward-euler?"),
        (["--methods", "rk8pd"], 2, "no method 'rk8pd'; methods: "),
        (["--tolerances", "1e-3;1e-4"], 2, "--tolerances"),
        (["--steps", "1ms,2ms"], 3, "steps[1]"),
        (["--rtol", "1e-3"], 2, "no option --rtol"),
        (["-o", "study.hdf5"], 2, ".h5"),
        (["-o", "rows.CSV"], 2, ".csv"),
        (["-o", "no/such/folder/rows.csv"], 5, "no/such/folder"),
    ],
)
def test_wrong_usage(hooke, write, words, code, wanted):
    answer = hooke("study", write(SIX_PARTICLES), *words)
    assert answer.code == code
    assert wanted in answer.err and answer.out == ""


def test_a_scene_needs_a_duration_but_no_step(hooke, write):
    answer = hooke("study", write(SIX_PARTICLES, duration=None))
    assert answer.code == 2 and "no duration" in answer.err
    assert hooke("study", write(SIX_PARTICLES, step=None), *FEW).code == 0


def interrupted(process, after):
    interrupt(process, after)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130 and b"interrupted" in err
    return json.loads(out)


def test_ctrl_c_is_130_and_tells_the_rows_done(start, write, tmp_path):
    """The first of the two steps is quick, the second takes half an hour."""
    words = ["--methods", "symplectic-euler", "--steps", "10ms,1ns", "--duration", "2s", "--json", "-o", "rows.csv"]
    value = interrupted(start("study", write(SIX_PARTICLES), *words), 0.3)
    assert [row["status"] for row in value["rows"]] == ["finished", "stopped"]
    assert value["rows"][0]["error"] > 0 and value["rows"][1]["error"] is None
    assert value["recommendation"] is None
    assert len((tmp_path / "rows.csv").read_text().splitlines()) == 3


def test_ctrl_c_before_the_first_row(start, write, tmp_path):
    (tmp_path / "rows.csv").write_text("of old")
    value = interrupted(start("study", write(ENDLESS), "--json", "-o", "rows.csv"), 0.1)
    assert value["rows"] == [] and value["reference"]["agreement"] is None
    assert (tmp_path / "rows.csv").read_text() == "of old"
