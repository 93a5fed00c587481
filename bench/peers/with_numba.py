"""Numba: the loop over springs, compiled for the machine with fastmath."""

from __future__ import annotations

import math

import numba
import numpy as np

from cloth import GRAVITY, Cloth
from peer import Motion, Stepper


@numba.njit(fastmath=True)
def add_forces(q, v, ends, kappa, gamma, rest_length, f):
    for s in range(len(ends)):
        i, j = ends[s, 0], ends[s, 1]
        dx, dy, dz = q[i, 0] - q[j, 0], q[i, 1] - q[j, 1], q[i, 2] - q[j, 2]
        r = math.sqrt(dx * dx + dy * dy + dz * dz)
        along = ((v[i, 0] - v[j, 0]) * dx + (v[i, 1] - v[j, 1]) * dy + (v[i, 2] - v[j, 2]) * dz) / r
        t = (kappa[s] * (r - rest_length[s]) + gamma[s] * along) / r
        f[i, 0] -= t * dx
        f[i, 1] -= t * dy
        f[i, 2] -= t * dz
        f[j, 0] += t * dx
        f[j, 1] += t * dy
        f[j, 2] += t * dz


@numba.njit(fastmath=True)
def add_undamped_forces(q, ends, kappa, rest_length, f):
    for s in range(len(ends)):
        i, j = ends[s, 0], ends[s, 1]
        dx, dy, dz = q[i, 0] - q[j, 0], q[i, 1] - q[j, 1], q[i, 2] - q[j, 2]
        r = math.sqrt(dx * dx + dy * dy + dz * dz)
        t = kappa[s] * (r - rest_length[s]) / r
        f[i, 0] -= t * dx
        f[i, 1] -= t * dy
        f[i, 2] -= t * dz
        f[j, 0] += t * dx
        f[j, 1] += t * dy
        f[j, 2] += t * dz


@numba.njit(fastmath=True)
def step_damped(q, v, f, ends, kappa, gamma, rest_length, w, h, steps):
    for _ in range(steps):
        f[:] = 0.0
        add_forces(q, v, ends, kappa, gamma, rest_length, f)
        move(q, v, f, w, h)


@numba.njit(fastmath=True)
def step_undamped(q, v, f, ends, kappa, rest_length, w, h, steps):
    for _ in range(steps):
        f[:] = 0.0
        add_undamped_forces(q, ends, kappa, rest_length, f)
        move(q, v, f, w, h)


@numba.njit(fastmath=True)
def move(q, v, f, w, h):
    for p in range(len(w)):
        if w[p] > 0.0:
            for a in range(3):
                v[p, a] += h * (w[p] * f[p, a] - (GRAVITY if a == 1 else 0.0))
                q[p, a] += h * v[p, a]


def start(cloth: Cloth, step: float, threads: int) -> Motion:
    q, v, f = cloth.q.copy(), np.zeros_like(cloth.q), np.zeros_like(cloth.q)
    ends, w = cloth.ends.astype(np.int32), cloth.inverse_mass

    def take(count: int) -> None:
        if cloth.damped:
            step_damped(q, v, f, ends, cloth.kappa, cloth.gamma, cloth.rest_length, w, step, count)
        else:
            step_undamped(q, v, f, ends, cloth.kappa, cloth.rest_length, w, step, count)

    take(0)  # compiles
    return Motion(take, lambda: q)


SCATTER = Stepper("Numba", lambda: numba.__version__, "symplectic-euler", True, True, start, has_threads=False)
