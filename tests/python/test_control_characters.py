"""Names and files with terminal control characters: in messages, warnings, bars and printed results."""

import copy
import re

import pytest
from conftest import SIX_PARTICLES

import hooke

EVIL = "\x1b[31m\r\n\t\x07\x7f\x85\x9b2J\u061c\u200e\u200f\u2028\u2029\u202a\u202e\u2066\u2069"
PLAIN = re.sub(r"[^\[ -~]", "?", EVIL)

ROPE = {"kind": "rope", "name": "rope" + EVIL, "from": [9, 0, 0], "to": [9.4, 0, 0], "segments": 4, "mass": 0.1,
        "pinned": "start", "stretch": {"stiffness": 100, "damping": 0.05}}


@pytest.fixture
def scene():
    text = copy.deepcopy(SIX_PARTICLES)
    text["springs"][0]["name"] = "group" + EVIL
    text["parts"] = [ROPE]
    return hooke.Scene.parse(text)


def check(shown, *names):
    assert all(character.isprintable() or character == "\n" for character in shown), repr(shown)
    for name in names:
        assert name + PLAIN in shown, shown


def test_messages(tmp_path, scene):
    with pytest.raises(hooke.Error) as failure:
        hooke.Scene.load(tmp_path / EVIL)
    check(str(failure.value), "")
    with pytest.raises(hooke.BadValue) as failure:
        scene.run(want="10 " + EVIL)
    check(str(failure.value))
    check(str(hooke.BadValue("part" + EVIL)), "part")
    scene.run(duration=0.05, output=tmp_path / (EVIL + ".h5"))
    with hooke.Trajectory(tmp_path / (EVIL + ".h5")) as trajectory, pytest.raises(IndexError) as failure:
        trajectory[1000]
    check(str(failure.value), "")


def test_warnings_and_reasons(scene):
    with pytest.warns(hooke.StepWarning, match="rope") as warned:
        result = scene.run(step=0.05, every=0.05, duration=10)
    check(str(warned[0].message), "rope")
    why = hooke.why(result)
    check(str(why), "rope")
    check(str(why.blame[0]), "rope")


def test_a_bar(scene, capfd):
    hooke.needs(scene, 0.1, duration=0.5, refine=True, progress=True)
    shown = capfd.readouterr().err
    check(shown.replace("\r", ""), "rope")
