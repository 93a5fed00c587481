"""The library writes over no file that it read, by whatever name; a scene may be saved in its own place."""

import json
import os

import pytest

import hooke

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
SCENE = {
    "hooke": 1,
    "parts": [{"kind": "mesh", "file": "ball.obj", "mass": 1, "pinned": [0], "structural": {"stiffness": 10}}],
    "run": {"method": "verlet", "step": 0.01, "duration": 0.1},
}


@pytest.fixture
def scene(tmp_path):
    (tmp_path / "ball.obj").write_text(OBJ)
    (tmp_path / "scene.json").write_text(json.dumps(SCENE))
    os.link(tmp_path / "ball.obj", tmp_path / "twin.h5")
    os.symlink("ball.obj", tmp_path / "soft.h5")
    return tmp_path


@pytest.mark.parametrize("name", ["ball.obj", "twin.h5", "soft.h5", "scene.json"])
def test_outputs(scene, name):
    loaded = hooke.Scene.load(scene / "scene.json")
    for write in (
        lambda path: hooke.run(loaded, output=path),
        lambda path: hooke.run(scene / "scene.json", output=path),
        lambda path: hooke.compare(loaded, ["verlet"], output=path),
    ):
        with pytest.raises(hooke.BadValue, match="is read, too, and would be replaced"):
            write(scene / name)
    assert (scene / "ball.obj").read_text() == OBJ and json.loads((scene / "scene.json").read_text()) == SCENE


def test_saving(scene):
    loaded = hooke.Scene.load(scene / "scene.json")
    with pytest.raises(hooke.BadValue, match="is read, too"):
        loaded.save(scene / "soft.h5")
    assert (scene / "ball.obj").read_text() == OBJ
    loaded.save(scene / "scene.json")
    assert hooke.Scene.load(scene / "scene.json").system.particle_count == 3


def test_pictures_of_a_trajectory(scene):
    hooke.run(scene / "scene.json", output=scene / "out.h5")
    before = (scene / "out.h5").read_bytes()
    os.link(scene / "out.h5", scene / "page.html")
    for write in (hooke.view, hooke.write_xdmf):
        with pytest.raises(hooke.BadValue, match="is read, too"):
            write(scene / "out.h5", scene / "page.html")
    assert (scene / "out.h5").read_bytes() == before == (scene / "page.html").read_bytes()
