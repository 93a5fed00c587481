"""hooke.modes: values known beforehand, frames of bodies and cables, zero modes, damping, and what states are refused or told."""

import math

import numpy as np
import pytest

import hooke


def turned(axis):
    """The matrix of a rotation by |axis| about it."""
    angle = np.linalg.norm(axis)
    if angle == 0:
        return np.eye(3)
    x, y, z = axis / angle
    across = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * across + (1 - math.cos(angle)) * across @ across


class Frame:
    """Particles at q, of which those of a body move as one: by translations (none where one is pinned, the first) and
    rotation vectors; springs that have these tensions at q."""

    def __init__(self, q, mass, bodies=(), pinned=()):
        self.q, self.mass, self.bodies, self.pinned = np.asarray(q, float), np.asarray(mass, float), bodies, pinned
        inside = {p for body in bodies for p in body}
        self.alone = [p for p in range(len(q)) if p not in inside and p not in pinned]
        self.size = 3 * len(self.alone) + sum(3 if body[0] in pinned else 6 for body in bodies)

    def place(self, y):
        q, at = self.q.copy(), 3 * len(self.alone)
        q[self.alone] += y[:at].reshape(-1, 3)
        for body in self.bodies:
            body, move = list(body), np.zeros(3)
            if body[0] not in self.pinned:
                move, at = y[at : at + 3], at + 3
            point = self.q[body[0]]
            q[body] = point + move + (self.q[body] - point) @ turned(y[at : at + 3]).T
            at += 3
        return q

    def slopes(self, of, h=1e-5):
        unit = h * np.eye(self.size)
        return np.array([(np.asarray(of(e)) - np.asarray(of(-e))) / (2 * h) for e in unit])

    def lengths(self, y):
        return np.linalg.norm(np.subtract(*self.place(y)[self.pairs.T]), axis=1)

    def brace(self, pairs, stiffness, tension):
        """Rest lengths by which the springs hold the frame as it is: the tensions that balance which are nearest to these."""
        self.pairs, self.stiffness = np.asarray(pairs), np.asarray(stiffness, float)
        slopes = self.slopes(self.lengths)
        balance = np.linalg.svd(slopes)[2][np.linalg.matrix_rank(slopes, tol=1e-6) :]
        tension = balance.T @ (balance @ tension)
        self.rest = self.lengths(np.zeros(self.size)) - tension / self.stiffness
        return tension

    def energy(self, y):
        return float(np.sum(0.5 * self.stiffness * (self.lengths(y) - self.rest) ** 2))

    def squares(self):
        """Of the frequencies, of both signs, from differences of the energy and of the positions."""
        free = np.setdiff1d(np.arange(len(self.q)), self.pinned)
        moves = self.slopes(lambda y: self.place(y)[free].ravel())
        mass, h = moves * np.repeat(self.mass[free], 3) @ moves.T, 1e-4
        unit, stiffness = h * np.eye(self.size), np.empty((self.size, self.size))
        for i, a in enumerate(unit):
            for j, b in enumerate(unit):
                stiffness[i, j] = (self.energy(a + b) - self.energy(a - b) - self.energy(b - a) + self.energy(-a - b)) / (4 * h * h)
        return np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)

    def system(self):
        system = hooke.System()
        system.add_particles(self.q, mass=self.mass)
        for p in self.pinned:
            system.pin(p)
        for k, body in enumerate(self.bodies):
            system.add_body(f"bar{k}", list(body))
        system.add_springs("cables", self.pairs, stiffness=self.stiffness, rest_length=self.rest, law="length")
        return system


def squares_of(modes):
    rows = modes.rows
    return np.where(np.isnan(rows["omega"]), -np.nan_to_num(rows["growth"]) ** 2, np.nan_to_num(rows["omega"]) ** 2)


def compare(frame, accuracy=2e-6):
    """All modes of hooke and of the frame; the bodies' axes of no inertia have none."""
    found = hooke.modes(frame.system(), count=99)
    ours, theirs = squares_of(found), frame.squares()
    assert found.unknowns == len(ours) + found.zero_modes == frame.size
    theirs = np.delete(theirs, np.argsort(abs(theirs))[: found.zero_modes])
    assert np.allclose(ours, theirs, rtol=accuracy, atol=accuracy * abs(theirs).max())
    assert found.residual < 1e-10 * found.largest_force
    return found


def test_a_mast_is_held_by_the_tension_of_its_guys_alone():
    angles = 2 * math.pi * np.arange(3) / 3
    feet = np.column_stack([np.cos(angles), np.zeros(3), np.sin(angles)])
    # a bar of two lines of particles, so that it turns about all of its axes
    mast = [[0, 0, 0], [0, 1, 0], [0, 2, 0], [0.1, 1, 0.2]]
    frame = Frame([*mast, *feet], [1, 2, 1, 0.5, 1, 1, 1], [(0, 1, 2, 3)], (0, 4, 5, 6))
    frame.brace([[2, 4], [2, 5], [2, 6]], [50, 50, 50], [30, 30, 30])
    found = compare(frame)
    # guys that were as long and slack would leave it to turn
    frame.rest = frame.rest + 30 / 50
    assert hooke.modes(frame.system()).zero_modes == 1 == found.zero_modes


@pytest.mark.parametrize("seed", range(2))
def test_frames_of_bodies_and_cables(seed):
    random = np.random.default_rng(seed)
    bodies = [(0, 1, 2, 3), (4, 5, 6, 7)]
    q, mass = random.normal(size=(14, 3)), random.uniform(0.5, 2, 14)
    frame = Frame(q, mass, bodies, (8, 9, 10, 11) if seed else (0, 8, 9, 10, 11))
    pairs = [(a, b) for a in (0, 1, 2, 3, 12, 13) for b in (4, 5, 6, 7, 8, 9, 10, 11) if random.random() < 0.6]
    tension = frame.brace(pairs, random.uniform(5, 50, len(pairs)), random.normal(size=len(pairs)))
    assert tension.min() < 0 < tension.max()  # some are compressed
    compare(frame)


def test_a_cube_of_springs_floats_by_six_zero_modes():
    lattice = dict(size=(2, 2, 2), edges=((1, 0, 0), (0, 1, 0), (0, 0, 1)), mass=1)
    cube = hooke.Scene().lattice(**lattice, structural=dict(stiffness=10), shear=dict(stiffness=5))
    found = hooke.modes(cube, count=99)
    assert (found.zero_modes, found.translations, found.rotations, found.mechanisms) == (6, 3, 3, 0)
    assert len(found.rows) == 18 and found.unstable == 0
    # without diagonals it folds: 12 springs carry 24 - 6 motions
    loose = hooke.modes(hooke.Scene().lattice(**lattice, structural=dict(stiffness=10)))
    assert (loose.zero_modes, loose.rotations, loose.mechanisms) == (12, 3, 6)


def test_a_compressed_strut_buckles_and_a_slack_one_does_nothing():
    def line(rest, **more):
        system = hooke.System()
        system.add_particles([[0, 0, 0], [1, 0, 0], [2, 0, 0]], mass=2)
        system.pin(0)
        system.pin(2)
        system.add_springs("strut", [[0, 1], [1, 2]], stiffness=100, rest_length=rest, law="length", **more)
        return hooke.modes(system)

    strut = line(1.25)
    assert strut.unstable == 2 and np.allclose(squares_of(strut), [-25, -25, 100])  # 2 T/(r m), 2 k/m
    assert strut.rows["damping_ratio"][2] == 0 and np.isnan(strut.rows["damping_ratio"][0])
    assert np.allclose(squares_of(line(0.5)), [50, 50, 100])
    slack = line(1.25, compression=False)
    assert slack.zero_modes == 3 == slack.translations and len(slack.rows) == 0


def test_damping_masses_and_shapes_of_an_oscillator():
    system = hooke.System()
    system.add_particles([[0, 0, 0], [0, -1, 0]], mass=[1, 4])
    system.pin(0)
    system.set_gravity((0, -10, 0))
    system.set_drag(0.8)
    system.add_springs("spring", [[0, 1]], stiffness=400, damping=8, rest_length=0.9, law="length")
    found = hooke.modes(system)
    omega = np.sqrt([10, 10, 100])  # a pendulum in two directions, and k/m
    assert np.allclose(found.rows["omega"], omega) and np.allclose(found.rows["frequency"], omega / (2 * math.pi))
    assert np.allclose(found.rows["damping_ratio"], [0.1 / omega[0], 0.1 / omega[0], 1.1 / omega[2]])
    masses = np.column_stack([found.rows[f"mass_{a}"] for a in "xyz"])
    assert np.allclose(masses.sum(axis=0), 4) and np.allclose(masses.sum(axis=1), 4)
    assert np.allclose(found.shapes[2], [[0, 0, 0], [0, 1, 0]]) and found.groups == ["spring"] and np.allclose(found.shares, 1)


def membrane(cells, tension=3.0):
    """A square of springs under tension, held along its rim, in units of the square's membrane."""
    n, h = cells + 1, 1 / cells
    x, y = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    number, rim = n * x + y, (x == 0) | (y == 0) | (x == cells) | (y == cells)
    system = hooke.System()
    system.add_particles(np.column_stack([h * x.ravel(), h * y.ravel(), np.zeros(n * n)]), mass=h * h)
    for p in number[rim]:
        system.pin(int(p))
    pairs = np.vstack([np.column_stack([number[:-1].ravel(), number[1:].ravel()]),
                       np.column_stack([number[:, :-1].ravel(), number[:, 1:].ravel()])])
    system.add_springs("net", pairs, stiffness=100 * tension, rest_length=h * (1 - 0.01), law="length")
    return hooke.modes(system, count=3).rows["omega"]


def beam(segments):
    """A clamped line of masses with bending, about its straight shape."""
    n, h = segments + 2, 1 / segments
    system = hooke.System()
    system.add_particles([[h * (k - 1), 0, 0] for k in range(n)], mass=[1, *[h] * (n - 2), h / 2])
    system.pin(0)
    system.pin(1)
    system.add_springs("axis", [[k, k + 1] for k in range(n - 1)], stiffness=1e4 / h, rest_length=h, law="length")
    system.add_bending("beam", [[k, k + 1, k + 2] for k in range(n - 2)], [1 / h**3 * (2 if k == 0 else 1) for k in range(n - 2)])
    return hooke.modes(system, count=3).rows["omega"][::2]


@pytest.mark.parametrize("make, fine, exact", [
    (membrane, (6, 12), math.pi * np.sqrt(3.0 * 0.01 * 100 * np.array([2, 5, 5]))),
    (beam, (20, 40), np.array([1.875104068711961, 4.694091132974175]) ** 2),
])
def test_order_two(make, fine, exact):
    coarse, halved = (abs(make(n) - exact) for n in fine)
    assert np.all((1.8 < np.log2(coarse / halved)) & (np.log2(coarse / halved) < 2.2))
