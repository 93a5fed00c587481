"""The check value of each frame: that of zlib, and every reader of hooke's refuses a frame that disagrees with it."""

import json
import os
import signal
import subprocess
import threading
import zlib

import pytest

import hooke

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")

OBSERVABLES = ["kinetic_energy", "potential_energy", "total_energy", "dissipated_power", "momentum", "angular_momentum"]
FRAMES = 6
EVERY = 1 if os.environ.get("HOOKE_LONG") == "1" else 5  # number of the byte

SCENE = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "parts": [
        {
            "kind": "rope",
            "from": [0, 0, 0],
            "to": [1, 0.1, 0],
            "segments": 3,
            "mass": 0.5,
            "pinned": ["start"],
            "stretch": {"stiffness": 30, "damping": 0.1},
        }
    ],
    "run": {"method": "symplectic-euler", "step": 1e-3, "duration": 0.05, "every": 0.01},
}


def arrays(file, group="all"):
    """The arrays of a frame in the order of the check value."""
    particles, inside = file[f"particles/{group}"], "" if group == "all" else f"/{group}"
    names = ["position/step", "position/time", "position/value", "velocity/value"]
    return [particles[name] for name in names] + [file[f"observables{inside}/{name}/value"] for name in OBSERVABLES]


def check_of(file, frame, group="all"):
    value = 0
    for array in arrays(file, group):
        value = zlib.crc32(array[frame].tobytes(), value)
    return value


@pytest.fixture
def path(tmp_path):
    scene = tmp_path / "scene.json"
    scene.write_text(json.dumps(SCENE))
    hooke.run(scene, output=tmp_path / "out.h5")
    return tmp_path / "out.h5"


def test_it_is_that_of_zlib(path):
    with h5py.File(path) as file:
        stored = file["hooke/frame_check"]
        assert stored.shape == (FRAMES,) and stored.dtype == np.uint32 and stored.chunks is None
        assert [check_of(file, k) for k in range(FRAMES)] == list(stored)
        assert len(set(stored)) == FRAMES


def test_in_a_comparison_and_where_runs_end_early(tmp_path):
    """A comparison has one for each run; truncated files keep them."""
    scene = tmp_path / "scene.json"
    scene.write_text(json.dumps({**SCENE, "run": {**SCENE["run"], "step": 0.01}}))
    stiff = json.loads(scene.read_text())
    stiff["parts"][0]["stretch"] = {"stiffness": 3e5}
    stiff["run"]["duration"] = 1
    scene.write_text(json.dumps(stiff))
    hooke.compare(scene, ["symplectic-euler", "backward-euler"], output=tmp_path / "out.h5")
    lengths = []
    with h5py.File(tmp_path / "out.h5") as file:
        for group in ["all", "symplectic-euler", "backward-euler"]:
            stored = file["hooke" if group == "all" else f"hooke/{group}"]["frame_check"]
            lengths.append(len(stored))
            assert len(stored) == len(arrays(file, group)[1])
            assert [check_of(file, k, group) for k in range(len(stored))] == list(stored), group
    assert lengths[0] == lengths[2] == 101 > lengths[1] > 0
    for group in ["all", "symplectic-euler"]:
        damage(tmp_path / "out.h5", f"particles/{group}/velocity/value", 5)
        state = {"file": "out.h5", "dataset": f"/particles/{group}/position/value", "frame": 0}
        scene.write_text(json.dumps({**SCENE, "parts": [], "particles": {"position": state, "mass": 1}}))
        with pytest.raises(hooke.BadValue, match="frame 0 of .*out.h5 is damaged"):
            hooke.Scene.load(scene)


def damage(path, dataset, byte, bit=0):
    """Changes a bit of an array."""
    with h5py.File(path) as file:
        at = file[dataset].id.get_offset() + byte
    with open(path, "r+b") as file:
        file.seek(at)
        old = file.read(1)[0]
        file.seek(at)
        file.write(bytes([old ^ (1 << bit)]))


def test_every_byte_of_a_frame(path):
    whole = path.read_bytes()
    with h5py.File(path) as file:
        rows = [*arrays(file), file["hooke/frame_check"]]
        places = [(array.name, len(array[2].tobytes())) for array in rows]
    assert sum(size for _, size in places) == 16 + 48 * 4 + 80 + 4
    for name, size in places:
        for byte in range(0, size, EVERY):
            damage(path, name, 2 * size + byte, byte % 8)
            with hooke.open(path) as out:
                with pytest.raises(hooke.BadValue, match="frame 2 of .* is damaged|there is no frame 2"):
                    out.check(2)
                out.check(1)
            path.write_bytes(whole)


def test_readers_refuse_a_damaged_frame(path, tmp_path):
    damage(path, "particles/all/velocity/value", 3 * 96 + 9)
    with hooke.open(path) as out:
        assert len(out) == FRAMES, "opening looks at the marks alone"
        with pytest.raises(hooke.BadValue, match="frame 3 of .*out.h5 is damaged"):
            out.state(3)
        with pytest.raises(hooke.BadValue, match="frame 3 of "):
            out.check()
        for frame in [0, 1, 2, 4, 5, -1]:
            assert np.array_equal(out.state(frame).q, out.q[frame])
    assert '"damaged":1,' in hooke.view(path, tmp_path / "page.html").read_text("utf-8")
    position = {"file": "out.h5", "dataset": "particles/all/position/value"}
    for frame, fits in [(3, False), (-3, False), (2, True), (None, True)]:
        piece = position if frame is None else {**position, "frame": frame}
        scene = tmp_path / "next.json"
        scene.write_text(json.dumps({**SCENE, "parts": [], "particles": {"position": piece, "mass": 1}}))
        if fits:
            hooke.Scene.load(scene)
        else:
            with pytest.raises(hooke.BadValue, match="frame 3 of .*out.h5 is damaged"):
                hooke.Scene.load(scene)


def test_files_without_check_values_are_read(path):
    with h5py.File(path, "a") as file:
        del file["hooke/frame_check"], file["hooke/file_check"]
        del file["hooke"].attrs["run"]
    with hooke.open(path) as out:
        out.check()
        assert out.run == "" and len(out) == FRAMES and out.state(3).t == out.t[3]


def test_arrays_that_do_not_belong_together(path):
    with h5py.File(path, "a") as file:
        del file["hooke/frame_check"]
        file["hooke/frame_check"] = np.zeros(2, np.uint32)
    with hooke.open(path) as out, pytest.raises(hooke.BadValue, match="frame 3 of .* damaged: it has no check value"):
        out.check(3)
    with h5py.File(path, "a") as file:
        del file["hooke/frame_check"], file["observables/momentum/value"]
        file["hooke/frame_check"] = np.zeros(FRAMES, np.uint32)
        file["observables/momentum/value"] = np.zeros(3)
    with hooke.open(path) as out, pytest.raises(hooke.BadValue, match="its arrays do not belong together"):
        out.state(0)


# ---- reading while a run writes ----


def poll(path, stop, seen, held):
    """Every existing frame is whole, again and again; the file is opened like by any reader."""
    while not stop.is_set():
        try:
            file = h5py.File(path)
        except FileNotFoundError:
            continue
        times = file["particles/all/position/time"][:]
        count = int(np.isfinite(times).sum())
        assert np.isfinite(times[:count]).all() and len(times) in (count, 20001)
        stored = file["hooke/frame_check"][:]
        for k in {0, count // 2, count - 1} if count else {}:
            assert check_of(file, k) == stored[k], f"frame {k} of {count}"
        seen.append(count)
        if held is None:
            file.close()
        elif len(held) < 1:
            held.append(file)  # open to the end
    return


@pytest.mark.check
@pytest.mark.skipif("HOOKE_CLI" not in os.environ, reason="needs the program")
@pytest.mark.parametrize("early", [False, True])
@pytest.mark.parametrize("hold", [False, True])
def test_reading_during_a_run(tmp_path, early, hold):
    environment = {name: value for name, value in os.environ.items() if name != "HDF5_USE_FILE_LOCKING"}
    assert "HDF5_USE_FILE_LOCKING" not in os.environ
    scene = {**SCENE, "run": {**SCENE["run"], "duration": 200 if early else 20, "every": 0.01 if early else 0.001}}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    stop, seen, held, failures = threading.Event(), [], [] if hold else None, []

    def look():
        try:
            poll(tmp_path / "out.h5", stop, seen, held)
        except BaseException as failure:
            failures.append(failure)

    reader = threading.Thread(target=look, daemon=True)  # a failure below ends the test
    reader.start()
    command = [os.environ["HOOKE_CLI"], "run", "scene.json", "-o", "out.h5", "--quiet"]
    run = subprocess.Popen(command, cwd=tmp_path, env=environment, stdout=subprocess.DEVNULL)
    if early:
        while not failures and len(set(seen)) <= 2:
            assert run.poll() is None
        run.send_signal(signal.SIGINT)
    assert run.wait(timeout=60) == (130 if early else 0)
    stop.set()
    reader.join()
    assert not failures, failures
    assert len(set(seen)) > 2, "the reader did not see the run"
    with h5py.File(tmp_path / "out.h5") as file:
        assert file["hooke/status"][()] == (b"stopped" if early else b"finished")
    for file in held or []:
        assert file["particles/all/position/time"].shape == (20001,), "the file that was opened, as it was made"
        file.close()
    with hooke.open(tmp_path / "out.h5") as out:
        out.check(-1)
