"""Building and querying systems."""

import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator

import hooke


@pytest.fixture
def moved():
    rng = np.random.default_rng(7)
    return rng.normal(size=(6, 3)) * 2, rng.normal(size=(6, 3))


def test_calls_and_scene_make_the_same_system(scene, system, moved):
    a, b = scene.system, system
    assert a.groups == b.groups == [("edges", 7)]
    np.testing.assert_array_equal(a.masses, b.masses)
    np.testing.assert_array_equal(a.inverse_masses, b.inverse_masses)
    np.testing.assert_array_equal(a.spring_ends, b.spring_ends)
    for left, right in zip(a.spring_material, b.spring_material):
        np.testing.assert_array_equal(left, right)
    np.testing.assert_array_equal(a.force(*moved), b.force(*moved))
    assert a.forces == b.forces == ["springs", "gravity"]


def test_what_a_system_tells(system):
    assert not system.is_committed
    assert (system.particle_count, system.spring_count) == (6, 7)
    assert system.spring_ends.tolist() == SIX_PARTICLES["springs"][0]["between"]
    assert system.is_committed and system.free_count == 5 and system.memory > 0
    kappa, gamma, rest = system.spring_material
    q = system.state().q
    length = np.linalg.norm(np.diff(q[system.spring_ends], axis=1)[:, 0], axis=1)
    np.testing.assert_allclose(rest, 0.9 * length, rtol=1e-15)
    np.testing.assert_allclose(kappa, 100 / rest, rtol=1e-15)
    np.testing.assert_allclose(gamma, 0.5 / rest, rtol=1e-15)
    assert "6 particles, 7 springs" in repr(system)


def test_the_energies_are_those_of_the_formula(system, moved):
    q, v = moved
    kappa, _, rest = system.spring_material
    r = np.linalg.norm(np.diff(q[system.spring_ends], axis=1)[:, 0], axis=1)
    m = system.masses.copy()
    m[5] = 0
    kinetic, spring, gravity = 0.5 * m @ (v**2).sum(axis=1), 0.5 * kappa @ (r - rest) ** 2, 9.81 * m @ q[:, 1]
    assert system.kinetic_energy(v) == pytest.approx(kinetic, rel=1e-13)
    assert system.spring_energy(q) == pytest.approx(spring, rel=1e-13)
    assert system.gravity_energy(q) == pytest.approx(gravity, rel=1e-13)
    assert system.potential_energy(q) == pytest.approx(spring + gravity, rel=1e-13)
    assert system.energy(q, v) == pytest.approx(kinetic + spring + gravity, rel=1e-13)
    np.testing.assert_allclose(system.momentum(v), m @ v, rtol=1e-13)
    np.testing.assert_allclose(system.angular_momentum(q, v), m @ np.cross(q, v), rtol=1e-12)


def test_bending_is_that_of_the_formula(moved):
    q, v = moved
    system = hooke.System()
    system.add_particles(q, mass=1)
    triples, c = [[0, 1, 2], [3, 5, 1], [2, 4, 0]], np.array([2.0, 0.0, 3.0])
    system.add_bending("bends", triples, c)
    assert (system.bending_count, system.bending_groups) == (3, [("bends", 3)])
    assert system.forces == ["bending"]
    assert (system.bending_count, system.bending_groups) == (2, [("bends", 2)])
    assert system.bending_ends.tolist() == [triples[0], triples[2]]
    np.testing.assert_array_equal(system.bending_coefficient, [2, 3])
    expected, energy = np.zeros((6, 3)), 0.0
    for (i, j, k), stiffness in zip(triples, c):
        d = q[i] - 2 * q[j] + q[k]
        energy += 0.5 * stiffness * d @ d
        for p, factor in ((i, 1), (j, -2), (k, 1)):
            expected[p] -= factor * stiffness * d
    np.testing.assert_allclose(system.force(q, v), expected, rtol=1e-13)
    assert system.bending_energy(q) == pytest.approx(energy, rel=1e-14)
    assert system.potential_energy(q) == system.energy(q, 0 * v) == system.bending_energy(q)


def test_altitude_springs_are_those_of_the_formula():
    system = hooke.System()
    q = np.array([[0, 0, 0], [1, 0, 0], [0.4, 1, 0], [0.5, 0.4, 0.3], [2, 2, 2]])
    system.add_particles(q, mass=1)
    system.add_altitude("a", [[0, 1, 2, 3], [4, 3, 2, 1]], stiffness=[6, 0], damping=[0.3, 0], rest_scale=1.5)
    assert (system.altitude_count, system.altitude_groups) == (2, [("a", 2)])
    assert system.forces == ["altitude"]
    assert (system.altitude_count, system.altitude_groups) == (1, [("a", 1)])
    assert system.altitude_ends.tolist() == [[0, 1, 2, 3]]
    stiffness, damping, rest = system.altitude_material
    assert (stiffness.tolist(), damping.tolist(), rest.shape) == ([6], [0.3], (1, 7))
    assert rest[0, 3] == pytest.approx(0.45, rel=1e-15)
    q[3, 2] = 0.2  # the top is 0.2 over the face of the others, and sinks
    v = np.zeros((5, 3))
    v[3, 2] = -0.5
    weights = np.array([1 - 0.34 - 0.4, 0.34, 0.4, -1, 0])  # of the point below it
    tension = (6 * (0.2 - 0.45) - 0.3 * 0.5) / 0.45
    np.testing.assert_allclose(system.force(q, v)[:, 2], tension * weights, rtol=1e-13, atol=1e-14)
    assert system.altitude_lengths(q) == pytest.approx([0.2], rel=1e-15)
    assert system.altitude_energy(q) == pytest.approx(3 / 0.45 * 0.25**2, rel=1e-13)
    assert system.potential_energy(q) == system.altitude_energy(q)
    assert system.dissipated_power(q, v) == pytest.approx(0.3 / 0.45 * 0.25, rel=1e-13)
    with pytest.raises(hooke.BadValue, match=r"tetrahedra"):
        hooke.System().add_altitude(None, [0, 1, 2], stiffness=1)


def test_anchors_are_springs_to_points():
    system = hooke.System()
    system.add_particles([[0, 0, 0], [1, 0, 0]], mass=1)
    system.add_anchors("wall", [1, 0], points=[[1, 2, 0], [0, 0, 1]], stiffness=[6, 0], damping=[0.3, 0], rest_length=0.5)
    system.add_anchors(None, [0], stiffness=2)
    assert (system.forces, system.anchor_count) == (["anchors"], 2)
    particles, points, stiffness, damping, rest = system.anchors
    assert (particles.tolist(), points.tolist()) == ([1, 0], [[1, 2, 0], [0, 0, 0]])
    assert (stiffness.tolist(), damping.tolist(), rest.tolist()) == ([6, 2], [0.3, 0], [0.5, 0])
    q, v = np.array([[0.1, 0, 0], [1, 0, 0]]), np.array([[0, 0, 0], [3, 1, 0]])
    np.testing.assert_allclose(system.force(q, v), [[-0.2, 0, 0], [0, 6 * 1.5 - 0.3, 0]], rtol=1e-14)
    assert system.potential_energy(q) == pytest.approx(3 * 1.5**2 + 0.01, rel=1e-14)
    assert system.dissipated_power(q, v) == pytest.approx(0.3, rel=1e-14)
    assert "points" in hooke.describe("anchors")
    with pytest.raises(hooke.BadValue, match=r"points"):
        hooke.System().add_anchors(None, [], points=[1, 2, 3, 4], stiffness=1)


def test_parts_tell_what_they_derived():
    system = hooke.System()
    system.add_part(
        "rope",
        "r",
        from_=[0, 0, 0],
        to=[1, 0, 0],
        segments=2,
        density=0.2,
        bending=1,
        stretch={"stiffness": 5, "damping_ratio": 0.5},
    )
    rows = system.derived
    assert rows[0] == ("r", None, "mass of an inner particle", 0.1, "kg")
    assert rows[-1] == ("r", "bending", "c", 8.0, "N/m")
    assert {row.family for row in rows} == {None, "stretch", "bending"}
    np.testing.assert_allclose(system.masses, [0.05, 0.1, 0.05], rtol=1e-15)


def test_the_derivative_is_that_of_the_force(system, moved):
    q, v = moved
    dq, dv = np.random.default_rng(8).normal(size=(2, 6, 3))
    h = 1e-6
    quotient = (system.force(q + h * dq, v + h * dv) - system.force(q - h * dq, v - h * dv)) / (2 * h)
    product = system.derivative_product(q, v, dq, dv)
    np.testing.assert_allclose(product, quotient, rtol=1e-6, atol=1e-6)
    blocks = system.derivative_blocks(q, v)
    total = np.zeros((6, 3))
    for row in range(6):
        for k in range(blocks.row_start[row], blocks.row_start[row + 1]):
            column = blocks.column[k]
            total[row] += blocks.dfdq[k] @ dq[column] + blocks.dfdv[k] @ dv[column]
    np.testing.assert_allclose(total, product, rtol=1e-12, atol=1e-12)


def test_inputs_may_be_lists_flat_or_strided(system, moved):
    q, v = moved
    expected = system.force(q, v)
    np.testing.assert_array_equal(system.force(q.tolist(), v.ravel()), expected)
    np.testing.assert_array_equal(system.force(np.asfortranarray(q), np.repeat(v, 2, axis=0)[::2]), expected)


def test_springs_without_direction_are_counted():
    system = hooke.System()
    system.add_particles(np.zeros((2, 3)), mass=1)
    system.add_springs(None, [[0, 1]], stiffness=1, rest_length=1)
    assert system.coincident_springs(np.zeros((2, 3))) == 1
    assert system.coincident_springs([[0, 0, 0], [1, 0, 0]]) == 0
    assert not system.force(np.zeros((2, 3)), np.zeros((2, 3))).any()
    assert system.groups == [("", 1)]


def test_parts():
    system = hooke.System()
    anchor = system.add_particles([0, 5, 0], mass=1)
    sheet = system.add_part(
        "cloth",
        "sail",
        origin=[0, 0, 0],
        edges=[[1, 0, 0], [0, 0, 2]],
        size=[3, 4],
        mass=1.2,
        pinned="top-corners",
        structural={"stiffness": 50, "damping": 0.02},
        shear={"stiffness": 5},
    )
    line = system.add_part(
        "rope", from_=[0, 0, 0], to=[0, 1, 0], segments=4, mass=1, stretch={"stiffness": 10}
    )
    assert (anchor, sheet, line) == (range(0, 1), range(1, 13), range(13, 18))
    assert system.groups == [("sail.structural", 17), ("sail.shear", 12), ("rope1.stretch", 4)]
    np.testing.assert_allclose(system.masses[1:13], 0.1, rtol=1e-15)
    assert np.flatnonzero(system.inverse_masses == 0).tolist() == [1, 3]


def test_step_bound_of_an_oscillator():
    system = build_oscillator(k=20.0, m=0.5)
    bound = system.step_bound("symplectic-euler", system.state().q)
    exact = 2 / np.sqrt(20 / 0.5)
    assert 0.5 * exact < bound <= exact * (1 + 1e-12)
    assert system.step_bound("forward-euler", system.state().q) == 0
    with pytest.raises(hooke.BadValue):
        system.step_bound("magic", system.state().q)


def test_a_scene_gives_its_title_text_and_options(scene):
    assert scene.title == "six particles" and '"gravity"' in scene.text
    assert scene.run_options["step"] == 1e-3 and scene.run_options["method"] == "symplectic-euler"
    scene.run_options["step"] = 1e-2
    assert scene.run().options["step"] == 1e-2
    assert scene.system is scene.system


APART = ("symplectic-euler", "verlet", "shardlow")  # step positions and velocities apart


def test_facts():
    facts = hooke.build_facts()
    assert facts["version"] and facts["licence"] and facts["instructions"]
    names = [method.name for method in hooke.methods()]
    assert names[:2] == ["forward-euler", "symplectic-euler"]
    for method in hooke.methods():
        assert method.summary and method.adaptive == method.name.startswith("cvode")
        assert method.built or not facts["sundials"]
        assert (method.bodies, method.overdamped) == (method.name != "shardlow", method.name not in APART)
        assert method.first_order == (method.name in ("forward-euler", "heun", "rk4") or method.adaptive)


def test_an_empty_system_runs():
    result = build_empty().run(method="symplectic-euler", step=0.1, duration=1)
    assert result.status == "finished" and result.state.q.shape == (0, 3) and result.counts["steps"] == 10


def build_empty():
    return hooke.System()
