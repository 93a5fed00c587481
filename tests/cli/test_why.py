"""hooke why: runs that blow up, each in another way, with the cause planted in the scene; and their diagnosis."""

import json
import math
import os
import shlex
import shutil
from pathlib import Path

import pytest
from conftest import LONG, SIX_PARTICLES, STIFF_PAIR

pytestmark = pytest.mark.everything

SCENES = Path(os.environ["HOOKE_SOURCE_DIR"]) / "tests/cli/scenes/exploding"
KEYS = ["scene", "cause", "sentence", "method", "time", "noticed", "step", "limit", "particle", "left_out", "blame", "advice", "claims"]
BLAME_KEYS = ["spring", "number", "first", "second", "group", "share", "force"]

# Scene: cause, and the group or the springs that must be named first (None: none is).
KINDS = {
    "stiff-cloth": ("step-above-limit", "sheet.shear"),
    "light-particle": ("step-above-limit", [[2, 3], [1, 2]]),
    "stiff-spring": ("step-above-limit", "hem"),
    "strong-damping": ("step-above-limit", "sheet.shear"),
    "strong-drag": ("step-above-limit", None),
    "rk4-above": ("step-above-limit", "sheet.shear"),
    "verlet-above": ("step-above-limit", "sheet.shear"),
    "stretching": ("step-above-limit", "upright"),
    "forward-euler-oscillator": ("never-stable", [[0, 1]]),
    "forward-euler-string": ("never-stable", "string.stretch"),
    "collapsing": ("collapsed-spring", "strut"),
    "coincident": ("collapsed-spring", [[0, 1]]),
    "collapsing-cvode": ("collapsed-spring", [[0, 1]]),
    "backward-euler-cable": ("solver-failed", None),
    "cvode-cable": ("solver-failed", None),
    "few-steps": ("solver-failed", None),
    "huge-stiffness": ("overflow", [[0, 1]]),
    "tiny-mass": ("overflow", [[0, 1]]),
    "huge-step": ("overflow", None),
    "torn-apart": ("overflow", None),
    "drag-rk4": ("step-above-limit", None),
    "drag-forward-euler": ("step-above-limit", None),
    "drag-light-particle": ("step-above-limit", None),
    "damping-rk4": ("step-above-limit", "sheet.structural"),
    "squares-of-speeds": ("overflow", None),
    "squares-of-lengths": ("overflow", None),
    "squares-with-tolerances": ("overflow", None),
    "gaining-strand": ("model-gains-energy", None),
    "gaining-strand-verlet": ("model-gains-energy", None),
}

# The force that is named before springs.
FORCES = {
    "strong-damping": ["damping"],
    "damping-rk4": ["damping"],
    "strong-drag": ["drag"],
    "drag-rk4": ["drag"],
    "drag-forward-euler": ["drag"],
    "drag-light-particle": ["drag"],
}

# No run of these stays finite: the scene has to change.
HOPELESS = ["squares-of-lengths"]


def test_every_scene_is_in_the_table():
    assert sorted(path.stem for path in SCENES.glob("*.json")) == sorted(KINDS)


def words_of(command):
    words = shlex.split(command)
    assert words[0] == "hooke"
    return words[1:]


def check_step_below_limit(why, run):
    """A limit comes with a step of nine tenths of it or less, of which frames and the run are whole multiples."""
    steps = [one for one in why["advice"] if one["option"] == "step"]
    assert bool(steps) or not why["limit"]
    for one in steps if why["limit"] else []:
        words, step = words_of(one["command"]), float(one["value"])
        assert one["change"].startswith(f"a step of {step:.6g} s") and step <= 0.9 * why["limit"]
        for name in ("every", "duration"):
            whole = words[words.index(f"--{name}") + 1] if f"--{name}" in words else run.get(name)
            count = float(whole) / step if whole else 1
            assert count == pytest.approx(round(count), rel=1e-9) and count > 0.5


@pytest.mark.check
@pytest.mark.parametrize("kind", [pytest.param(k, marks=[LONG] * k.startswith("gaining")) for k in KINDS])
def test_the_cause_named_is_the_one_planted_and_the_first_advice_works(hooke, tmp_path, kind):
    cause, first = KINDS[kind]
    shutil.copy(SCENES / f"{kind}.json", tmp_path / "scene.json")
    run = hooke("run", "scene.json", "--json", "--quiet")
    assert run.code == 4
    answer = hooke("why", "scene.json", "--json")
    assert answer.code == 0 and answer.err == ""
    why = answer.json
    assert list(why) == KEYS
    assert why["cause"] == cause, run.json["diagnosis"]
    springs = [one for one in why["blame"] if one["spring"]]
    forces = [one for one in why["blame"] if not one["spring"]]
    assert all(list(one) == BLAME_KEYS for one in why["blame"]) and forces in ([], why["blame"][:1])
    assert all(one["spring"] == [one["first"], one["second"]] and one["force"] is None for one in springs)
    assert all(one["number"] is None and one["first"] is None for one in forces)
    assert [one["force"] for one in forces] == FORCES.get(kind, [])
    assert all(list(one) == ["change", "option", "value", "want", "command"] for one in why["advice"])
    assert why["sentence"] == run.json["diagnosis"] and why["left_out"] is None
    check_step_below_limit(why, json.loads((tmp_path / "scene.json").read_text())["run"])
    if isinstance(first, str):
        assert springs[0]["group"] == first
    elif first:
        assert springs[0]["spring"] in first
    if cause == "step-above-limit":
        assert 0 < why["limit"] < why["step"]
        assert f'{why["limit"]:.3g}'[:4] in run.json["diagnosis"]
    if cause == "never-stable":
        assert why["limit"] == 0
    shares = [one["share"] for one in springs]
    if cause in ("step-above-limit", "never-stable"):
        assert shares == sorted(shares, reverse=True) and 0 < sum(shares) < 1 + 1e-9
        assert all(0.5 <= one["share"] < 1 + 1e-9 for one in forces)
    if kind in HOPELESS:
        assert why["advice"] and all(one["command"] is None for one in why["advice"])
        return
    words = words_of(why["advice"][0]["command"])
    assert words[:2] == ["run", "scene.json"]
    again = hooke(*words, "--json")
    assert again.code == 0, again.err
    assert again.json["status"] == "finished"


# ---- words ----


def test_run_and_why_say_the_same_sentence(hooke, write):
    scene = write(STIFF_PAIR)
    run = hooke("run", scene, "--json")
    sentence = run.json["diagnosis"]
    claims = run.json["claims"]
    assert claims == hooke("why", scene, "--json").json["claims"]
    assert [(claim["key"], claim["of"]) for claim in claims] == [("cause", "part"), ("course", "part")]
    assert sentence == "; ".join(claim["text"] for claim in claims)
    assert run.err.splitlines()[0] == f"hooke run: {claims[0]['text']}"
    told = " ".join(hooke("why", scene).out.split())
    assert f"cause {claims[0]['text']} course {claims[1]['text']} kind " in told
    assert hooke("why", scene, "--no-why").code == 2


def test_run_gives_the_best_advice_and_why_all(hooke, write):
    scene = write(STIFF_PAIR)
    err, out = hooke("run", scene).err, hooke("why", scene).out
    first, *others = hooke("why", scene, "--json").json["advice"]
    assert first["change"] in err and first["command"] in err
    assert others and all(one["change"] in out and one["command"] in out for one in [first, *others])


def test_a_run_that_ends_well_has_nothing_to_explain(hooke, write):
    scene = write(SIX_PARTICLES)
    answer = hooke("why", scene)
    assert answer.code == 0 and "did not blow up" in answer.out
    why = hooke("why", scene, "--json").json
    assert list(why) == KEYS
    assert (why["cause"], why["time"], why["blame"], why["advice"], why["claims"]) == (None, 0.5, [], [], [])


def test_options_of_a_run_are_options_of_why(hooke, write):
    scene = write(SIX_PARTICLES)
    why = hooke("why", scene, "--step", "0.5", "--every", "0.5", "--duration", "50", "--json").json
    assert why["cause"] == "step-above-limit" and why["step"] == 0.5
    words = words_of(why["advice"][0]["command"])
    assert "--every" in words and hooke(*words).code == 0


def test_what_cannot_be_run_cannot_be_explained(hooke, write):
    assert hooke("why", "missing.json").code == 3
    assert hooke("why", write(SIX_PARTICLES, duration=None)).code == 2
    chosen = hooke("why", write(SIX_PARTICLES, step=None))  # by hooke, as of a run
    assert chosen.code == 0 and "step is " in chosen.err and "did not blow up" in chosen.out
    assert hooke("why").code == 2


@pytest.mark.check
def test_a_step_that_is_not_tried_to_its_end(hooke):
    """A limit gives a step also where its run is too long to be tried, and no limit is said to be unknown beside it."""
    scene = SCENES.parents[3] / "examples/scenes/cloth-64.json"
    words = [scene, "--step", "10ms", "--every", "0.5", "--duration", "1"]
    why = hooke("why", *words, "--json").json
    assert why["limit"] == pytest.approx(9.0003e-5, rel=1e-4)
    assert why["advice"][0]["change"] == "a step of 5e-05 s, below the limit (not tried to its end, for want of time)"
    assert why["left_out"] == "not known, since time was short (2 s of counted work): what else to do"
    check_step_below_limit(why, {"every": 0.5, "duration": 1})


# ---- an output ----


def test_an_output_is_explained_without_its_scene(hooke, write, tmp_path):
    scene = write(STIFF_PAIR)
    assert hooke("run", scene, "-o", "out.h5").code == 4
    of_scene = hooke("why", scene, "--json").json
    (tmp_path / scene).unlink()
    why = hooke("why", "out.h5", "--json").json
    for key in ["cause", "time", "method", "step", "limit", "blame"]:
        assert why[key] == of_scene[key], key
    words = words_of(why["advice"][0]["command"])
    assert words[1] == "out.h5"
    again = hooke(*words, "--json")
    assert again.code == 0 and again.json["time"] == 100


def test_an_output_late_in_a_run(hooke, tmp_path):
    """Frames until it blows up: the diagnosis starts from the last one."""
    shutil.copy(SCENES / "stretching.json", tmp_path / "scene.json")
    run = hooke("run", "scene.json", "--json", "-o", "out.h5")
    assert run.code == 4 and run.json["time"] > 10
    why = hooke("why", "out.h5", "--json").json
    assert why["cause"] == "step-above-limit" and why["blame"][0]["group"] == "upright"


def test_an_output_that_ended_well(hooke, write):
    assert hooke("run", write(SIX_PARTICLES), "-o", "out.h5").code == 0
    assert hooke("why", "out.h5").out.split("\nstep ")[0] == "the run did not blow up\nstatus      finished\ntime        0.5 s"


def test_an_output_can_be_run_again(hooke, write):
    """With the options of its run, to the bit."""
    first = hooke("run", write(SIX_PARTICLES), "--step", "2e-3", "-o", "out.h5", "--json", "--final").json
    again = hooke("run", "out.h5", "--json", "--final").json
    assert again["step"] == 2e-3 and again["final"] == first["final"]


def test_a_file_that_is_no_output(hooke, tmp_path):
    (tmp_path / "odd.h5").write_bytes(b"\x89HDF\r\n\x1a\n" + b"junk" * 100)
    answer = hooke("why", "odd.h5")
    assert answer.code in (3, 5) and "odd.h5" in answer.err


# ---- warnings ----


def warnings_of(answer):
    return [line for line in answer.err.splitlines() if "warning: " in line]


def test_run_warns_before_it_blows_up(hooke, write):
    """The limit of an oscillator and its bound are the same: 2/omega."""
    limit = 2 / math.sqrt(1000)
    for share, count, word, *more in [(0.9, 0, ""), (0.97, 1, "within 5 % of"), (1.01, 1, "is above", "--no-why"), (1.01, 0, "")]:
        step = share * limit
        answer = hooke("run", write(STIFF_PAIR, step=step, duration=100 * step, every=step), *more)
        assert answer.code == (4 if share > 1 else 0)
        (line,) = warnings_of(answer) or [""]
        assert len(warnings_of(answer)) == count and word in line
        if count:
            for part in [f"{step:.6g} s", f"{limit:.6g} s", "spring 0 (particles 0 and 1)", "particle 1", "t = 0 s"]:
                assert part in line
    assert warnings_of(hooke("run", write(STIFF_PAIR), "--quiet")) == []


def test_results_do_not_depend_on_the_watch(hooke, write):
    scene = write(SIX_PARTICLES, step=0.02, every=0.02, duration=1)
    watched, alone = (hooke("run", scene, "--json", "--final", *more).json for more in ([], ["--quiet"]))
    assert watched["final"] == alone["final"] and watched["steps"] == alone["steps"]
