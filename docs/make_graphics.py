"""Makes the diagram of XPBD and projective dynamics in docs/choosing.md: python docs/make_graphics.py

Both methods are the textbook ones, for springs alone: extended position-based dynamics with one iteration a substep
(Macklin, Müller and Chentanez 2016; Macklin et al. 2019), and the local and global steps of Liu et al. (2013). Takes
a few minutes. Times depend on the machine; errors do not.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
import tempfile
import time
import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import hooke

ROOT = Path(__file__).resolve().parents[1]
SIDE, STIFFNESS, MASS, DURATION, EVERY = 20, 2e3, 0.2, 0.5, 0.05  # N, kg, s
GRAPHICS_STEP = 0.01  # [s]
METHODS = {
    "symplectic-euler": (5e-5, 2e-5),
    "verlet": (5e-5, 2e-5),
    "rk4": (1e-4, 5e-5),
    "backward-euler": (1e-2, 2.5e-3, 5e-4),
    "tr-bdf2": (1e-2, 5e-3, 2e-3, 1e-3),
}  # steps [s]
SUBSTEPS = (5, 10, 20, 50, 100, 200, 500, 1000, 2000)  # of a frame
TOLERANCES = (1e-2, 1e-3, 1e-4)
REPEATS = 3
GRAVITY = np.array([0.0, -9.81, 0.0])


class Cloth:
    """A stiff cloth on a grid, pinned along its upper edge and let go at an angle."""

    def __init__(self) -> None:
        u, v = np.meshgrid(np.arange(SIDE), np.arange(SIDE))
        u, v = u.ravel() / (SIDE - 1), v.ravel() / (SIDE - 1)
        self.q = np.column_stack([u, -0.8 * v, 0.6 * v])
        number = np.arange(SIDE * SIDE).reshape(SIDE, SIDE)
        pairs = [(number[:, :-1], number[:, 1:]), (number[:-1], number[1:]), (number[:-1, :-1], number[1:, 1:]),
                 (number[:-1, 1:], number[1:, :-1])]  # fmt: skip
        self.ends = np.concatenate([np.column_stack([a.ravel(), b.ravel()]) for a, b in pairs])
        self.rest = np.linalg.norm(self.q[self.ends[:, 0]] - self.q[self.ends[:, 1]], axis=1)
        self.mass = MASS / SIDE**2
        self.free = np.arange(SIDE * SIDE) >= SIDE
        self.w = self.free / self.mass
        self.k = STIFFNESS / self.rest  # [N/m]

    def system(self) -> hooke.System:
        system = hooke.System()
        system.add_particles(self.q, mass=self.mass)
        system.add_springs("springs", self.ends, stiffness=STIFFNESS)
        system.pin(np.flatnonzero(~self.free))
        system.set_gravity(GRAVITY)
        return system.commit()


def colours(ends: np.ndarray, count: int) -> list[np.ndarray]:
    """Springs by colour: no two springs of one colour share a particle."""
    seen: list[set[int]] = [set() for _ in range(count)]
    colour = np.empty(len(ends), int)
    for s, (a, b) in enumerate(ends):
        colour[s] = next(c for c in range(len(ends)) if c not in seen[a] and c not in seen[b])
        seen[a].add(colour[s])
        seen[b].add(colour[s])
    return [np.flatnonzero(colour == c) for c in range(colour.max() + 1)]


def frames_of(cloth: Cloth, step: float, advance) -> np.ndarray:
    """Positions (frames, n, 3) at EVERY; `advance(q, v)` makes a step."""
    q, v = cloth.q.copy(), np.zeros_like(cloth.q)
    frames = []
    for k in range(round(DURATION / step)):
        q, v = advance(q, v)
        if (k + 1) % round(EVERY / step) == 0:
            frames.append(q.copy())
    return np.array(frames)


class Xpbd:
    """Compiles docs/xpbd.c and loads it."""

    class Cloth(ctypes.Structure):
        _fields_ = (
            [(name, ctypes.c_int64) for name in ("particles", "colours")]
            + [(name, ctypes.c_void_p) for name in ("colour_end", "a", "b", "rest", "compliance", "w")]
        )  # fmt: skip

    def __init__(self, folder: Path, cloth: Cloth) -> None:
        library = folder / "xpbd.so"
        flags = ["-O3", "-march=native", "-shared", "-fPIC", "-o", library]
        subprocess.run([os.environ.get("CC", "cc"), *flags, ROOT / "docs/xpbd.c", "-lm"], check=True)
        self.advance = ctypes.CDLL(os.fspath(library)).advance
        batches = colours(cloth.ends, len(cloth.q))
        order = np.concatenate(batches)
        self.cloth, self.order = cloth, order
        self.arrays = {
            "colour_end": np.cumsum([len(c) for c in batches]),
            "a": cloth.ends[order, 0].astype(np.int32),
            "b": cloth.ends[order, 1].astype(np.int32),
            "rest": cloth.rest[order],
            "w": cloth.w,
        }

    def run(self, step: float) -> tuple[np.ndarray, float]:
        """Frames, and the time [s]."""
        self.arrays["compliance"] = 1 / (self.cloth.k[self.order] * step**2)
        pointers = {name: array.ctypes.data for name, array in self.arrays.items()}
        c = self.Cloth(particles=len(self.cloth.q), colours=len(self.arrays["colour_end"]), **pointers)
        q, v, x = self.cloth.q.copy(), np.zeros_like(self.cloth.q), np.zeros_like(self.cloth.q)
        frames, begun = [], time.process_time()
        for _ in range(round(DURATION / EVERY)):
            self.advance(ctypes.byref(c), ctypes.c_int64(round(EVERY / step)), ctypes.c_double(step),
                         *(ctypes.c_void_p(array.ctypes.data) for array in (GRAVITY, q, v, x)))  # fmt: skip
            frames.append(q.copy())
        return np.array(frames), time.process_time() - begun


def projective(cloth: Cloth, step: float, iterations: int) -> np.ndarray:
    a, b = cloth.ends.T
    n = len(cloth.q)
    matrix = np.eye(n) * cloth.mass / step**2
    np.add.at(matrix, (a, a), cloth.k)
    np.add.at(matrix, (b, b), cloth.k)
    np.add.at(matrix, (a, b), -cloth.k)
    np.add.at(matrix, (b, a), -cloth.k)
    free = np.flatnonzero(cloth.free)
    inverse = np.linalg.inv(matrix[np.ix_(free, free)])
    coupling = matrix[np.ix_(free, np.flatnonzero(~cloth.free))] @ cloth.q[~cloth.free]
    spread = np.zeros((n, len(a)))
    spread[a, np.arange(len(a))] = cloth.k
    spread[b, np.arange(len(a))] = -cloth.k
    spread = spread[free]
    fall = np.outer(cloth.free, GRAVITY) * step

    def advance(q, v):
        guess = q + step * (v + fall)
        x = guess.copy()
        for _ in range(iterations):
            d = x[a] - x[b]
            d *= (cloth.rest / np.linalg.norm(d, axis=1))[:, None]
            x[free] = inverse @ (cloth.mass / step**2 * guess[free] + spread @ d - coupling)
        return x, (x - q) / step

    return frames_of(cloth, step, advance)


def by_hooke(cloth: Cloth, **options) -> tuple[np.ndarray, float]:
    """Frames, and the time [s]."""
    system, begun = cloth.system(), time.process_time()
    result = hooke.run(system, duration=DURATION, every=EVERY, frames=True, **options)
    return result.frames.q[1:], time.process_time() - begun


def error(frames: np.ndarray, reference: np.ndarray) -> float:
    """Largest root mean square distance of the particles in any frame [m]."""
    return float(np.sqrt(((frames - reference) ** 2).sum(axis=2).mean(axis=1)).max())


def tension(cloth: Cloth, frames: np.ndarray) -> np.ndarray:
    """Tension of each spring in each frame [N]."""
    a, b = cloth.ends.T
    return cloth.k * (np.linalg.norm(frames[:, a] - frames[:, b], axis=2) - cloth.rest)


def tension_error(cloth: Cloth, frames: np.ndarray, reference: np.ndarray) -> float:
    """Largest root mean square error of tension in any frame, relative to that tension of the reference."""
    right = tension(cloth, reference)
    return float(np.sqrt(((tension(cloth, frames) - right) ** 2).mean(axis=1).max() / (right**2).mean()))


def measure(cloth: Cloth, reference: np.ndarray) -> dict[str, list[tuple[float, float, float]]]:
    """Time [s] (the shortest of several), error [m] and error of tension of each method."""
    curves: dict[str, list[tuple[float, float, float]]] = {}

    def add(name: str, run: Callable[[], tuple[np.ndarray, float]]) -> None:
        runs = [run() for _ in range(REPEATS)]
        frames = runs[0][0]
        if len(frames) < len(reference):
            return  # diverged
        errors = error(frames, reference), tension_error(cloth, frames, reference)
        curves.setdefault(name, []).append((min(seconds for _, seconds in runs), *errors))

    with tempfile.TemporaryDirectory() as folder:
        xpbd = Xpbd(Path(folder), cloth)
        for substeps in SUBSTEPS:
            add("XPBD", partial(xpbd.run, EVERY / substeps))
    for name, steps in METHODS.items():
        for step in steps:
            add(name, partial(by_hooke, cloth, method=name, step=step))
    for rtol in TOLERANCES:
        add("cvode-bdf", partial(by_hooke, cloth, method="cvode-bdf", rtol=rtol, atol=rtol, max_steps=10**8))
    return curves


def draw(curves: dict[str, list[tuple[float, float, float]]], motion: float, path: Path) -> None:
    figure, axes = plt.subplots(1, 2, figsize=(9.6, 4.2), layout="constrained")
    for name, points in curves.items():
        seconds, off, pull = np.transpose(points)
        style = {"marker": "o", "markersize": 4, "color": "black" if name == "XPBD" else None, "label": name}
        axes[0].loglog(seconds, 100 * off / motion, **style)
        axes[1].loglog(seconds, 100 * pull, **style)
    axes[0].set(xlabel="time [s]", ylabel="error of positions [% of the motion]")
    axes[1].set(xlabel="time [s]", ylabel="error of tensions [% of their rms]")
    axes[1].legend()
    figure.savefig(path, dpi=100)


def main(folder: Path) -> None:
    warnings.simplefilter("ignore", hooke.StepWarning)
    cloth = Cloth()
    reference, _ = by_hooke(cloth, method="cvode-adams", rtol=1e-11, atol=1e-12, max_steps=10**8)
    motion = error(np.broadcast_to(cloth.q, reference.shape), reference)
    print(f"motion {motion:.3g} m")
    curves = measure(cloth, reference)
    for name, points in curves.items():
        for seconds, off, pull in points:
            print(f"{name:16} {seconds:.3g} s, positions {100 * off / motion:.2g} %, tensions {100 * pull:.2g} %")
    draw(curves, motion, folder / "choosing-graphics.png")
    implicit, _ = by_hooke(cloth, method="backward-euler", step=GRAPHICS_STEP)
    print(f"backward-euler, step {GRAPHICS_STEP} s: {100 * error(implicit, reference) / motion:.2g} %")
    for iterations in (1, 10, 100, 1000, 10000):
        frames = projective(cloth, GRAPHICS_STEP, iterations)
        print(f"local and global, {iterations} iterations: {100 * error(frames, reference) / motion:.2g} %, "
              f"{error(frames, implicit):.2g} m from backward Euler", flush=True)  # fmt: skip


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/images")
