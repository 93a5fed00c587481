"""Files and standard output that cannot be written: exit code 5, a reason, no claim of success, the older file as it was."""

import json
import os
import resource
import subprocess

import pytest
from conftest import CLI, SIX_PARTICLES

pytestmark = pytest.mark.everything

VERBS = {
    "run": ["run", "scene.json", "--quiet", "-o"],
    "compare": ["compare", "scene.json", "--duration", "0.01", "--every", "0.005", "--quiet", "-o"],
    "limit": ["limit", "scene.json", "--predict", "--report"],
    "make": ["make", "rope", "--from", "0,0,0", "--to", "1,0,0", "--segments", "4", "--mass", "1", "-o"],
}
ENDING = {"limit": ".html", "make": ".json"}


@pytest.fixture(name="folder")
def fixture_folder(tmp_path):
    (tmp_path / "scene.json").write_text(json.dumps(SIX_PARTICLES))
    return tmp_path


def limit_files():
    resource.setrlimit(resource.RLIMIT_FSIZE, (64, resource.RLIM_INFINITY))


def start(folder, words, preexec=None, out=subprocess.PIPE):
    return subprocess.run([CLI, *words], cwd=folder, stdout=out, stderr=subprocess.PIPE, text=True, timeout=120,
                          preexec_fn=preexec, check=False)


@pytest.mark.parametrize("verb", VERBS)
@pytest.mark.parametrize("place", ["/dev/full", "missing/out", "scene.json/out", "/proc/out"])
def test_places_that_take_no_file(folder, verb, place):
    answer = start(folder, [*VERBS[verb], place + ("" if place == "/dev/full" else ENDING.get(verb, ".h5"))])
    assert answer.returncode == 5, answer.stderr
    assert place in answer.stderr
    assert '"finished"' not in answer.stdout
    assert os.listdir(folder) == ["scene.json"]


@pytest.mark.parametrize("verb", VERBS)
def test_a_limit_on_file_sizes_leaves_the_older_file(folder, verb):
    name = "out" + ENDING.get(verb, ".h5")
    (folder / name).write_text("precious")
    answer = start(folder, [*VERBS[verb], name], preexec=limit_files)
    assert answer.returncode in (5, -25), answer.stderr  # by the signal, where the program leaves that as it is
    assert '"finished"' not in answer.stdout
    assert (folder / name).read_text() == "precious"


@pytest.mark.parametrize("words", [["run", "scene.json", "--json"], ["limit", "scene.json", "--predict", "--json"],
                                   ["check", "scene.json"], ["--help"]])
def test_standard_output_that_is_full(folder, words):
    with open("/dev/full", "w", encoding="utf-8") as full:
        answer = start(folder, words, out=full)
    assert answer.returncode == 5
    assert "standard output" in answer.stderr
