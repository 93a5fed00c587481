"""What people type: every line of tests/data/typed.txt, and what a table cannot hold."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import CLI

pytestmark = pytest.mark.everything

DATA = Path(__file__).parents[1] / "data"
ROPE = Path(__file__).parents[2] / "examples/scenes/rope.json"
VERBS = ["make", "run", "compare", "study", "limit", "why", "needs", "check", "view", "verify"]
TWO = {"hooke": 1, "particles": {"position": [[0, 0, 0], [0.1, 0, 0]], "mass": 1, "pinned": [0]},
       "run": {"step": 1e-3, "duration": 0.01}}


def rows():
    for line in (DATA / "typed.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            command, code, *said = (piece.strip().replace("\\|", "|") for piece in re.split(r" (?<!\\)\| ", line))
            yield pytest.param(command, int(code), said[0], said[1:], id=f"{command} [{said[0][:20]}]")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("typed")

    def put(name, **more):
        (path / name).write_text(json.dumps({**TWO, **more}))

    rope = json.loads(ROPE.read_text())
    (path / "rope.json").write_text(json.dumps(rope))
    part = {"kind": "cloth", "name": "cloth", "edges": [[1, 0, 0], [0, 1, 0]], "size": [4, 4], "mass": 1}
    put("three.json", springs=[{"between": [[0, 1], [1, 0], [0, 1]], "stiffness": 100}])
    put("loose.json", parts=[part], gravity=[0, -9.81, 0])
    put("soft.json", springs=[{"name": "soft", "between": [[0, 1]], "stiffness": 0, "damping": 1}])
    put("unit.json", springs=[{"between": [[0, 1]], "stiffness": "2 kN/m"}])
    put("drag.json", dynamics="overdamped", drag=2, particles={"position": [[0, 0, 0], [1.5, 0, 0]]},
        springs=[{"between": [[0, 1]], "law": "length", "stiffness": 30, "rest_length": 1}],
        run={"method": "forward-euler", "step": 0.06, "duration": 1.2})
    del rope["run"]["step"]
    (path / "nostep.json").write_text(json.dumps(rope))
    subprocess.run([CLI, "run", "rope.json", "-o", "out.h5", "--quiet", "--no-estimate"], cwd=path, check=True,
                   stdout=subprocess.DEVNULL)
    return path


def answer(folder, command):
    words = ["bash", "-c", 'hooke() { "$HOOKE_CLI" "$@"; }\n' + command]
    done = subprocess.run(words, cwd=folder, env={**os.environ, "HOOKE_CLI": CLI}, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60)
    return done.returncode, " ".join(done.stdout.split("\n"))


@pytest.mark.parametrize("command, code, said, never", list(rows()))
def test_what_is_typed(folder, command, code, said, never):
    before = sorted(os.listdir(folder))
    got, text = answer(folder, command)
    assert (got, said in text) == (code, True), text
    assert not any(word in text for word in never), text
    assert sorted(os.listdir(folder)) == before or code == 0


@pytest.mark.parametrize("verb", VERBS)
def test_help_is_short_and_names_all_options(folder, verb):
    short, complete = (subprocess.run([CLI, verb, "--help", *more], text=True, capture_output=True, check=True).stdout
                       for more in ([], ["all"]))
    assert len(short.splitlines()) <= 15 and max(map(len, short.splitlines())) <= 110
    flags = re.findall(r"^  (?:-\w, |    )(--[\w.-]+)", complete, re.MULTILINE)
    assert all(re.search(rf"{flag}\b", short) for flag in flags) and (flags or verb == "make")


def test_final_numbers_read_back(folder):
    words = [CLI, "run", "rope.json", "--final", "--no-estimate"]
    printed = subprocess.run(words, cwd=folder, text=True, capture_output=True, check=True).stdout
    final = json.loads(subprocess.run([*words, "--json"], cwd=folder, capture_output=True, check=True).stdout)["final"]
    lines = [list(map(float, line.split()[1:])) for line in printed.split("[m/s]\n")[1].splitlines()]
    assert lines == [q + v for q, v in zip(final["position"], final["velocity"], strict=True)]
