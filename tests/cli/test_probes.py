"""hooke run --probe: quantities over time, in files that are written while the run goes."""

import csv
import signal

import h5py
import numpy as np
import pytest
from conftest import ENDLESS, SIX_PARTICLES, STIFF_PAIR, interrupt

pytestmark = pytest.mark.everything

PROBE = ["3.y", "edges:2.tension", "energy", "5.reaction_y"]


def lines_of(path):
    with open(path, encoding="ascii", newline="") as file:
        names, *rows = csv.reader(file)
    return names, np.array([[float(value) for value in row] for row in rows])


def probed(hooke, scene, *words, file="out.csv"):
    answer = hooke("run", scene, "--probe", ",".join(PROBE), "--probes", file, "--json", "--final", "--no-estimate", *words)
    assert answer.code == 0 and answer.json["probes"] == file
    return answer.json


def test_lines_are_the_frames_to_the_bit(hooke, write, tmp_path):
    scene = write({**SIX_PARTICLES, "run": {**SIX_PARTICLES["run"], "method": "verlet"}})
    plain = hooke("run", scene, "--json", "--final", "--no-estimate").json
    result = probed(hooke, scene, "-o", "out.h5")
    assert result["final"] == plain["final"] and result["steps"] == plain["steps"]
    names, lines = lines_of(tmp_path / "out.csv")
    assert names == ["time", *PROBE]
    with h5py.File(tmp_path / "out.h5") as file:
        frames = file["particles/all/position"]
        assert np.array_equal(lines[:, 0], frames["time"]) and np.array_equal(lines[:, 1], frames["value"][:, 3, 1])
        assert np.array_equal(lines[:, 3], file["observables/total_energy/value"])
    probed(hooke, scene, file="probes.h5")
    with h5py.File(tmp_path / "probes.h5") as file:
        table = file["probes"]
        assert list(table.dtype.names) == names and list(table.attrs["units"]) == ["s", "m", "N", "J", "N"]
        assert np.array_equal(np.array(table[:].tolist()), lines)


@pytest.mark.parametrize("method", ["rk4", "cvode-bdf"])
def test_times_of_their_own_are_those_of_frames(hooke, write, tmp_path, method):
    scene = write(SIX_PARTICLES)
    probed(hooke, scene, "--method", method, "--duration", "0.1s", "--probe-every", "15ms", "-o", "coarse.h5")
    hooke("run", scene, "--method", method, "--duration", "0.1s", "--every", "15ms", "-o", "fine.h5", "--no-estimate")
    _, lines = lines_of(tmp_path / "out.csv")
    with h5py.File(tmp_path / "fine.h5") as file:
        frames = file["particles/all/position"]
        assert len(lines) == 8 and lines[-1, 0] == 0.1  # the end is one, too
        assert np.array_equal(lines[:, 0], frames["time"]) and np.array_equal(lines[:, 1], frames["value"][:, 3, 1])


def column(path, name):
    """Of a file in either format."""
    if path.suffix == ".csv":
        names, lines = lines_of(path)
        return lines[:, names.index(name)]
    with h5py.File(path) as file:
        return file["probes"][name]


@pytest.mark.parametrize("file", ["out.csv", "out.h5"])
def test_a_run_that_diverges_keeps_its_lines(hooke, write, tmp_path, file):
    answer = hooke("run", write(STIFF_PAIR), "--probe", "1.x", "--probes", file, "--probe-every", 0.1, "--no-why")
    times = column(tmp_path / file, "time")
    assert answer.code == 4 and np.isfinite(column(tmp_path / file, "1.x")).all()
    assert 5 < len(times) < 1000 and f"{file} ({len(times)} lines, until {times[-1]:.6g} s)" in answer.out


@pytest.mark.parametrize("file", ["out.csv", "out.h5"])
def test_an_interrupted_run_keeps_its_lines_and_says_so(start, write, tmp_path, file):
    process = start("run", write(ENDLESS), "--probe", "3.y", "--probes", file, "--probe-every", 1)
    interrupt(process, 0.06)
    _, err = process.communicate(timeout=60)
    times = column(tmp_path / file, "time")
    assert process.returncode == 130 and len(times) > 1 and np.array_equal(times, np.arange(len(times)))
    assert f"and {len(times)} lines in {file}" in err.decode()


def test_a_killed_run_leaves_the_lines_that_it_wrote(start, write, tmp_path, file="out.h5"):
    process = start("run", write(ENDLESS), "--probe", "3.y", "--probes", file, "--probe-every", 1)
    interrupt(process, 0.06, signal.SIGKILL)
    process.communicate(timeout=60)
    times = column(tmp_path / file, "time")
    written = np.count_nonzero(times == times)
    assert 1 < written < 1e6 and np.array_equal(times[:written], np.arange(written)) and np.isnan(times[written:]).all()


@pytest.mark.parametrize(("words", "code", "said"), [
    ("--probe 3.y", 2, "give both"),
    ("--probes out.csv", 2, "give both"),
    ("--probe-every 1ms", 2, "give both"),
    ("--probe 9.y --probes out.csv", 3, "particles 0 to 5"),
    ("--probe period:3.y --probes out.csv", 3, "over time there is 3.y"),
    ("--probe 3.y --probes out.txt", 3, ".csv, .h5 or .hdf5"),
    ("--probe 3.y --probes out.csv --probe-every 1.5ms", 3, "the nearest are 0.001 and 0.002 s"),
    ("--probe 3.y --probes out.csv --probe-every 0.1ms", 3, "the nearest is 0.001 s"),
    ("--probe 3.y --probes out.csv --probe-every 0", 2, "a number > 0"),
    ("--probe 3.y --probes same.h5 -o same.h5", 2, "name another"),
    ("--probe 3.y --probes missing/out.csv", 5, "missing/out.csv"),
    ("--probe 3.y --probes scene.json", 3, ".csv, .h5 or .hdf5"),
    ("-o out.csv", 2, "--probes"),
    ("-o out.dat", 2, ".h5, .hdf5 or .h5md"),
])
def test_what_is_refused(hooke, write, tmp_path, words, code, said):
    hooke("run", write(SIX_PARTICLES), "--no-estimate", *words.split(), code=code, err=said)
    assert [path.name for path in tmp_path.iterdir()] == ["scene.json"]


def test_names_that_mean_hdf5(hooke, write, tmp_path):
    (tmp_path / "v1.2").mkdir()
    scene = write(SIX_PARTICLES)
    for name in ("out.hdf5", "out.h5md", "v1.2/out"):
        assert hooke("run", scene, "--no-estimate", "-o", name).code == 0 and h5py.is_hdf5(tmp_path / name)
