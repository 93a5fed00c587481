"""Steps of the implicit methods against a few lines of NumPy that know nothing of hooke's solver."""

import numpy as np
import pytest

import hooke

ROOT = np.sqrt(2)
EDGES = np.array([[0, 1], [1, 2], [2, 3], [3, 4], [0, 2], [1, 3], [2, 4]])
STIFFNESS, DAMPING, REST, MASS, GRAVITY = 300.0, 1.5, 0.9, 0.3, np.array([0, -9.81, 0])
PLACE = np.array([[0, 0, 0], [1, 0, 0.1], [2, 0.2, 0], [2, 1.1, 0.3], [0.7, 1.2, 0]])
SPEED = np.array([[0, 0, 0], [1, 2, 0], [0, -1, 3], [0.5, 0, 0], [0, 1, -2]])


def acceleration(q, v):
    d, w = q[EDGES[:, 0]] - q[EDGES[:, 1]], v[EDGES[:, 0]] - v[EDGES[:, 1]]
    r = np.sqrt((d * d).sum(axis=1))
    tension = (STIFFNESS * (r - REST) + DAMPING * (d * w).sum(axis=1) / r) / REST
    force = np.zeros(q.shape, q.dtype)
    np.subtract.at(force, EDGES[:, 0], (tension / r)[:, None] * d)
    np.add.at(force, EDGES[:, 1], (tension / r)[:, None] * d)
    a = force / MASS + GRAVITY
    a[0] = 0
    return a


def solve(start, place, speed, a):
    """v = speed + a acceleration(place + a v, v), by Newton with derivatives along the imaginary axis."""
    v = start.astype(complex)
    for _ in range(30):
        residual = v - speed - a * acceleration(place + a * v, v)
        jacobian = np.empty((v.size, v.size))
        for k in range(v.size):
            moved = v.real.astype(complex)
            moved.flat[k] += 1e-40j
            jacobian[:, k] = (moved - speed - a * acceleration(place + a * moved, moved)).imag.ravel() / 1e-40
        change = np.linalg.solve(jacobian, residual.real.ravel()).reshape(v.shape)
        v = v.real - change + 0j
        if np.abs(change).max() < 1e-15:
            break
    return place + a * v.real, v.real


def tr_bdf2(q, v, h):
    c, d = 2 - ROOT, (ROOT - 1) / 2
    a = c * h / 2
    middle, speed = solve(v, q + a * v, v + a * acceleration(q, v), a)
    return solve(speed, (1 + d) * middle - d * q, (1 + d) * speed - d * v, a)


def implicit_midpoint(q, v, h):
    _, speed = solve(v, q, v, h / 2)
    return q + h * speed, 2 * speed - v


def backward_euler(q, v, h):
    return solve(v, q, v, h)


@pytest.mark.parametrize("step", [1e-3, 0.02])
@pytest.mark.parametrize("formula", [tr_bdf2, implicit_midpoint, backward_euler], ids=lambda f: f.__name__.replace("_", "-"))
def test_steps_are_the_formula(formula, step):
    system = hooke.System()
    system.add_particles(PLACE, velocity=SPEED, mass=MASS)
    system.pin([0])
    system.add_springs("net", EDGES, stiffness=STIFFNESS, damping=DAMPING, rest_length=REST)
    system.set_gravity(GRAVITY)
    state = system.state()
    integrator = hooke.Integrator(system, method=formula.__name__.replace("_", "-"), step=step, newton_tolerance=1e-12)
    q, v = PLACE.astype(float), SPEED.astype(float)
    for _ in range(20):
        q, v = formula(q, v, step)
        integrator.step(state, 1)
        np.testing.assert_allclose(state.q, q, rtol=0, atol=1e-12)
        np.testing.assert_allclose(state.v, v, rtol=0, atol=1e-12 / step)
