"""Faulty scenes: each ends with exit code 3 and a message that names file, place, value and what is allowed."""

import copy
import json
import os
import pathlib
import subprocess

import pytest
from conftest import CLI, SIX_PARTICLES

pytestmark = pytest.mark.everything

FOLDER = pathlib.Path(__file__).parent / "scenes" / "bad"

# file: (line:column, path in the scene or "", the value, what is allowed)
EXPECTED = {
    # not JSON at all
    "empty": ("1:1", "", "is empty", "one JSON object"),
    "blank": ("3:1", "", "is empty", "one JSON object"),
    "array-at-top": ("1:1", "", "[ is not JSON", "one JSON object"),
    "text-at-top": ("1:1", "", "hooke is not JSON", "one JSON object"),
    "truncated": ("9:54", "", "ends too early", "one whole JSON object"),
    "trailing-comma": ("5:22", "", "] is not JSON", "no comma before it"),
    "missing-comma": ("6:5", "", '"pinned" is not JSON', ", or }"),
    "comment": ("2:15", "", "a comment", 'the "key" of a value'),
    "two-objects": ("13:1", "", "text after the end", "nothing after it"),
    "duplicate-key": ("6:5", "particles.mass", "is given twice", "each key once"),
    "not-utf8": ("2:28", "", "byte 0xe9", "UTF-8"),
    "utf16": ("1:1", "", "byte 0xff", "UTF-8"),
    "byte-order-mark": ("1:1", "", "a byte order mark is not JSON", "starting with {"),
    "nul-byte": ("2:14", "", "NUL byte", "UTF-8"),
    "nul-in-text": ("2:26", "", "\\u0000 is not JSON", "neither U+0000"),
    "control-character": ("2:26", "", "control character 0x1b", "\\u001b"),
    "deep": ("2:42", "", "nested 33 levels", "up to 32"),
    "nan": ("5:17", "", "NaN", "a finite decimal number"),
    "infinity": ("4:30", "", "-Infinity", "a finite decimal number"),
    "hexadecimal": ("9:49", "", "0x64", "a finite decimal number"),
    "leading-zero": ("9:49", "", "0100", "a finite decimal number"),
    "huge-exponent": ("9:49", "", "1e999", "up to 1.797e308"),
    "tiny-exponent": ("9:65", "", "1e-999", "from 4.94e-324 up"),
    "huge-integer": ("9:31", "", "9223372036854775808", "64 bits"),
    "capital-true": ("9:69", "", "True", "true, false"),
    # the top level
    "nothing": ("1:1", "hooke", "missing", "allowed: 1"),
    "no-version": ("1:1", "hooke", "missing", "allowed: 1"),
    "other-version": ("2:12", "hooke", "2 is not", "allowed: 1"),
    "version-as-text": ("2:12", "hooke", '"1"', "allowed: 1"),
    "no-particles": ("1:1", "", "without particles", "particles, parts or both"),
    "unknown-key": ("8:3", "spring", '"spring"', 'did you mean "springs"?'),
    "strange-key": ("1:1", "", 'unknown key "?[2J?."', "hooke, particles, springs"),
    "title-number": ("3:12", "title", "7", "a text"),
    "gravity-number": ("3:14", "gravity", "-9.81", "3 numbers [m/s^2]"),
    "gravity-of-two": ("3:14", "gravity", "2 numbers", "3 numbers [m/s^2]"),
    "gravity-text": ("3:18", "gravity[1]", '"-9.81"', "a number"),
    "drag-negative": ("3:11", "drag", "-0.5", "a number >= 0 [N s/m]"),
    "particles-array": ("3:16", "particles", "an array of 1", "an object"),
    "springs-object": ("9:5", "springs", "an object", "an array of objects"),
    # particles
    "no-mass": ("3:16", "particles.mass", "missing", "one or more numbers > 0 [kg]"),
    "no-position": ("3:16", "particles.position", "missing", "rows of 3 numbers each [m]"),
    "position-of-two": ("4:29", "particles.position[1]", "an array of 2", "a row of 3 numbers"),
    "position-null": ("4:44", "particles.position[2][1]", "null", "a number"),
    "position-flat": ("4:18", "particles.position[0]", "0 is not", "a row of 3 numbers"),
    "velocity-rows": ("5:17", "particles.velocity", "2 rows", "3, one for each position"),
    "mass-zero": ("5:17", "particles.mass[1]", "0 is not", "numbers > 0 [kg]"),
    "mass-count": ("5:13", "particles.mass", "2 masses for 3 particles", "one, or one for each"),
    "pinned-range": ("6:19", "particles.pinned[1]", "3", "0 to 2"),
    "pinned-negative": ("6:16", "particles.pinned[0]", "-1", "whole numbers >= 0"),
    "pinned-real": ("6:16", "particles.pinned[0]", "0.0", "a whole number"),
    "pinned-number": ("6:15", "particles.pinned", "0 is not", "any number of whole numbers"),
    "pinned-moving": ("5:22", "particles.velocity[0][1]", "velocity 2", "has velocity 0"),
    # springs
    "between-missing": ("9:5", "springs[0].between", "missing", "pairs of particles"),
    "between-range": ("9:31", "springs[0].between[1][1]", "3", "0 to 2"),
    "between-negative": ("9:31", "springs[0].between[1][1]", "-2", "0 to 2"),
    "between-same": ("9:27", "springs[0].between[1]", "particles 1 and 1", "two different ones"),
    "between-real": ("9:31", "springs[0].between[1][1]", "2.0", "the number of a particle"),
    "between-triple": ("9:27", "springs[0].between[1]", "an array of 3", "a row of 2"),
    "between-flat": ("9:19", "springs[0].between[0]", "0 is not", "a row of 2"),
    "stiffness-missing": ("9:5", "springs[0].stiffness", "missing", "numbers >= 0"),
    "stiffness-negative": ("9:49", "springs[0].stiffness", "-100", "numbers >= 0 [N (strain law), N/m (length law)]"),
    "stiffness-element": ("9:55", "springs[0].stiffness[1]", "-200000", "numbers >= 0"),
    "stiffness-text": ("9:49", "springs[0].stiffness", '"100"', "numbers >= 0"),
    "stiffness-count": ("9:49", "springs[0].stiffness", "3 values for 2 springs", "one, or one for each"),
    "stiffness-misspelt": ("9:36", "springs[0].stifness", '"stifness"', 'did you mean "stiffness"?'),
    "damping-negative": ("9:65", "springs[0].damping", "-0.1", "numbers >= 0"),
    "law-unknown": ("9:61", "springs[0].law", '"hook"', '"strain" or "length"'),
    "rest-length-word": ("9:69", "springs[0].rest_length", '"start"', 'or "initial"'),
    "rest-length-zero": ("9:73", "springs[0].rest_length[1]", "rest length 0", "> 0"),
    "rest-length-coincident": ("9:19", "springs[0].between[0]", "rest length 0", "> 0"),
    "rest-scale-zero": ("9:68", "springs[0].rest_scale", "0 is not", "a number > 0"),
    "compression-number": ("9:69", "springs[0].compression", "1 is not", "true or false"),
    # parts
    "kind-missing": ("4:5", "parts[0].kind", "missing", "rope, cloth"),
    "kind-unknown": ("5:15", "parts[0].kind", '"trellis"', "rope, cloth"),
    "part-key": ("5:75", "parts[0].segment", '"segment"', 'did you mean "segments"?'),
    "segments-zero": ("5:87", "parts[0].segments", "0 is not", "a whole number >= 1"),
    "segments-real": ("5:87", "parts[0].segments", "4.0", "a whole number >= 1"),
    "part-pinned-word": ("6:18", "parts[0].pinned[0]", '"middle"', '"start" or "end"'),
    "part-pinned-range": ("6:27", "parts[0].pinned[1]", "5", "0 to 4"),
    "part-unknown": ("11:34", "springs[0].between[0][1][0]", '"rope"', "allowed: line"),
    "part-index": ("11:42", "springs[0].between[0][1][1]", "5", "0 to 4"),
    "part-names": ("9:31", "parts[1].name", '"line"', "a name of its own"),
    "family-key": ("7:38", "parts[0].stretch.colour", '"colour"', "stiffness, damping, damping_ratio, rest_scale, compression"),
    "family-number": ("7:18", "parts[0].stretch", "100", "an object of stiffness"),
    "family-empty": ("7:18", "parts[0].stretch.stiffness", "missing", "a number >= 0 [N]"),
    "rope-of-no-length": ("7:18", "parts[0].stretch", "0 m", "> 0"),
    "cloth-size": ("5:90", "parts[0].size[1]", "1 is not", "2 whole numbers >= 2"),
    "cloth-edges": ("5:54", "parts[0].edges", "1 row", "2 rows of 3 numbers"),
    "cloth-mass": ("5:102", "parts[0].mass", "-1", "a number > 0 [kg]"),
    "cloth-pinned": ("6:17", "parts[0].pinned", '"top-corner"', '"top-corners"'),
    "mass-and-density": ("6:29", "parts[0].density", "mass and density are both given", "one of mass (total, kg)"),
    "mass-or-density": ("4:5", "parts[0]", "neither mass nor density", "one of mass (total, kg) and density"),
    "density-zero": ("6:18", "parts[0].density", "0 is not", "a number > 0 [kg/m]"),
    "density-of-no-length": ("6:18", "parts[0].density", "0 kg", "> 0"),
    "bending-negative": ("6:32", "parts[0].bending", "-3", "a number >= 0 [N m^2]"),
    "bending-of-no-length": ("4:96", "parts[0].bending", "inf N/m", "> 0 up to 1e300"),
    "damping-twice": ("7:71", "parts[0].stretch.damping_ratio", "both given", "a family has one of them"),
    "damping-ratio-negative": ("7:55", "parts[0].stretch.damping_ratio", "-0.5", "a number >= 0"),
    "lattice-size": ("5:106", "parts[0].size[2]", "1 is not", "3 whole numbers >= 2"),
    "lattice-edges": ("5:56", "parts[0].edges", "2 rows", "3 rows of 3 numbers"),
    "lattice-huge": ("5:99", "parts[0].size", "8000000000 particles, 2.3988e+10 springs", "2147483647 of each"),
    "lattice-flat": ("5:56", "parts[0].edges", "span no volume", "vectors in different directions"),
    "lattice-of-no-length": ("7:21", "parts[0].structural", "0 m", "> 0"),
    "lattice-pinned": ("6:28", "parts[0].pinned[1]", '"left"', '"bottom" or "top"'),
    "lattice-pinned-range": ("6:22", "parts[0].pinned[1]", "27", "0 to 26"),
    "mesh-empty": ("4:5", "parts[0].vertices", "missing", "a file, or vertices and triangles"),
    "mesh-half": ("4:5", "parts[0].triangles", "missing", "a file, or vertices and triangles"),
    "mesh-both": ("5:55", "parts[0].vertices", "without a file", "a file, or vertices and triangles"),
    "mesh-file-missing": ("5:31", "parts[0].file", '"none.obj"', "a file in the scene's folder"),
    "mesh-file-above": ("5:31", "parts[0].file", '"../empty.obj"', "inside the scene's folder"),
    "mesh-file-scene": ("5:31", "parts[0].file", 'mesh-empty.json:1: "{"', "v and f"),
    "mesh-range": ("6:39", "parts[0].triangles[1][2]", "no vertex 4", "0 to 3"),
    "mesh-corners": ("6:43", "parts[0].triangles[2]", "vertex 3 is two", "three different ones"),
    "mesh-welded": ("6:32", "parts[0].triangles[1]", "corners 1 and 3 become one particle", "three different ones"),
    "mesh-flat": ("6:32", "parts[0].triangles[1]", "vertices 0, 1 and 3 has no area", "an area > 0"),
    "mesh-unused": ("5:69", "parts[0].vertices[3]", "vertex 3 is in no face", "vertices of faces only"),
    "mesh-crowded": ("6:43", "parts[0].triangles[2]", "0 and 1 has a third face", "two faces at an edge"),
    "mesh-twice": ("6:43", "parts[0].triangles[2]", "0, 1 and 2, after that of triangle 0", "each face once"),
    "mesh-triangle-of-four": ("6:21", "parts[0].triangles[0]", "an array of 4", "a row of 3 whole numbers"),
    "mesh-transform": ("6:67", "parts[0].transform.scale", "0 is not", "a number > 0"),
    "mesh-transform-key": ("6:58", "parts[0].transform.rotate", '"rotate"', "scale, translate"),
    "mesh-weld": ("6:52", "parts[0].weld", "-1", "a number >= 0 [m]"),
    "strand-curl-alone": ("6:15", "parts[0].curl", "turns is missing", "both curl (its radius) and turns"),
    "strand-turns-alone": ("6:16", "parts[0].turns", "curl is missing", "both curl (its radius) and turns"),
    "strand-offset-of-curl": ("6:42", "parts[0].offset", "a curl has no extra particles", "a strand without curl"),
    "strand-offset-zero": ("6:17", "parts[0].offset", "0 is not", "a number > 0 and <= 100"),
    "strand-of-no-length": ("5:66", "parts[0].to", "0 m long", "> 0"),
    "strand-flat": ("7:52", "parts[0].altitude", "particles 0, 1, 2 and 3 lie in a plane", "more than 1e-9"),
    "strand-nearly-straight": ("7:52", "parts[0].altitude", "e-12 m", "more than 1e-9"),
    "strand-pinned": ("6:25", "parts[0].pinned[1]", '"middle"', '"start" or "end"'),
    "strand-damping-twice": ("7:101", "parts[0].altitude.damping_ratio", "both given", "a family has one of them"),
    "strand-twist-key": ("6:7", "parts[0].torsion", '"torsion"', "stretch, bend, twist, altitude"),
    # driven particles
    "motion-unknown": ("8:35", "driven[0].motion", '"circular"', '"harmonic" or "table"'),
    "motion-mixed": ("8:95", "driven[0].time", '"table"', "amplitude, frequency, phase"),
    "frequency-missing": ("8:5", "driven[0].frequency", "missing", 'required with motion "harmonic"'),
    "driven-range": ("8:24", "driven[0].particles[1]", "2", "0 to 1"),
    "driven-pinned": ("8:21", "driven[0].particles[0]", "particle 0", "pinned or driven"),
    "driven-twice": ("8:27", "driven[0].particles[2]", "particle 0", "driven once"),
    "table-order": ("8:59", "driven[0].time[2]", "1 is not", "ascend"),
    "table-rows": ("9:19", "driven[0].position", "2 rows", "3, one for each time"),
    # the run
    "run-key": ("11:12", "run.stepsize", '"stepsize"', "method, step, duration"),
    "step-zero": ("11:20", "run.step", "0 is not", "a number > 0 [s]"),
    "step-text": ("11:20", "run.step", '"fast"', "a number > 0 [s]"),
    "method-unknown": ("11:22", "run.method", '"euler"', "forward-euler, symplectic-euler"),
    "threads-real": ("11:23", "run.threads", "1.5", "a whole number >= 1"),
    "rtol-large": ("11:20", "run.rtol", "2 is not", "<= 0.1"),
    # files that a scene names
    "file-above": ("4:27", "particles.position.file", '"../empty.h5"', "inside the scene's folder"),
    "file-absolute": ("4:27", "particles.position.file", '"/etc/passwd"', "inside the scene's folder"),
    "file-missing": ("4:27", "particles.position.file", '"none.h5"', "a file in the scene's folder"),
    "file-not-hdf5": ("4:27", "particles.position.file", "empty.json", "HDF5"),
    "file-key": ("4:52", "particles.position.frames", '"frames"', "file, dataset, frame"),
    "file-frame": ("4:61", "particles.position.frame", "0.5", "a whole number"),
}


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


def test_every_file_is_expected():
    assert sorted(path.stem for path in FOLDER.iterdir()) == sorted(EXPECTED)
    assert len(EXPECTED) >= 50


@pytest.mark.check
@pytest.mark.parametrize("verb", ["check", "run"])
@pytest.mark.parametrize("name", EXPECTED)
def test_message(hooke, verb, name):
    path = FOLDER / f"{name}.json"
    answer = hooke(verb, path)
    check_message(answer, path.name, *EXPECTED[name])
    if EXPECTED[name][0]:
        check_caret(answer.err.splitlines()[1:3], path, *map(int, EXPECTED[name][0].split(":")))


def test_json_keeps_standard_output_json(hooke):
    answer = hooke("check", FOLDER / "mass-zero.json", "--json")
    assert answer.code == 3
    error = answer.json["error"]
    assert error["exit"] == 3
    assert "mass-zero.json:5:17: particles.mass[1]: 0 is not allowed" in error["message"]


# ---- files that cannot be in the folder ----


def test_missing_file(hooke):
    check_message(hooke("check", "no-such.json"), "no-such.json", "", "", "No such file", "a scene file")


def test_folder_instead_of_file(hooke, tmp_path):
    (tmp_path / "folder.json").mkdir()
    check_message(hooke("run", "folder.json"), "folder.json", "", "", "directory", "a scene file")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may read everything")
def test_unreadable_file(hooke, tmp_path):
    (tmp_path / "secret.json").write_text("{}")
    (tmp_path / "secret.json").chmod(0)
    check_message(hooke("check", "secret.json"), "secret.json", "", "", "Permission denied", "a scene file")


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
