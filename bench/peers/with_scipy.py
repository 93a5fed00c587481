"""SciPy: solve_ivp on the first-order system y = (q, v), whose right-hand side is compiled by Numba."""

from __future__ import annotations

import numba
import numpy as np
import scipy
from scipy.integrate import solve_ivp
from scipy.sparse import bmat, coo_array, eye_array, kron

from cloth import GRAVITY, Cloth
from peer import Solver
from with_numba import add_forces


@numba.njit(fastmath=True)
def rate(y, ends, kappa, gamma, rest_length, w, out):
    n = 3 * len(w)
    q, v, f = y[:n].reshape(-1, 3), y[n:].reshape(-1, 3), out[n:].reshape(-1, 3)
    out[:n] = y[n:]
    f[:] = 0.0
    add_forces(q, v, ends, kappa, gamma, rest_length, f)
    for p in range(len(w)):
        for a in range(3):
            f[p, a] = w[p] * f[p, a] - (GRAVITY if a == 1 and w[p] > 0.0 else 0.0)


def right_hand_side(cloth: Cloth):
    ends = cloth.ends.astype(np.int32)

    def function(_t: float, y: np.ndarray) -> np.ndarray:
        out = np.empty_like(y)
        rate(y, ends, cloth.kappa, cloth.gamma, cloth.rest_length, cloth.inverse_mass, out)
        return out

    return function


def start_of(cloth: Cloth) -> np.ndarray:
    return np.concatenate([cloth.q.ravel(), np.zeros(cloth.q.size)])


def sparsity(cloth: Cloth):
    """The sparsity pattern of the Jacobian: accelerations of particles that share a spring."""
    n = len(cloth.q)
    i, j = cloth.ends.T
    pairs = coo_array((np.ones(2 * len(i)), (np.r_[i, j], np.r_[j, i])), shape=(n, n)) + eye_array(n)
    blocks = kron(pairs, np.ones((3, 3)))
    return bmat([[None, eye_array(3 * n)], [blocks, blocks]], format="csc")


def solver(method: str) -> Solver:
    def solve(cloth: Cloth, duration: float, rtol: float, atol: float) -> np.ndarray:
        more = {"jac_sparsity": sparsity(cloth)} if method == "BDF" else {}
        found = solve_ivp(right_hand_side(cloth), (0.0, duration), start_of(cloth), method=method, rtol=rtol, atol=atol,
                          t_eval=[duration], **more)
        if not found.success:
            raise RuntimeError(f"SciPy {method}: {found.message}")
        return found.y[: cloth.q.size, -1].reshape(-1, 3)

    return Solver(f"SciPy {method}", lambda: scipy.__version__, solve,
                  lambda cloth: right_hand_side(cloth)(0.0, start_of(cloth)))
