"""Words: help, version, wrong usage, and the answers of a minimal build."""

import re
import subprocess

import pytest
from conftest import CLI, MINIMAL, SIX_PARTICLES


def test_methods_say_what_they_take(hooke):
    answer = hooke("methods")
    assert (answer.code, answer.err, answer.out) == (0, "", hooke("--methods").out)
    rows = {words[0]: words[1:] for words in map(str.split, answer.out.splitlines())}
    assert rows.pop("method") == ["bodies", "overdamped", "first-order"]
    listed = hooke("--help").out.split("\nmethods:\n")[1].split("\n\n")[0]
    assert list(rows) == re.findall(r"^  ([\w-]+) ", listed, re.MULTILINE)
    assert (rows["shardlow"], rows["tr-bdf2"], rows["rk4"]) == (["no"] * 3, ["yes", "yes", "no"], ["yes"] * 3)


def test_version_says_what_it_was_built_with(hooke):
    answer = hooke("--version")
    assert (answer.code, answer.err) == (0, "")
    facts = dict(line.split(None, 1) for line in answer.out.splitlines())
    assert re.fullmatch(r"\d+\.\d+\.\d+", facts["hooke"])
    assert facts["ABI"].isdigit()
    for library in ["SUNDIALS", "CHOLMOD", "LAPACK", "GSL", "HDF5"]:
        if MINIMAL:
            assert facts[library] == "not in this build"
        else:
            assert re.match(r"\d+\.\d+", facts[library])
    assert int(facts["threads"].split()[0]) >= 1
    assert facts["instructions"]
    if MINIMAL:
        assert facts["licence"] == "MIT"
    else:
        assert facts["licence"] == "GPL-3.0-or-later, since it contains GSL and CHOLMOD; hooke itself is MIT"


@pytest.mark.parametrize(
    "words, wanted",
    [
        ([], "usage: hooke VERB"),
        (["rnu", "scene.json"], "did you mean 'run'"),
        (["chekc"], "did you mean 'check'"),
        (["--verbose"], "there is no option '--verbose'"),
        (["run"], "no scene"),
        (["run", "a.json", "b.json"], "'a.json' and 'b.json'"),
        (["run", "a.json", "--stpe", "1"], "did you mean --step?"),
        (["run", "a.json", "--stpe=1"], "did you mean --step?"),
        (["run", "a.json", "-x"], "there is no option -x"),
        (["run", "a.json", "-qx"], "there is no option -x"),
        (["run", "a.json", "--step"], "--step wants a value"),
        (["run", "a.json", "-o"], "--output wants a value"),
        (["run", "a.json", "--json=yes"], "--json takes no value"),
        (["run", "a.json", "--step", "fast"], "--step fast"),
        (["run", "a.json", "--step", "-1"], "> 0"),
        (["run", "a.json", "--step", "nan"], "--step nan"),
        (["run", "a.json", "--step", ""], "--step"),
        (["run", "a.json", "--threads", "1.5"], "whole"),
        (["run", "a.json", "--method", "forward-eular"], "did you mean forward-euler?"),
        (["run", "a.json", "--method", "magic"], "cvode-adams"),
        (["compare", "a.json", "--methods", "forward-euler,magic"], "'magic'"),
        (["compare", "a.json", "--methods", ""], "''"),
        (["compare", "a.json", "--methods", "forward-euler,forward-euler"], "named twice"),
        (["check", "a.json", "-o", "b.h5"], "there is no option -o"),
        (["needs", "a.json", "--at", "b.h5"], "there is no option --at, which is one of limit, modes;"),
        (["needs", "a.json", "--ato", "1"], "--ato is ambiguous: --atol, --atol-velocity"),
        (["run", "a.json", "--step", "1e305"], "1e+305 is not allowed; allowed: a number > 0 [s], up to 1e300"),
        (["compare", "a.json", "-o", "b.txt"], "ends in .csv, for the rows as a table, or in .h5, for all that is found"),
    ],
)
def test_wrong_usage_is_2_and_says_why(hooke, words, wanted):
    hooke(*words, code=2, err=wanted, out="")


def test_wrong_usage_with_json_is_an_object(hooke):
    answer = hooke("run", "a.json", "--json", "--stpe", "1")
    assert answer.code == 2
    assert answer.json["error"]["exit"] == 2
    assert "--stpe" in answer.json["error"]["message"]


def test_text_from_outside_cannot_steer_a_terminal(hooke):
    answer = hooke("run", "a.json", "--step", "\x1b[2Jfast")
    assert answer.code == 2
    assert "\x1b" not in answer.err
    assert "\x1b" not in hooke("\x1b[2J").err


def test_output_that_cannot_be_written_is_5():
    with open("/dev/full", "w") as full:
        done = subprocess.run([CLI, "--help"], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
    assert done.returncode == 5
    assert "standard output" in done.stderr


@pytest.mark.skipif(not MINIMAL, reason="this build has the libraries")
@pytest.mark.parametrize(
    "words, wanted",
    [
        (["run", "-o", "out.h5"], "HDF5"),
        (["compare", "-o", "out.h5"], "HDF5"),
        (["compare", "--methods", "cvode-bdf"], "cvode-bdf"),
    ],
)
def test_what_is_not_in_a_minimal_build_is_6(hooke, write, tmp_path, words, wanted):
    scene = write(SIX_PARTICLES)
    hooke(words[0], scene, *words[1:], code=6, err=wanted, out="")
    assert not (tmp_path / "out.h5").exists()
    assert hooke(words[0], scene, "--json", *words[1:]).json["error"]["exit"] == 6


@pytest.mark.skipif(not MINIMAL, reason="this build has the libraries")
def test_without_sundials_a_study_says_that_rk4_checks_itself(hooke, write):
    words = ["--methods", "verlet", "--duration", 1, "--every", 0.1, "--want", 1e-3, "--json"]
    study = hooke("study", write(SIX_PARTICLES), *words).json
    [floor] = [claim["text"] for claim in study["claims"] if claim["key"] == "floor"]
    assert "by rk4, agrees with itself in steps of" in floor and "an error that both make alike is not seen" in floor
    assert study["reference"]["methods"] == ["rk4", "rk4"] and study["recommendation"]["met"] is True
    assert study["recommendation"]["error"] <= 1e-3
