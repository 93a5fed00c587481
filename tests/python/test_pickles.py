"""Scenes, systems, results and measurements in other processes, and copies of them."""

import copy
import multiprocessing
import os
import pickle

import numpy as np
import pytest

import hooke

RUN = {"method": "verlet", "step": 1e-3, "duration": 0.05}


def build_scene():
    return hooke.Scene("rope", gravity=(0, -9.81, 0), run=RUN).rope(
        from_=(0, 0, 0), to=(1, 0, 0), segments=4, mass=1, stretch={"stiffness": 1e3, "damping": 0.1}, pinned="start"
    )


def again(thing):
    return pickle.loads(pickle.dumps(thing))


@pytest.mark.parametrize("way", [again, copy.copy, copy.deepcopy])
def test_scenes_and_systems_are_the_same_to_the_bit(way):
    scene = build_scene()
    whole = scene.run().state
    other = way(scene)
    assert other.title == "rope" and np.array_equal(other.run().state.q, whole.q)
    system = way(way(scene.system))
    assert system.spring_count == 4 and np.array_equal(hooke.run(system, **RUN).state.v, whole.v)
    options = way(scene.run_options)
    assert dict(options) == dict(scene.run_options) and options.is_set("step") and not options.is_set("threads")
    options["step"] = 1.0
    assert scene.run_options["step"] == 1e-3


def test_a_part_before_particles_and_callbacks_are_refused():
    system = hooke.System()
    system.add_part("rope", from_=(0, 0, 0), to=(1, 0, 0), segments=2, mass=1, stretch={"stiffness": 1})
    system.add_particles([[5.0, 0, 0]], mass=1)
    with pytest.raises(TypeError, match="after its parts"):
        pickle.dumps(system)
    scene = build_scene()
    scene.system.set_force(lambda t, q, v, force: None)
    for one in (scene, scene.system):
        with pytest.raises(TypeError, match="callbacks"):
            pickle.dumps(one)


def stiffer(scene, step):
    return scene.run(step=step, estimate=True)


def test_a_pool_returns_results():
    scene, steps = build_scene(), [1e-3, 5e-4, 0.5]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        found = pool.starmap(stiffer, [(scene, step) for step in steps[:2]])
    for step, result in zip(steps, found):
        here = stiffer(scene, step)
        assert np.array_equal(here.state.q, result.state.q)
        assert str(here) == str(result) and repr(here.error) == repr(result.error)
        assert result.system.energy(result.state.q, result.state.v) == scene.system.energy(here.state.q, here.state.v)


def test_a_result_of_a_run_that_blew_up_or_had_callbacks():
    with pytest.warns(hooke.StepWarning):
        result = build_scene().run(method="forward-euler", step=0.05, duration=100.0)
    other = again(again(result))
    assert other.status == "diverged" and other.message == result.message and copy.copy(result).diagnosis == result.diagnosis
    with pytest.raises(hooke.BadCall, match="not pickled"):
        hooke.why(other)
    decay = hooke.FirstOrder(lambda t, x, rate: None, [1.0]).run(method="forward-euler", step=0.1, duration=1.0)
    other = again(again(decay))
    assert other.state.x == decay.state.x and copy.deepcopy(decay).problem is decay.problem
    with pytest.raises(hooke.BadCall, match="a first-order problem"):
        other.problem.state()


@pytest.mark.parametrize(
    "measure",
    [
        lambda scene: hooke.study(scene, ["verlet"], want=1e-3, points=6, duration=0.05),
        hooke.limit,
        lambda scene: hooke.needs(scene, 0.1),
        hooke.rest,
        hooke.modes,
        lambda scene: hooke.cost(scene, predict=True),
        hooke.check,
    ],
)
def test_measurements_keep_their_tables(measure, tmp_path):
    found = measure(build_scene())
    other = again(again(found))
    assert other.rows.tobytes() == found.rows.tobytes() and str(other) == str(found) and repr(other) == repr(found)
    with pytest.raises(hooke.BadCall, match="measure again"):
        other.write(tmp_path / "it.json")
    if hasattr(found, "_repr_html_"):
        assert "<table" in other._repr_html_()
    copy.deepcopy(found).write(tmp_path / "it.json")
    if isinstance(found, hooke.Study):
        assert repr(again(other.recommendation)) == repr(found.recommendation)
        assert np.array_equal(other.series(0).error, found.series(0).error, equal_nan=True)


def test_a_trajectory_is_its_file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    build_scene().run(output="out.h5")
    data = pickle.dumps(hooke.open("out.h5"))
    os.chdir("/")
    assert len(pickle.loads(data)) == len(hooke.open(tmp_path / "out.h5"))


def test_unknown_keywords_are_type_errors_too():
    scene = build_scene()
    for kind in (TypeError, ValueError, hooke.BadValue):
        with pytest.raises(kind, match='did you mean "step"'):
            scene.run(stepp=1)
        with pytest.raises(kind, match='did you mean "stiffness"'):
            hooke.System().add_springs(None, [(0, 1)], stifness=1)


def test_errors_pass_between_processes():
    with pytest.raises(hooke.BadValue) as caught:
        build_scene().run(stepp=1)
    error = again(caught.value)
    assert type(error) is type(caught.value) and str(error) == str(caught.value) and error.status == caught.value.status
    failure = hooke.SolverFailed("no")
    failure.integrator = hooke.Integrator(build_scene().system, **RUN)
    assert again(failure).diagnosis == "no"


def test_a_pickle_runs_nothing_and_its_result_finds_its_error(monkeypatch):
    result = build_scene().run()
    with monkeypatch.context() as patch:
        patch.setattr("hooke.results._settled", None)  # without which nothing runs
        other = again(result)
    assert other.error.estimate == result.error.estimate > 0 and str(other) == str(result)
    system = hooke.System()
    system.add_part("rope", from_=(0, 0, 0), to=(1, 0, 0), segments=2, mass=1, stretch={"stiffness": 1})
    system.add_particles([[5.0, 0, 0]], mass=1)
    lost = again(hooke.run(system, **RUN))
    assert lost.error is None and str(lost) == repr(lost)
