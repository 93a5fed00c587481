"""The end of a run is a frame, also where frames do not divide its duration: in files, judgements and resumed runs."""

import copy
import json

import pytest
from conftest import SIX_PARTICLES, STIFF_PAIR

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")
pytestmark = pytest.mark.everything

EVERY, END = 0.06, 0.5
TIMES = [0, 0.06, 0.12, 0.18, 0.24, 0.3, 0.36, 0.42, 0.48, 0.5]
AWKWARD = ["--every", str(EVERY), "--duration", str(END)]


def frames_of(path, name="position"):
    with h5py.File(path) as file:
        data = file[f"particles/all/{name}"]
        return data["time"][:], data["step"][:], data["value"][:]


@pytest.mark.parametrize("method", ["symplectic-euler", "verlet", "cvode-adams"])
def test_a_file_ends_where_the_run_does(hooke, write, tmp_path, method):
    scene = write(SIX_PARTICLES)
    ran = json.loads(hooke("run", scene, *AWKWARD, "--method", method, "--final", "--json", "-o", "out.h5").out)
    time, step, q = frames_of(tmp_path / "out.h5")
    assert np.allclose(time, TIMES, rtol=0, atol=1e-15) and time[-1] == ran["time"] == END
    assert step[-1] == ran["steps"] and (np.diff(step) > 0).all()
    assert np.array_equal(q[-1], ran["final"]["position"])
    assert np.array_equal(frames_of(tmp_path / "out.h5", "velocity")[2][-1], ran["final"]["velocity"])
    with h5py.File(tmp_path / "out.h5") as file:
        energy = file["observables/total_energy/value"][:]
    assert energy[-1] == pytest.approx(ran["energy"]["final"], rel=1e-13)
    assert abs(energy[-2] - energy[-1]) > 1e-6  # of 0.48 s
    checked = json.loads(hooke("verify", "out.h5", "--all", "--json").out)
    assert checked["verdict"] == "agrees" and checked["time_last"] == END and checked["frames"] == len(TIMES)
    late = json.loads(hooke("verify", "out.h5", "--slice", "0.485,0.5", "--json").out)
    assert late["verdict"] == "agrees" and late["time_last"] == END
    assert late["time_first"] == pytest.approx(0 if method == "cvode-adams" else 0.48)
    assert hooke("view", "out.h5", "-o", "out.html").code == 0
    assert f'"{END}"' in (tmp_path / "out.xdmf").read_text()


def test_frames_that_divide_the_run_are_as_many_as_before(hooke, write, tmp_path):
    for every, count in [(0.05, 11), (0.1, 6), (0.5, 2), (0.05 * (1 + 5e-10), 11)]:
        assert hooke("run", write(SIX_PARTICLES), "--every", repr(every), "--strict", "-o", "out.h5").code == 0
        time, step, _ = frames_of(tmp_path / "out.h5")
        assert len(time) == count and step[-1] == 500


def test_errors_are_judged_to_the_end(hooke, write, tmp_path):
    """Of a mass on a spring, whose motion is known: x = 1 + 0.1 cos(sqrt(1000) t)."""
    scene = copy.deepcopy(STIFF_PAIR)
    scene["run"] = {"method": "verlet", "step": 2e-3, "duration": END, "every": EVERY}
    study = json.loads(hooke("study", write(scene), "--methods", "verlet", "--steps", "2e-3,1e-3,5e-4", "--json").out)
    assert study["reference"]["trusted_until"] == END and study["frames"] == len(TIMES)
    compared = json.loads(hooke("compare", write(scene), "--methods", "verlet,cvode-adams", "--json", "-o", "both.h5").out)
    assert compared["frames"] == len(TIMES)
    with h5py.File(tmp_path / "both.h5") as file:
        assert file["study/series/time"][-1] == END
        at = file["study/series/error"][0]
        assert at[-1] == compared["rows"][0]["error_final"] != at[-2]
    ran = json.loads(hooke("run", write(scene), "--final", "--json").out)
    off = abs(ran["final"]["position"][1][0] - (1 + 0.1 * np.cos(np.sqrt(1000) * END)))
    for row in [study["rows"][0], compared["rows"][0]]:
        assert row["step"] == 2e-3 and row["error_final"] == pytest.approx(off, rel=1e-3)
    words = hooke("study", write(scene), "--methods", "verlet", "--steps", "2e-3,1e-3").out
    assert "errors are known over the whole run, 0.5 s\n" in words


def test_needs_are_judged_to_the_end(hooke, write):
    found = json.loads(hooke("needs", write(SIX_PARTICLES), *AWKWARD, "--want", "20cm", "--json").out)
    assert found["judged_until"] == found["duration"] == END


def test_frames_beyond_divergence_reach_the_end(hooke, write, tmp_path):
    scene = copy.deepcopy(STIFF_PAIR)
    scene["run"].update(step=0.1, every=0.6, duration=2)
    assert hooke("run", write(scene), "--past-divergence", "-o", "out.h5").code == 4
    time, step, _ = frames_of(tmp_path / "out.h5")
    assert list(step) == [0, 6, 12, 18, 20] and time[-1] == pytest.approx(2)
    with h5py.File(tmp_path / "out.h5") as file:
        assert 0 < file["hooke/beyond"][0] < 4
