"""hooke check: the numbers of a scene, its step limits and its warnings."""

import copy
import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import CLI, METHODS, SIX_PARTICLES, STIFF_PAIR

pytestmark = pytest.mark.everything

KEYS = ["particles", "free", "springs", "triples", "tetrahedra", "bodies", "inside_bodies", "dropped_springs", "idle_particles"]
KEYS += ["memory_bytes", "memory_bytes_output", "memory_bytes_factor", "bytes_per_particle", "bytes_per_spring"]
KEYS += ["groups", "bending_groups", "altitude_groups", "derived", "forces", "step_limit", "warnings", "claims"]
COST_KEYS = ["method", "step", "nanoseconds", "resolution", "memory_bytes", "step_limit", "dropped_springs"]
COST_KEYS += ["idle_particles", "rows", "claims"]
ROW_KEYS = ["ingredient", "kind", "group", "springs", "nanoseconds", "resolution", "memory_bytes", "step_limit_without"]


def test_json_has_exactly_the_keys(hooke, write):
    answer = hooke("check", write(SIX_PARTICLES), "--json")
    assert (answer.code, answer.err) == (0, "")
    value = answer.json
    assert list(value) == KEYS
    assert value["particles"] == 6 and value["springs"] == 7
    assert value["groups"] == [{"name": "edges", "springs": 7}]
    assert value["forces"] == ["springs", "gravity"]
    assert list(value["step_limit"]) == METHODS and value["free"] == 5
    assert [(claim["key"], claim["of"]) for claim in value["claims"]] == [("memory", "whole"), ("cost", "whole")]
    assert list(hooke("check", write(SIX_PARTICLES), "--json", "--cost", "--predict").json) == [*KEYS, "cost"]
    # --predict skips the timing, so there is none
    assert list(hooke("check", write(SIX_PARTICLES), "--json", "--predict").json) == KEYS


BEAM = {
    "hooke": 1,
    "parts": [
        {
            "kind": "rope", "name": "beam", "from": [0, 0, 0], "to": [2, 0, 0], "segments": 4, "density": 0.3,
            "bending": 0.5, "pinned": [0, 1], "stretch": {"stiffness": 80, "damping_ratio": 0.1, "rest_scale": 0.8},
        }
    ],
}  # fmt: skip


def test_tells_what_parts_derived(hooke, write):
    scene = write(BEAM, step=1e-4, duration=1)
    answer = hooke("check", scene, "--json")
    assert (answer.code, answer.json["warnings"]) == (0, [])
    value = answer.json
    assert (value["triples"], value["bending_groups"]) == (3, [{"name": "beam.bending", "triples": 3}])
    assert value["forces"] == ["springs", "bending"]
    kappa, m = 80 / 0.4, 0.15
    wanted = {
        (None, "mass of an inner particle", "kg"): m,
        (None, "mass of an end", "kg"): m / 2,
        ("stretch", "kappa", "N/m"): kappa,
        ("stretch", "gamma", "N s/m"): 2 * 0.1 * math.sqrt(kappa * m / 2),
        ("bending", "c", "N/m"): 0.5 / 0.5**3,
    }
    found = {(row["family"], row["name"], row["unit"]): row["value"] for row in value["derived"]}
    assert list(found) == list(wanted)
    assert {row["part"] for row in value["derived"]} == {"beam"}
    for key in wanted:
        assert found[key] == pytest.approx(wanted[key], rel=1e-14)
    words = hooke("check", scene).out
    assert "triples      3\n           3 beam.bending\n" in words
    assert "  beam: mass of an inner particle 0.15 kg\n" in words
    assert "  beam.bending: c 4 N/m\n" in words


def test_what_bends_is_not_loose(hooke, write):
    scene = copy.deepcopy(BEAM)
    del scene["parts"][0]["stretch"]
    answer = hooke("check", write(scene, step=1e-4, duration=1), "--json")
    rest = ["nothing moves: no particle has a velocity, and the forces are in balance"]
    assert (answer.code, answer.json["springs"], answer.json["warnings"]) == (0, 0, rest)


def peak_of_run(folder, *words):
    """VmHWM of a finished run: it waits to write more than the pipe takes."""
    command = [CLI, "run", *words, "--json", "--final"]
    with subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, bufsize=0) as process:
        try:
            assert process.stdout.read(1) == b"{"
            status = Path(f"/proc/{process.pid}/status").read_text()
        finally:
            process.kill()
    return 1024 * int(re.search(r"^VmHWM:\s+(\d+) kB", status, re.M).group(1))


def cloth(n, **more):
    part = {"kind": "cloth", "origin": [0, 0, 0], "edges": [[1, 0, 0], [0, 0, 1]], "size": [n, n], "mass": 1}
    part["structural"] = {"stiffness": 10, **more}
    return {"hooke": 1, "parts": [part], "run": {"step": 1e-6, "duration": 1e-5}}


def lattice(n):
    part = {"kind": "lattice", "origin": [0, 0, 0], "size": [n] * 3}
    part["edges"] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    part.update(mass=1, structural={"stiffness": 10})
    return {"hooke": 1, "parts": [part], "run": {"step": 1e-6, "duration": 1e-5}}


def loose_springs(n):
    """Particles and springs in lists, in random order."""
    positions = [[i % 50, i // 50, 0.1 * (i * i % 7)] for i in range(n)]
    pairs = [[i, (7919 * i + k) % n] for i in range(n) for k in (1, 2)]
    springs = [{"name": "all", "between": [p for p in pairs if p[0] != p[1]], "stiffness": 1, "damping": 0.01}]
    particles = {"position": positions, "mass": 1}
    return {"hooke": 1, "particles": particles, "springs": springs, "run": {"step": 1e-6, "duration": 1e-5}}


@pytest.mark.check
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the peak of a process is read from /proc")
@pytest.mark.skipif(os.environ.get("HOOKE_PRESET") == "asan", reason="the address sanitizer keeps what was given back")
@pytest.mark.parametrize("method", ["symplectic-euler", "verlet", "rk4", "backward-euler"])
@pytest.mark.parametrize(
    "scene", [cloth(32), cloth(128, damping=0.01), cloth(256), lattice(24), loose_springs(20000)],
    ids=["small", "cloth", "large", "lattice", "loose"],
)  # fmt: skip
@pytest.mark.check
def test_memory_is_the_peak_of_a_run(hooke, write, tmp_path, scene, method):
    file = write(scene)
    said = hooke("check", file, "--json", "--method", method).json
    peak = peak_of_run(tmp_path, file, "--method", method)
    assert 0.8 < said["memory_bytes"] / peak < 1.2
    if method == "backward-euler":  # the memory of writing does not depend on the method
        return
    peak = peak_of_run(tmp_path, file, "--method", method, "-o", "out.h5")
    assert 0.8 < said["memory_bytes_output"] / peak < 1.2


@pytest.mark.check
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the peak of a process is read from /proc")
@pytest.mark.skipif(os.environ.get("HOOKE_PRESET") == "asan", reason="the address sanitizer keeps what was given back")
def test_memory_of_a_run_whose_order_stays_low(hooke, write, tmp_path):
    scene = write({**cloth(256), "gravity": [0, -9.81, 0]}, duration=0.002)
    said = hooke("check", scene, "--json", "--method", "cvode-adams").json["memory_bytes"]
    assert 0.8 < said / peak_of_run(tmp_path, scene, "--method", "cvode-adams") < 1.2


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the peak of a process is read from /proc")
@pytest.mark.skipif(os.environ.get("HOOKE_PRESET") == "asan", reason="the address sanitizer keeps what was given back")
@pytest.mark.parametrize("solver, duration", [("auto", 0.001), ("auto", 0.05), ("direct", 0.001)])
def test_memory_of_a_run_that_analyses_a_factor(hooke, write, tmp_path, solver, duration):
    """By iterations, after an analysis that finds a factor too costly, and with the factor."""
    scene = write({**cloth(48, damping=0.01), "gravity": [0, -9.81, 0]}, duration=duration, every=duration)
    words = [scene, "--method", "cvode-bdf", "--linear-solver", solver]
    said = hooke("check", *words, "--json").json
    alone = hooke("check", scene, "--method", "cvode-bdf", "--linear-solver", "blocks", "--json").json
    peak = peak_of_run(tmp_path, *words)
    assert 0.8 < said["memory_bytes"] / peak < 1.2
    factor = said["memory_bytes"] - alone["memory_bytes"]
    assert 5e6 < factor < 10e6 if solver == "direct" else abs(factor) < 1e6
    assert (said["memory_bytes_factor"] is None) == (solver == "direct") and alone["memory_bytes_factor"] is None


@pytest.mark.check
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the peak of a process is read from /proc")
@pytest.mark.skipif(os.environ.get("HOOKE_PRESET") == "asan", reason="the address sanitizer keeps what was given back")
@pytest.mark.parametrize(
    "method, n, duration, of",
    [
        ("arkode-esdirk", 128, 1e-4, "memory_bytes"),
        ("arkode-esdirk", 256, 1e-4, "memory_bytes"),  # takes over 2 s
        ("cvode-bdf", 256, 1e-4, "memory_bytes"),
        ("arkode-esdirk", 64, 0.1, "memory_bytes_factor"),
        ("rk8pd", 128, 1e-4, "memory_bytes"),
    ],
)
@pytest.mark.check
def test_memory_of_a_run_of_few_steps(hooke, write, tmp_path, method, n, duration, of):
    """For any duration: the rerun that estimates the error comes after it. With a factor if it computes one."""
    scene = write({**cloth(n, damping=0.01), "gravity": [0, -9.81, 0]}, duration=duration, every=duration)
    said = hooke("check", scene, "--method", method, "--json").json
    assert 0.8 < said[of] / peak_of_run(tmp_path, scene, "--method", method) < 1.2


def test_memory_of_the_model_grows_with_the_scene(hooke, write):
    small, large = (hooke("check", write(cloth(n)), "--json").json for n in (20, 40))
    assert (small["particles"], large["particles"]) == (400, 1600)
    assert small["springs"] == 2 * 20 * 19
    model = [sum(v[f"bytes_per_{of}"] * v[f"{of}s"] for of in ("particle", "spring")) for v in (small, large)]
    assert 2.5 < model[1] / model[0] < 4.5
    assert all(0 < m < v["memory_bytes"] for m, v in zip(model, (small, large)))


def test_options_count_like_those_of_the_scene(hooke, write):
    scene = write(STIFF_PAIR)
    assert hooke("check", scene, "--json").json["warnings"]
    assert not hooke("check", scene, "--json", "--step", "0.01").json["warnings"]


def test_words_have_the_same_numbers(hooke, write):
    scene = write(STIFF_PAIR)
    value = hooke("check", scene, "--json").json
    answer = hooke("check", scene)
    assert answer.code == 0
    memory = re.search(r"^memory +([\d.]+) MB at the peak", answer.out, re.M)  # of another process
    assert 1e6 * float(memory.group(1)) == pytest.approx(value["memory_bytes"], rel=0.1)
    assert f"{value['step_limit']['symplectic-euler']:.6g} s" in answer.out
    assert "warning: " + value["warnings"][0] in answer.err
    assert value["claims"][0]["text"] == value["warnings"][0] and value["claims"][0]["key"] == "above-limit"
    told = [claim["text"] for claim in value["claims"][1:] if claim["key"] != "memory"]
    assert told and all(text in answer.out for text in told)
    assert "warning" not in answer.out


@pytest.mark.parametrize("missing", ["step", "duration", "method"])
def test_a_scene_without_all_of_a_run_is_still_valid(hooke, write, missing):
    scene = write(SIX_PARTICLES, **{missing: None})
    assert hooke("check", scene, "--json").code == 0


def test_the_first_limit_is_within_the_budget(hooke, write):
    """Otherwise a certainly stable step is chosen."""
    cloth = {"kind": "cloth", "size": [40, 40], "edges": [[1, 0, 0], [0, 0, 1]], "mass": 1, "structural": {"stiffness": 1e4}}
    words = ["check", write({"hooke": 1, "parts": [cloth]}, step=1), "--cost", "--predict", "--json"]
    value = hooke(*words, "--budget", "1ns").json
    assert value["cost"]["step_limit"] is None
    assert value["cost"]["step"] == value["step_limit"]["symplectic-euler"] < 1
    known = hooke(*words, "--budget", "20s").json["cost"]
    assert known["step"] == known["step_limit"] > value["cost"]["step"]


def test_costs_without_the_timing(hooke, write):
    """The same numbers every time; an adaptive method has steps of symplectic Euler."""
    file = write(SIX_PARTICLES, method="cvode-bdf")
    first, second = (hooke("check", file, "--json", "--cost", "--predict").json["cost"] for _ in range(2))
    assert first == second
    answer = hooke("check", file, "--json", "--cost", "--predict")
    assert answer.json["cost"]["method"] == "symplectic-euler" and answer.json["cost"]["nanoseconds"] is None
    words = hooke("check", file, "--cost", "--predict").out
    gravity = re.search(r"^  gravity +- +- +0 +(\S+)$", words, re.M)
    assert float(gravity.group(1)) == pytest.approx(answer.json["cost"]["step_limit"], rel=1e-5)


def test_costs_of_the_largest_groups(hooke, write):
    scene = copy.deepcopy(SIX_PARTICLES)
    scene["springs"].append({"name": "other", "between": [[0, 2]], "stiffness": 1})
    file = write(scene)
    rows = hooke("check", file, "--json", "--cost", "--predict", "--groups", "1").json["cost"]["rows"]
    assert [row["ingredient"] for row in rows] == ["edges", "other", "damping", "gravity"]
    assert [row["memory_bytes"] is None for row in rows] == [False, True, False, False]
    words = hooke("check", file, "--cost", "--predict", "--groups", "1").out
    assert "  edges " in words and "  other " not in words.split("a step of")[1]
    assert "1 ingredient was not looked at" in words
    assert "not looked at" not in hooke("check", file, "--cost", "--predict").out
    hooke("check", file, "--groups", "-1", code=2, err="groups")


def test_the_budget_holds_for_very_many_groups(hooke, write):
    """Omitted results are reported as such and null."""
    count = 1000
    particles = {"position": [[i, 0, 0] for i in range(count + 1)], "mass": 1, "pinned": [0]}
    springs = [{"name": f"g{i}", "between": [[i, i + 1]], "stiffness": 10} for i in range(count)]
    file = write({"hooke": 1, "particles": particles, "springs": springs, "run": {"step": 1e-3, "duration": 1}})
    words = ("check", file, "--cost", "--groups", "1000")
    few = [hooke(*words, "--budget", budget, "--json").json["cost"]["rows"] for budget in ("1ms", "200ms")]
    looked_at = [sum(row["memory_bytes"] is not None for row in rows) for rows in few]
    assert looked_at[0] <= 1 and looked_at[0] <= looked_at[1] < count
    assert len(few[0]) == count and few[0][-1]["nanoseconds"] is None
    assert re.search(r"^left-out +\d+ ingredients were not looked at", hooke(*words, "--budget", "1ms").out, re.M)


def test_what_does_nothing_is_dropped_and_counted(hooke, write):
    scene = copy.deepcopy(SIX_PARTICLES)
    scene["particles"]["position"] += [[9, 9, 9]]
    scene["particles"]["mass"] = 1
    scene["particles"]["pinned"].append(6)
    scene["springs"].append({"name": "slack", "between": [[0, 2], [1, 3]], "stiffness": 0})
    scene["drag"] = 0
    file = write(scene)
    value = hooke("check", file, "--json", "--cost", "--predict").json
    assert value["springs"] == 7 and value["forces"] == ["springs", "gravity"]
    assert value["groups"] == [{"name": "edges", "springs": 7}, {"name": "slack", "springs": 0}]
    assert (value["dropped_springs"], value["idle_particles"]) == (2, 1)
    assert (value["cost"]["dropped_springs"], value["cost"]["idle_particles"]) == (2, 1)
    assert "slack" not in [row["ingredient"] for row in value["cost"]["rows"]]
    words = hooke("check", file, "--cost", "--predict").out
    assert "dropped      2 springs that have neither" in words and "idle         1 pinned particle that" in words


def test_a_step_that_does_not_fit_is_changed_as_by_run(hooke, write):
    scene = write(SIX_PARTICLES, step=3e-3)
    check, run = hooke("check", scene, "--json"), hooke("run", scene, "--json", "--no-estimate")
    words = "step is 0.00294118 s: a little less, so that every and duration are whole multiples of it"
    assert (check.code, check.err, check.json["warnings"]) == (0, f"hooke check: {words}\n", [])
    assert words in run.err and run.json["step"] == 0.05 / 17


def test_why_no_step_can_be_chosen_is_a_warning_of_check(hooke, write):
    scene = write(STIFF_PAIR, step=None, method="forward-euler")
    check, run = hooke("check", scene, "--json"), hooke("run", scene)
    lack, never = check.json["warnings"]
    assert check.code == 0 and lack == "the run has no step, which forward-euler takes"
    assert never.startswith("forward-euler, the method of the run, is stable at no step")
    sentence = "no step: forward-euler is certain to be stable here at no step; give one, or take another method"
    assert (run.code, run.err) == (2, f"hooke run: {sentence}\n")


def test_strings_are_escaped(hooke, write):
    scene = copy.deepcopy(SIX_PARTICLES)
    name = 'a "quoted" \\ name\nwith é, \u4e2d, \U0001f9f5 and \x01\x1f\x7f'
    scene["springs"][0]["name"] = name
    file = write(scene)
    answer = hooke("check", file, "--json")
    assert answer.json["groups"][0]["name"] == name
    assert "\x01" not in hooke("check", file).out


@pytest.mark.parametrize(
    "run, lacks",
    [
        ({"method": "verlet"}, ["the run has no duration and no step, which verlet takes: it is certain to be stable up to "
                                "0.0266627 s"]),
        ({"step": 1e-3}, ["the run has no duration"]),
        ({"method": "cvode-bdf", "duration": 1}, []),
        ({}, []),
    ],
)  # fmt: skip
def test_says_at_once_what_a_run_lacks(hooke, tmp_path, run, lacks):
    (tmp_path / "scene.json").write_text(json.dumps({**BEAM, "run": run}))
    assert hooke("check", tmp_path / "scene.json", "--json").json["warnings"] == lacks
