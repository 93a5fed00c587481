"""Failures of the library as exceptions with its message; outcomes as results."""

import os
import subprocess
import sys
import threading

import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator

import hooke
from hooke._library import lib


def test_the_kinds_of_exceptions():
    expected = {
        -1: (hooke.NoMemory, MemoryError, "no memory"),
        -2: (hooke.BadValue, ValueError, "bad value"),
        -3: (hooke.BadCall, RuntimeError, "bad call"),
        -4: (hooke.IOFailed, OSError, "i/o failed"),
        -5: (hooke.NotBuilt, NotImplementedError, "not in this build"),
        -6: (hooke.Unsuited, ValueError, "unsuited"),
        -7: (hooke.SolverFailed, ArithmeticError, "solver failed"),
        -8: (hooke.Internal, RuntimeError, "defect of hooke"),
    }
    for status, (kind, base, _) in expected.items():
        assert issubclass(kind, hooke.Error) and issubclass(kind, base) and kind.status == status
        assert lib.hooke_status_name(status) != lib.hooke_status_name(-99)


def test_bad_value_carries_the_message_of_the_library(system):
    with pytest.raises(hooke.BadValue) as caught:
        system.add_springs("bad", [[0, 17]], stiffness=1)
    assert caught.value.status == -2
    assert str(caught.value) == lib.hooke_last_error().decode()
    assert "17" in str(caught.value) and "5" in str(caught.value)


@pytest.mark.parametrize(
    "change",
    [
        lambda system: system.add_particles([[0, 0, 0]], mass=-1),
        lambda system: system.add_particles([[0, 0, np.inf]], mass=1),
        lambda system: system.add_particles([[0, 0]], mass=1),
        lambda system: system.add_particles([[0, 0, 0]], mass=[1, 2]),
        lambda system: system.add_particles([[0, 0, 0]], [[1, 1, 1], [2, 2, 2]], mass=1),
        lambda system: system.add_particles([["0", "0", "up"]], mass=1),
        lambda system: system.pin(6),
        lambda system: system.pin(0.5),
        lambda system: system.pin(-1),
        lambda system: system.add_springs("s", [[0, 0]], stiffness=1),
        lambda system: system.add_springs("s", [[0, 1]]),
        lambda system: system.add_springs("s", [0, 1, 2], stiffness=1),
        lambda system: system.add_springs("s", [[0, 1]], stiffness=[1, 2]),
        lambda system: system.set_gravity([0, 1]),
        lambda system: system.set_drag(-1),
        lambda system: system.add_part("sail"),
        lambda system: system.drive_harmonic(1, [0, 1], 1),
        lambda system: system.drive_table(1, [0, 1], [[0, 0, 0]]),
        lambda system: system.drive_table(1, [1, 0], [[0, 0, 0], [1, 0, 0]]),
    ],
)
def test_bad_values_leave_the_system_as_it_was(system, change):
    with pytest.raises(hooke.BadValue):
        change(system)
    assert (system.particle_count, system.spring_count, system.is_committed) == (6, 7, False)
    assert hooke.run(system, method="symplectic-euler", step=1e-3, duration=0.01).status == "finished"


@pytest.mark.parametrize("shape", [(5, 3), (6, 2), (17,), (6, 3, 1), ()])
def test_arrays_of_the_wrong_size_never_reach_the_library(system, shape):
    good = np.zeros((6, 3))
    for call in (
        lambda q: system.force(q, good),
        lambda q: system.force(good, q),
        lambda q: system.energy(q, good),
        lambda q: system.momentum(q),
        lambda q: system.derivative_product(good, good, good, q),
    ):
        with pytest.raises(hooke.BadValue, match="shape"):
            call(np.zeros(shape))


def test_calls_out_of_order(system):
    system.commit()
    for call in (
        system.commit,
        lambda: system.pin(0),
        lambda: system.add_particles([[0, 0, 0]], mass=1),
        lambda: system.set_force(lambda t, q, v, force: None),
    ):
        with pytest.raises(hooke.BadCall):
            call()


def test_a_scene_says_where_it_is_wrong():
    broken = {**SIX_PARTICLES, "gravitiy": 1}
    with pytest.raises(hooke.BadValue, match=r"^broken\.json:\d+:\d+: gravitiy"):
        hooke.Scene.parse(broken, name="broken.json")


def test_a_missing_scene(tmp_path):
    for use in (hooke.Scene.load, hooke.run, hooke.compare):
        with pytest.raises(hooke.BadValue, match="none.json.*No such file"):
            use(tmp_path / "none.json")


def test_an_output_that_cannot_be_written(system, tmp_path):
    with pytest.raises(hooke.IOFailed, match="nowhere"):
        hooke.run(
            system, method="symplectic-euler", step=1e-3, duration=0.01, output=tmp_path / "nowhere/out.h5"
        )


def test_an_unsuited_method():
    problem = hooke.FirstOrder(lambda t, x, rate: None, [1.0])
    with pytest.raises(hooke.Unsuited):
        problem.run(method="symplectic-euler", step=0.1, duration=1)


def test_an_unknown_method_lists_those_there_are(system):
    with pytest.raises(hooke.BadValue, match="symplectic-euler"):
        hooke.run(system, method="magic", step=1e-3, duration=1)


def test_a_diverged_run_is_a_result():
    system = build_oscillator(k=20.0, m=0.5)
    result = hooke.run(system, method="forward-euler", step=0.1, duration=100)
    assert result.status == "diverged" and "diverge" in result.message
    assert np.isfinite(result.state.q).all()
    assert 0 < result.state.t <= result.diverged_at < 100


def test_the_step_limit_is_a_result(system):
    result = hooke.run(system, method="cvode-adams", duration=10, rtol=1e-9, max_steps=20)
    assert result.status == "step-limit" and 0 < result.state.t < 10 and result.counts["steps"] == 20


def test_a_finished_run_has_no_message(system):
    result = hooke.run(system, method="symplectic-euler", step=1e-3, duration=0.01)
    assert (result.status, result.message, result.stop_value) == ("finished", "", 0)
    assert np.isnan(result.diverged_at)


def test_messages_belong_to_threads():
    with pytest.raises(hooke.BadValue):
        hooke.Options.for_run()["rtol"] = -1
    mine = lib.hooke_last_error()
    seen = []
    thread = threading.Thread(target=lambda: seen.append(lib.hooke_last_error()))
    thread.start()
    thread.join()
    assert seen == [b""] and lib.hooke_last_error() == mine != b""


@pytest.mark.parametrize(
    "kind, opening",
    [
        (hooke.BadValue, lambda: hooke.run("none.json")),
        (hooke.BadValue, lambda: hooke.Scene.load("none.json")),
        (hooke.BadValue, lambda: hooke.Scene().mesh(file="none.obj", mass=1, structural={"stiffness": 1})),
        (hooke.IOFailed, lambda: hooke.open("none.h5")),
        (hooke.IOFailed, lambda: hooke.verify("none.h5")),
    ],
)
def test_a_missing_file_is_not_found(kind, opening):
    with pytest.raises(FileNotFoundError, match="No such file") as caught:
        opening()
    assert isinstance(caught.value, kind) and caught.value.status == kind.status


def test_other_failures_of_files_are_found(tmp_path):
    with pytest.raises(hooke.BadValue, match="is a directory; allowed: a scene or trajectory file$") as caught:
        hooke.Scene.load(tmp_path)
    assert not isinstance(caught.value, FileNotFoundError)


def test_no_particles_yet():
    with pytest.raises(hooke.BadValue, match="there is no particle 0; there are no particles yet$"):
        hooke.System().pin(0)


def test_numpy_that_is_missing_is_named():
    code = "import sys; sys.modules['numpy'] = None; import hooke"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=os.environ)
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].startswith("ModuleNotFoundError: hooke needs NumPy, which this Python has not: pip")


def test_a_scene_that_misleads_warns():
    scene = hooke.Scene(gravity=(0, -9.81, 0)).cloth(size=(4, 4), edges=((1, 0, 0), (0, 0, 1)), mass=1)
    with pytest.warns(hooke.StepWarning, match='^part "cloth0" has no stiffness: nothing holds these particles together$'):
        hooke.run(scene, method="rk4", step=1e-3, duration=1e-2)
