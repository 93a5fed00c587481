"""Contents of the HDF5 files of run and compare, and failures to write or read them."""

import os
import resource
import signal

import pytest
from conftest import SIX_PARTICLES, STIFF_PAIR

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")
pytestmark = pytest.mark.everything

CLOTH = {
    "hooke": 1,
    "title": "a flag",
    "gravity": [0, -9.81, 0],
    "parts": [
        {
            "kind": "cloth",
            "origin": [0, 0, 0],
            "edges": [[0.4, 0, 0], [0, 0, 0.6]],
            "size": [5, 7],
            "mass": 0.1,
            "pinned": ["top"],
            "structural": {"stiffness": 20, "damping": 0.01},
            "shear": {"stiffness": 5},
        }
    ],
    "driven": [{"particles": [34], "motion": "harmonic", "amplitude": [0, 0.1, 0], "frequency": 2}],
    "run": {"method": "symplectic-euler", "step": 1e-4, "duration": 0.1, "every": 0.01},
}

OBSERVABLES = ["kinetic_energy", "potential_energy", "total_energy", "dissipated_power", "momentum", "angular_momentum"]


def elements(file, group="all"):
    """The H5MD elements of one run."""
    inside = "" if group == "all" else f"/{group}"
    particles = [file[f"particles/{group}/{name}"] for name in ["position", "velocity"]]
    return particles + [file[f"observables{inside}/{name}"] for name in OBSERVABLES]


def objects(file):
    """Every group and dataset by its path."""
    found = {"/": file["/"]}
    file.visititems(lambda name, thing: found.__setitem__(name, thing))
    return found


def test_layout(hooke, write, tmp_path):
    assert hooke("run", write(CLOTH), "-o", "out.h5").code == 0
    with h5py.File(tmp_path / "out.h5") as file:
        assert list(file["h5md"].attrs["version"]) == [1, 1]
        assert file["h5md/creator"].attrs["name"] == "hooke"
        assert file["h5md/author"].attrs["name"]
        box = file["particles/all/box"]
        assert box.attrs["dimension"] == 3 and list(box.attrs["boundary"]) == ["none"] * 3

        for element in elements(file):
            assert element["time"] == file["particles/all/position/time"], "one array, by hard links"
            assert element["step"] == file["particles/all/position/step"]
        assert file["particles/all/position/value"].shape == (11, 35, 3)
        assert file["particles/all/velocity/value"].shape == (11, 35, 3)
        assert np.array_equal(file["particles/all/position/step"], 100 * np.arange(11))
        assert np.allclose(file["particles/all/position/time"], 0.01 * np.arange(11), rtol=1e-15)
        for name in OBSERVABLES:
            shape = (11, 3) if "momentum" in name else (11,)
            assert file[f"observables/{name}/value"].shape == shape

        assert list(file["particles/all/species"]) == 5 * [1] + 29 * [0] + [2]
        assert np.allclose(file["particles/all/mass"], 0.1 / 35, rtol=1e-15)
        springs = file["connectivity/springs"]
        assert springs.shape == (7 * 4 + 6 * 5 + 2 * 6 * 4, 2) and springs.dtype.kind == "i"
        assert list(springs[0]) == [0, 1] and list(springs[28]) == [0, 5]
        assert file[springs.attrs["particles_group"]] == file["particles/all"]

        for path, thing in objects(file).items():
            assert "unit" not in thing.attrs, path
            if isinstance(thing, h5py.Dataset):
                assert thing.chunks is None, f"{path} is contiguous"
                assert thing.id.get_offset() is None or thing.id.get_offset() % 16 == 0, path


def test_description(hooke, write, tmp_path):
    scene = write(CLOTH)
    version = hooke("--version").out.split()[1]
    assert hooke("run", scene, "--step", "2e-4", "-o", "out.h5").code == 0
    with h5py.File(tmp_path / "out.h5") as file:
        group = file["hooke"]
        assert group["scene"].asstr()[()] == (tmp_path / scene).read_text()
        assert group["status"][()] == b"finished"
        assert group.attrs["method"] == "symplectic-euler" and group.attrs["version"] == version
        assert "position m" in group.attrs["units"]
        options = group["options"].attrs
        assert options["step"] == 2e-4 and options["duration"] == 0.1 and options["every"] == 0.01
        assert options["method"] == "symplectic-euler"


def test_numbers(hooke, write, tmp_path):
    answer = hooke("run", write(SIX_PARTICLES), "--final", "--json", "-o", "out.h5").json
    with h5py.File(tmp_path / "out.h5") as file:
        q, v = file["particles/all/position/value"][:], file["particles/all/velocity/value"][:]
        assert np.array_equal(q[-1], answer["final"]["position"])
        assert np.array_equal(v[-1], answer["final"]["velocity"])
        assert np.array_equal(q[0], SIX_PARTICLES["particles"]["position"])
        assert file["particles/all/position/time"][-1] == answer["time"]

        free = np.arange(6) != 5
        mass = file["particles/all/mass"][:]
        kinetic = 0.5 * (mass * (v**2).sum(axis=2))[:, free].sum(axis=1)
        springs = file["connectivity/springs"][:]
        length = np.linalg.norm(q[:, springs[:, 0]] - q[:, springs[:, 1]], axis=2)
        rest = 0.9 * length[0]
        potential = (0.5 * 100 * rest * (length / rest - 1) ** 2).sum(axis=1)
        potential += 9.81 * (mass * q[:, :, 1])[:, free].sum(axis=1)
        momentum = (mass[:, None] * v)[:, free].sum(axis=1)
        angular = np.cross(q, mass[:, None] * v)[:, free].sum(axis=1)
        assert np.allclose(file["observables/kinetic_energy/value"], kinetic, rtol=1e-13)
        assert np.allclose(file["observables/potential_energy/value"], potential, rtol=1e-13)
        assert np.allclose(file["observables/total_energy/value"], kinetic + potential, rtol=1e-13)
        assert np.allclose(file["observables/momentum/value"], momentum, rtol=1e-13, atol=1e-14)
        assert np.allclose(file["observables/angular_momentum/value"], angular, rtol=1e-13, atol=1e-13)
        assert file["observables/total_energy/value"][0] == answer["energy"]["initial"]
        assert file["observables/total_energy/value"][-1] == answer["energy"]["final"]
        assert list(file["observables/momentum/value"][-1]) == answer["momentum"]
        assert file["observables/dissipated_power/value"][5] > 0


def test_same_run_makes_the_same_bytes_but_for_its_name(hooke, write, tmp_path):
    scene = write(SIX_PARTICLES)
    found, runs = [], []
    for name in ["a.h5", "b.h5"]:
        hooke("run", scene, "-o", name)
        with h5py.File(tmp_path / name) as file:
            runs.append(file["hooke"].attrs["run"].encode())
        found.append((tmp_path / name).read_bytes())
    assert all(len(run) == 32 for run in runs) and runs[0] != runs[1]
    assert found[0].count(runs[0]) == 1
    assert found[0].replace(runs[0], runs[1]) == found[1]


def test_diverged_run_keeps_its_frames_only(hooke, write, tmp_path):
    answer = hooke("run", write(STIFF_PAIR), "--json", "-o", "out.h5")
    assert answer.code == 4
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["hooke/status"][()] == b"diverged"
        time = file["particles/all/position/time"][:]
        assert 0 < len(time) < 101 and time[-1] <= answer.json["time"] + 1e-12
        for element in elements(file):
            assert len(element["value"]) == len(element["step"]) == len(time)
            assert np.isfinite(element["value"][:]).all()
            assert (element["step"][:] >= 0).all() and np.isfinite(element["time"][:]).all()
        assert file[file["connectivity/springs"].attrs["particles_group"]] == file["particles/all"]
        assert list(file["particles/all/species"]) == [1, 0]
        assert file["hooke/options"].attrs["duration"] == 100
        assert list(file["particles/all/box"].attrs["boundary"]) == ["none"] * 3
    assert sorted(os.listdir(tmp_path)) == ["out.h5", "out.xdmf", "scene.json"]


def test_interrupted_run_keeps_its_frames(start, write, tmp_path):
    process = start("run", write(SIX_PARTICLES, duration=1e5, every=1), "-o", "out.h5")
    while not (tmp_path / "out.h5").exists():
        assert process.poll() is None
    with pytest.raises(Exception):
        process.wait(timeout=0.5)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["hooke/status"][()] == b"stopped"
        time = file["particles/all/position/time"][:]
        assert 1 < len(time) < 100001 and np.array_equal(time, np.arange(len(time)))
        assert np.isfinite(file["particles/all/position/value"][:]).all()


def test_comparison(hooke, write, tmp_path):
    """Forward Euler diverges: its runs are truncated, the others whole, the table has them all."""
    answer = hooke("compare", write(STIFF_PAIR, step=0.01, duration=5, every=0.5), "--json", "-o", "out.h5").json
    with h5py.File(tmp_path / "out.h5") as file:
        table = file["study"]
        methods = [name.decode() for name in table["method"]]
        assert methods == [row["method"] for row in answer["rows"]]
        assert [name.decode() for name in table["status"]] == [row["status"] for row in answer["rows"]]
        assert "diverged" in [row["status"] for row in answer["rows"]]
        assert table["reference"].attrs["method"].startswith("cvode-")
        assert file["hooke/status"][()] == b"finished"
        assert np.allclose(table["series/time"], 0.5 * np.arange(11))
        for name in ["step", "rtol", "error", "error_max", "error_final", "energy_drift", "force_evaluations", "steps"]:
            found = [None if np.isnan(number) else number for number in table[name]]
            assert found == [row[name] for row in answer["rows"]], name

        reference = file["particles/all/position/value"][:]
        assert reference.shape == (11, 2, 3)
        for k, (method, row) in enumerate(zip(methods, answer["rows"])):
            q = file[f"particles/{method}/position/value"][:]
            whole = row["status"] == "finished"
            assert len(q) == 11 if whole else 0 < len(q) < 11
            for element in elements(file, method):
                assert np.isfinite(element["value"][:]).all() and np.isfinite(element["time"][:]).all()
            error = np.linalg.norm((q - reference[: len(q)])[:, 1], axis=1)
            series = table["series/error"][k]
            seen = np.isfinite(series[: len(q)])
            assert seen.any() and np.allclose(series[: len(q)][seen], error[seen], rtol=1e-12)
            assert np.isnan(series[len(q) :]).all()
            assert not whole or np.isfinite(series).all()


def limited(size):
    """The program cannot write files longer than this."""

    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

    return limit


@pytest.mark.parametrize("verb", ["run", "compare"])
def test_no_room(hooke, write, tmp_path, verb):
    scene = write(CLOTH)
    (tmp_path / "out.h5").write_text("precious")
    answer = hooke(verb, scene, "-o", "out.h5", preexec_fn=limited(20000), restore_signals=False)
    assert answer.code == 5
    assert "out.h5" in answer.err and "File too large" in answer.err and "HDF5-DIAG" not in answer.err
    assert (tmp_path / "out.h5").read_text() == "precious"
    assert sorted(os.listdir(tmp_path)) == ["out.h5", scene]


@pytest.mark.parametrize("output", ["/dev/full", "/dev/null", "."])
def test_only_files_are_replaced(hooke, write, output):
    before = os.stat(output).st_rdev
    answer = hooke("run", write(SIX_PARTICLES), "-o", output)
    assert answer.code in (2, 5) and output in answer.err
    assert os.stat(output).st_rdev == before


# ---- arrays that scenes take from files ----


def taking(scene, dataset, **more):
    """The scene with its positions taken from a file."""
    changed = {**scene, "particles": dict(scene["particles"])}
    changed["particles"]["position"] = {"file": "state.h5", "dataset": dataset, **more}
    return changed


@pytest.mark.parametrize("frame", [None, -1, 10, 3, -8])
def test_positions_from_a_trajectory(hooke, write, tmp_path, frame):
    assert hooke("run", write(SIX_PARTICLES), "-o", "state.h5").code == 0
    more = {} if frame is None else {"frame": frame}
    scene = write(taking(SIX_PARTICLES, "/particles/all/position/value", **more), "next.json")
    assert hooke("run", scene, "-o", "next.h5").code == 0
    with h5py.File(tmp_path / "state.h5") as state, h5py.File(tmp_path / "next.h5") as following:
        expected = state["particles/all/position/value"][-1 if frame is None else frame]
        assert np.array_equal(following["particles/all/position/value"][0], expected)


def make_state(folder):
    position = np.array(SIX_PARTICLES["particles"]["position"], dtype=float)
    with h5py.File(folder / "other.h5", "w") as file:
        file["position"] = position
    position.tofile(folder / "raw.bin")
    with h5py.File(folder / "state.h5", "w") as file:
        file["plain"] = position
        file["single"] = position.astype("f4")
        file["swapped"] = position.astype(">f8")
        file["packed"] = h5py.Empty("f8")
        file.create_dataset("zipped", data=position, compression="gzip", chunks=(2, 3))
        file["words"] = np.array([[b"a", b"b", b"c"]] * 6)
        file["deep"] = np.zeros((2, 2, 6, 3))
        file["six"] = position.astype(int)
        file.create_dataset("huge", shape=(10**12, 3), chunks=(1024, 3), dtype="f8")
        file.create_dataset("hollow", shape=(6, 3), dtype="f8")
        file["away"] = h5py.ExternalLink("other.h5", "/position")
        file.create_dataset("outside", shape=(6, 3), dtype="f8", external=[(str(folder / "raw.bin"), 0, 144)])
        layout = h5py.VirtualLayout(shape=(6, 3), dtype="f8")
        layout[:] = h5py.VirtualSource(str(folder / "other.h5"), "position", shape=(6, 3))
        file.create_virtual_dataset("virtual", layout)
        file["element/value"] = np.stack([position, position + 1, position + 2])
        file["element/time"] = [0.0, 1.0, np.nan]
        file["empty/value"] = np.stack([position])
        file["empty/time"] = [np.nan]
        file["here"] = h5py.SoftLink("/plain")


@pytest.mark.parametrize("dataset", ["plain", "/plain", "swapped", "zipped", "here"])
def test_arrays_of_all_kinds(hooke, write, tmp_path, dataset):
    make_state(tmp_path)
    answer = hooke("run", write(taking(SIX_PARTICLES, dataset)), "--json", "--final")
    assert answer.code == 0
    expected = hooke("run", write(SIX_PARTICLES), "--json", "--final").json
    assert answer.json == {**expected, "wall_seconds": answer.json["wall_seconds"]}


def test_uncommitted_frames_are_not_there(hooke, write, tmp_path):
    make_state(tmp_path)
    assert hooke("run", write(taking(SIX_PARTICLES, "element/value")), "-o", "out.h5").code == 0
    with h5py.File(tmp_path / "out.h5") as file:
        expected = np.array(SIX_PARTICLES["particles"]["position"]) + 1
        assert np.array_equal(file["particles/all/position/value"][0], expected), "the last frame with a time"
    hooke("check", write(taking(SIX_PARTICLES, "element/value", frame=2)), code=3, err="has no frame 2")


@pytest.mark.parametrize(
    "dataset, says",
    [
        ("words", "not an array of numbers"),
        ("deep", "dimensions"),
        ("packed", "dimensions"),
        ("huge", "stored"),
        ("hollow", "stored"),
        ("away", "away"),
        ("outside", "another file"),
        ("virtual", "another file"),
        ("empty/value", "no frames"),
        ("nothing", "nothing"),
    ],
)
def test_bad_arrays(hooke, write, tmp_path, dataset, says):
    make_state(tmp_path)
    answer = hooke("check", write(taking(SIX_PARTICLES, dataset)))
    assert answer.code in (3, 5), answer.err
    assert says in answer.err and "state.h5" in answer.err and "HDF5-DIAG" not in answer.err


@pytest.mark.parametrize("length", [0, 7, 500, 2000, 9000])
def test_cut_off_file(hooke, write, tmp_path, length):
    make_state(tmp_path)
    whole = (tmp_path / "state.h5").read_bytes()
    (tmp_path / "state.h5").write_bytes(whole[:length])
    answer = hooke("check", write(taking(SIX_PARTICLES, "plain")))
    assert answer.code in (3, 5) and "state.h5" in answer.err


@pytest.mark.parametrize("verb", ["run", "compare"])
def test_long_scenes_are_stored(hooke, write, tmp_path, verb):
    scene = {**STIFF_PAIR, "title": "long " * 700_000, "run": {"method": "rk4", "step": 0.01, "duration": 0.1}}
    words = ["--no-estimate"] if verb == "run" else ["--methods", "rk4"]
    assert hooke(verb, write(scene), "-o", "out.h5", "--quiet", *words).code == 0
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["hooke/scene"].asstr()[()] == (tmp_path / "scene.json").read_text()
