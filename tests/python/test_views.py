"""Arrays over the library's memory: no copy, and alive as long as they are used."""

import ctypes
import gc
import weakref

import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator, build_six_particles

import hooke
from hooke._library import lib
from hooke._memory import address_of

POSITION = np.array(SIX_PARTICLES["particles"]["position"], float)
VELOCITY = np.array(SIX_PARTICLES["particles"]["velocity"], float)


def test_q_and_v_are_the_memory_of_the_state(system):
    state = system.state()
    assert state.q.shape == state.v.shape == (6, 3)
    assert state.q.ctypes.data == address_of(lib.hooke_state_position(state._handle))
    assert state.v.ctypes.data == address_of(lib.hooke_state_velocity(state._handle))
    np.testing.assert_array_equal(state.q, POSITION)
    np.testing.assert_array_equal(state.v, VELOCITY)


def test_writing_through_a_view_moves_the_particles(system):
    state, other = system.state(), system.state()
    state.q[2] = [7, 8, 9]
    state.v += 1
    state.t = 2.5
    other.assign(state)
    assert other.q[2].tolist() == [7, 8, 9] and other.t == 2.5
    np.testing.assert_array_equal(other.v, VELOCITY + 1)
    state.q = 0
    assert not state.x.any() and other.q.any()


@pytest.mark.parametrize("name, expected", [("q", POSITION), ("v", VELOCITY)])
def test_a_view_outlives_its_state(system, name, expected):
    state = system.state()
    array, handle = getattr(state, name), weakref.ref(state._handle)
    part = array[1:4]
    del state, system, array
    gc.collect()
    churn = [build_oscillator().state() for _ in range(200)]  # would reuse the memory if it were free
    np.testing.assert_array_equal(part, expected[1:4])
    assert handle() is not None and len(churn) == 200
    del part
    gc.collect()
    assert handle() is None


def test_masses_outlive_their_system_and_cannot_be_written():
    system = build_six_particles()
    mass, inverse, handle = system.masses, system.inverse_masses, weakref.ref(system._handle)
    del system
    gc.collect()
    assert mass.tolist() == [1, 2, 3, 4, 5, 6]
    assert inverse.tolist() == [1, 1 / 2, 1 / 3, 1 / 4, 1 / 5, 0]
    with pytest.raises(ValueError):
        mass[0] = 2
    del mass, inverse
    gc.collect()
    assert handle() is None


def test_a_system_outlives_its_scene(scene):
    system = scene.system
    del scene
    gc.collect()
    assert system.particle_count == 6
    assert system.state().q.shape == (6, 3)


def test_an_integrator_outlives_the_names_of_its_system(scene):
    integrator, state = (
        hooke.Integrator(scene.system, method="symplectic-euler", step=1e-3, duration=0.01),
        scene.system.state(),
    )
    options = integrator.options
    del scene
    gc.collect()
    assert integrator.run(state) == "finished"
    del integrator
    gc.collect()
    assert options["step"] == 1e-3


def test_an_integrator_outlives_the_names_of_a_first_order_problem():
    def make():
        problem = hooke.FirstOrder(lambda t, x, rate: rate.fill(2), [1.0])
        return hooke.Integrator(problem, method="forward-euler", step=0.5, duration=1), problem.state()

    integrator, state = make()
    gc.collect()
    churn = [hooke.FirstOrder(lambda t, x, rate: rate.fill(-1), [1.0]) for _ in range(100)]
    assert integrator.run(state) == "finished" and state.x[0] == 3 and len(churn) == 100


def test_garbage_in_a_cycle_is_released_children_first():
    released = []

    class Spy:
        """Replaces a destroy function; ctypes functions cannot be observed."""

        def __init__(self, name, destroy):
            self.name, self.destroy = name, destroy

        def __call__(self, pointer):
            released.append(self.name)
            self.destroy(pointer)

    def make():
        holder = []
        system = build_oscillator()
        system.set_force(lambda t, q, v, force: holder.clear())
        integrator = hooke.Integrator(system, method="symplectic-euler", step=1e-3)
        for name, owner in (("system", system), ("integrator", integrator)):
            owner._handle._destroy = Spy(name, owner._handle._destroy)
        holder += [integrator, system]  # the callback refers to it: a cycle through both

    gc.disable()
    try:
        make()
        assert released == []
    finally:
        gc.enable()
    gc.collect()
    assert released == ["integrator", "system"]


def test_a_state_without_particles_has_empty_views():
    state = hooke.System().state()
    assert state.q.shape == state.v.shape == (0, 3)


def test_a_state_of_a_first_order_problem_is_a_row():
    state = hooke.FirstOrder(lambda t, x, rate: None, [1.0, 2.0]).state()
    assert state.x.tolist() == [1, 2] and state.x.ctypes.data == address_of(
        lib.hooke_state_position(state._handle)
    )
    with pytest.raises(AttributeError, match="x"):
        print(state.q)
    other = state.copy()
    other.x[0] = 5
    assert state.x[0] == 1


def test_a_copy_is_separate(system):
    state = system.state()
    state.t = 3.0
    other = state.copy()
    other.q[0] = 1e3
    assert other.t == 3.0 and state.q[0, 0] == 0


def test_states_of_different_sizes_are_not_assigned(system):
    with pytest.raises(hooke.BadValue):
        system.state().assign(build_oscillator().state())


def test_a_view_can_be_handed_to_ctypes(system):
    q = system.state().q
    assert ctypes.cast(q.ctypes.data, ctypes.POINTER(ctypes.c_double))[3] == 1.0
