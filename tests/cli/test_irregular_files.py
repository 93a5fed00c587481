"""Pipes, devices, folders and sockets as inputs: every verb refuses them at once, in the same words."""

import json
import os
import socket

import pytest
from conftest import SIX_PARTICLES

pytestmark = pytest.mark.everything

VERBS = [["run"], ["check"], ["compare"], ["study"], ["limit"], ["why"], ["needs", "--want", "1mm"], ["view", "-o", "page.html"],
         ["run", "--resume"]]
NO_PIPE = "is not a regular file; allowed: a scene or trajectory file, no pipe and no device"
KINDS = {
    "pipe": (NO_PIPE, os.mkfifo),
    "/dev/zero": (NO_PIPE, lambda _: None),
    "folder": ("is a directory; allowed: a scene or trajectory file", os.mkdir),
    "socket": ("cannot be opened: No such device or address; allowed: a scene or trajectory file that can be read",
               lambda path: socket.socket(socket.AF_UNIX).bind(str(path))),
}


@pytest.fixture(name="name", params=KINDS, ids=lambda name: name.strip("/").replace("/", "-"))
def fixture_name(request, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # the address of a socket has to be short
    KINDS[request.param][1](request.param)
    return request.param


@pytest.mark.parametrize("verb", VERBS, ids=" ".join)
def test_as_a_scene(hooke, name, verb):
    answer = hooke(*verb, name)
    assert (answer.code, answer.err) == (3, f"hooke {verb[0]}: {name}: {KINDS[name][0]}\n")


def test_as_a_trajectory(hooke, name):
    """Where no scene is allowed: as one that is not there."""
    said = f"{name}: {KINDS[name][0].replace('a scene or trajectory file', 'a file of HDF5')}\n" if name != "socket" else "No such device or address"
    hooke("verify", name, code=5, err=said)
    answer = hooke("view", name, name, "-o", "page.html")  # each may be a scene
    assert answer.code in (3, 6) and (KINDS[name][0] in answer.err or answer.code == 6)
    assert not os.path.exists("page.html")


def test_as_what_a_scene_names(hooke, name, tmp_path):
    answer = hooke("make", "mesh", "--file", name, "--mass", "1", "-o", "made.json")
    assert answer.code == 3 and KINDS[name][0].replace("scene or trajectory ", "") in answer.err and not os.path.exists("made.json")
    if name.startswith("/"):
        return  # no scene may name it
    for place in ({"parts": [{"kind": "mesh", "file": name, "mass": 1}]}, {"particles": {"position": {"file": name, "dataset": "q"}}}):
        scene = {"hooke": 1, **place, "run": SIX_PARTICLES["run"]}
        (tmp_path / "scene.json").write_text(json.dumps(scene))
        for verb in (["run"], ["view"], ["check"]):
            answer = hooke(*verb, "scene.json")
            assert answer.code == 3 and f"{name}" in answer.err, answer.err
