"""Python functions called by the library: their arguments, and their exceptions."""

import gc
import os
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest
from conftest import PACKAGES, build_oscillator, build_six_particles

import hooke
from hooke._status import pending

RUN = {"method": "symplectic-euler", "step": 1e-2, "duration": 1.0, "every": 0.1}


class Oops(Exception):
    pass


def free_particle():
    system = hooke.System()
    system.add_particles([[0, 0, 0]], [[1, 0, 0]], mass=2)
    return system


def test_a_force_in_python_equals_the_same_force_in_the_library():
    """Drag as a callback against drag of the system."""
    plain, called = build_six_particles(), build_six_particles()
    plain.set_drag(0.3)

    def drag(t, q, v, force):
        force[:5] -= 0.3 * v[:5]

    called.set_force(drag)
    a, b = (hooke.run(system, **RUN).state for system in (plain, called))
    np.testing.assert_allclose(b.q, a.q, rtol=1e-13, atol=1e-13)
    assert plain.forces != called.forces and "callback" in called.forces


def test_what_a_force_sees():
    seen = []

    def force(t, q, v, force):
        seen.append(
            (t, q.copy(), v.copy(), q.flags.writeable, v.flags.writeable, force.flags.writeable, force.shape)
        )

    system = build_six_particles()
    system.set_force(force)
    state = system.state()
    system.force(state.q, state.v, t=2.5)
    t, q, v, *flags, shape = seen[0]
    assert t == 2.5 and flags == [False, False, True] and shape == (6, 3)
    np.testing.assert_array_equal(q, state.q)
    np.testing.assert_array_equal(v, state.v)


def test_a_product_is_used_for_the_derivative():
    def force(t, q, v, out):
        out -= 3 * q**3

    def product(t, q, v, dq, dv, out):
        out -= 9 * q**2 * dq
        calls.append(dv.shape)

    calls = []
    rng = np.random.default_rng(1)
    q, v, dq, dv = rng.normal(size=(4, 6, 3))
    without, given = build_six_particles(), build_six_particles()
    without.set_force(force)
    given.set_force(force, product)
    exact = given.derivative_product(q, v, dq, dv)
    assert calls == [(6, 3)]
    np.testing.assert_allclose(without.derivative_product(q, v, dq, dv), exact, rtol=1e-6, atol=1e-6)
    plain = build_six_particles().derivative_product(q, v, dq, dv)
    np.testing.assert_allclose(exact - plain, -9 * q**2 * dq, rtol=1e-10, atol=1e-10)


def test_a_drive_moves_a_particle():
    system = build_oscillator()

    def drive(t, q, v):
        q[:] = [[1 + t, 2 * t, 0]]
        v[:] = [[1, 2, 0]]

    system = hooke.System()
    system.add_particles([[0, 0, 0], [1, 0, 0]], mass=1)
    system.add_springs("s", [[0, 1]], stiffness=1)
    system.drive_callback(1, drive)
    result = hooke.run(system, **RUN)
    np.testing.assert_allclose(result.state.q[1], [2, 2, 0], rtol=1e-14)
    assert result.state.v[1].tolist() == [1, 2, 0] and result.state.q[0, 1] > 0


def test_callbacks_stay_alive():
    system = free_particle()
    system.set_force(lambda t, q, v, force: None)
    integrator, state = hooke.Integrator(system, **RUN), system.state()
    del system
    gc.collect()
    churn = [hooke.System() for _ in range(100)]
    assert integrator.run(state) == "finished" and len(churn) == 100


# arrays beyond their call

KEEPING = """
import gc, sys
sys.path[:0] = [{package!r}, {tests!r}]
import numpy as np
from conftest import build_oscillator, build_six_particles
import hooke

kept = []

def keep(writes):
    def callback(t, *arrays):
        if writes == 2:
            arrays[0][:], arrays[1][:] = [[1 + t, 0, 0]], [[1, 0, 0]]
        else:
            arrays[-1].flat[0] += 0.25 - arrays[0].flat[0]
        if len(kept) < most:
            views = arrays[0], arrays[-1][:1], arrays[-1].reshape(-1), arrays[0].T
            kept.extend((view, view.copy(), view is not arrays[0] and view.base is not None) for view in views)
        return 0
    return callback

def motion(method, *callbacks, drive=None):
    system = build_six_particles()
    if callbacks:
        system.set_force(*callbacks)
    if drive:
        system.drive_callback(4, drive)
    hooke.run(system, method=method, step=1e-3, duration=0.01)

def rates(dtype):
    start = np.ones(3, dtype)
    hooke.FirstOrder(keep(1), start).run(method="rk4", step=1e-3, duration=0.01)
    hooke.FirstOrder(keep(1), start).run(method="cvode-adams", duration=0.01)

def coordinates(method, *product):
    hooke.SecondOrder(keep(1), [1.0, 2.0], None, 0.5, *product).run(method=method, step=1e-3, duration=0.01)

work = {{
    "force": lambda: motion("rk4", keep(1)),
    "study": lambda: hooke.study(build_oscillator(), ["rk4"], force=keep(1), steps=[1e-3], duration=2e-3, every=1e-3),
    "difference": lambda: motion("backward-euler", keep(1)),
    "product": lambda: motion("backward-euler", lambda *_: None, keep(1)),
    "drive": lambda: motion("verlet", drive=keep(2)),
    "rate": lambda: rates(float),
    "complex": lambda: rates(complex),
    "coordinates": lambda: coordinates("verlet"),
    "coordinates' product": lambda: coordinates("backward-euler", keep(1)),
}}
for name, run in work.items():
    most = len(kept) + 16
    run()
    assert len(kept) >= most, name
    gc.collect()
    churn = [np.full(9 * n, 7.0) for n in range(300)]
    for array, copy, _ in kept:
        np.testing.assert_array_equal(array, copy, name)
for array, _, _ in kept:
    if array.flags.writeable:
        array[...] = -1.0
states = [build_six_particles().state() for _ in range(100)]
assert all(np.isfinite(state.q).all() for state in states)
print(len(kept), "kept")
"""


def test_what_is_kept_outlives_everything():
    """In a process of its own, since memory that was freed ends it."""
    script = KEEPING.format(package=str(PACKAGES), tests=os.path.dirname(__file__))
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stderr, done.stdout) == (0, "", "144 kept\n")


def test_a_product_that_is_asked_for_may_be_kept():
    kept = []

    def product(t, q, v, dq, dv, out):
        out -= dq
        kept.append((q, v, dq, dv, out))

    system = build_six_particles()
    system.set_force(lambda *_: None, product)
    given = np.random.default_rng(2).normal(size=(4, 6, 3))
    found = system.derivative_product(*given)
    del system
    gc.collect()
    churn = [np.full(90, np.nan) for _ in range(100)]
    np.testing.assert_array_equal(kept[0][:4], given)
    np.testing.assert_array_equal(kept[0][4], found)
    assert len(churn) == 100


def test_an_exception_may_keep_arrays():
    def force(t, q, v, force):
        raise Oops(q, force)

    system = build_six_particles()
    system.set_force(force)
    expected = system.state().q.copy()
    with pytest.raises(Oops) as caught:
        hooke.run(system, **RUN)
    del system
    gc.collect()
    q, out = caught.value.args
    churn = [np.full(54, np.nan) for _ in range(100)]
    np.testing.assert_array_equal(q, expected)
    assert np.isfinite(out).all() and len(churn) == 100


def reshaped(arrays, seen):
    for array in arrays:
        seen.add(array.shape)
        array.shape = (array.size,)
        array.flags.writeable = False


@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_every_call_has_arrays_of_its_own_shape():
    seen = {name: set() for name in ("force", "product", "drive", "rate", "observer")}

    def shaping(name):
        return lambda t, *arrays: reshaped(arrays, seen[name])

    system = build_six_particles()
    system.set_force(shaping("force"), shaping("product"))
    system.drive_callback(4, shaping("drive"))
    state, options = system.state(), {"method": "backward-euler", "step": 1e-3, "duration": 3e-3}
    hooke.run(system, on_step=(1, lambda step, state: reshaped((state.q, state.v), seen["observer"])), state=state, **options)
    hooke.FirstOrder(shaping("rate"), [1.0, 2.0]).run(method="rk4", step=0.1, duration=0.3)
    assert seen["rate"] == {(2,)} and seen["drive"] == {(1, 3)}
    assert seen["force"] == seen["product"] == seen["observer"] == {(6, 3)}
    assert state.q.shape == (6, 3) and state.q.flags.writeable and state.x.shape == (18,)


def raising(exception):
    def callback(*_):
        raise exception

    return callback


def run_force(exception):
    system = free_particle()
    system.set_force(raising(exception))
    hooke.run(system, **RUN)


def query_force(exception):
    system = free_particle()
    system.set_force(raising(exception))
    system.force([[0, 0, 0]], [[0, 0, 0]])


def query_product(exception):
    system = free_particle()
    system.set_force(lambda *_: None, raising(exception))
    system.derivative_product(*np.zeros((4, 1, 3)))


def start_drive(exception):
    system = free_particle()
    system.drive_callback(0, raising(exception))
    system.state()


def run_adaptive(exception):
    system = free_particle()
    system.set_force(raising(exception))
    hooke.run(system, method="cvode-adams", duration=1)


def run_first_order(exception):
    hooke.FirstOrder(raising(exception), [1.0]).run(method="forward-euler", step=0.1, duration=1)


PATHS = [
    run_force,
    query_force,
    query_product,
    start_drive,
    run_adaptive,
    run_first_order,
    lambda exception: hooke.run(free_particle(), on_frame=raising(exception), **RUN),
    lambda exception: hooke.run(free_particle(), on_step=(7, raising(exception)), **RUN),
    lambda exception: hooke.run(free_particle(), progress=raising(exception), **RUN),
    lambda exception: hooke.compare(
        build_oscillator(), ["forward-euler"], progress=raising(exception), **RUN
    ),
]


@pytest.mark.parametrize("path", PATHS, ids=lambda path: getattr(path, "__name__", None))
@pytest.mark.parametrize("kind", [Oops, ZeroDivisionError, KeyboardInterrupt, SystemExit])
def test_the_same_exception_comes_out(path, kind):
    exception = kind("out of coffee")
    with pytest.raises(kind) as caught:
        path(exception)
    assert caught.value is exception
    assert pending.exception is None


def test_an_exception_stops_at_once():
    calls = []

    def watch(step, state):
        calls.append(step)
        if step == 30:
            raise Oops

    system = free_particle()
    integrator, state = hooke.Integrator(system, **RUN), system.state()
    with pytest.raises(Oops):
        integrator.run(state, on_step=(10, watch))
    assert calls == [10, 20, 30] and state.t == pytest.approx(0.3)
    # and the integrator can be used again, without the observer
    assert integrator.run(state) == "finished" and calls[-1] == 30
    assert state.t == pytest.approx(1.3)


def test_an_observer_is_let_go_when_its_run_is_over():
    system, seen = free_particle(), []
    integrator, state = hooke.Integrator(system, **RUN), system.state()
    integrator.run(state, on_step=(1, lambda step, _: seen.append(step)))
    told = len(seen)
    gc.collect()
    integrator.step(state, 3)
    assert len(seen) == told > 0


def test_a_number_stops_the_run_and_comes_out():
    result = hooke.run(free_particle(), on_step=(1, lambda step, state: 42 if step == 5 else None), **RUN)
    assert (result.status, result.stop_value, result.counts["steps"]) == ("stopped", 42, 5)
    assert "42" in result.message and result.state.t == pytest.approx(0.05)


@pytest.mark.parametrize(
    "answer, stops",
    [
        (None, False),
        (0, False),
        (False, False),
        (np.False_, False),
        (True, True),
        (np.True_, True),
        (-3, True),
    ],
)
def test_what_an_answer_means(answer, stops):
    result = hooke.run(free_particle(), on_frame=lambda step, state: answer, **RUN)
    assert result.status == ("stopped" if stops else "finished")


@pytest.mark.parametrize(
    "answer, kind", [("no", TypeError), (np.ones(3), TypeError), (0.5, TypeError), (2**32, OverflowError)]
)
def test_an_answer_that_means_nothing(answer, kind):
    with pytest.raises(kind):
        hooke.run(free_particle(), on_frame=lambda step, state: answer, **RUN)


def test_stopping_where_nothing_runs():
    system = free_particle()
    system.set_force(lambda t, q, v, force: 1)
    with pytest.raises(hooke.Stopped):
        system.force([[0, 0, 0]], [[0, 0, 0]])
    system = free_particle()
    system.drive_callback(0, lambda t, q, v: 1)
    with pytest.raises(hooke.Stopped):
        system.state()


def test_observers_see_the_state_that_runs():
    frames, steps = [], []
    system = free_particle()
    state = system.state()
    integrator = hooke.Integrator(system, **RUN)
    status = integrator.run(
        state,
        on_frame=lambda step, seen: frames.append((step, seen.t, seen is state, seen.q[0, 0])),
        on_step=(25, lambda step, seen: steps.append((step, seen.q[0, 0]))),
    )
    assert status == "finished" and integrator.frame_count == 11
    assert [step for step, *_ in frames] == list(range(0, 101, 10))
    assert all(same for _, _, same, _ in frames)
    assert [t for _, t, _, _ in frames] == [k * 10 * 1e-2 for k in range(11)]
    np.testing.assert_allclose([x for *_, x in frames], [t for _, t, _, _ in frames], rtol=1e-12, atol=1e-15)
    assert [step for step, _ in steps] == [25, 50, 75, 100]


def test_an_integrator_does_not_run_within_itself():
    system = free_particle()
    integrator, state = hooke.Integrator(system, **RUN), system.state()
    with pytest.raises(hooke.BadCall):
        integrator.run(state, on_frame=lambda step, seen: integrator.step(seen))
    assert integrator.run(system.state()) == "finished"


def test_a_callback_may_run_another_system_that_fails():
    inner = free_particle()
    inner.set_force(raising(Oops("inner")))

    def outer(step, state):
        with pytest.raises(Oops):
            hooke.run(inner, **RUN)

    assert hooke.run(free_particle(), on_frame=outer, **RUN).status == "finished"


def test_threads_keep_their_exceptions_apart():
    outcomes = {}

    def work(number):
        system = build_oscillator()
        exception = Oops(number)

        def watch(step, state):
            if number % 2 and step == 50:
                raise exception

        try:
            outcomes[number] = hooke.run(system, on_step=(1, watch), **RUN).status
        except Oops as caught:
            outcomes[number] = caught is exception

    threads = [threading.Thread(target=work, args=(number,)) for number in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert outcomes == {number: True if number % 2 else "finished" for number in range(8)}


def test_ctrl_c_ends_a_run():
    system = build_oscillator()
    steps = []

    def interrupt(step, state):
        steps.append(step)
        if len(steps) == 3:
            os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        hooke.run(system, on_frame=interrupt, **RUN)
    assert len(steps) in (3, 4)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_ctrl_c_while_no_callback_is_given():
    system = build_oscillator()
    timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        hooke.run(system, method="symplectic-euler", step=1e-6, duration=1000, every=1e-3)
    timer.join()


def test_a_handler_of_your_own_is_left_alone():
    seen = []
    before = signal.signal(signal.SIGINT, lambda *_: seen.append(1))
    try:
        hooke.run(
            free_particle(),
            on_frame=lambda step, state: os.kill(os.getpid(), signal.SIGINT) if step == 50 else None,
            **RUN,
        )
    finally:
        signal.signal(signal.SIGINT, before)
    assert seen == [1]
