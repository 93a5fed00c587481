"""Arrays of a scene from HDF5 files."""

import copy
import json

import h5py
import numpy
import pytest
from conftest import SIX_PARTICLES

pytestmark = pytest.mark.everything


def start_of(hooke, scene):
    """Initial positions of the particles of a scene, from the first frame of a run of one step."""
    answer = hooke("run", scene, "--step", "1e-9", "--duration", "1e-9", "--every", "1e-9", "-o", "start.h5", "--quiet")
    assert answer.code == 0, answer.err


def test_a_run_goes_on_from_the_last_frame(hooke, write, tmp_path):
    assert hooke("run", write(SIX_PARTICLES), "-o", "first.h5", "--quiet").code == 0
    scene = copy.deepcopy(SIX_PARTICLES)
    values = "/particles/all/{}/value"
    scene["particles"]["position"] = {"file": "first.h5", "dataset": values.format("position"), "frame": -1}
    scene["particles"]["velocity"] = {"file": "first.h5", "dataset": values.format("velocity"), "frame": -1}
    start_of(hooke, write(scene, "second.json", step=None, duration=None, every=None))
    with h5py.File(tmp_path / "first.h5") as first, h5py.File(tmp_path / "start.h5") as start:
        for what in ("position", "velocity"):
            last = first[values.format(what)][-1]
            assert numpy.array_equal(start[values.format(what)][0], last)
            assert not numpy.array_equal(first[values.format(what)][0], last)


def test_every_array_may_stand_in_a_file(hooke, write, tmp_path):
    with h5py.File(tmp_path / "arrays.h5", "w") as file:
        for key in ("position", "mass", "pinned"):
            file[key] = SIX_PARTICLES["particles"][key]
        file["between"] = SIX_PARTICLES["springs"][0]["between"]
        file["gravity"] = SIX_PARTICLES["gravity"]
        file["stiffness"] = [100.0] * 7
    scene = copy.deepcopy(SIX_PARTICLES)

    def stored(key):
        return {"file": "arrays.h5", "dataset": key}

    scene["gravity"] = stored("gravity")
    scene["particles"] = {key: stored(key) for key in scene["particles"]}
    scene["springs"][0].update(between=stored("between"), stiffness=stored("stiffness"))
    plain = hooke("run", write(SIX_PARTICLES), "--json", "--final")
    from_file = hooke("run", write(scene, "files.json"), "--json", "--final")
    assert plain.code == from_file.code == 0, from_file.err
    assert from_file.json["final"] == plain.json["final"]


@pytest.mark.parametrize("group", ["/", "one/", "one/./two/", "g" * 2000 + "/"], ids=["root", "one", "two", "long"])
@pytest.mark.parametrize("time, last", [([0, 1, numpy.nan], 1), ([0, 1, 2], 2), ([0, numpy.nan], 2), ("group", 2), (None, 2)])
def test_frames_count_up_to_the_first_without_a_time(hooke, write, tmp_path, group, time, last):
    """A sibling that is not the time of each frame is ignored."""
    positions = numpy.array(SIX_PARTICLES["particles"]["position"])
    with h5py.File(tmp_path / "arrays.h5", "w") as file:
        file[group + "frames"] = [positions, positions + 1, positions + 2]
        if time == "group":
            file.create_group(group + "time")
        elif time:
            file[group + "time"] = time
    scene = copy.deepcopy(SIX_PARTICLES)
    scene["particles"]["position"] = {"file": "arrays.h5", "dataset": group + "frames", "frame": -1}
    start_of(hooke, write(scene, step=1e-3, duration=1e-3))
    with h5py.File(tmp_path / "start.h5") as start:
        assert numpy.array_equal(start["/particles/all/position/value"][0], positions + last)


@pytest.mark.parametrize(
    "key, value, place, words",
    [
        ("position", [[0, 0], [1, 0]], "particles.position.dataset", "2 rows of 2 numbers; allowed: rows of 3"),
        ("position", [[0, 0, 0], [1, float("nan"), 0]], "particles.position.dataset", "allowed: finite numbers"),
        ("pinned", [0.5], "particles.pinned.dataset", "allowed: whole numbers"),
        ("pinned", [7], "particles.pinned[0]", "there is no particle 7; allowed: 0 to 5"),
        ("mass", [1, 2, -3, 4, 5, 6], "particles.mass[2]", "-3 is not allowed; allowed: one or more numbers > 0"),
        ("mass", b"one", "particles.mass.dataset", "allowed"),
        ("mass", None, "particles.mass.file", "mass"),
        ("mass", {}, "particles.mass.dataset", "dataset mass is not an array of numbers"),
    ],
)
def test_numbers_in_files_are_checked_alike(hooke, tmp_path, key, value, place, words):
    with h5py.File(tmp_path / "arrays.h5", "w") as file:
        if value == {}:
            file.create_group(key)
        elif value is not None:
            file[key] = value
    scene = copy.deepcopy(SIX_PARTICLES)
    scene["particles"][key] = {"file": "arrays.h5", "dataset": key}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    answer = hooke("check", "scene.json")
    assert answer.code == 3, answer.err
    message = answer.err.splitlines()[0]
    assert message.startswith("hooke check: scene.json:1:") and f" {place}: " in message, message
    assert words in message, message
