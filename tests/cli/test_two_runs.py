"""A second run on an output that is in use, and an output of the longest name."""

import os
import time

import h5py
import pytest
from conftest import ENDLESS, SIX_PARTICLES, interrupt

pytestmark = pytest.mark.everything

WORDS = "another run is writing this file"
SHORT = ["--duration", "0.01", "--every", "0.001", "--methods", "verlet"]


def begin(start, folder, *words):
    process = start("run", *words, "--quiet")
    while not (folder / "out.h5").exists():
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    return process


def test_an_output_in_use_is_refused(hooke, start, write, tmp_path):
    process = begin(start, tmp_path, write(ENDLESS, checkpoint=1e5), "-o", "out.h5")
    for link in ("link.h5", "link.json"):
        os.symlink("out.h5", tmp_path / link)
    scene = write(SIX_PARTICLES, "short.json")
    for words in (
        ["run", scene, "-o", "out.h5"],
        ["run", scene, "-o", "link.h5"],
        ["run", "--resume", "out.h5"],
        ["compare", scene, *SHORT, "-o", "out.h5"],
        ["study", scene, *SHORT, "--points", "6", "-o", "out.h5"],
        ["needs", scene, "--want", "1cm", "-o", "link.json"],
    ):
        answer = hooke(*words, "--quiet")
        assert answer.code == 5 and f"{words[-1]}: {WORDS}" in answer.err, answer.err
    assert not [name for name in os.listdir(tmp_path) if name.endswith(".part")]
    with h5py.File(tmp_path / "out.h5") as file:  # readers are not kept out
        assert file["hooke/status"][()].startswith(b"running")
    interrupt(process)
    assert process.wait(60) == 130
    first, second = (begin(start, tmp_path, "--resume", "out.h5") for _ in range(2))
    while first.poll() is None and second.poll() is None:
        time.sleep(0.01)
    loser, winner = (second, first) if first.poll() is None else (first, second)
    assert loser.wait(60) == 5 and f"out.h5: {WORDS}" in loser.communicate()[1].decode()
    interrupt(winner)
    assert winner.wait(60) == 130
    assert hooke("run", scene, "-o", "out.h5", "--quiet").code == 0


def test_an_output_of_a_killed_run_is_free(hooke, start, write, tmp_path):
    process = begin(start, tmp_path, write(ENDLESS), "-o", "out.h5")
    process.kill()
    process.wait(60)
    assert hooke("run", write(SIX_PARTICLES), "-o", "out.h5", "--quiet").code == 0


def test_the_longest_name(hooke, start, write, tmp_path):
    name = "x" * 252 + ".h5"
    process = start("run", write(ENDLESS, checkpoint=300), "-o", name, "--quiet")
    while len(os.listdir(tmp_path)) < 4:  # the scene, the output, two checkpoints
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    interrupt(process)
    assert process.wait(60) == 130, process.communicate()
    process = start("run", "--resume", name)
    interrupt(process)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130 and b"goes on from the checkpoint" in err
    assert hooke("run", write(SIX_PARTICLES), "-o", name, "--quiet").code == 0
    left = sorted(path.suffix for path in tmp_path.iterdir())
    assert left == [".h5", ".json", ".xdmf"]
    assert hooke("verify", name, "--quiet").code == 0
