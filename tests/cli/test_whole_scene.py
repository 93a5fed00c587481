"""The output of a run needs no other file: files named by its scene may be gone, and the output may be moved."""

import copy
import json
import os
import shutil
from pathlib import Path

import pytest
from conftest import SIX_PARTICLES, interrupt

h5py = pytest.importorskip("h5py")
numpy = pytest.importorskip("numpy")
pytestmark = pytest.mark.everything

BALL = Path(__file__).resolve().parents[2] / "examples" / "scenes" / "ball.obj"
TITLE = 'a "whole" scene </b> é'


@pytest.fixture
def scene(tmp_path):
    """Arrays and a mesh of other files, in a folder; its path, and the folder beside it for output."""
    (tmp_path / "scene").mkdir()
    (tmp_path / "out").mkdir()
    value = copy.deepcopy(SIX_PARTICLES)
    source = numpy.random.default_rng(1)
    time, moved, velocity = numpy.linspace(0, 0.5, 7), source.normal(size=(7, 3)), source.normal(size=(6, 3))
    moved[0] = velocity[3] = velocity[5] = 0  # driven, pinned
    with h5py.File(tmp_path / "scene" / "arrays.h5", "w") as file:
        for key, numbers in value["particles"].items():
            file[key] = numbers
        file["stiffness"] = 100 / 3 + numpy.arange(7)
        file["time"], file["moved"], file["velocity"] = time, moved, velocity

    def stored(key):
        return {"file": "arrays.h5", "dataset": key}

    value["title"] = TITLE
    value["particles"] = {key: stored(key) for key in [*value["particles"], "velocity"]}
    value["springs"][0]["stiffness"] = stored("stiffness")
    value["parts"] = [{"kind": "mesh", "name": "ball", "file": "ball.obj", "transform": {"scale": 0.1, "translate": [0, 1, 0]},
                       "mass": 0.05, "pinned": [16], "structural": {"stiffness": 20, "damping": 0.01}, "bend": {"stiffness": 5}}]  # fmt: skip
    value["driven"] = [{"particles": [3], "motion": "table", "time": stored("time"), "position": stored("moved")}]
    shutil.copy(BALL, tmp_path / "scene")
    (tmp_path / "scene" / "scene.json").write_text(json.dumps(value))
    return tmp_path / "scene" / "scene.json", tmp_path / "out"


def end_of(answer):
    assert answer.code == 0, answer.err
    return {key: answer.json[key] for key in ("final", "steps", "energy", "momentum", "particles", "springs")}


def title_of(file):
    return json.loads(file["hooke/scene"].asstr()[()])["title"]


@pytest.mark.parametrize("method", ["symplectic-euler", "cvode-bdf"])
def test_the_output_is_run_again_and_gone_on_with_anywhere(hooke, start, scene, method):
    path, out = scene
    run = ["run", path, "--method", method, "--checkpoint", "0.1"]
    whole = end_of(hooke(*run, "-o", out / "whole.h5", "--json", "--final"))
    process = start(*run, "--duration", "100000", "--every", "1000", "-o", out / "stopped.h5")
    interrupt(process, 0.3)
    process.communicate(timeout=60)
    assert process.returncode == 130
    shutil.rmtree(path.parent)

    answer = hooke("verify", out / "whole.h5", "--json")
    assert answer.code == 0, answer.err
    assert end_of(hooke("run", out / "whole.h5", "--json", "--final")) == whole
    assert end_of(hooke("run", "--resume", out / "whole.h5", "--json", "--final"))["final"] == whole["final"]
    process = start("run", "--resume", out / "stopped.h5")
    interrupt(process, 0.3)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130 and b"goes on from the checkpoint" in err, err
    with h5py.File(out / "whole.h5") as file:
        assert title_of(file) == TITLE


@pytest.mark.check
def test_of_a_run_that_was_stopped_the_end_is_that_of_one_that_was_not(hooke, start, scene):
    path, out = scene
    step = "1e-5" if os.environ.get("HOOKE_PRESET") == "asan" else "1e-6"  # some tenths of a second of work
    run = ["run", path, "--step", step, "--checkpoint", "0.05"]
    whole = end_of(hooke(*run, "-o", out / "whole.h5", "--json", "--final"))
    process = start(*run, "-o", out / "stopped.h5")
    interrupt(process, 0.01)
    process.communicate(timeout=60)
    assert process.returncode in (0, 130)
    shutil.rmtree(path.parent)
    assert end_of(hooke("run", "--resume", out / "stopped.h5", "--json", "--final")) == whole


@pytest.mark.parametrize("verb", ["compare", "study"])
def test_comparisons_and_studies_keep_it_too(hooke, scene, verb):
    path, out = scene
    answer = hooke(verb, path, "--methods", "symplectic-euler,rk4", "--duration", "0.05", "-o", out / "out.h5", "--json")
    assert answer.code == 0, answer.err
    there = hooke("run", path, "--duration", "0.05", "--json", "--final")
    shutil.rmtree(path.parent)
    with h5py.File(out / "out.h5") as file:
        assert title_of(file) == TITLE
        (out / "again.json").write_text(file["hooke/scene"].asstr()[()])
    again = hooke("run", out / "again.json", "--method", "symplectic-euler", "--step", "1e-3", "--duration", "0.05",
                  "--json", "--final")  # fmt: skip
    assert end_of(again)["final"] == end_of(there)["final"]


def test_a_scene_that_names_no_file_is_kept_as_it_is_written(hooke, tmp_path):
    text = json.dumps({**SIX_PARTICLES, "springs": [{**SIX_PARTICLES["springs"][0], "name": "file"}]}, indent=3)
    (tmp_path / "scene.json").write_text(text)
    assert hooke("run", "scene.json", "-o", "out.h5").code == 0
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["hooke/scene"].asstr()[()] == text
