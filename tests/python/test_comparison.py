"""Comparisons: rows and series as arrays, the file, the pictures."""

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
    assert comparison.status == "finished" and comparison.reference.startswith("cvode")
    assert comparison.methods == EULERS and comparison.rows["status"].tolist() == ["finished"] * 2
    assert comparison.rows["step"].tolist() == [1e-3] * 2 and np.isnan(comparison.rows["rtol"]).all()
    assert comparison.rows["steps"].tolist() == [1000, 1000]
    assert (comparison.rows["wall_seconds"] > 0).all()
    assert all(name in str(comparison) for name in EULERS)


def test_the_error_is_that_of_the_run(comparison):
    """The end of the oscillator is known exactly, and there is one free particle."""
    exact = 1 + 0.25 * np.cos(np.sqrt(40) * 1.0)
    for row in comparison.rows:
        x = hooke.run(build_oscillator(), method=str(row["method"]), **RUN).state.q[1, 0]
        assert row["error_final"] == pytest.approx(abs(x - exact), rel=1e-4)
        assert row["error"] == row["error_max"] >= row["error_final"]


def test_series(comparison):
    assert comparison.time.shape == (21,) and comparison.error.shape == comparison.energy_drift.shape == (
        2,
        21,
    )
    np.testing.assert_allclose(comparison.time, np.arange(21) * 0.05, rtol=1e-14)
    assert (comparison.error[:, 0] == 0).all()
    np.testing.assert_array_equal(comparison.error.max(axis=1), comparison.rows["error"])
    np.testing.assert_array_equal(abs(comparison.energy_drift).max(axis=1), comparison.rows["energy_drift"])
    # forward Euler gains energy without end, symplectic Euler gains and loses
    assert comparison.energy_drift[0, -1] > 10 * abs(comparison.energy_drift[1, -1])


def test_a_method_that_diverges_stays_as_a_row():
    comparison = hooke.compare(build_oscillator(), EULERS, step=0.1, duration=100, every=1)
    assert comparison.rows["status"].tolist() == ["diverged", "finished"]
    assert np.isnan(comparison.rows["error"][0]) and comparison.rows["error"][1] > 0
    assert np.isnan(comparison.error[0, -1]) and np.isfinite(comparison.error[1]).all()


def test_without_methods_all_are_compared():
    comparison = hooke.compare(build_oscillator(), **RUN)
    assert comparison.methods == [method.name for method in hooke.methods() if method.built]
    error = dict(zip(comparison.methods, comparison.rows["error"]))
    adaptive = [error[method.name] for method in hooke.methods() if method.built and method.adaptive]
    assert len(adaptive) == 2 and 0 < min(adaptive) and max(adaptive) < error["symplectic-euler"]
    assert 0 < error["rk4"] < error["verlet"] < error["symplectic-euler"] < error["forward-euler"]


def test_progress_and_stopping():
    seen = []
    hooke.compare(build_oscillator(), EULERS, progress=lambda done, what: seen.append((done, what)), **RUN)
    shares = [done for done, _ in seen]
    assert shares == sorted(shares) and 0 <= shares[0] and shares[-1] <= 1
    assert {"forward-euler", "symplectic-euler"} <= {what for _, what in seen}
    stopped = hooke.compare(
        build_oscillator(), EULERS, progress=lambda done, what: what == "symplectic-euler", **RUN
    )
    assert stopped.status == "stopped"
    assert stopped.rows["status"][0] == "finished" and stopped.rows["error"][0] > 0


def test_frames_of_every_run():
    seen = {}
    comparison = hooke.compare(
        build_oscillator(),
        EULERS,
        on_frame=lambda run, frame, step, state: seen.setdefault(run, []).append(
            (frame, state.t, state.q[1, 0])
        ),
        **RUN,
    )
    assert set(seen) == {"reference", *EULERS}
    for rows in seen.values():
        assert [frame for frame, *_ in rows] == list(range(21))
    difference = np.array(seen["forward-euler"])[:, 2] - np.array(seen["reference"])[:, 2]
    np.testing.assert_allclose(abs(difference), comparison.error[0], rtol=1e-9, atol=1e-15)


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("comparison") / "out.h5"
    return path, hooke.compare(hooke.Scene.parse(SIX_PARTICLES), EULERS, output=path)


def test_the_file_holds_table_series_and_frames(file):
    path, comparison = file
    with h5py.File(path) as h5:
        for name in ("step", "error", "error_max", "error_final", "energy_drift", "steps"):
            np.testing.assert_array_equal(h5["comparison"][name], comparison.rows[name])
        np.testing.assert_array_equal(h5["comparison/series/time"], comparison.time)
        np.testing.assert_array_equal(h5["comparison/series/error"], comparison.error)
        reference = h5["particles/all/position/value"][:]
        for row, method in enumerate(EULERS):
            q = h5[f"particles/{method}/position/value"][:]
            error = np.sqrt(((q - reference)[:, :5] ** 2).sum(axis=2).mean(axis=1))
            np.testing.assert_allclose(error, comparison.error[row], rtol=1e-9, atol=1e-14)


def test_pictures_from_a_file(file):
    import matplotlib.pyplot as plt

    path, comparison = file
    ax = hooke.plot.error(path)
    assert [line.get_label() for line in ax.lines] == EULERS
    np.testing.assert_array_equal(ax.lines[0].get_ydata(), comparison.error[0][comparison.error[0] > 0])
    assert hooke.plot.error(path, series="energy_drift") is not ax
    space = hooke.plot.cloth(path)
    assert len(space.collections) == 1 and len(space.collections[0]._segments3d) == 7
    assert hooke.plot.cloth(path, space, run="forward-euler", frame=3, color="tab:red") is space
    with h5py.File(path) as h5:
        q = h5["particles/forward-euler/position/value"][3]
    segments = np.asarray(space.collections[1]._segments3d)
    np.testing.assert_array_equal(segments[0], q[[0, 1]][:, [2, 0, 1]])
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
    with pytest.raises(hooke.BadValue):
        hooke.compare(build_oscillator(), EULERS, output="x.h5", on_frame=lambda *_: None, **RUN)
    with pytest.raises(hooke.BadValue):
        hooke.compare(hooke.FirstOrder(lambda t, x, rate: None, [1.0]), EULERS, **RUN)
