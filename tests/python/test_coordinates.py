"""Second-order problems of generalized coordinates."""

import pickle

import numpy as np
import pytest

import hooke

RUN = {"step": 1e-2, "duration": 1.0}


def swing(t, q, v, force):
    force -= 9.81 * np.sin(q)


def swing_product(t, q, v, dq, dv, out):
    out -= 9.81 * np.cos(q) * dq


@pytest.mark.parametrize("size", [1, 2, 3, 4])
def test_frames_and_states_have_the_size_of_the_problem(size):
    problem = hooke.SecondOrder(swing, np.full(size, 0.5), np.zeros(size))
    seen = []
    result = problem.run(method="verlet", frames=True, on_frame=lambda step, state: seen.append(state.q.shape), **RUN)
    assert result.status == "finished" and set(seen) == {(size,)}
    assert result.frames.q.shape == result.frames.v.shape == (101, size)
    assert np.ptp(result.frames.q, axis=1).max() == 0.0
    energy = 0.5 * result.frames.v**2 - 9.81 * np.cos(result.frames.q)
    assert np.ptp(energy) < 1e-3
    again = pickle.loads(pickle.dumps(result.state.copy()))
    np.testing.assert_array_equal(again.v, result.state.v)
    assert "coordinates" in repr(again) and "coordinates" in repr(problem)


def test_a_derivative_is_asked_for():
    calls = []

    def product(t, q, v, dq, dv, out):
        calls.append(t)
        swing_product(t, q, v, dq, dv, out)

    ends = [
        hooke.SecondOrder(swing, [1.0], derivative=derivative).run(method="backward-euler", **RUN).state.q
        for derivative in (product, None)
    ]
    assert len(calls) > 50
    np.testing.assert_allclose(*ends, atol=1e-3)


def test_inverse_masses():
    def spring(t, q, v, force):
        force[:] = -q

    result = hooke.SecondOrder(spring, [1.0, 1.0], inverse_mass=[1.0, 4.0]).run(method="rk4", **RUN)
    np.testing.assert_allclose(result.state.q, np.cos([1.0, 2.0]), atol=1e-8)


def test_a_loop_of_the_callers_own():
    problem = hooke.SecondOrder(swing, [1.0])
    integrator, state = hooke.Integrator(problem, method="rk4", step=0.01), problem.state()
    for _ in range(100):
        assert integrator.step(state) == "finished"
    np.testing.assert_array_equal(state.q, problem.run(method="rk4", **RUN).state.q)
    with pytest.raises(hooke.Unsuited, match="second-order problem"):
        integrator.get([0])


def test_bad_values():
    for arguments in (([],), ([[1.0]],), ([1.0], [0.0, 0.0]), ([1.0], None, [1.0, 1.0]), (["a"],)):
        with pytest.raises(hooke.BadValue):
            hooke.SecondOrder(swing, *arguments)
    with pytest.raises(hooke.BadValue, match=r"inverse_mass\[0\]"):
        hooke.SecondOrder(swing, [1.0], inverse_mass=0.0).run(method="rk4", **RUN)


def test_an_exception_ends_the_run():
    def fails(t, q, v, force):
        raise ZeroDivisionError("within")

    with pytest.raises(ZeroDivisionError, match="within"):
        hooke.SecondOrder(fails, [1.0]).run(method="verlet", **RUN)
