"""Titles, names and file names with terminal control characters: their output in words and as JSON."""

import contextlib
import copy
import json
import os
import re
import subprocess

import pytest
from conftest import CLI, SIX_PARTICLES, STIFF_PAIR, open_terminal

pytestmark = pytest.mark.everything

EVIL = "\x1b[31m\r\n\t\x07\x7f\x85\x9b2J\u061c\u200e\u200f\u2028\u2029\u202a\u202e\u2066\u2069"
PLAIN = re.sub(r"[^\[ -~]", "?", EVIL)
FILE = os.fsencode(EVIL) + b"\xff\xc2' \\"
CONTROL = re.compile("[\0-\x09\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")

ROPE = {"kind": "rope", "name": "rope" + EVIL, "from": [9, 0, 0], "to": [9.4, 0, 0], "segments": 4, "mass": 0.1,
        "pinned": "start", "stretch": {"stiffness": 100, "damping": 0.05}}


def scene_of(scene, parts=(), **run):
    scene = copy.deepcopy(scene)
    scene["title"] = "title" + EVIL
    scene["springs"][0]["name"] = "group" + EVIL
    scene["parts"] = list(parts)
    scene["run"].update(run)
    return scene


@pytest.fixture
def call(tmp_path):
    """Calls the program and returns exit code and both outputs, which contain no control characters."""

    def run(*words):
        done = subprocess.run([CLI, *words], cwd=tmp_path, capture_output=True, timeout=240)
        out, err = done.stdout.decode(), done.stderr.decode()
        for text in (out, err):
            assert not CONTROL.search(text), (words, text)
        return done.returncode, out, err

    return run


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "scene.json").write_text(json.dumps(scene_of(SIX_PARTICLES, [ROPE], duration=0.1)))
    (tmp_path / "stiff.json").write_text(json.dumps(scene_of(STIFF_PAIR)))
    return "scene.json"


def test_a_scene_that_is_made_escapes_them(call):
    out = call(*"make rope --from 0,0,0 --to 1,0,0 --segments 2 --stretch.stiffness 1 --density 1 --name".split(),
               "rope" + EVIL, "--title", "title" + EVIL)[1]
    scene = json.loads(out)
    assert (scene["title"], scene["parts"][0]["name"]) == ("title" + EVIL, "rope" + EVIL)


def test_file_names(call, scene, tmp_path):
    here = os.fsencode(tmp_path) + b"/"
    os.rename(here + b"scene.json", here + FILE)
    for words in ([b"run", FILE, b"-o", FILE + b".h5"], [b"verify", FILE + b".h5"], [b"compare", FILE, b"-o", FILE + b"2.h5"],
                  [b"view", FILE + b".h5", b"-o", FILE + b".html"], [b"run", b"--resume", FILE + b".h5"]):
        code, out, err = call(*words)
        assert code == 0 and PLAIN in out + err, err


def test_refusals(call, scene, tmp_path):
    (tmp_path / "unknown.json").write_text(json.dumps({**scene_of(SIX_PARTICLES), "key" + EVIL: 1}))
    method = scene_of(SIX_PARTICLES, method="method" + EVIL)
    (tmp_path / "method.json").write_text(json.dumps(method))
    for words in (["check", "unknown.json"], ["run", "method.json"], ["run", FILE], ["make", FILE], [FILE], ["run", scene, FILE],
                  ["run", scene, "--" + EVIL], ["run", scene, "--method", FILE], ["run", scene, "--step", FILE],
                  ["view", FILE, "-o", "page.html"], ["limit", scene, "--at", FILE], ["study", scene, "--watch", FILE],
                  ["run", scene, "-o", FILE + b"/x"]):
        code, out, err = call(*words)
        message, *excerpt = err.splitlines()
        assert code != 0 and "?" in message, (words, err)
        assert not excerpt or [line[6:9] for line in excerpt] == [" | ", " | "], (words, err)
        if words[0] != FILE:
            code, out, err = call(*words, "--json")
            assert code != 0
            assert not out or json.loads(out)["error"]["message"]


def test_an_advised_command_is_one_line_for_the_shell(call, scene, tmp_path):
    code, out, err = call("needs", scene, "--want", "10cm", "-o", FILE)
    assert code == 0, err
    command = next(line for line in out.splitlines() if "hooke run" in line).strip()
    words = subprocess.run(["bash", "-c", f"hooke() {{ printf '%s\\0' \"$@\"; }}; {command}"], capture_output=True, check=True)
    assert words.stdout.split(b"\0") == [b"run", FILE, b""]
    assert "\\n" in command


def shown_on_terminal(folder, looked_for, *words):
    """Output of a call on standard error, on a terminal, where everything after the first second is shown; the call
    is ended once the wanted output appears."""
    terminal, end = open_terminal()
    plain = {**os.environ, "NO_COLOR": "1"}  # or the program itself changes colours
    process = subprocess.Popen([CLI, *words], cwd=folder, env=plain, stderr=end, stdout=subprocess.DEVNULL)
    os.close(end)
    shown = b""
    with contextlib.suppress(OSError):  # which tells the end
        while more := os.read(terminal, 4096):
            shown += more
            if looked_for.encode() in shown:
                process.terminate()
    os.close(terminal)
    assert process.wait() in (0, 130)
    return shown.decode().replace("\r\x1b[K", "").replace("\r\n", "\n")  # as a terminal ends lines


def test_progress(scene, tmp_path):
    """The part in question is shown as progress: most of the time one of many is; their duration depends on the
    machine."""
    ropes = [{**ROPE, "name": f"{k}{ROPE['name']}"} for k in range(40)]
    shown, duration = "", 0.5
    while "rope" not in shown and duration < 1e5:
        (tmp_path / scene).write_text(json.dumps(scene_of(SIX_PARTICLES, ropes, duration=duration)))
        shown = shown_on_terminal(tmp_path, "rope" + PLAIN, "needs", scene, "--want", "10m", "--method", "verlet", "--refine")
        duration *= 2
    assert "rope" + PLAIN in shown and not CONTROL.search(shown), shown[:400]
