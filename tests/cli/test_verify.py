"""hooke verify: the output of every method reproduces from its scene, and a changed file is detected."""

import json
import shutil
import zlib

import h5py
import numpy as np
import pytest
from conftest import METHODS, SIX_PARTICLES, interrupt

pytestmark = pytest.mark.everything

OBSERVABLES = [
    "kinetic_energy",
    "potential_energy",
    "total_energy",
    "dissipated_power",
    "momentum",
    "angular_momentum",
]

MOVED = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "drag": 0.01,
    "parts": [
        {
            "kind": "cloth",
            "size": [6, 6],
            "edges": [[1, 0, 0], [0, 0, 1]],
            "mass": 0.2,
            "structural": {"stiffness": 20, "damping_ratio": 0.1, "compression": False},
            "bending": 0.001,
        },
        {
            "kind": "strand",
            "from": [0, 1, 0],
            "to": [1, 1, 0],
            "segments": 6,
            "mass": 0.1,
            "pinned": ["start"],
            "stretch": {"stiffness": 20},
            "bend": {"stiffness": 2},
            "altitude": {"stiffness": 1},
        },
    ],
    "driven": [
        {"particles": [0, 5], "motion": "harmonic", "amplitude": [0, 0.05, 0], "frequency": 2},
    ],
    "run": {"method": "verlet", "step": 1e-4, "duration": 0.1, "every": 0.01},
}


def seal(file):
    """The check values of the current numbers of all frames."""
    arrays = [
        file[f"particles/all/{name}"][:] for name in ["position/step", "position/time", "position/value", "velocity/value"]
    ]
    arrays += [file[f"observables/{name}/value"][:] for name in OBSERVABLES]
    for k in range(len(arrays[0])):
        value = 0
        for array in arrays:
            value = zlib.crc32(array[k].tobytes(), value)
        file["hooke/frame_check"][k] = value


@pytest.fixture
def made(hooke, write, tmp_path):
    """A result of the six particles, made once a test: made("verlet")."""

    def make(method="verlet", **run):
        write(SIX_PARTICLES, method=method, **run)
        assert hooke("run", "scene.json", "-o", "out.h5", "--quiet").code == 0
        return tmp_path / "out.h5"

    return make


def changed(path, name, index, change, sealed=True):
    """Changes one number of the file, and returns its old and new value."""
    with h5py.File(path, "r+") as file:
        before = file[name][index]
        file[name][index] = change(before)
        after = file[name][index]
        if sealed:
            seal(file)
    return before, after


@pytest.mark.parametrize("method", METHODS)
def test_every_method_verifies(hooke, made, method):
    made(method)
    answer = hooke("verify", "out.h5", "--json")
    assert answer.code == 0, answer.err
    found = answer.json
    claims = {claim["key"]: claim for claim in found["claims"]}
    assert list(claims) == ["verdict", "energy", "error", "run-again"]
    words = " ".join(hooke("verify", "out.h5", "--all").out.split())
    assert "verdict the file agrees with its scene to the bit from 0 s to" in words
    assert "energy the balance of energy holds from 0 s to" in words
    assert {claim["of"] for claim in claims.values()} == {"part" if found["frame_first"] else "whole"}
    times = f"from {found['time_first']:g} s to {found['time_last']:g} s"
    assert claims["verdict"]["text"] == f"the file agrees with its scene to the bit {times}"
    assert f"{found['error_estimate']:.2g} m" in claims["error"]["text"]
    assert (found["verdict"], found["difference"], found["balance"]) == ("agrees", "", "holds")
    assert found["method"] == method and len(found["run"]) == 32
    assert found["frames"] == found["frames_checked"] == 11 and found["frame_last"] == 10
    assert found["frame_first"] == (0 if method.startswith("cvode") else 5)
    assert 0 < found["error_estimate"] < 0.01
    assert found["residual"] <= found["residual_bound"]
    assert found["version"] == found["version_here"] and found["sundials"] == found["sundials_here"]
    change = found["work"] - found["heat"] - found["energy_change"]
    assert abs(change) <= found["residual"] * 1.000001 + 1e-12


def test_slices(hooke, made):
    made()
    some = hooke("verify", "out.h5", "--slice", "0.1,0.2", "--json").json
    assert (some["frame_first"], some["frame_last"], some["time_first"], some["time_last"]) == (2, 4, 0.1, 0.2)
    assert some["steps"] == 100 and some["verdict"] == "agrees"
    assert hooke("verify", "out.h5", "--slice", "120ms,0.13", "--json").json["frame_last"] == 3
    whole = hooke("verify", "out.h5", "--all", "--json").json
    assert (whole["frame_first"], whole["frame_last"], whole["steps"]) == (0, 10, 500)
    bits = hooke("verify", "out.h5", "--all", "--bits", "--json").json
    assert bits["verdict"] == "agrees" and bits["balance"] == "not-checked" and bits["error_estimate"] is None
    hooke("verify", "out.h5", "--slice", "0.3,0.2", code=3, err="ascending")


def test_driven_strands_and_cables(hooke, write):
    write(MOVED)
    assert hooke("run", "scene.json", "-o", "out.h5", "--quiet").code == 0
    answer = hooke("verify", "out.h5", "--all", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["verdict"] == "agrees" and abs(answer.json["work"]) > 1e-3
    assert answer.json["balance"] in ("holds", "unresolved")


@pytest.mark.parametrize("sealed", [True, False])
@pytest.mark.parametrize(
    ("name", "index", "words"),
    [
        ("particles/all/position/value", (7, 2, 1), "frame 7, particle 2, position y"),
        ("particles/all/velocity/value", (8, 0, 2), "frame 8, particle 0, velocity z"),
        ("particles/all/position/value", (0, 3, 0), "frame 0, particle 3, position x"),
    ],
)
def test_one_changed_bit_is_found(hooke, made, name, index, words, sealed):
    path = made()
    before, after = changed(path, name, index, lambda x: np.nextafter(x, 10.0), sealed)
    answer = hooke("verify", "out.h5")
    assert answer.code == 3
    if sealed:
        assert words in answer.err and repr(float(after)) in answer.err and repr(float(before)) in answer.err
        assert "disagrees" in answer.out
    else:
        assert f"frame {index[0]}" in answer.err and "damaged" in answer.err
    answer = hooke("verify", "out.h5", "--json")
    assert answer.code == 3 and answer.json["verdict"] == "disagrees" and answer.json["difference"]
    (verdict,) = (claim for claim in answer.json["claims"] if claim["key"] == "verdict")
    assert (verdict["text"], verdict["of"]) == ("the file disagrees with its scene", "whole")


def test_a_false_mass_is_found(hooke, made):
    path = made()
    changed(path, "particles/all/mass", 2, lambda x: np.nextafter(x, 10.0))
    answer = hooke("verify", "out.h5")
    assert answer.code == 3 and "masses or springs are not those that were written" in answer.err and not answer.out


def test_a_frame_without_a_time_is_found(hooke, made):
    changed(made(), "particles/all/position/time", 9, lambda t: np.nan, sealed=False)
    for verb in ("verify", "run"):
        words = ["verify", "out.h5"] if verb == "verify" else ["run", "--resume", "out.h5"]
        assert hooke(*words).code == (3 if verb == "verify" else 0)
    answer = hooke("verify", "out.h5")
    assert "frame 9 of out.h5 is damaged" in answer.err and "9 of 11 by their check values" in answer.out
    hooke("view", "out.h5", "-o", "out.html", code=0, err="1 damaged frame is skipped")


@pytest.mark.parametrize("method", ["verlet", "cvode-bdf"])
def test_what_is_not_known_is_said_in_words(hooke, made, method):
    """Before a slice was taken again, or where it ends at a fault, and where no run with half the step ends."""
    path = made(method)
    whole = path.read_bytes()
    for name, index, sealed in [
        ("position", (0, 3, 0), True),
        ("velocity", (7, 0, 2), True),
        ("velocity", (7, 0, 2), False),
    ]:
        changed(path, f"particles/all/{name}/value", index, lambda x: x + 1e-3, sealed)
        answer = hooke("verify", "out.h5", "--all")
        assert answer.code == 3 and "nan" not in answer.out and "inf" not in answer.out.split("verdict")[0]
        again = next(line for line in answer.out.splitlines() if line.startswith("run-again"))
        assert ("nothing was run again: " in again) == (not sealed or index[0] == 0), again
        path.write_bytes(whole)
    assert "nan" not in hooke("verify", "out.h5", "--bits").out


def test_a_changed_beginning_is_found(hooke, made):
    """The first frame of a slice is taken from the file: the frames computed from it differ."""
    path = made()
    changed(path, "particles/all/position/value", (5, 1, 1), lambda x: x + 1e-9)
    hooke("verify", "out.h5", code=3, err="frame 6")


def test_a_changed_time_is_found(hooke, made):
    path = made()
    changed(path, "particles/all/position/time", 7, lambda t: np.nextafter(t, 1.0))
    hooke("verify", "out.h5", code=3, err=("frame 7", "time"))


@pytest.mark.parametrize("key", ["damping", "stiffness"])
def test_a_changed_scene_is_found(hooke, made, key):
    path = made()
    with h5py.File(path, "r+") as file:
        text = bytes(np.array(file["hooke/scene"][()]).tobytes()).rstrip(b"\0").decode()
        scene = json.loads(text)
        scene["springs"][0][key] *= 1.001
        del file["hooke/scene"], file["hooke/file_check"]
        written = json.dumps(scene).encode()
        file["hooke"].create_dataset("scene", data=np.array(written, dtype=f"S{len(written)}"))
    hooke("verify", "out.h5", code=3, err="frame 6")


@pytest.mark.parametrize("fact", ["sundials", "blas"])
def test_other_versions_may_differ_within_the_error(hooke, made, fact):
    path = made("cvode-bdf")
    with h5py.File(path, "r+") as file:
        del file["hooke/file_check"]
        file["hooke"].attrs[fact] = "5.0.0"
    assert hooke("verify", "out.h5", "--json").json["verdict"] == "agrees"
    changed(path, "particles/all/position/value", (7, 2, 1), lambda x: x + 1e-9)
    answer = hooke("verify", "out.h5", "--json")
    assert answer.code == 0 and answer.json["verdict"] == "within-tolerance"
    assert answer.json[fact] == "5.0.0" != answer.json[f"{fact}_here"]
    changed(path, "particles/all/position/value", (7, 2, 1), lambda x: x + 1e-3)
    hooke("verify", "out.h5", code=3, err="apart")


@pytest.mark.parametrize("fact, run", [
    ("sundials", {"method": "verlet"}),
    ("blas", {"method": "backward-euler", "linear_solver": "direct"}),
])
def test_other_versions_make_no_difference_to_a_fixed_step(hooke, made, fact, run):
    path = made(**run)
    with h5py.File(path, "r+") as file:
        del file["hooke/file_check"]
        file["hooke"].attrs[fact] = "5.0.0"
    changed(path, "particles/all/position/value", (7, 2, 1), lambda x: np.nextafter(x, 9.0))
    hooke("verify", "out.h5", code=3, err="frame 7, particle 2, position y")


@pytest.mark.check
def test_runs_that_ended_early(hooke, write):
    write(SIX_PARTICLES, method="forward-euler", step=0.1, duration=100, every=0.2)
    assert hooke("run", "scene.json", "-o", "out.h5", "--quiet").code == 4
    answer = hooke("verify", "out.h5", "--all", "--json")
    assert answer.code == 0, answer.err
    assert answer.json["verdict"] == "agrees"


def test_files_that_are_none(hooke, made, tmp_path):
    assert hooke("verify", "none.h5").code == 5
    (tmp_path / "text.h5").write_text("no")
    assert hooke("verify", "text.h5").code == 5
    path = made()
    shutil.copy(path, tmp_path / "bare.h5")
    with h5py.File(tmp_path / "bare.h5", "r+") as file:
        del file["hooke/scene"], file["hooke/file_check"]
    hooke("verify", "bare.h5", code=3, err="no scene")
    assert hooke("verify").code == 2


def test_ctrl_c(hooke, start, write):
    write(SIX_PARTICLES, duration=40, every=10)
    assert hooke("run", "scene.json", "-o", "out.h5", "--quiet").code == 0
    process = start("verify", "out.h5", "--all", "--json")
    interrupt(process)
    out, _ = process.communicate(timeout=60)
    assert process.returncode in (130, 0)
    if process.returncode == 130:
        assert not out or json.loads(out)["verdict"] == "stopped"


VERBS = {
    "run --resume": ("run", "--resume", "out.h5"),
    "run": ("run", "out.h5"),
    "run --want": ("run", "out.h5", "--want", "1mm"),
    "verify": ("verify", "out.h5"),
    "why": ("why", "out.h5", "--step", "0.05", "--every", "0.05"),
    "study": ("study", "out.h5", "--methods", "rk4"),
    "compare": ("compare", "out.h5"),
    "limit": ("limit", "out.h5", "--predict"),
    "needs": ("needs", "out.h5", "--want", "1mm"),
    "check --cost": ("check", "--cost", "out.h5"),
}


def test_the_run_of_a_callback_is_not_repeated(hooke, made):
    """The file says that a program gave it one, which no file holds; it can still be looked at."""
    path = made()
    for words in ("none", "force and drive", "force"):
        with h5py.File(path, "r+") as file:
            assert file["hooke"].attrs["callbacks"] == "none" or words != "none"
            file["hooke"].attrs["callbacks"] = words
            if "file_check" in file["hooke"]:
                del file["hooke/file_check"]
        for name, verb in VERBS.items() if words == "force" else [("verify", VERBS["verify"])]:
            answer = hooke(*verb)
            assert answer.code == (0 if words == "none" else 3), f"{name}: {answer.err}"
            if words == "none":
                continue
            assert f"the run had a {words} in a callback, which the file cannot hold" in answer.err and not answer.out, name
    assert hooke("view", "out.h5", "-o", "out.html").code == 0
