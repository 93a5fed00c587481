"""A study of one row a method: rows and series, the file with all motions, the pictures."""

import json

import h5py
import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator

import hooke

RUN = {"step": 1e-3, "duration": 1.0, "every": 0.05}
EULERS = ["forward-euler", "symplectic-euler"]


@pytest.fixture(scope="module")
def comparison():
    return hooke.compare(build_oscillator(), EULERS, **RUN)


def test_rows(comparison):
    assert comparison.outcome == "finished" and comparison.reference.methods[0].startswith("cvode")
    assert comparison.reference.ended == "agreed" and comparison.reference.growth_seen != comparison.reference.growth_seen
    assert comparison.methods == EULERS and comparison.rows["status"].tolist() == ["finished"] * 2
    assert comparison.rows["step"].tolist() == [1e-3] * 2 and np.isnan(comparison.rows["rtol"]).all()
    assert comparison.rows["steps"].tolist() == [1000, 1000]
    assert (comparison.rows["wall_seconds"] > 0).all()
    assert str(comparison).splitlines()[0] == "errors are known over the whole run, 1 s"


def test_series(comparison):
    for row in range(2):
        series = comparison.series(row)
        np.testing.assert_allclose(series.time, np.arange(21) * 0.05, rtol=1e-14)
        assert series.error.shape == series.energy_drift.shape == (21,) and series.error[0] == 0
        assert series.error.max() == comparison.error[row]
        assert abs(series.energy_drift).max() == comparison.energy_drift[row]
    # forward Euler gains energy without end, symplectic Euler gains and loses
    assert comparison.series(0).energy_drift[-1] > 10 * abs(comparison.series(1).energy_drift[-1])


def test_the_tolerances_are_those_of_the_run():
    """Also that of velocities, in a ladder, too."""
    options = {"rtol": 1e-5, "atol": 3e-8, "atol_velocity": 1e-3, "duration": 1.0}
    runs = [hooke.run(build_oscillator(), method="cvode-adams", **{**options, **other}).counts
            for other in ({}, {"atol_velocity": 3e-8})]  # fmt: skip
    assert runs[0]["steps"] != runs[1]["steps"]
    found = hooke.compare(build_oscillator(), "cvode-adams", **options)
    assert (found.steps[0], found.force_evaluations[0]) == (runs[0]["steps"], runs[0]["force_evaluations"])
    assert (found.rtol[0], found.atol[0]) == (1e-5, 3e-8)
    ladder = hooke.study(build_oscillator(), "cvode-adams", tolerances=1e-5, **options)
    assert ladder.steps[0] == runs[0]["steps"]


def test_a_recommendation_afterwards():
    found = hooke.compare(build_oscillator(), ["verlet", "rk4"], **RUN)
    assert found.recommendation is None
    assert found.recommend(1e-4).met and 0 < found.recommendation.error <= 1e-4
    assert len(found.rows) == 2


def test_progress_and_stopping():
    seen = []
    hooke.compare(build_oscillator(), EULERS, progress=lambda done, what: seen.append((done, what)), **RUN)
    shares = [done for done, _ in seen]
    assert shares == sorted(shares) and 0 <= shares[0] and shares[-1] <= 1
    assert {"forward-euler", "symplectic-euler"} <= {what for _, what in seen}
    stopped = hooke.compare(
        build_oscillator(), EULERS, progress=lambda done, what: what == "symplectic-euler", **RUN
    )
    assert stopped.outcome == "stopped"
    assert stopped.rows["status"].tolist() == ["finished", "stopped"] and stopped.rows["error"][0] > 0


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("comparison") / "out.h5"
    return path, hooke.compare(hooke.Scene.parse(SIX_PARTICLES), EULERS, output=path)


def test_the_file_holds_table_series_and_frames(file):
    path, comparison = file
    with h5py.File(path) as h5:
        for name in ("step", "error", "error_max", "error_final", "energy_drift", "steps"):
            np.testing.assert_array_equal(h5["study"][name], comparison.rows[name])
        np.testing.assert_array_equal(h5["study/series/time"], comparison.series(0).time)
        reference = h5["particles/all/position/value"][:]
        for row, method in enumerate(EULERS):
            np.testing.assert_array_equal(h5["study/series/error"][row], comparison.series(row).error)
            q = h5[f"particles/{method}/position/value"][:]
            error = np.sqrt(((q - reference)[:, :5] ** 2).sum(axis=2).mean(axis=1))
            np.testing.assert_allclose(error, comparison.series(row).error, rtol=1e-9, atol=1e-14)
            run = hooke.Scene.parse(SIX_PARTICLES).run(method=method)
            np.testing.assert_array_equal(q[-1], run.state.q)
            np.testing.assert_array_equal(h5[f"particles/{method}/velocity/value"][-1], run.state.v)
            assert h5[f"particles/{method}/position/step"][-1] == run.counts["steps"]
            assert h5[f"observables/{method}/total_energy/value"].shape == (11,)


def test_the_reference_in_the_file_is_that_of_the_errors(tmp_path):
    """Far from the origin its tolerances depend on the extent of the motion, which a level of it changes."""
    scene = json.loads(json.dumps(SIX_PARTICLES))
    for position in scene["particles"]["position"]:
        position[0] += 1000
    found = hooke.compare(hooke.Scene.parse(scene), ["rk4"], output=tmp_path / "out.h5")
    with h5py.File(tmp_path / "out.h5") as h5:
        apart = (h5["particles/rk4/position/value"][:] - h5["particles/all/position/value"][:])[:, :5]
    error = np.sqrt((apart**2).sum(axis=2).mean(axis=1))
    # no error is below what rounding may do
    above = found.series(0).error > error[1:].max() / 10
    assert above.any()
    np.testing.assert_allclose(error[above], found.series(0).error[above], rtol=1e-9)


def test_motions_are_made_again(tmp_path):
    """Callbacks are called again, and the progress function may stop it: then nothing is written."""
    path, calls, seen, stop = tmp_path / "out.h5", [], [], []

    def weight(t, q, v, force):
        calls.append(t)
        force[1, 0] -= 1.0

    def progress(done, what):
        seen.append((done, what))
        return bool(stop)

    found = hooke.compare(build_oscillator(), ["rk4"], force=weight, progress=progress, **RUN)
    before = len(calls)
    found.write(tmp_path / "out.csv")
    assert len(calls) == before
    seen.clear()
    found.write(path)
    assert len(calls) >= before + 4000
    shares = [done for done, _ in seen]
    assert shares == sorted(shares) and shares[0] < 0.5 < shares[-1] == 1 and {what for _, what in seen} == {"all", "rk4"}
    with h5py.File(path) as h5:
        assert h5["particles/rk4/position/value"].shape == h5["particles/all/position/value"].shape
    text = path.read_bytes()
    stop.append(1)
    with pytest.raises(hooke.Stopped):
        found.write(path)
    assert path.read_bytes() == text and len(list(tmp_path.iterdir())) == 2


def test_a_run_that_takes_another_course_is_told(tmp_path):
    """By a force that is another one when the run is made again: it is no number after half a second."""
    strange = []

    def weight(t, q, v, force):
        force[1, 0] -= np.nan if strange and t > 0.5 else 1.0

    found = hooke.compare(build_oscillator(), ["forward-euler"], force=weight, **RUN)
    assert found.rows["status"].tolist() == ["finished"]
    strange.append(1)
    with pytest.raises(hooke.IOFailed, match="out.h5: the run of all came to 21 frames and now to 1[0-2]"):
        found.write(tmp_path / "out.h5")
    assert not (tmp_path / "out.h5").exists()


def test_motions_of_a_comparison_that_was_stopped(tmp_path):
    found = hooke.compare(build_oscillator(), EULERS, progress=lambda done, what: what == "symplectic-euler", **RUN)
    found.write(tmp_path / "out.h5")
    with h5py.File(tmp_path / "out.h5") as h5:
        assert "particles" not in h5 and h5["study/error"].shape == (2,) and h5["hooke/status"][()] == b"stopped"


def test_pictures_from_a_file(file):
    import matplotlib.pyplot as plt

    path, comparison = file
    ax = hooke.plot.error(path)
    assert [line.get_label() for line in ax.lines] == EULERS
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), comparison.series(0).error[1:])
    assert hooke.plot.error(path, series="energy_drift") is not ax
    space = hooke.plot.cloth(path)
    assert len(space.collections) == 1 and len(space.collections[0]._segments3d) == 7
    assert hooke.plot.cloth(path, space, run="forward-euler", frame=3, color="tab:red") is space
    with h5py.File(path) as h5:
        q = h5["particles/forward-euler/position/value"][3]
    first, segments = q[[0, 1]][:, [2, 0, 1]], np.asarray(space.collections[1]._segments3d)  # the farthest first
    assert any(np.array_equal(first, segment) for segment in segments)
    with pytest.raises(IndexError):
        hooke.plot.cloth(path, frame=11)
    space.figure.canvas.draw()
    plt.close("all")


def test_pictures_from_arrays_and_results(system):
    import matplotlib.pyplot as plt

    result = hooke.run(system, **SIX_PARTICLES["run"])
    a = hooke.plot.cloth(result, up="z")
    b = hooke.plot.cloth((result.state.q, system.spring_ends), up="z")
    np.testing.assert_array_equal(a.collections[0]._segments3d, b.collections[0]._segments3d)
    assert a.get_zlim()[0] <= result.state.q[:, 2].min() and a.get_zlim()[1] >= result.state.q[:, 2].max()
    plt.close("all")


def test_what_a_comparison_refuses():
    with pytest.raises(hooke.BadValue):
        hooke.compare(build_oscillator(), ["magic"], **RUN)
    with pytest.raises(hooke.BadValue, match="steps: is not for `once`"):
        hooke.compare(build_oscillator(), EULERS, steps=1e-3, **RUN)
    with pytest.raises(hooke.Unsuited, match="symplectic-euler steps positions and velocities apart"):
        hooke.compare(hooke.FirstOrder(lambda t, x, rate: None, [1.0]), EULERS, **RUN)
