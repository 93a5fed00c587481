"""No verb writes over a file that it reads, by whatever name that is given."""

import json
import os
from pathlib import Path

import h5py
import pytest

pytestmark = pytest.mark.everything

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
SCENE = {
    "hooke": 1,
    "particles": {"position": {"file": "place.h5", "dataset": "/q"}, "mass": 1},
    "parts": [{"kind": "mesh", "file": "ball.obj", "mass": 1, "pinned": [0], "structural": {"stiffness": 10}}],
    "run": {"method": "verlet", "step": 0.01, "duration": 0.1},
}
# The outputs of every verb: the words before the name of the file, and the ending that the verb demands of it.
OUTPUTS = {
    "run": ("run scene.json -o", ""),
    "compare": ("compare scene.json --methods verlet -o", ".h5"),
    "compare --report": ("compare scene.json --methods verlet --report", ""),
    "study": ("study scene.json --methods verlet -o", ".h5"),
    "study --report": ("study scene.json --methods verlet --report", ""),
    "limit": ("limit scene.json --methods verlet --report", ""),
    "modes": ("modes scene.json --report", ""),
    "rest": ("rest scene.json -o", ".json"),
    "rest --report": ("rest scene.json --report", ""),
    "needs": ("needs scene.json --want 1m -o", ""),
    "needs --report": ("needs scene.json --want 1m --report", ""),
    "why": ("why scene.json --report", ""),
    "view": ("view scene.json -o", ""),
}


def other_names(folder, file, ending):
    """Names of a file: its own, a hard link, a link, a path about the folder."""
    os.link(folder / file, folder / f"hard{ending}")
    os.symlink(file, folder / f"soft{ending}")
    (folder / "inner").mkdir(exist_ok=True)
    own = [] if ending and not file.endswith(ending) else [file, f"inner/../{file}", str(folder / file)]
    return [*own, f"hard{ending}", f"soft{ending}"]


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "ball.obj").write_text(OBJ)
    with h5py.File(tmp_path / "place.h5", "w") as file:
        file["q"] = [[5.0, 0, 0]]
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    return tmp_path


def contents(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


@pytest.mark.parametrize(("output", "file"), [*((output, "ball.obj") for output in OUTPUTS),
                                              ("run", "place.h5"), ("run", "scene.json"), ("needs", "scene.json")])
def test_what_a_scene_reads(hooke, scene, output, file):
    words, ending = OUTPUTS[output]
    names = other_names(scene, file, ending)
    before = contents(scene)
    for name in names if output == "run" else names[-2:]:
        answer = hooke(*words.split(), name)
        said = "in .h5" if output == "run" and name.endswith((".json", ".obj")) else "is read, too"
        assert answer.code == 2 and said in answer.err, answer.err
    assert contents(scene) == before


def test_the_list_of_outputs_is_whole(hooke):
    """A verb with another option that writes a file is to be added above."""
    verbs = hooke("--help").out.split("verbs:\n")[1].split("\n\n")[0].splitlines()
    for verb in (line.split()[0] for line in verbs):
        words = [*(["make", "rope"] if verb == "make" else [verb]), "--help", "all"]
        flags = {word.strip(",") for line in hooke(*words).out.splitlines() for word in line.split()[:2]}
        found = {"-o", "--output", "--report"} & flags
        listed = {words.split()[-1] for words, _ in OUTPUTS.values() if words.split()[0] == verb}
        assert bool(found & {"-o", "--output"}) == ("-o" in listed or verb == "make"), verb
        assert ("--report" in found) == ("--report" in listed), verb


def test_names_that_are_made(hooke, scene):
    """The page of a view has the name of the scene, and a run drops checkpoints beside its output."""
    for old, new in (("scene.html", "view"), ("out.h5.checkpoint", "run"), ("out.h5.checkpoint.previous", "run")):
        (scene / old).write_text(OBJ)
        (scene / "scene.json").write_text(json.dumps(SCENE).replace("ball.obj", old))
        answer = hooke(new, "scene.json", *(["-o", "out.h5"] if new == "run" else []))
        assert answer.code == 2 and "is read, too" in answer.err, answer.err
        assert (scene / old).read_text() == OBJ and not (scene / "out.h5").exists()


def test_meshes_and_trajectories(hooke, scene):
    for name in other_names(scene, "ball.obj", ""):
        answer = hooke("make", "mesh", "--file", "ball.obj", "--mass", "1", "--structural.stiffness", "1", "-o", name)
        assert answer.code == 2 and "is the mesh itself" in answer.err, answer.err
    assert hooke("run", "scene.json", "-o", "out.h5", "--quiet").code == 0
    os.link(scene / "out.h5", scene / "twin.h5")
    before = (scene / "out.h5").read_bytes()
    for words in ("run out.h5 -o", "view out.h5 -o", "why out.h5 --report", "limit scene.json --at out.h5 --report"):
        for name in ("twin.h5", "inner/../out.h5"):
            assert hooke(*words.split(), name).code == 2, words
    assert (scene / "out.h5").read_bytes() == before


def test_other_files_are_replaced(hooke, scene):
    (scene / "old.h5").write_text(OBJ)
    assert hooke("run", "scene.json", "-o", "old.h5", "--quiet").code == 0
    assert (Path(scene) / "old.h5").read_bytes()[:4] == b"\x89HDF"
