"""The package refuses wrong arguments with a sentence; objects that can be copied are copied."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator

import hooke

RUN = {"method": "verlet", "step": 1e-3, "duration": 0.1, "every": 0.01}


def commit(name):
    system = hooke.System()
    system.add_particles([[0, 0, 0], [1, 0, 0]], mass=1)
    system.add_springs(name, [[0, 1]], stiffness=1)


def checkpoint(path):
    integrator = hooke.Integrator(build_oscillator(), **RUN)
    integrator.write_checkpoint(path, build_oscillator().state())


@pytest.mark.parametrize(
    "give",
    [
        lambda text: hooke.run(build_oscillator(), output=text, **RUN),
        lambda text: hooke.run(build_oscillator(), **{**RUN, "method": text}),
        lambda text: hooke.Scene.load(text),
        lambda text: build_oscillator().save(text),
        lambda text: build_oscillator().save("x.json", title=text),
        lambda text: hooke.Trajectory(text),
        lambda text: build_oscillator().step_bound(text, [[0, 0, 0], [1, 0, 0]]),
        lambda text: hooke.Options.for_part(text),
        commit,
        checkpoint,
    ],
)
def test_a_nul_in_a_text_is_refused(give, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match="'verlet\\\\x00b' is not allowed: a text has no NUL character"):
        give("verlet\0b")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    "steps, message",
    [
        (2**64, "18446744073709551616 is not allowed; whole numbers go from"),
        (2**64 + 3, "is not allowed"),
        (2**63, "is not allowed"),
        (-1, "steps: -1 is not allowed; 0 or more are"),
        (-(2**64) + 1, "is not allowed"),
        (2.0, "2.0 is not allowed; a whole number is needed"),
        (np.float64(3), "a whole number is needed"),
    ],
)
def test_steps_are_whole_and_fit(steps, message):
    system = build_oscillator()
    state = system.state()
    with pytest.raises(ValueError, match=message):
        hooke.Integrator(system, **RUN).step(state, steps)
    assert state.t == 0


def test_steps_of_numpy_are_taken():
    system = build_oscillator()
    state = system.state()
    hooke.Integrator(system, **RUN).step(state, np.int32(3))
    assert state.t == 3e-3


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, lambda state: pickle.loads(pickle.dumps(state))])
def test_a_state_can_be_copied(again):
    system = hooke.Scene.parse(SIX_PARTICLES).system
    whole, state = system.state(), system.state()
    integrator = hooke.Integrator(system, **RUN)
    integrator.step(state, 30)
    other = again(state)
    assert other.t == state.t and np.array_equal(other.q, state.q) and np.array_equal(other.v, state.v)
    before = state.q.copy()
    other.q += 1
    assert np.array_equal(state.q, before)
    other.q = before
    hooke.Integrator(system, **RUN).step(other, 70)
    hooke.Integrator(system, **RUN).step(whole, 100)
    assert np.array_equal(other.q, whole.q) and np.array_equal(other.copy().v, whole.v)


@pytest.mark.parametrize("x0", [[1.0, 2.0], [1.0 + 2.0j]])
@pytest.mark.parametrize("again", [copy.deepcopy, lambda state: pickle.loads(pickle.dumps(state))])
def test_a_state_of_first_order_can_be_copied(x0, again):
    state = hooke.FirstOrder(lambda t, x, rate: None, x0).state()
    state.t = 0.5
    other = again(state)
    assert other.t == 0.5 and np.array_equal(other.x, state.x) and other.x.dtype == state.x.dtype


@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, pickle.dumps])
def test_what_holds_an_object_of_the_library_cannot_be_copied(again):
    system = hooke.Scene.parse(SIX_PARTICLES).system
    held = [
        hooke.Integrator(system, **RUN),
        hooke.FirstOrder(lambda t, x, rate: None, [1.0]),
        system.state()._handle,
    ]
    for one in held:
        with pytest.raises(TypeError, match=f"a {type(one).__name__} holds an object of the library and cannot be"):
            again(one)


def test_masked_elements_are_refused():
    masked, whole = np.ma.array([[0.0, 0, 0], [1, 0, 0]]), np.ma.array([[0.0, 0, 0], [1, 0, 0]])
    masked[1, 2] = np.ma.masked
    state = build_oscillator().state()
    two = hooke.System()
    two.add_particles(whole, mass=np.ma.array([1.0, 2.0]))
    two.set_gravity(np.ma.array([0, -9.81, 0]))
    assert np.array_equal(two.state().q, whole.data)
    for give, place in [
        (lambda: hooke.System().add_particles(masked, mass=1), r"position\[1\]\[2\]"),
        (lambda: hooke.System().add_particles(list(masked), mass=1), r"position\[1\]\[2\]"),
        (lambda: two.pin(np.ma.array([0, 1], mask=[False, True])), r"particles\[1\]"),
        (lambda: setattr(state, "q", masked[1:]), r"q\[0\]\[2\]"),
        (lambda: setattr(state, "x", np.ma.masked), "x"),
        (lambda: hooke.FirstOrder(lambda t, x, rate: None, np.ma.array([1.0], mask=[True])), r"x0\[0\]"),
        (lambda: hooke.Options.for_run().set(step=np.ma.masked), "step"),
        (lambda: hooke.Options.for_springs().set(stiffness=np.ma.array([1.0, 2.0], mask=[0, 1])), r"stiffness\[1\]"),
    ]:
        with pytest.raises(ValueError, match=f"^{place}: is masked; give it a value or leave it out"):
            give()


def build_cloth(side=120):
    system = hooke.System()
    system.add_part("cloth", mass=1, edges=[[1, 0, 0], [0, 0, 1]], size=[side, side], structural={"stiffness": 100})
    return system


def go_on(pipe, system, held):
    integrator, state = held.pop()
    integrator.step(state, 20)
    pipe.send(state.q.copy())
    del integrator
    other = system.state()
    hooke.Integrator(system, threads=2, **SMALL).step(other, 40)
    pipe.send(other.q.copy())


SMALL = {"method": "symplectic-euler", "step": 1e-5}


def test_a_fork_goes_on():
    """Threads do not survive in a child; integrators with threads do, also those made before the fork."""
    context = multiprocessing.get_context("fork")
    system = build_cloth()
    integrator, state = hooke.Integrator(system, threads=2, **SMALL), system.state()
    integrator.step(state, 20)
    ours, its = context.Pipe()  # a queue needs /dev/shm
    child = context.Process(target=go_on, args=(its, system, [(integrator, state)]))
    del integrator
    child.start()
    try:
        forked, fresh = [ours.recv() for _ in range(2) if ours.poll(60)]
    finally:
        child.kill()
    child.join()
    hooke.Integrator(system, **SMALL).step(state, 20)
    assert np.array_equal(forked, state.q) and np.array_equal(fresh, state.q)
