"""Runs the program; holds common scenes."""

import copy
import json
import os
import pty
import re
import signal
import subprocess
import time
from pathlib import Path

import pytest

CLI = os.environ["HOOKE_CLI"]
MINIMAL = os.environ.get("HOOKE_PRESET") == "minimal"
LONG = pytest.mark.skipif(os.environ.get("HOOKE_PRESET") == "asan" and not os.environ.get("HOOKE_LONG"),
                          reason="takes ten times as long with a sanitizer; the tests in C run there")

SIX_PARTICLES = {
    "hooke": 1,
    "title": "six particles, seven springs",
    "gravity": [0, -9.81, 0],
    "particles": {
        "position": [[0, 0, 0], [1, 0, 0.1], [2, 0.2, 0], [2, 1.1, 0.3], [0.7, 1.2, 0], [3, 2, 0.2]],
        "mass": [1, 2, 3, 4, 5, 6],
        "pinned": [5],
    },
    "springs": [
        {
            "name": "edges",
            "between": [[0, 1], [0, 4], [1, 2], [1, 4], [2, 3], [3, 4], [3, 5]],
            "stiffness": 100,
            "damping": 0.5,
            "rest_scale": 0.9,
        }
    ],
    "run": {"method": "symplectic-euler", "step": 1e-3, "duration": 0.5, "every": 0.05},
}

METHODS = [
    "forward-euler",
    "symplectic-euler",
    "verlet",
    "shardlow",
    "heun",
    "rk4",
    "backward-euler",
    "tr-bdf2",
    "implicit-midpoint",
    "cvode-bdf",
    "cvode-adams",
]

# One mass of 1 kg on a spring of 1000 N/m, undamped: symplectic Euler is stable up to 2 / sqrt(1000) s = 0.063 s.
STIFF_PAIR = {
    "hooke": 1,
    "particles": {"position": [[0, 0, 0], [1.1, 0, 0]], "mass": 1, "pinned": [0]},
    "springs": [{"between": [[0, 1]], "law": "length", "stiffness": 1000, "rest_length": 1}],
    "run": {"method": "symplectic-euler", "step": 0.1, "duration": 100, "every": 1},
}


def hanging_cloth(side, structural, **part):
    """A scene of a square cloth of side x side particles that hangs at two corners; `part` has what else it has."""
    cloth = {"kind": "cloth", "edges": [[1, 0, 0], [0, 0, 1]], "size": [side, side], "mass": 1, "pinned": "top-corners"}
    return {"hooke": 1, "gravity": [0, -9.81, 0], "parts": [{**cloth, "structural": structural, **part}]}


# Runs for hours, with a frame every few milliseconds.
ENDLESS = copy.deepcopy(SIX_PARTICLES)
ENDLESS["run"].update(duration=1e6, every=100)


def pytest_collection_modifyitems(items):
    for item in items:
        if MINIMAL and item.get_closest_marker("everything"):
            item.add_marker(pytest.mark.skip(reason="the minimal build reads no scenes"))


class Answer:
    """The result of one call of the program: exit code, standard output, standard error."""

    def __init__(self, code, out, err):
        self.code, self.out, self.err = code, out, err

    @property
    def json(self):
        """Standard output as JSON; anything but one strict object and a line end is an error."""

        def refuse(word):
            raise ValueError(f"{word} is not JSON")

        assert self.out.endswith("}\n"), self.out
        value = json.loads(self.out, parse_constant=refuse)
        assert isinstance(value, dict)
        return value


def open_terminal():
    try:
        return pty.openpty()
    except OSError as error:
        pytest.skip(f"no terminal to be had here: {error}")


def default_signals():
    """A test run in the background passes ignored signals on, which the program would rightly keep ignoring."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


@pytest.fixture
def hooke(tmp_path):
    """Calls the program in an empty folder: hooke("run", "scene.json", ...); with code, err and out, its exit code, texts that
    standard error contains, and standard output have to be those."""

    def call(*words, code=None, err=(), out=None, **options):
        words = [word if isinstance(word, bytes) else str(word) for word in words]
        done = subprocess.run([CLI, *words], cwd=tmp_path, capture_output=True, text=True, timeout=240, **options)
        assert done.returncode >= 0, f"killed by signal {-done.returncode}\n{done.stderr}"
        assert "Sanitizer" not in done.stderr, done.stderr
        assert code in (None, done.returncode), done.stderr
        missing = [text for text in ([err] if isinstance(err, str) else err) if text not in done.stderr]
        assert not missing, done.stderr
        assert out in (None, done.stdout)
        return Answer(done.returncode, done.stdout, done.stderr)

    return call


def used(process):
    """Seconds of processor, which are the same on a busy machine."""
    fields = Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")


def interrupt(process, after=0.0, number=signal.SIGINT):
    """Ctrl-C, or another signal, once the program handles it and has used so many more seconds of processor."""
    while int(re.search(r"SigCgt:\s*(\w+)", Path(f"/proc/{process.pid}/status").read_text()).group(1), 16) & 2 == 0:
        assert process.poll() is None
        time.sleep(0.01)
    begun = used(process)
    while used(process) < begun + after:
        assert process.poll() is None
        time.sleep(0.01)
    assert process.poll() is None
    process.send_signal(number)


@pytest.fixture
def start(tmp_path):
    """Starts the program without waiting for it; whatever still runs at the end of the test is killed."""
    running = []

    def call(*words, **options):
        options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "preexec_fn": default_signals, **options}
        running.append(subprocess.Popen([CLI, *map(str, words)], cwd=tmp_path, **options))
        return running[-1]

    yield call
    for process in running:
        if process.poll() is None:
            process.kill()
        process.communicate()


@pytest.fixture
def write(tmp_path):
    """Writes a scene with changes to its run and returns its name: write(SIX_PARTICLES, step=0.1); None removes a
    key."""

    def put(scene, name="scene.json", **run):
        scene = copy.deepcopy(scene)
        scene.setdefault("run", {}).update(run)
        scene["run"] = {key: value for key, value in scene["run"].items() if value is not None}
        (tmp_path / name).write_text(json.dumps(scene))
        return name

    return put
