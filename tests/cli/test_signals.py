"""Ctrl-C, SIGTERM and SIGHUP end the work in the same way, however many arrive: results so far are kept, and a run
says how to continue."""

import json
import random
import re
import signal
import subprocess
import time
from pathlib import Path

import h5py
import pytest
from conftest import hanging_cloth, interrupt

pytestmark = pytest.mark.everything

SIDE = 40
ALL = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
CLOTH = {
    **hanging_cloth(SIDE, {"stiffness": 500, "damping": 1e-3}, mass=0.1),
    "run": {"method": "symplectic-euler", "step": 1e-6, "duration": 1000, "every": 1000},
}


def listens(process, number):
    """Waits until the program handles the signal."""
    end = time.monotonic() + 60
    while time.monotonic() < end:
        caught = re.search(r"SigCgt:\s*(\w+)", Path(f"/proc/{process.pid}/status").read_text()).group(1)
        if int(caught, 16) >> (number - 1) & 1:
            return
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    pytest.fail("it does not listen")


def end_by(process, numbers, after=0.3):
    """Sends the signals one after the other; returns the output, and the seconds to the end."""
    listens(process, numbers[0])
    time.sleep(after)
    began = time.monotonic()
    for number in numbers:
        process.send_signal(number)
        time.sleep(0.002)
    out, err = process.communicate(timeout=60)
    return out.decode(), err.decode(), time.monotonic() - began


@pytest.mark.parametrize(
    "method, number", [*(("symplectic-euler", number) for number in ALL), ("backward-euler", signal.SIGTERM)]
)
@pytest.mark.check
def test_a_run_between_frames_ends_and_can_go_on(hooke, start, write, tmp_path, number, method):
    step = 1e-6 if method == "symplectic-euler" else 1e-4
    scene = write(CLOTH, method=method, step=step, duration=1000, every=1000)
    process = start("run", scene, "-o", "out.h5")
    while not (tmp_path / "out.h5").exists():
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    out, err, seconds = end_by(process, [number] * 20)
    assert process.returncode == 130, (out, err)
    assert seconds < 10  # on a busy machine; 2 s, and a step and its writing
    assert "interrupted at t = " in err and err.endswith("to go on:\n  hooke run --resume out.h5\n")
    assert "largest stable" not in err  # no diagnosis
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["/hooke/status"][()] == b"stopped"
    reached = next(float(line.split()[2]) for line in out.splitlines() if line.startswith("time reached"))
    assert reached > 0
    process = start("run", "--resume", "out.h5", "--no-why")
    _, err, _ = end_by(process, [number])
    assert process.returncode == 130 and "checkpoint" in err


@pytest.mark.parametrize(
    "words",
    [
        ["limit", "--accuracy", "1e-4", "--budget", "300s"],
        ["study", "--duration", "10", "--every", "1", "--budget", "300s"],
        ["needs", "--want", "1mm", "--duration", "10", "--every", "1"],
        ["why", "--step", "5ms", "--every", "50ms", "--duration", "100", "--budget", "300s"],
    ],
    ids=lambda words: words[0],
)
@pytest.mark.check
def test_other_work_ends_too(start, write, words):
    process = start(words[0], write(CLOTH), *words[1:])
    _, err, seconds = end_by(process, [signal.SIGHUP, *ALL, signal.SIGHUP], 0.5)
    if process.returncode == 6:
        pytest.skip("a part that is not built")
    assert process.returncode == 130 and "interrupted" in err, err
    assert seconds < 10


def test_a_signal_during_a_diagnosis_does_not_kill(start, write):
    scene = write(CLOTH, step=5e-3, every=0.05, duration=100)
    process = start("run", scene, "-o", "out.h5")
    for line in process.stdout:
        if line.startswith(b"output"):
            break
    _, err, seconds = end_by(process, ALL * 3, 0)
    assert process.returncode == 4 and "the run diverged" in err
    assert "is not looked into further" in err or "\ntry: hooke run" in err
    assert seconds < 10


@pytest.mark.parametrize("number", [signal.SIGHUP, signal.SIGTERM])
def test_what_was_ignored_stays_ignored(start, write, number):
    """As SIGHUP under nohup."""
    process = start("run", write(CLOTH), preexec_fn=lambda: signal.signal(number, signal.SIG_IGN))
    listens(process, signal.SIGINT)
    process.send_signal(number)
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(0.3)
    interrupt(process)
    process.communicate(timeout=60)
    assert process.returncode == 130


def names(folder):
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize("number", ALL)
def test_a_view_leaves_nothing(start, write, tmp_path, number):
    """Neither trajectory nor checkpoint, and the page that was there stays as it is."""
    scene = write(CLOTH, checkpoint=1e-4)
    (tmp_path / "page.html").write_text("older")
    temporary = set()
    for after in (0.1, 0):
        process = start("view", scene, "-o", "page.html", "--json")
        listens(process, number)
        time.sleep(after)
        temporary |= set(names(tmp_path)) - {"page.html", "scene.json"}
        out, err, seconds = end_by(process, [number] * 20, 0)
        if process.returncode == 6:
            pytest.skip("this build writes no pages")
        assert process.returncode == 130 and "interrupted; nothing is written" in err, (out, err)
        assert json.loads(out)["error"]["exit"] == 130 and seconds < 10
        assert names(tmp_path) == ["page.html", "scene.json"] and (tmp_path / "page.html").read_text() == "older"
    unguessable = [name for name in temporary if re.fullmatch(r"hooke-\w{6}", name)]
    assert unguessable and str(process.pid) not in str(temporary)


def test_a_view_leaves_nothing_whenever_it_is_interrupted(start, write, tmp_path):
    """Also before it listens: it is then killed."""
    scene = write(CLOTH, duration=0.02, every=0.002, step=1e-5)
    for number in 2 * ALL:
        process = start("view", scene)
        time.sleep(random.Random(process.pid).uniform(0, 0.08))
        process.send_signal(number)
        process.communicate(timeout=60)
        assert process.returncode in (0, 6, 130, -number)
        assert names(tmp_path) == sorted(["scene.json"] + ["scene.html"] * (process.returncode == 0))
        (tmp_path / "scene.html").unlink(missing_ok=True)


def test_making_a_scene_ends_too(start, tmp_path):
    words = ["make", "cloth", "--size", "1000x1000", "--edges", "1,0,0;0,0,1", "--mass", "1", "--structural.stiffness", "100"]
    process = start(*words, "-o", "cloth.json")
    _, err, seconds = end_by(process, 7 * ALL, 0)
    assert process.returncode == 130 and "hooke make: interrupted; nothing is written" in err
    assert names(tmp_path) == [] and seconds < 10


def test_the_page_of_a_file_is_whole_or_not_there(hooke, start, write, tmp_path):
    assert hooke("run", write(CLOTH, step=1e-5, duration=1e-3, every=1e-5), "-o", "out.h5", "-q", "--no-estimate").code == 0
    there = names(tmp_path)
    process = start("view", "out.h5", "-o", "page.html")
    _, err, _ = end_by(process, 7 * ALL, 0)
    if process.returncode == 130:
        assert "interrupted; nothing is written" in err and names(tmp_path) == there
    elif process.returncode == 0:
        assert names(tmp_path) == sorted([*there, "page.html"])
        assert (tmp_path / "page.html").read_text(encoding="utf-8").endswith("</html>\n")
    else:
        assert process.returncode == 6, err
