"""Runs: the same bits from every interface, files, frames, first-order problems."""

import gc
import json
import pickle
import sys
import warnings

import h5py
import numpy as np
import pytest
from conftest import ROOT, SIX_PARTICLES, build_oscillator, build_six_particles

import hooke

RUN = SIX_PARTICLES["run"]


@pytest.mark.parametrize("method", [method.name for method in hooke.methods()])
def test_every_way_to_run_gives_the_same_bits(scene, tmp_path, method):
    path = tmp_path / "six.json"
    path.write_text(json.dumps(SIX_PARTICLES))
    integrator = hooke.Integrator(build_six_particles(), **{**RUN, "method": method})
    by_hand = build_six_particles().state()
    integrator.run(by_hand)
    states = [
        hooke.run(path, method=method).state,
        hooke.run(scene, method=method).state,
        build_six_particles().run(**{**RUN, "method": method}).state,
        by_hand,
    ]
    for state in states:
        assert state.t == RUN["duration"]
        np.testing.assert_array_equal(state.q, states[0].q)
        np.testing.assert_array_equal(state.v, states[0].v)
    assert not np.array_equal(states[0].q, build_six_particles().state().q)


def test_a_result_tells_what_was_done(system):
    result = hooke.run(system, **RUN)
    assert (result.status, result.counts["steps"], result.state.t) == ("finished", 500, 0.5)
    assert result.counts["force_evaluations"] in (500, 501) and result.counts["memory_bytes"] > 0
    assert 0 < result.wall_seconds < 10 and result.system is system
    assert result.options["method"] == "symplectic-euler" and "finished" in repr(result)


def test_springs_through_zero_are_counted_with_a_warning():
    scene = hooke.Scene().particles([[0, 0, 0], [1.5, 0, 0]], mass=1, pinned=0)
    scene.springs(between=[[0, 1]], law="length", stiffness=10, damping=0.1, rest_length=0.5)
    with pytest.warns(hooke.PassageWarning, match=r"length zero 7 times, first that of particles 0 and 1 at") as told:
        result = hooke.run(scene, method="rk4", step=0.002, duration=10, every=10)
    assert result.counts["zero_passages"] == 7 and len(told) == 1 and told[0].filename == __file__
    with warnings.catch_warnings():
        warnings.simplefilter("error", hooke.PassageWarning)
        assert hooke.run(scene, method="rk4", step=0.002, duration=0.5).counts["zero_passages"] == 0


def test_frames_in_memory(system):
    result = hooke.run(system, frames=True, **RUN)
    t, q, v = result.frames
    assert q.shape == v.shape == (11, 6, 3)
    np.testing.assert_allclose(t, np.arange(11) * 0.05, rtol=1e-15, atol=1e-17)
    np.testing.assert_array_equal(q[0], SIX_PARTICLES["particles"]["position"])
    np.testing.assert_array_equal(q[-1], result.state.q)
    np.testing.assert_array_equal(v[-1], result.state.v)
    stopped = hooke.run(system, frames=True, on_frame=lambda step, state: step == 200, **RUN)
    assert stopped.status == "stopped" and len(stopped.frames.t) <= 5
    np.testing.assert_array_equal(stopped.frames.q[:4], q[:4])


def test_a_file_of_a_built_system(system, tmp_path):
    path = tmp_path / "out.h5"
    result = hooke.run(system, output=path, **RUN)
    with h5py.File(path) as file:
        np.testing.assert_array_equal(file["particles/all/position/value"][-1], result.state.q)


def test_a_stopped_run_leaves_a_file_of_its_frames(system, tmp_path):
    path = tmp_path / "out.h5"

    def watch(step, state):
        if step == 200:
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        hooke.run(system, output=path, on_frame=watch, **RUN)
    with h5py.File(path) as file:
        time = file["particles/all/position/time"][:]
        assert file["particles/all/position/value"].shape == (5, 6, 3)
        np.testing.assert_allclose(time, np.arange(5) * 0.05, rtol=1e-15)


def test_progress_goes_from_0_to_1(system):
    seen = []
    hooke.run(system, progress=lambda fraction, state: seen.append((fraction, state.t)), **RUN)
    assert [fraction for fraction, _ in seen] == [k / 10 for k in range(11)]
    np.testing.assert_allclose([t for _, t in seen], [k * 0.05 for k in range(11)], rtol=1e-14, atol=1e-16)


def test_steps_by_hand_equal_a_run(system):
    options = {"method": "symplectic-euler", "step": 1e-3}
    state, other = system.state(), system.state()
    integrator = hooke.Integrator(system, **options)
    assert [integrator.step(state, count) for count in (1, 99, 400)] == ["finished"] * 3
    hooke.Integrator(system, **options, duration=0.5).run(other)
    np.testing.assert_array_equal(state.q, other.q)
    assert integrator.counts["steps"] == 500 and state.t == other.t
    with pytest.raises(hooke.BadValue):
        integrator.step(state, -1)
    with pytest.raises(hooke.BadValue, match="duration"):
        integrator.run(state)


@pytest.mark.parametrize("method", [method.name for method in hooke.methods()])
def test_the_motion_goes_on_without_a_state(system, method):
    state, other = system.state(), system.state()
    integrator, steps = (hooke.Integrator(system, **{**RUN, "method": method}) for _ in range(2))
    assert integrator.step(state, 0) == "finished"
    assert [integrator.advance(), integrator.advance(9), integrator.advance(steps=0)] == ["finished"] * 3
    assert state.t == 0
    assert integrator.sync(state) == "finished"
    for _ in range(10):
        steps.step(other)
    assert state.t == other.t
    np.testing.assert_array_equal(state.q, other.q)
    np.testing.assert_array_equal(state.v, other.v)


def test_particles_of_the_motion_are_read_and_written(system):
    integrator = hooke.Integrator(system, method="verlet", step=2**-12)
    state, other = system.state(), system.state()
    integrator.step(state, 5)
    q, v = integrator.get([4, 2])
    np.testing.assert_array_equal(q, state.q[[4, 2]])
    np.testing.assert_array_equal(v, state.v[[4, 2]])
    np.testing.assert_array_equal(integrator.get(3)[1], state.v[3])
    integrator.put([4, 2], q + 0.01)
    integrator.put(3, v=[1, 2, 3])
    integrator.advance(7)
    other.assign(state)
    integrator.sync(state)
    other.q[[4, 2]] += 0.01
    other.v[3] = [1, 2, 3]
    hooke.Integrator(system, method="verlet", step=2**-12).step(other, 7)
    np.testing.assert_array_equal(state.q, other.q)
    np.testing.assert_array_equal(state.v, other.v)


def test_motions_that_are_not_there(system):
    integrator = hooke.Integrator(system, method="verlet", step=1e-3)
    for call in (integrator.advance, lambda: integrator.sync(system.state()), lambda: integrator.get(0)):
        with pytest.raises(hooke.BadCall, match="no motion"):
            call()
    integrator.step(system.state())
    for call in (lambda: integrator.get(6), lambda: integrator.put([0, -1], v=np.zeros((2, 3)))):
        with pytest.raises(hooke.BadValue, match="no particle"):
            call()
    with pytest.raises(hooke.BadValue, match="shape"):
        integrator.put([0, 1], q=[1, 2, 3])
    with pytest.raises(hooke.BadValue, match=r"velocity\[0\]\[1\]"):
        integrator.put(0, v=[1, np.nan, 3])
    with pytest.raises(hooke.BadValue):
        integrator.advance(-1)


def test_a_run_starts_where_it_is_told(system):
    whole = hooke.run(system, **RUN).state
    half = {**RUN, "duration": 0.25}
    state = hooke.run(system, **half).state
    result = hooke.run(system, state=state, **half)
    assert result.state is state and state.t == pytest.approx(0.5)
    np.testing.assert_allclose(state.q, whole.q, rtol=1e-12)


def test_a_state_of_another_system_is_refused(system):
    with pytest.raises(hooke.BadValue, match="state"):
        hooke.run(system, state=build_oscillator().state(), **RUN)


def test_a_step_that_does_not_fit_is_refused(system):
    with pytest.raises(hooke.BadValue, match="step"):
        hooke.run(system, method="symplectic-euler", step=0.3, duration=1, strict=True)


def test_a_force_given_to_run(scene):
    plain = hooke.run(hooke.Scene.parse(SIX_PARTICLES)).state

    def lift(t, q, v, force):
        force[:5, 1] += 9.81 * scene.system.masses[:5]

    lifted = hooke.run(scene, force=lift).state
    weightless = hooke.run(hooke.Scene.parse({**SIX_PARTICLES, "gravity": [0, 0, 0]})).state
    np.testing.assert_allclose(lifted.q, weightless.q, rtol=1e-11, atol=1e-11)
    assert abs(plain.q - lifted.q).max() > 0.1


def test_a_force_belongs_to_its_run(scene, system):
    """The next run has none, and a problem that ran already takes one."""

    def lift(t, q, v, force):
        force[:5, 1] += 30

    for problem in (scene, system):
        options = dict(RUN, state=None)
        plain = hooke.run(problem, **options).state.q
        for push in (lift, lambda t, q, v, force: None, lift):
            found = hooke.run(problem, force=push, **options)
            assert ("callback" in found.system.forces) and found.counts["steps"] > 0
            assert np.array_equal(found.state.q, plain) == (push is not lift)
        assert np.array_equal(hooke.run(problem, **options).state.q, plain)
    forced = build_six_particles()
    forced.set_force(lift)
    own = hooke.run(forced, **RUN).state.q
    assert np.array_equal(own, hooke.run(system, force=lift, **RUN).state.q), "one of the system gives the same bits"
    assert not np.array_equal(own, hooke.run(forced, force=lambda *_: None, **RUN).state.q), "it stands in for that"
    assert np.array_equal(own, hooke.run(forced, **RUN).state.q) and not np.array_equal(own, plain)


def test_a_force_of_a_run_lives_as_long_as_its_result():
    result = hooke.run(build_oscillator(), force=lambda t, q, v, force: force.__iadd__(1) is None, **RUN)
    gc.collect()
    system = result.system
    del result
    gc.collect()
    assert system.force([[0, 0, 0], [1, 0, 0]], np.zeros((2, 3))).tolist()[1] == [1, 1, 1]


def test_a_system_may_be_shared_by_integrators(system):
    integrators = [hooke.Integrator(system, method="symplectic-euler", step=h) for h in (1e-3, 5e-4)]
    states = [system.state() for _ in integrators]
    for _ in range(10):
        integrators[0].step(states[0], 1)
        integrators[1].step(states[1], 2)
    np.testing.assert_allclose(states[0].q, states[1].q, atol=1e-4)
    assert not np.array_equal(states[0].q, states[1].q)


# first-order problems


@pytest.mark.parametrize("a", [-2.0, 0.5, 1j, -0.3 + 4j])
def test_the_factor_of_forward_euler(a):
    def rate(t, x, out):
        out[:] = a * x

    h, n = 0.01, 200
    result = hooke.FirstOrder(rate, [1.0 if isinstance(a, float) else 1.0 + 0j]).run(
        method="forward-euler", step=h, duration=n * h
    )
    assert result.status == "finished"
    np.testing.assert_allclose(result.state.x[0], (1 + a * h) ** n, rtol=1e-12)


def test_a_first_order_problem_by_cvode_sees_time():
    def rate(t, x, out):
        out[0], out[1] = np.cos(t), -x[1]

    result = hooke.FirstOrder(rate, [0.0, 1.0]).run(
        method="cvode-adams", duration=2, rtol=1e-10, atol=1e-12, frames=True
    )
    np.testing.assert_allclose(result.state.x, [np.sin(2), np.exp(-2)], atol=1e-8)
    assert result.frames.q.shape == (101, 2) and result.frames.v is None
    np.testing.assert_allclose(result.frames.q[:, 0], np.sin(result.frames.t), atol=1e-8)


def test_what_a_first_order_problem_cannot_do(tmp_path):
    problem = hooke.FirstOrder(lambda t, x, rate: None, [1.0])
    run = {"method": "forward-euler", "step": 0.1, "duration": 1}
    with pytest.raises(hooke.BadValue):
        problem.run(output=tmp_path / "out.h5", **run)
    with pytest.raises(hooke.BadValue):
        problem.run(force=lambda t, q, v, force: None, **run)
    with pytest.raises(AttributeError):
        print(problem.run(**run).system)
    for bad in ([], [[1.0]], ["a"]):
        with pytest.raises(hooke.BadValue):
            hooke.FirstOrder(lambda t, x, rate: None, bad)


def test_an_error_of_earlier_files_is_no_error_of_the_farthest_particle(tmp_path):
    """Their six or seven numbers are of a root mean square, at the end or over a part of the run."""
    path = tmp_path / "out.h5"
    hooke.run(build_oscillator(), method="verlet", step=1e-3, duration=1.0, output=path, estimate=True)
    assert hooke.open(path).error is not None
    with h5py.File(path, "r+") as file:
        numbers = file["hooke/error"][:7]
        del file["hooke/error"]
        file["hooke/error"] = numbers
        del file["hooke/file_check"]  # those had none
    assert hooke.open(path).error is None


@pytest.mark.parametrize("want", [1e-4, "0.1mm"])
def test_a_wanted_error_is_kept(want):
    """The end of the oscillator is known."""
    result = hooke.run(build_oscillator(), want=want, duration=1.0, every=0.05)
    error = result.error
    assert result.status == "finished" and error.met is True and error.wanted == pytest.approx(1e-4)
    exact = 1 + 0.25 * np.cos(np.sqrt(40) * 1.0)
    assert abs(result.state.q[1, 0] - exact) <= 1e-4 and error.estimate <= 1e-4
    assert (error.known_until, error.by) == (1.0, "reference") and error.rms == error.estimate


def test_what_is_watched_is_a_table():
    options = {"method": "cvode-adams", "rtol": 1e-9, "duration": 3.0, "every": 1.0, "watch": "1.x,0.reaction"}
    for estimate in (False, True):
        result = hooke.run(build_oscillator(), estimate=estimate, **options)
        (x, reaction), state = result.watched, result.state
        assert x["value"] == state.q[1, 0] and (result.error is not None) == estimate
        assert abs(x["maximum"] - 1.25) < 1e-7 and abs(x["minimum"] - 0.75) < 1e-7
        assert abs(reaction["maximum"] - 20 * 0.25) < 1e-5 and reaction["unit"] == "N" and reaction["until"] == 3
    assert hooke.run(build_oscillator(), **{**options, "watch": None}).watched is None
    start = build_oscillator().state()
    with pytest.raises(hooke.BadValue, match="springs 0 to 0|allowed"):
        hooke.run(build_oscillator(), state=start, **{**options, "watch": "1.reaction"})


def test_an_error_is_estimated_when_it_is_asked_for(tmp_path):
    options = {"method": "symplectic-euler", "step": 1e-3, "duration": 1.0, "output": tmp_path / "out.h5"}
    assert hooke.run(build_oscillator(), estimate=False, **options).error is None
    later = hooke.run(build_oscillator(), **options)
    later.state.q += 1  # which is the caller's
    assert hooke.open(tmp_path / "out.h5").error is None
    result = hooke.run(build_oscillator(), estimate=True, **options)
    assert repr(later.error) == repr(result.error) == repr(pickle.loads(pickle.dumps(later)).error)
    kept = hooke.open(tmp_path / "out.h5").error
    assert kept is not None and repr(kept) == repr(result.error)
    frames = hooke.open(tmp_path / "out.h5")
    truly = np.abs(frames.q[:, 1, 0] - 1 - 0.25 * np.cos(np.sqrt(40) * frames.t)).max()
    assert truly <= result.error.estimate < 1.3 * truly and result.error.met is None
    assert result.error.heat_excess == 0
    pushed = build_oscillator()
    pushed.set_force(lambda t, q, v, force: None)
    assert hooke.run(pushed, **options).error is None and hooke.run(pushed, estimate=True, **options).error is not None


@pytest.mark.parametrize(
    "options, word", [({"want": "1 furlong"}, "furlong"), ({"want": "1mm", "step": 1e-3}, "step"), ({"want": -1}, "want")]
)
def test_a_want_that_cannot_be_kept_is_refused(options, word):
    with pytest.raises(hooke.BadValue, match=word):
        hooke.run(build_oscillator(), duration=1.0, **options)


def oscillator_in(length, time, mass):
    """Of 1 rad/s, stretched by a half, in units of so many m, s and kg."""
    position = [[0, 0, 0], [1.5 * length, 0, 0]]
    scene = hooke.Scene().particles(position, mass=mass, pinned=[0])
    return scene.springs(between=[[0, 1]], law="length", stiffness=mass / time / time, rest_length=length)


@pytest.mark.parametrize("method", [method.name for method in hooke.methods() if method.adaptive])
def test_tolerances_are_in_the_scale_of_a_scene(method):
    """To the bit, where units are powers of two."""

    def run(*units, **options):
        ran = hooke.run(oscillator_in(*units), method=method, duration=100 * units[1], every=units[1], estimate=True, **options)
        return ran.counts["steps"], ran.state.q[1, 0] / units[0], ran.error.estimate / units[0]

    assert run(2.0**-33, 2.0**-47, 2.0**-86) == run(2.0**40, 2.0**20, 2.0**-20) == run(1, 1, 1)
    steps, position, error = run(1e-10, 1e-14, 1e-26)  # of an atom, in decimal units, which rounding tells apart
    assert steps == pytest.approx(run(1, 1, 1)[0], rel=0.12)
    assert abs(position - (1 + 0.5 * np.cos(100))) <= error < 2e-3


# probes


def test_probes_of_a_run(tmp_path):
    scene = hooke.Scene.parse(SIX_PARTICLES)
    results = [hooke.run(scene, probe="3.y,energy", probe_every="10ms", probes=tmp_path / name) for name in ("a.csv", "a.h5")]
    table, other = (result.probes for result in results)
    assert table.dtype.names == ("time", "3.y", "energy") and len(table) == 51 and np.array_equal(table, other)
    assert table["3.y"][-1] == results[0].state.q[3, 1] and table["time"][-1] == results[0].state.t


def test_a_run_that_ends_early_keeps_its_lines(tmp_path):
    def stop(step, state):
        return int(state.t > 0.2)

    def fail(step, state):
        if state.t > 0.2:
            raise KeyboardInterrupt

    scene = hooke.Scene.parse(SIX_PARTICLES)
    for name in ("a.csv", "a.h5"):
        result = hooke.run(scene, probe="energy", probe_every=1e-3, probes=tmp_path / name, on_frame=stop)
        assert (result.status, len(result.probes), result.probes["time"][-1]) == ("stopped", 251, 0.25)
    with pytest.raises(KeyboardInterrupt):
        hooke.run(scene, probe="energy", probe_every=1e-3, probes=tmp_path / "a.csv", on_frame=fail)
    assert len((tmp_path / "a.csv").read_text().splitlines()) == 252


def test_what_is_missing_is_said(tmp_path, monkeypatch):
    scene = hooke.Scene.parse(SIX_PARTICLES)
    with pytest.raises(hooke.BadValue, match="give both"):
        hooke.run(scene, probe="energy")
    with pytest.raises(hooke.BadValue, match="probe='energy'|probe=\"energy\""):
        hooke.run(scene).to_pandas()
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match="pip install pandas"):
        hooke.run(scene, probe="energy", probes=tmp_path / "a.csv").to_pandas()


def test_damping_is_explicit_where_the_start_allows_it(tmp_path):
    """At a step at which an integrator by itself solves for it."""
    path, run = ROOT / "examples/scenes/cloth-16.json", {"method": "verlet", "step": 5e-4, "duration": 0.02}
    result = hooke.run(path, **run, output=tmp_path / "cloth.h5")
    assert result.counts["linear_iterations"] == 0
    assert hooke.open(tmp_path / "cloth.h5").options["verlet_damping"] == "explicit"
    solved = hooke.Integrator(hooke.Scene.load(path).system, **run)
    assert solved.options["verlet_damping"] == "implicit"
