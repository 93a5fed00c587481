"""Studies: columns, the reference, orders, the recommendation, files and pictures."""

import json
import os
import pickle
import subprocess

import h5py
import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator, build_six_particles

import hooke

METHODS = ["symplectic-euler", "rk4", "cvode-adams"]
RUN = {"duration": 1.0, "every": 0.05}
COLUMNS = (
    "method status step rtol error error_max error_final energy_drift force_evaluations steps wall_seconds "
    "atol linear_iterations wall_median repeats near_floor near_energy_floor error_step timed_alone"
).split()


@pytest.fixture(scope="module")
def study():
    return hooke.study(build_oscillator(), METHODS, want=1e-4, points=6, **RUN)


def test_rows_that_cannot_win_are_left_out(study):
    """They follow one of five times the counted work of the cheapest that meets the want."""
    cut = hooke.study(build_oscillator(), METHODS, want=1e-4, **RUN)
    said = next(claim.text for claim in cut.claims if claim.key == "cut")
    meets = cut.rows[cut.error_max <= 1e-4]["force_evaluations"].min()
    for method in METHODS:
        rows, all_rows = cut.rows[cut.method == method], study.rows[study.method == method]
        assert (rows["error"] == all_rows["error"][:len(rows)])[~np.isnan(rows["error"])].all()
        assert (len(rows) < len(all_rows)) == (method in said)
        assert method == "cvode-adams" or (rows["force_evaluations"][:-1] < 5 * meets).all()
        assert len(rows) > 0 and (method == "cvode-adams" or (rows["force_evaluations"][1:] < 5 * meets).all())
    assert cut.recommendation.step == study.recommendation.step and "rk4" in said


def test_a_ladder_ends_that_falls_short():
    """Symplectic Euler, of order 1, is a hundred times off the want with five times the work that rk4 takes for it."""
    study = hooke.study(build_oscillator(), METHODS[:2], want=1e-6, **RUN)
    errors, evaluations = study.error_max[study.method == METHODS[0]], study.rows["force_evaluations"]
    meets = evaluations[study.error_max <= 1e-6].min()
    assert len(errors) == 3, "three rows show the order, and no more are run"
    assert errors[-1] * evaluations[study.method == METHODS[0]][-1] / (5 * meets) > 1e2 * 1e-6


def shape_of(value):
    """Keys of a document, and those inside of them; of an array those of its first entry."""
    if isinstance(value, list):
        return [shape_of(one) for one in value[:1]]
    return {key: shape_of(one) for key, one in value.items()} if isinstance(value, dict) else None


@pytest.mark.skipif("HOOKE_CLI" not in os.environ, reason="needs the program")
def test_a_file_has_the_keys_of_the_program(tmp_path):
    scene = hooke.Scene.load("examples/scenes/oscillator.json")
    more = {"duration": 0.5, "every": 0.1, "steps": [1e-2, 5e-3, 2e-3], "watch": ["energy"], "want": 1e-2}
    hooke.study(scene, ["rk4"], **more).write(tmp_path / "study.json")
    words = "--methods rk4 --duration 0.5 --every 0.1 --steps 1e-2,5e-3,2e-3 --watch energy --want 1e-2 --json".split()
    command = [os.environ["HOOKE_CLI"], "study", "examples/scenes/oscillator.json", *words]
    told = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    assert told.pop("scene") == command[2] and told["recommendation"].pop("command").startswith("hooke run ")
    written = json.loads((tmp_path / "study.json").read_text())
    assert written["recommendation"].pop("command") is None
    assert shape_of(written) == shape_of(told) and written["orders"]["rk4"]["order"] == told["orders"]["rk4"]["order"]


def test_columns(study):
    assert study.outcome == "finished" and not study.budget_spent and study.duration == 1.0
    assert study.methods == METHODS and sorted(study.rows.dtype.names) == sorted(COLUMNS)
    for name in COLUMNS:
        column = getattr(study, name)
        assert column.shape == (len(study.rows),) and not column.flags.writeable
        np.testing.assert_array_equal(column, study.rows[name])
    adaptive = study.method == "cvode-adams"
    assert np.isnan(study.step[adaptive]).all() and np.isnan(study.rtol[~adaptive]).all()
    assert (study.step[~adaptive] > 0).all() and (study.rtol[adaptive] > 0).all()
    for method in METHODS:
        value = study.rtol if method == "cvode-adams" else study.step
        assert (study.method == method).sum() >= 6
        assert (np.diff(value[study.method == method]) < 0).all(), "the coarsest first"
    done = study.status == "finished"
    assert done.sum() >= 18 and (study.wall_seconds[done] > 0).all()
    assert (study.wall_median >= study.wall_seconds)[done].all() and (study.repeats[done] >= 1).all()
    assert str(study).splitlines() == [claim.text for claim in study.claims] and "rows" in repr(study) and "nan" not in str(study)


def test_series(study):
    for row in (0, 3, -1):
        time, error, energy_drift = study.series(row)
        np.testing.assert_allclose(time, np.arange(21) * 0.05, rtol=1e-14)
        if study.status[row] == "finished":
            assert error.max() == study.error[row] and error[-1] == study.error_final[row]
            assert abs(energy_drift).max() == study.energy_drift[row]
    with pytest.raises(IndexError):
        study.series(len(study.rows))


def test_another_want(study):
    finer = study.recommend(want=1e-7)
    assert finer.met and finer.error <= 1e-7 and finer.force_evaluations > 50
    assert study.recommendation.error == finer.error and study.recommendation.want == 1e-7
    none = study.recommend(1e-16)
    assert not none.met and "reference" in none.note and none.error > 1e-16
    for bad in (0, -1, float("nan")):
        with pytest.raises(hooke.BadValue, match="want"):
            study.recommend(bad)


def test_without_a_want_nothing_is_recommended():
    study = hooke.study(build_oscillator(), "rk4", **RUN)
    assert study.recommendation is None and study.methods == ["rk4"]


def test_a_scene_or_its_path_brings_its_own_options(tmp_path, scene):
    study = hooke.study(scene, ["rk4"])
    assert study.duration == SIX_PARTICLES["run"]["duration"]
    assert len(study.series(0).time) == 11


def test_progress_and_stopping():
    seen = []
    hooke.study(build_oscillator(), METHODS, progress=lambda done, what: seen.append((done, what)), **RUN)
    assert all(0 <= done <= 1 for done, _ in seen)
    assert {"reference", *METHODS} <= {what for _, what in seen}
    stopped = hooke.study(build_oscillator(), METHODS, progress=lambda done, what: what == "rk4", **RUN)
    assert stopped.outcome == "stopped" and stopped.rows[0]["status"] == "finished"
    nothing = hooke.study(build_oscillator(), METHODS, progress=lambda done, what: 1, **RUN)
    assert nothing.outcome == "stopped" and len(nothing.rows) == 0 and nothing.orders == {}


def test_exceptions_of_progress_come_out():
    class Mine(Exception):
        pass

    def fail(done, what):
        raise Mine

    with pytest.raises(Mine):
        hooke.study(build_oscillator(), METHODS, progress=fail, **RUN)

    def interrupt(done, what):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        hooke.study(build_oscillator(), METHODS, progress=interrupt, **RUN)


def test_a_force_of_ones_own():
    def push(t, q, v, force):
        force[1] += [1.0, 0, 0]

    study = hooke.study(build_oscillator(), ["rk4"], force=push, steps=[0.01], duration=0.2, every=0.1)
    assert study.error[0] < 1e-5 and study.reference.agreement < 1e-8
    with pytest.raises(hooke.BadValue, match="threads"):
        hooke.study(build_oscillator(), ["rk4"], force=push, threads=2, **RUN)

    def fail(t, q, v, force):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        hooke.study(build_oscillator(), ["rk4"], force=fail, **RUN)


def test_what_a_study_refuses():
    system = build_oscillator()
    for options, name in (
        ({"methods": ["magic"]}, "magic"),
        ({"points": 2}, "points"),
        ({"want": -1}, "want"),
        ({"steps": [1e-3, 1e-2]}, "steps"),
        ({"stepp": 1}, "stepp"),
    ):
        with pytest.raises(hooke.BadValue, match=name):
            hooke.study(system, **options, **RUN)
    with pytest.raises(hooke.BadValue, match="duration"):
        hooke.study(system)


# ---- files ----


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("study") / "study.h5"
    scene = hooke.Scene.parse(SIX_PARTICLES)
    return path, scene, hooke.study(scene, ["forward-euler", *METHODS], want=1e-3, output=path)


def test_the_file_holds_everything(file):
    path, scene, study = file
    with h5py.File(path) as h5:
        group = h5["study"]
        for name in ("method", "status"):
            assert group[name].asstr()[:].tolist() == study.rows[name].tolist()
        for name in COLUMNS[2:]:
            np.testing.assert_array_equal(group[name][:], study.rows[name])
        for row in range(len(study.rows)):
            series = study.series(row)
            np.testing.assert_array_equal(group["series/time"][:], series.time)
            np.testing.assert_array_equal(group["series/error"][row], series.error)
            np.testing.assert_array_equal(group["series/energy_drift"][row], series.energy_drift)
        reference = group["reference"].attrs
        assert (reference["method"], reference["check"]) == study.reference.methods
        for name in ("agreement", "trusted_until", "growth"):
            assert reference[name] == getattr(study.reference, name)
        assert group["orders/method"].asstr()[:].tolist() == study.methods
        for name in ("order", "low", "high", "theory"):
            wanted = [getattr(study.orders[m], name) if m in study.orders else np.nan for m in study.methods]
            np.testing.assert_array_equal(group[f"orders/{name}"][:], wanted)
        recommendation = group["recommendation"].attrs
        assert recommendation["method"] == study.recommendation.method
        for name in ("met", "want", "step", "rtol", "atol", "error", "wall_seconds", "force_evaluations"):
            np.testing.assert_array_equal(recommendation[name], getattr(study.recommendation, name))
        assert group.attrs["duration"] == study.duration and group.attrs["budget_spent"] == 0
        assert group["options"].attrs["want"] == 1e-3
        assert h5["hooke/scene"].asstr()[()] == scene.text
        assert h5["hooke/status"].asstr()[()] == "finished"
        assert h5["hooke/options"].attrs["duration"] == 0.5


def test_a_file_without_rows_or_recommendation(tmp_path):
    path = tmp_path / "study.h5"
    hooke.study(build_six_particles(), METHODS, progress=lambda done, what: 1, output=path, **RUN)
    with h5py.File(path) as h5:
        assert h5["study/error"].shape == (0,) and h5["study/series/error"].shape == (0, 0)
        assert "recommendation" not in h5["study"] and "scene" not in h5["hooke"]
        assert h5["hooke/status"].asstr()[()] == "stopped"
    assert [entry.name for entry in tmp_path.iterdir()] == ["study.h5"]


def test_a_file_that_cannot_be_written(tmp_path, study):
    (tmp_path / "old.h5").write_text("old")
    with pytest.raises(hooke.IOFailed, match="missing"):
        study.write(tmp_path / "missing" / "study.h5")
    with pytest.raises(hooke.IOFailed):
        (tmp_path / "folder.h5").mkdir()
        study.write(tmp_path / "folder.h5")
    with pytest.raises(hooke.BadValue, match="html"):
        study.write(tmp_path)
    study.write(tmp_path / "old.h5")
    assert h5py.is_hdf5(tmp_path / "old.h5")


# ---- pictures ----


def test_pictures(file):
    import matplotlib.pyplot as plt

    path, _, study = file
    drawn = study.plot(want=1e-3)
    assert drawn[0].get_xscale() == drawn[0].get_yscale() == drawn[1].get_xscale() == "log"
    lines = {line.get_label(): line for line in drawn[0].lines}
    for method in study.methods:
        rows = study.rows[(study.method == method) & (study.error > 0)]
        np.testing.assert_array_equal(lines[method].get_xdata(), rows["wall_seconds"])
        np.testing.assert_array_equal(lines[method].get_ydata(), rows["error_max"])
        assert lines[method].get_marker() not in ("", "None", None)
    slopes = [line.get_label() for line in drawn[1].lines]
    assert any(label.startswith("rk4, order ") for label in slopes)
    assert not any(label.startswith("cvode-adams") for label in slopes), "it has no step"
    from_file = hooke.plot.study(path, cost="force_evaluations")
    for one, other in zip(study.plot(cost="force_evaluations"), from_file):
        assert len(one.lines) == len(other.lines) > 3
        for a, b in zip(one.lines, other.lines):
            np.testing.assert_array_equal(a.get_xydata(), b.get_xydata())
            assert a.get_label() == b.get_label() or a.get_label().startswith("_")
    from_file[0].figure.canvas.draw()
    plt.close("all")


def test_runs_that_diverged_are_at_the_edge():
    import matplotlib.pyplot as plt

    study = hooke.study(build_oscillator(), ["symplectic-euler"], steps=[0.4, 0.01], duration=4, every=0.4)
    _, steps = study.plot()
    crosses = [line for line in steps.lines if line.get_marker() == "x"]
    assert [line.get_xdata().tolist() for line in crosses] == [[0.4]]
    plt.close("all")


def test_watched_quantities_and_statistics():
    system = hooke.System()
    system.add_particles([[0, 0, 0], [1, 0.2, 0], [2, 0.5, 0.3]], mass=1.0)
    system.pin([0])
    system.set_gravity([0, -9.81, 0])
    system.add_springs("rods", [[0, 1], [1, 2]], stiffness=200.0)
    made = hooke.study(
        system, ["rk4"], steps=[2e-3], watch=["2.y", "rods:1.tension"], ensemble=2, seed=7, duration=30.0, every=0.1
    )
    assert list(made.watched) == list(made.agreement) == ["2.y", "rods:1.tension"]
    assert made.watched["2.y"].shape == (1,) and made.watched["2.y"][0] > 0
    assert 0 < made.agreement["2.y"] < 1e-4
    assert list(made.statistics) == ["kinetic", "potential", "energy", "2.y", "rods:1.tension"]
    for found in made.statistics.values():
        assert list(found) == ["reference", "rk4"]
        assert found["rk4"].members == 2 and found["rk4"].step == 2e-3 and np.isnan(found["reference"].bias)
        errors = [one.spread / np.sqrt(one.members) for one in found.values()]
        difference = found["rk4"].mean - found["reference"].mean
        assert np.isclose(found["rk4"].bias, difference / np.hypot(*errors), rtol=1e-12)
    with pytest.raises(hooke.BadValue, match="particles 0 to 2"):
        hooke.study(system, ["rk4"], watch="3.y", duration=1.0)


def test_records_are_tuples_of_their_tables(study):
    assert "- `agreement`: twice the largest distance" in type(study.reference).__doc__ and "[m]" in hooke.RunError.__doc__
    assert "`error_max`: largest distance of any free particle" in " ".join(hooke.Study.__doc__.split())
    order = study.orders["rk4"]
    again = pickle.loads(pickle.dumps(order))
    assert type(again) is type(order) and again == order != order._replace(low=0.0) and again.order == order[order._fields.index("order")]
    assert repr(order).startswith("Order(method='rk4', order=") and order._asdict()["theory"] == 4
    assert isinstance(study.reference.displacements, int) and study["rk4"]["method"] == "rk4"
