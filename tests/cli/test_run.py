"""hooke run: results, files, divergence, Ctrl-C and progress."""

import copy
import json
import math
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest
from conftest import CLI, ENDLESS, SIX_PARTICLES, STIFF_PAIR, open_terminal

pytestmark = pytest.mark.everything

KEYS = ["status", "method", "step", "time", "steps", "force_evaluations", "wall_seconds", "particles", "springs",
        "zero_passages", "energy", "momentum", "output", "diagnosis"]
ADAPTIVE_KEYS = KEYS[:2] + ["rtol", "atol"] + KEYS[3:]
ERROR_KEYS = ["estimate", "rms", "known_until", "by", "energy_rise", "heat_excess", "reason"]


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)


@pytest.mark.parametrize("method, keys", [("symplectic-euler", KEYS), ("forward-euler", KEYS),
                                          ("cvode-bdf", ADAPTIVE_KEYS), ("cvode-adams", ADAPTIVE_KEYS)])
def test_json_has_exactly_the_keys_and_types(hooke, write, method, keys):
    answer = hooke("run", write(SIX_PARTICLES), "--method", method, "--json")
    assert answer.code == 0
    assert [line for line in answer.err.splitlines() if "warning: " not in line] == []
    assert ("warning: " in answer.err) == (method == "forward-euler")
    value = answer.json
    assert list(value) == keys + ["error", "claims"] and list(value["error"]) == ERROR_KEYS
    assert (value["status"], value["method"]) == ("finished", method)
    assert value["time"] == 0.5
    for key in ["steps", "force_evaluations", "particles", "springs"]:
        assert isinstance(value[key], int), key
    assert (value["particles"], value["springs"]) == (6, 7)
    assert 0 < value["wall_seconds"] < 60
    assert list(value["energy"]) == ["initial", "final"]
    assert all(map(is_number, value["energy"].values()))
    assert len(value["momentum"]) == 3 and all(map(is_number, value["momentum"]))
    assert value["output"] is None and value["diagnosis"] is None
    if "step" in keys:
        assert value["step"] == 1e-3 and value["steps"] == 500
    else:
        extent = np.linalg.norm(np.ptp(SIX_PARTICLES["particles"]["position"], axis=0))
        assert (value["rtol"], value["atol"]) == (1e-6, pytest.approx(1e-9 * extent, rel=1e-12, abs=0))
        assert value["force_evaluations"] >= value["steps"] > 10


WALL = {
    "hooke": 1,
    "particles": {"position": [[0, 0, 0], [1.5, 0, 0]], "mass": 1, "pinned": [0]},
    "springs": [{"between": [[0, 1]], "law": "length", "stiffness": 10, "damping": 0.1, "rest_length": 0.5}],
    "run": {"method": "rk4", "step": 0.002, "duration": 10, "every": 10},
}


def test_springs_through_zero_are_told_and_a_far_wall_has_none(hooke, write):
    """Seen between the two frames of a run, in words, as JSON and by a study."""
    through = hooke("run", write(WALL), "--json")
    assert through.json["zero_passages"] == 7
    assert "warning: springs passed through length zero 7 times, first that of particles 0 and 1 at t = 0.67" in through.err
    assert "put the wall farther away" in through.err and through.err.count("passed through") == 1
    assert "passed through" not in hooke("run", write(WALL), "--quiet").err
    study = hooke("study", write(WALL), "--duration", "1", "--every", "0.5", "--methods", "rk4")
    assert "passages        springs passed through length zero 1 time," in study.out
    far = copy.deepcopy(WALL)
    far["particles"]["position"][0][0] = -10
    far["springs"][0]["rest_length"] = 10.5
    signed = hooke("run", write(far), "--json", "--final")
    assert signed.json["zero_passages"] == 0 and "passed through" not in signed.err
    w = math.sqrt(10 - 0.05**2)
    right = 0.5 + math.exp(-0.5) * (math.cos(10 * w) + 0.05 / w * math.sin(10 * w))
    assert abs(signed.json["final"]["position"][1][0] - right) < 1e-9
    study = hooke("study", write(far), "--duration", "1", "--every", "0.5", "--methods", "rk4", "--json")
    assert study.json["reference"]["zero_passages"] == ""


def test_more_heat_than_there_is_comes_with_a_warning(hooke, write):
    """A damper whose velocity reverses at each step, by Verlet; and at a step that resolves it."""
    scene = {
        "hooke": 1,
        "particles": {"position": [[0, 0, 0], [1, 0, 0]], "velocity": [[0, 0, 0], [1, 0, 0]], "mass": 1, "pinned": [0]},
        "springs": [{"between": [[0, 1]], "stiffness": 1, "damping": 100}],
        "run": {"method": "verlet", "duration": 10},
    }
    coarse, fine = (hooke("run", write(scene), "--step", step) for step in ("0.5", "1e-3"))
    assert (coarse.code, fine.code) == (0, 0)
    assert "heat-excess           damping and drag took more energy than there was to take, by " in coarse.out
    assert "took more energy" not in fine.out
    excess = [hooke("run", write(scene), "--step", step, "--json").json["error"]["heat_excess"] for step in ("0.5", "1e-3")]
    assert excess[0] > 1 and 0 <= excess[1] < 1e-3
    quiet = hooke("run", write(scene), "--step", "0.5", "--quiet")
    assert quiet.err == ""


def test_options_come_before_the_scene(hooke, write):
    value = hooke("run", "--step=2.5e-3", write(SIX_PARTICLES), "--duration", "0.25", "--json").json
    assert (value["step"], value["time"], value["steps"]) == (2.5e-3, 0.25, 100)


def test_what_is_beyond_numbers_is_not_known(hooke, write):
    """The square of 1e200 is; "inf" and "nan" are no words for people."""
    scene = write({"hooke": 1, "particles": {"position": [[0, 0, 0]], "mass": [1], "velocity": [[1e200, 0, 0]]},
                   "run": {"method": "symplectic-euler", "step": 1e-3, "duration": 0.01}})
    answer, value = hooke("run", scene), hooke("run", scene, "--json").json
    assert re.search(r"^energy +not known before, not known after$", answer.out, re.MULTILINE)
    assert re.search(r"^momentum +1e\+200 0 0 kg m/s$", answer.out, re.MULTILINE)
    assert re.search(r"^error +the error is not known: distances are beyond the range of numbers$", answer.out, re.MULTILINE)
    assert not re.search(r"\b(inf|nan)\b", answer.out)
    assert value["energy"] == {"initial": None, "final": None}
    assert value["error"]["estimate"] is None and value["error"]["reason"] == "distances are beyond the range of numbers"


def test_energy_and_momentum_are_those_of_the_last_state(hooke, write):
    """Computed from --final: m v, 1/2 m v^2, springs and weight."""
    value = hooke("run", write(SIX_PARTICLES), "--json", "--final").json
    assert list(value) == KEYS + ["error", "claims", "final"] and list(value["final"]) == ["position", "velocity"]
    q, v = value["final"]["position"], value["final"]["velocity"]
    assert len(q) == len(v) == 6 and all(len(row) == 3 for row in q + v)
    assert q[5] == [3, 2, 0.2] and v[5] == [0, 0, 0]
    mass = SIX_PARTICLES["particles"]["mass"][:5]
    momentum = [math.fsum(m * v[i][k] for i, m in enumerate(mass)) for k in range(3)]
    assert value["momentum"] == pytest.approx(momentum, rel=1e-13)
    energy = sum(m * (sum(c * c for c in v[i]) / 2 + 9.81 * q[i][1]) for i, m in enumerate(mass))
    start = SIX_PARTICLES["particles"]["position"]
    for i, j in SIX_PARTICLES["springs"][0]["between"]:
        rest = 0.9 * math.dist(start[i], start[j])
        energy += 50 * rest * (math.dist(q[i], q[j]) / rest - 1) ** 2
    assert value["energy"]["final"] == pytest.approx(energy, rel=1e-12)


def test_json_and_the_final_table_have_every_digit_and_other_words_six(hooke, write, tmp_path):
    """The same state as JSON, as words, and as the last frame of the file."""
    scene = write(SIX_PARTICLES)
    value = hooke("run", scene, "--json", "--final", "-o", "out.h5").json
    words = hooke("run", scene, "--final").out
    rows = [line.split() for line in words.split("vz [m/s]\n")[1].splitlines()]
    with h5py.File(tmp_path / "out.h5") as file:
        for what, first in [("position", 1), ("velocity", 4)]:
            stored = file[f"/particles/all/{what}/value"][-1].tolist()
            assert value["final"][what] == stored
            assert [list(map(float, row[first : first + 3])) for row in rows] == stored
    assert f"{value['energy']['final']:.6g} J after" in words
    assert any(len(repr(x)) > 17 for row in value["final"]["position"] for x in row), "no number tests the digits"


def test_names_that_are_not_utf8_are_still_json(hooke, write, tmp_path):
    value = hooke("run", write(SIX_PARTICLES), "--json", "-o", b"out \xff\xc3.h5").json
    assert value["output"] == "out \ufffd\ufffd.h5"
    assert os.path.exists(os.fsencode(tmp_path) + b"/out \xff\xc3.h5")


# ---- refused scenes ----


@pytest.mark.parametrize(
    "run, words, code, wanted",
    [
        ({"duration": None}, [], 2, "no duration"),
        ({"step": None}, ["--strict"], 2, "no step"),
        ({"step": 3e-3}, ["--strict"], 3, "nearest step"),
        ({}, ["--step", "3e-3", "--strict"], 3, "nearest step"),
        ({}, ["--every", "0.0333", "--strict"], 3, "multiple"),
        ({"method": "magic"}, [], 3, "magic"),
        ({"step": -1}, [], 3, "run.step"),
        ({}, ["-o", "scene.json"], 2, "its name has to end in .h5; 'hooke make -o' writes a scene"),
        ({}, ["-o", "no/such/folder/out.h5"], 5, "no/such/folder/out.h5"),
        ({}, ["-o", "."], 5, "."),
        ({}, ["-o", "folder/"], 2, "-o 'folder/': allowed: the name of a file"),
    ],
)
def test_what_cannot_be_run_says_why(hooke, write, run, words, code, wanted):
    scene = write(SIX_PARTICLES, **run)
    hooke("run", scene, *words, code=code, err=wanted, out="")
    error = hooke("run", scene, "--json", *words).json["error"]
    assert error["exit"] == code and wanted in error["message"]


def test_the_steps_it_names_fit(hooke, write):
    scene = write(SIX_PARTICLES, step=3e-3)
    answer = hooke("run", scene)
    named = [word for word in answer.err.replace(",", " ").split() if word.startswith("0.00") and word != "0.003"]
    steps = [float(word) for word in named if abs(float(word) / 3e-3 - 1) > 1e-9]
    assert steps
    for step in steps:
        assert hooke("run", scene, "--step", repr(step)).code == 0


def test_a_step_limit_is_4_and_keeps_what_there_was(hooke, write):
    answer = hooke("run", write(SIX_PARTICLES), "--method", "cvode-adams", "--max-steps", "10", "--json")
    assert answer.code == 4
    assert answer.json["status"] == "stopped"
    assert "max_steps" in answer.json["diagnosis"]
    assert 0 < answer.json["time"] < 0.5
    assert "--max-steps" in answer.err


# ---- divergence ----


def advised_command(err):
    (line,) = [line for line in err.splitlines() if line.startswith("try: hooke run ")]
    return shlex.split(line, comments=True)[2:]


@pytest.mark.parametrize(
    "method, stiffness", [("symplectic-euler", 1000), ("symplectic-euler", 18000), ("forward-euler", 1000)]
)
def test_a_run_that_diverges_is_4_and_the_advice_works(hooke, write, tmp_path, method, stiffness):
    """Symplectic Euler at 1.6 and 6.7 times its limit; forward Euler, which has no stable step here."""
    scene = copy.deepcopy(STIFF_PAIR)
    scene["springs"][0]["stiffness"] = stiffness
    answer = hooke("run", write(scene, method=method), "--json", "-o", "it's out.h5")
    assert answer.code == 4
    value = answer.json
    assert list(value) == KEYS + ["claims"]
    assert value["status"] == "diverged" and value["diagnosis"]
    assert 0 <= value["time"] < 100
    assert value["output"] == "it's out.h5"
    (cause,) = (claim["text"] for claim in value["claims"] if claim["key"] == "cause")
    assert answer.err.splitlines()[0] == f"hooke run: {cause}" and value["diagnosis"].startswith(f"{cause}; ")
    good = float(re.match(r"the run diverged after t = (\S+) s: ", cause).group(1))
    assert value["time"] <= good < value["time"] + 1  # from frame to frame
    with h5py.File(tmp_path / "it's out.h5") as file:
        times = file["/particles/all/position/time"][:].tolist()
        assert times == [float(k) for k in range(len(times))] and times[-1] <= value["time"]
        assert f"{len(times)} frame" in answer.err
    words = advised_command(answer.err)
    assert "it's out.h5" in words and "--step" in words
    again = hooke(*words)
    assert again.code == 0, again.err
    assert again.json["time"] == 100 and 0.1 < again.json["step"] * math.sqrt(stiffness) < 2


EXPLODING = sorted(path.stem for path in (Path(os.environ["HOOKE_SOURCE_DIR"]) / "tests/cli/scenes/exploding").glob("*.json"))


@pytest.mark.check
@pytest.mark.parametrize("kind", EXPLODING)
def test_a_blow_up_is_told_in_four_lines(hooke, tmp_path, kind):
    """What happened and when, what to try, where to see more, and what is kept; and with --quiet the first of them."""
    shutil.copy(Path(os.environ["HOOKE_SOURCE_DIR"]) / f"tests/cli/scenes/exploding/{kind}.json", tmp_path / "scene.json")
    answer = hooke("run", "scene.json", "--json", "--past-divergence", "-o", "out.h5")
    what, advice, see, kept = lines = answer.err.splitlines()
    assert (answer.code, [line.split()[0] for line in lines]) == (4, ["hooke", "try:", "see:", "kept:"])
    why = hooke("why", "out.h5", "--json").json
    assert what == f"hooke run: {answer.json['claims'][0]['text']}" and max(map(len, lines)) < 320
    moment = r" after t = \S+ s"  # error-controlled methods go on from a frame by other steps
    assert re.subn(moment, "", what.removeprefix("hooke run: ")) == re.subn(moment, "", why["claims"][0]["text"])
    assert why["cause"] != "step-above-limit" or len(what) < 160
    assert not why["limit"] or f"{why['limit']:.6g} s" in what
    assert not any(word in advice for word in ("--past-divergence", "--frames-after"))
    with h5py.File(tmp_path / "out.h5") as file:
        times, beyond = file["/particles/all/position/time"][:], file["/hooke/beyond"][0]
    good = times if beyond < 0 else times[:beyond]
    assert f"kept: {len(good)} frame{'s' * (len(good) != 1)} up to t = {good[-1]:.6g} s in out.h5" in kept
    assert (f", and {len(times) - len(good)} after it diverged, which are no physics" in kept) == (beyond >= 0)
    assert see == "see: hooke why out.h5 --report why.html"
    assert hooke(*shlex.split(see)[2:]).code in (0, 6)  # 6: a build without Chart.js
    bare = hooke("run", "scene.json").err.splitlines()
    assert bare[0] == what and bare[2].startswith("see: hooke why scene.json") and len(bare) == 4
    assert hooke(*shlex.split(bare[2])[2:]).code in (0, 6)
    assert bare[3] == "kept: nothing; -o out.h5 keeps the frames up to there"
    assert hooke("run", "scene.json", "--quiet").err.splitlines() == [what]


def test_a_blow_up_that_is_not_looked_into(hooke, write):
    """The warning that was held back has the bound on the step, and the message a suggestion."""
    warning, what, *rest = hooke("run", write(STIFF_PAIR), "--no-why").err.splitlines()
    assert "warning: at t = 0 s the step 0.1 s is above 0.0632456 s" in warning and "the run diverged: at t = " in what
    assert rest == ["try: a smaller step", "see: hooke why scene.json --report why.html",
                    "kept: nothing; -o out.h5 keeps the frames up to there"]  # fmt: skip


def test_where_to_see_more_of_times_that_do_not_fit(hooke, write):
    """The step of a run decides what its times are moved to, and that of its explanation likewise."""
    answer = hooke("run", write(STIFF_PAIR), "--step", "0.3", "--every", "0.5")
    (see,) = [line for line in answer.err.splitlines() if line.startswith("see: ")]
    again = hooke(*shlex.split(see)[2:], "--json")
    assert answer.code == 4 and again.code in (0, 6) and again.json["cause"] == "step-above-limit"


def test_frames_after_divergence(hooke, write, tmp_path):
    """They are marked; all that takes the file goes by those before."""
    plain = hooke("run", write(STIFF_PAIR), "--json", "-o", "plain.h5")
    answer = hooke("run", write(STIFF_PAIR), "--json", "-o", "out.h5", "--past-divergence")
    assert (answer.code, answer.json["status"]) == (4, "diverged")
    assert {**answer.json, "output": "", "wall_seconds": 0} == {
        **plain.json, "output": "", "wall_seconds": 0, "frames_beyond": answer.json["frames_beyond"]}
    assert answer.json["frames_beyond"] > 5
    assert f", and {answer.json['frames_beyond']} after it diverged, which are no physics" in answer.err
    with h5py.File(tmp_path / "out.h5") as file, h5py.File(tmp_path / "plain.h5") as short:
        times, first = file["/particles/all/position/time"][:], file["/hooke/beyond"][0]
        assert short["/hooke/beyond"][0] == -1
        assert np.array_equal(times[:first], short["/particles/all/position/time"][:])
        assert len(times) == first + answer.json["frames_beyond"] and np.all(np.isfinite(times))
        assert np.all(np.isfinite(file["/particles/all/position/value"][:]))
    assert hooke("why", "out.h5", "--json").out.replace("out.h5", "plain.h5") == hooke("why", "plain.h5", "--json").out
    assert hooke("verify", "out.h5").code == 0
    few = hooke("run", "out.h5", "--json", "--frames-after", "2", "-o", "few.h5")
    assert (few.code, few.json["frames_beyond"]) == (4, 2)
    words = advised_command(few.err)
    assert not any("--past-divergence" in word or "--frames-after" in word for word in [*words, *advised_command(answer.err)])
    again = hooke("run", "--resume", "out.h5", "--json", "--no-why")
    assert (again.code, again.json["frames_beyond"]) == (4, answer.json["frames_beyond"])
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["/hooke/beyond"][0] == first
        assert np.array_equal(file["/particles/all/position/time"][:], times)
    assert hooke(*advised_command(answer.err)).json["status"] == "finished"


def test_no_frames_after_divergence(hooke, write):
    coarse = hooke("run", write(STIFF_PAIR), "--method", "forward-euler", "--every", "50", "--past-divergence", "--no-why",
                   "-o", "out.h5")  # fmt: skip
    assert coarse.code == 4 and "a smaller --every shows how" in coarse.err


# ---- Ctrl-C and progress ----


def wait_for_frames(path, process, count):
    """Waits until the run has written `count` frames: their bytes are in a file of a size known in advance."""
    end = time.monotonic() + 60
    while time.monotonic() < end:
        assert process.poll() is None, process.communicate()
        if path.exists():
            try:
                with h5py.File(path) as file:
                    if not math.isnan(file["/particles/all/position/time"][count - 1]):
                        return
            except (OSError, KeyError):
                pass  # caught between two writes
        time.sleep(0.05)
    pytest.fail("no frames after a minute")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_ctrl_c_is_130_and_keeps_what_was_computed(start, write, tmp_path, number):
    process = start("run", write(ENDLESS), "--json", "-o", "out.h5")
    wait_for_frames(tmp_path / "out.h5", process, 3)
    process.send_signal(number)
    sent = time.monotonic()
    out, err = process.communicate(timeout=60)
    assert time.monotonic() - sent < 20
    assert process.returncode == 130
    value = json.loads(out)
    assert list(value) == KEYS + ["claims"]
    assert value["status"] == "stopped" and value["diagnosis"] is None
    assert b"interrupted" in err and b"frames in out.h5" in err
    with h5py.File(tmp_path / "out.h5") as file:
        times = file["/particles/all/position/time"][:].tolist()
        assert len(times) >= 3 and times == [100.0 * k for k in range(len(times))]
        assert len(file["/particles/all/position/value"]) == len(times)
        assert times[-1] <= value["time"] < times[-1] + 100 + 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.h5", "out.h5.checkpoint", "out.xdmf", "scene.json"]


@pytest.mark.check
def test_progress_is_silent_in_a_pipe(start, write):
    process = start("run", write(ENDLESS))
    time.sleep(2.5)
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert err.decode().startswith("hooke run: interrupted at t = ") and err.count(b"\n") == 1
    assert b"\r" not in out + err and b"\x1b" not in out + err
    assert b"time reached" in out


def read_terminal(master, wanted, seconds):
    """Output on a terminal until `wanted` appears, or time is up."""
    seen = b""
    os.set_blocking(master, False)
    end = time.monotonic() + seconds
    while wanted not in seen and time.monotonic() < end:
        try:
            seen += os.read(master, 4096)
        except BlockingIOError:
            time.sleep(0.05)
    return seen


@pytest.mark.check
@pytest.mark.parametrize("verb, quiet", [("run", False), ("run", True), ("compare", False)])
def test_progress_on_a_terminal_after_a_second(start, write, verb, quiet):
    master, terminal = open_terminal()
    begun = time.monotonic()
    process = start(verb, write(ENDLESS), "--json", *(["--quiet"] if quiet else []), stderr=terminal)
    seen = read_terminal(master, b" left", 3 if quiet else 30)
    if quiet:
        assert seen == b""
    else:
        assert time.monotonic() - begun >= 1
        assert b"%" in seen and b" left" in seen
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    os.close(terminal)
    os.close(master)
    assert process.returncode == 130
    assert json.loads(out)["status" if verb == "run" else "rows"] == ("stopped" if verb == "run" else [])


def test_a_signal_that_was_ignored_stays_ignored(start, write):
    """As under nohup, or in the background of a script."""
    process = start("run", write(ENDLESS), preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    time.sleep(0.2)
    assert process.poll() is None
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    assert process.returncode == 130


def test_short_work_shows_no_progress_on_a_terminal(start, write):
    master, terminal = open_terminal()
    process = start("run", write(SIX_PARTICLES, duration=0.1), stderr=terminal)
    process.communicate(timeout=60)
    os.set_blocking(master, False)
    with pytest.raises(BlockingIOError):
        os.read(master, 1)
    os.close(terminal)
    os.close(master)
    assert process.returncode == 0


def test_standard_output_is_json_and_nothing_else(write, tmp_path):
    """Through a shell, as in a pipe of the user."""
    scene = write(STIFF_PAIR)
    for verb in ["check", "run", "run --step 0.01", "run --step 0.3", "run -o no/such/out.h5"]:
        word, _, rest = verb.partition(" ")
        line = f"{shlex.quote(CLI)} {word} {scene} --json {rest} 2>/dev/null | {shlex.quote(sys.executable)} -m json.tool"
        done = subprocess.run(line, shell=True, cwd=tmp_path, capture_output=True, text=True, timeout=60)
        assert done.returncode == 0, (verb, done.stderr)
        assert done.stdout.startswith("{") and "Extra data" not in done.stderr


@pytest.mark.parametrize(
    "run, words, step, every, duration, told",
    [
        ({"step": None}, [], None, 0.05, 0.5, "step is "),
        ({"step": None}, ["--method", "backward-euler"], 5e-4, 0.05, 0.5, "step is 0.0005 s"),
        ({}, ["--step", "1.02e-3"], 1e-3, 0.05, 0.5, "step is 0.001 s"),
        ({}, ["--every", "0.0333"], 1e-3, 0.033, 0.5, "every is 0.033 s"),
        ({}, ["--step", "3e-3", "--duration", "0.4", "--every", "0.01"], 3e-3, 0.009, 0.399, "duration is 0.399 s"),
        ({}, ["--step", "1e-3"], 1e-3, 0.05, 0.5, None),
    ],
)
def test_a_step_that_fits_is_chosen_and_told(hooke, write, tmp_path, run, words, step, every, duration, told):
    scene = write(SIX_PARTICLES, **run)
    answer = hooke("run", scene, *words, "--json", "-o", "out.h5")
    assert answer.code == 0 and (told in answer.err if told else answer.err == "")
    with h5py.File(tmp_path / "out.h5") as file:
        times = file["particles/all/position/time"][:]
    assert answer.json["time"] == pytest.approx(duration) and times[1] - times[0] == pytest.approx(every)
    if step is not None:
        assert answer.json["step"] == pytest.approx(step)
    else:  # at most half of the certainly stable step
        safe = hooke("check", scene, "--json").json["step_limit"]["symplectic-euler"]
        assert 0.25 * safe < answer.json["step"] <= 0.5 * safe


@pytest.mark.parametrize("words", [["--step", "1e-3"], ["--rtol", "1e-4"], ["--atol", "1e-6"]])
def test_a_want_goes_with_no_step_or_tolerance(hooke, write, words):
    refused = hooke("run", write(SIX_PARTICLES), "--want", "1mm", *words)
    assert refused.code == 2 and words[0] in refused.err and refused.out == ""


def test_a_method_restricts_the_want(hooke, write):
    value = hooke("run", write(SIX_PARTICLES), "--want", "1mm", "--method", "verlet", "--json").json
    assert value["method"] == "verlet" and value["want"]["met"] is True
    assert value["error"]["estimate"] <= 1e-3 and value["error"]["known_until"] == 0.5


def test_an_estimate_can_be_left_out(hooke, write):
    answer = hooke("run", write(SIX_PARTICLES), "--no-estimate")
    assert answer.code == 0 and "\nerror " not in answer.out
    assert "error" not in hooke("run", write(SIX_PARTICLES), "--no-estimate", "--json").json


@pytest.mark.parametrize("want, metres", [("1cm", 1e-2), ("1e-3", 1e-3), ("10 um", 1e-5)])
def test_want_picks_a_method_and_keeps_to_it(hooke, write, want, metres):
    """The error of the picked run, against a run at tight tolerance."""
    scene = write(SIX_PARTICLES)
    done = hooke("run", scene, "--want", want, "--json", "--final")
    assert done.code == 0
    assert "picked for an error of" in done.err and done.json["method"] in done.err
    tight = ["--method", "cvode-adams", "--rtol", "1e-10", "--atol", "1e-12"]
    exact = hooke("run", scene, *tight, "--json", "--final").json["final"]["position"]
    pairs = zip(done.json["final"]["position"], exact)
    assert math.sqrt(sum(math.dist(a, b) ** 2 for a, b in pairs) / 5) < metres


@pytest.mark.parametrize("want, word", [("1 furlong", "furlong"), ("-1", "want"), ("0", "want"), ("much", "want")])
def test_want_that_is_no_length(hooke, write, want, word):
    done = hooke("run", write(SIX_PARTICLES), "--want=" + want)
    assert done.code == 2
    assert word in done.err


@pytest.mark.parametrize("word, name", [("explicit-euler", "forward-euler"), ("semi-implicit-euler", "symplectic-euler"),
                                        ("implicit-euler", "backward-euler"), ("velocity-verlet", "verlet")])
def test_other_names_of_methods(hooke, write, word, name):
    answer = hooke("run", write(SIX_PARTICLES), "--method", word, "--json")
    assert (answer.code, answer.json["method"]) == (0, name)
