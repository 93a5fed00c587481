"""Faulty scenes: each ends with exit code 3 and a message that names file, place, value and what is allowed."""

import copy
import json
import os
import subprocess

import pytest
from bad_scenes import BAD
from conftest import CLI, SIX_PARTICLES

pytestmark = pytest.mark.everything


def check_message(answer, name, place, path, value, allowed):
    assert answer.code == 3, answer.err
    assert answer.out == ""
    message = answer.err.splitlines()[0]
    start = name + (f":{place}" if place else "") + ": " + (f"{path}: " if path else "")
    assert start in message, message
    words = message.split(start, 1)[1]
    assert value in words, message
    assert allowed in words, message
    assert all(c.isprintable() for c in message), repr(message)


def check_caret(lines, path, line, column):
    """The caret stands under the place: the text above it is that of the file from there on."""
    source = path.read_bytes().split(b"\n")[line - 1].decode("latin1").split("\0")[0].rstrip("\r").replace("\t", " ")
    number, shown = lines[0].split(" | ", 1)
    at = lines[1].index("^") - len(number) - 3
    assert int(number) == line and lines[1].split() == ["|", "^"]
    assert len(shown) <= 90
    if source.isascii() and source.isprintable():
        assert source[column - 1 :].startswith(shown[at:]) and len(shown[at:]) >= min(25, len(source) - column + 1)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bad")
    for name, row in BAD.items():
        (folder / f"{name}.json").write_bytes(row[0].encode("latin1"))
    return folder


@pytest.mark.check
@pytest.mark.parametrize("verb", ["check", "run"])
@pytest.mark.parametrize("name", BAD)
def test_message(hooke, folder, verb, name):
    path = folder / f"{name}.json"
    _, place, *said = BAD[name]
    answer = hooke(verb, path)
    check_message(answer, path.name, place, *said)
    check_caret(answer.err.splitlines()[1:3], path, *map(int, place.split(":")))


def test_json_keeps_standard_output_json(hooke, folder):
    answer = hooke("check", folder / "mass-zero.json", "--json")
    assert answer.code == 3
    error = answer.json["error"]
    assert error["exit"] == 3
    assert "mass-zero.json:5:17: particles.mass[1]: 0 is not allowed" in error["message"]


# ---- files that cannot be in the folder ----


def test_missing_file(hooke):
    check_message(hooke("check", "no-such.json"), "no-such.json", "", "", "No such file", "a scene or trajectory file")


def test_folder_instead_of_file(hooke, tmp_path):
    (tmp_path / "folder.json").mkdir()
    check_message(hooke("run", "folder.json"), "folder.json", "", "", "directory", "a scene or trajectory file")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_unreadable_file(hooke, tmp_path):
    (tmp_path / "secret.json").write_text("{}")
    (tmp_path / "secret.json").chmod(0)
    check_message(hooke("check", "secret.json"), "secret.json", "", "", "Permission denied", "a scene or trajectory file")


def test_link_out_of_the_folder(hooke, tmp_path):
    (tmp_path / "inner").mkdir()
    (tmp_path / "q.h5").write_bytes(b"")
    (tmp_path / "inner" / "q.h5").symlink_to("../q.h5")
    source = {"file": "q.h5", "dataset": "/q"}
    (tmp_path / "inner" / "scene.json").write_text(json.dumps({"hooke": 1, "particles": {"position": source, "mass": 1}}))
    answer = hooke("check", "inner/scene.json")
    check_message(answer, "scene.json", "1:49", "particles.position.file", '"q.h5"', "inside it")


def test_long_names_keep_the_place(hooke, tmp_path):
    folder = tmp_path / ("a" * 120) / ("b" * 120)
    folder.mkdir(parents=True)
    (folder / "scene.json").write_text('{"hooke": 3}')
    check_message(hooke("check", folder / "scene.json"), "scene.json", "1:11", "hooke", "3", "allowed: 1")


LONG = 200_000_000
LONG_TEXTS = {
    "open": ("[", ""),
    "open-objects": ('{"a":', ""),
    "open-inside": ("[", '{"hooke": 1, "parts": '),
    "pairs": ("[],", '{"hooke": 1, "parts": ['),
    "objects": ("{},", '{"hooke": 1, "springs": ['),
    "close": ("]", '{"hooke": 1, "parts": []'),
}


@pytest.mark.check
@pytest.mark.parametrize("kind", LONG_TEXTS)
def test_200_megabytes_of_brackets(tmp_path, kind):
    """Refused at once: in seconds, and with little memory."""
    piece, start = LONG_TEXTS[kind]
    path = tmp_path / "long.json"
    with open(path, "w") as file:
        file.write(start)
        block = piece * 1_000_000
        for _ in range(LONG // len(block)):
            file.write(block)
    process = subprocess.Popen([CLI, "check", str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    error = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    process.stdout.close()
    process.stderr.close()
    path.unlink()
    assert process.returncode == 3, error
    assert "long.json:1:" in error and "allowed" in error and "Sanitizer" not in error
    assert usage.ru_utime < 20
    assert usage.ru_maxrss < 200_000, "kilobytes"


# ---- several faults ----

SEVERAL = """{
 "hooke": 1,
 "gravty": [0, 0, -9.81],
 "particles": {"position": [[0, 0, 0], [1, 0, 0]], "mass": [1, -1], "pined": [0]},
 "parts": [{"kind": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 2.5, "mass": "1 m"},
           {"kind": "clot"},
           {"kind": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 2, "mass": 1, "stretch": {"stifness": 1}}],
 "springs": [{"between": [[0, 700]], "stiffness": 1}],
 "run": {"method": "rk5", "duration": -1, "step": 1e-3}
}
"""


def test_all_faults_are_told_at_once(hooke, tmp_path):
    path = tmp_path / "several.json"
    path.write_text(SEVERAL)
    answer = hooke("check", path)
    lines = answer.err.splitlines()
    told = [line.split("several.json:", 1)[1] for line in lines[::3]]
    assert answer.code == 3
    assert [line.split(": ")[1] for line in told] == [
        "gravty",
        "particles.mass[1]",
        "particles.pined",
        "parts[0].segments",
        "parts[0].mass",
        "parts[1].kind",
        "parts[2].stretch.stifness",
        "run.duration",
    ]
    for number, line in enumerate(told):
        check_caret(lines[3 * number + 1 :], path, *map(int, line.split(":")[:2]))


def test_springs_are_read_once_their_particles_are_right(hooke, tmp_path):
    path = tmp_path / "several.json"
    group = {"between": [[0, 1]], "stiffness": 1}
    springs = [{**group, "stiffness": -1}, group, {**group, "between": [[0, 2]]}, {**group, "law": "cubic"}]
    path.write_text(json.dumps({"hooke": 1, "particles": {"position": [[0, 0, 0], [1, 0, 0]], "mass": 1}, "springs": springs}))
    told = hooke("check", path, "--json").json["error"]["message"].splitlines()
    assert [line.split(": ")[1] for line in told] == ["springs[0].stiffness", "springs[2].between[0][1]", "springs[3].law"]


def test_no_more_than_twenty_faults_are_told(hooke, tmp_path):
    path = tmp_path / "many.json"
    path.write_text(json.dumps({"hooke": 1, "parts": [{"kind": "clot"}] * 100_000}))
    assert len(hooke("check", path, "--json").json["error"]["message"].splitlines()) == 20


def test_a_bad_scene_in_a_trajectory_is_quoted_as_text(hooke, write, tmp_path):
    h5py = pytest.importorskip("h5py")
    scene = copy.deepcopy(SIX_PARTICLES)
    scene["title"] = "a title"
    (tmp_path / "scene.json").write_text(json.dumps(scene, indent=1))
    assert hooke("run", "scene.json", "-o", "out.h5", "-q").code == 0
    with h5py.File(tmp_path / "out.h5", "r+") as file:
        del file["hooke/file_check"]
        text = file["hooke/scene"][()]
        file["hooke/scene"][()] = text.replace(b'"stiffness": 100', b'"stiffness": -10')
    line = text.split(b"\n").index(b'   "stiffness": 100,') + 1
    said = f"""out.h5:{line}:17: springs[0].stiffness: -10 is not allowed; allowed: one or more numbers >= 0 [N (strain law), N/m (length law)]
{line:6} |    "stiffness": -10,
       |                 ^
"""
    for verb in (["run"], ["run", "--resume"], ["check"], ["why"], ["limit", "--predict"], ["verify"], ["view", "--step", "1e-4"],
                 ["compare"], ["needs", "--want", "1mm"]):
        answer = hooke(*verb, "out.h5")
        assert answer.code == 3 and answer.err == f"hooke {verb[0]}: {said}", answer.err
    assert hooke("run", "out.h5", "--json").json["error"]["message"] == said.split("\n")[0]
