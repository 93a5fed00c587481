"""Makes the diagram of stiff cloths in docs/choosing.md, and prints its numbers: python docs/make_front.py

Takes a few minutes. Times are of the processor, the least of some runs; they depend on the machine, errors do not.
Explicit methods that would take too long are run for a part of the time, and the rest is extrapolated.
"""

from __future__ import annotations

import sys
import time
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import numpy as np

import hooke

ROOT = Path(__file__).resolve().parents[1]
STIFFNESS = 2e4  # [N]
NEW = ("tr-bdf2", "implicit-midpoint", "shardlow", "verlet")
IMPLICIT = ("backward-euler", "tr-bdf2", "implicit-midpoint")
EXPLICIT = ("symplectic-euler", "verlet", "shardlow", "rk4")
TOLERANCES = (1e-2, 1e-3, 1e-4)
PATIENCE = 3.0  # [s] of a run, and of all its repetitions
REPEATS = 3
LEAST, MOST = 1e-3, 1e-1  # the errors that are of interest, of the motion


class Cloth(NamedTuple):
    side: int
    damping: float  # [N s]
    duration: float  # [s]

    def title(self) -> str:
        return f"{self.side} x {self.side}, {self.damping:g} N s"

    def scene(self) -> hooke.Scene:
        material = {"stiffness": STIFFNESS, "damping": self.damping}
        return hooke.Scene(gravity=(0, -9.81, 0)).cloth(
            size=(self.side, self.side), edges=((1, 0, 0), (0, -0.8, 0.6)), mass=0.2, pinned="top",
            structural=material, shear=material)  # fmt: skip


CLOTHS = (Cloth(20, 0.5, 0.2), Cloth(20, 20, 0.2), Cloth(41, 0.5, 0.1), Cloth(41, 20, 0.1))


class Point(NamedTuple):
    method: str
    setting: str
    seconds: float
    error: float  # of the motion; infinite: it diverged, NaN: the time is extrapolated


def run(cloth: Cloth, duration: float, every: float, **options: Any) -> tuple[np.ndarray, float]:
    """Positions at the frames, the start among them, and processor time."""
    begun = time.process_time()
    result = hooke.run(cloth.scene(), duration=duration, every=every, frames=True, **options)
    return result.frames.q, time.process_time() - begun


def distance(a: np.ndarray, b: np.ndarray) -> float:
    """The largest root mean square over particles, in any frame."""
    return float(np.sqrt(((a - b) ** 2).sum(axis=2).mean(axis=1)).max())


def whole(cloth: Cloth, method: str, reference: np.ndarray, motion: float, **options: Any) -> Point:
    spent, least, frames = 0.0, float("inf"), reference
    for _ in range(REPEATS):
        frames, seconds = run(cloth, cloth.duration, cloth.duration / 10, method=method, **options)
        spent, least = spent + seconds, min(least, seconds)
        if spent > PATIENCE:
            break
    name, value = next(iter(options.items()))
    error = distance(frames, reference) / motion if frames.shape == reference.shape else float("inf")
    return Point(method, f"{name} {value:.2g}", least, error)


def explicit(cloth: Cloth, method: str, reference: np.ndarray, motion: float) -> Point:
    """At the largest safe step."""
    bound = 0.98 * cloth.scene().system.step_bound(method, reference[0])
    count = int(np.ceil(cloth.duration / 10 / bound))
    step = cloth.duration / 10 / count
    steps = min(200, count)
    _, seconds = run(cloth, steps * step, steps * step, method=method, step=step)
    if 10 * count / steps * seconds > PATIENCE:
        return Point(method, f"step {step:.2g}", 10 * count / steps * seconds, float("nan"))
    return whole(cloth, method, reference, motion, step=step)


def measure(cloth: Cloth) -> list[Point]:
    every = cloth.duration / 10
    tight = {"method": "cvode-bdf", "max_steps": 10**8}
    reference, _ = run(cloth, cloth.duration, every, rtol=1e-7, atol=1e-8, **tight)
    motion = distance(reference[:1], reference)
    other, _ = run(cloth, cloth.duration, every, rtol=1e-6, atol=1e-7, **tight)
    print(f"{cloth.title()}: motion {motion:.3g} m, reference to {distance(other, reference) / motion:.1e} of it")
    points = [explicit(cloth, method, reference, motion) for method in EXPLICIT]
    for method in IMPLICIT:
        for k in range(7 if method == "backward-euler" else 5):
            points.append(whole(cloth, method, reference, motion, step=every / 2**k))
            if points[-1].seconds > PATIENCE:
                break
    for rtol in TOLERANCES:
        points.append(whole(cloth, "cvode-bdf", reference, motion, rtol=rtol, atol=rtol))
    return points


def cheapest(points: list[Point], error: float) -> dict[str, float]:
    """Of each method the least time of a run within this error, as all are taken to be whose time is extrapolated."""
    least: dict[str, float] = {}
    for method in dict.fromkeys(point.method for point in points):
        own = sorted((p for p in points if p.method == method), key=lambda p: p.seconds)
        meeting = [p.seconds for p in own if p.error <= error or np.isnan(p.error)]
        if meeting:
            least[method] = min(meeting)
    return dict(sorted(least.items(), key=lambda item: item[1]))


def draw(axes: Any, cloth: Cloth, points: list[Point]) -> None:
    for method in dict.fromkeys(point.method for point in points):
        own = [(p.seconds, 100 * p.error) for p in points if p.method == method and p.error > 0]
        if own:
            colour = f"C{(*EXPLICIT, *IMPLICIT, 'cvode-bdf').index(method)}"
            line = "-" if method in NEW else "--"
            axes.loglog(*np.transpose(own), line, marker="o", markersize=4, label=method, color=colour)
    axes.axhspan(100 * LEAST, 100 * MOST, color="0.93")
    axes.set(title=cloth.title(), xlabel="processor time [s]", ylabel="error [% of the motion]", ylim=(1e-3, 30))


def main(folder: Path) -> None:
    warnings.simplefilter("ignore", hooke.StepWarning)
    figure, axes = plt.subplots(2, 2, figsize=(9.6, 8), layout="constrained")
    for ax, cloth in zip(axes.flat, CLOTHS):
        points = measure(cloth)
        draw(ax, cloth, points)
        for point in points:
            print(f"  {point.method:18} {point.setting:14} {point.seconds:9.3g} s  {100 * point.error:.2g} %")
        for error in (MOST, 1e-2, LEAST):
            print(f"  {100 * error:g} %: " + ", ".join(f"{m} {s:.2g} s" for m, s in cheapest(points, error).items()))
        sys.stdout.flush()
    axes.flat[0].legend()
    figure.savefig(folder / "choosing-stiff-cloths.png", dpi=100)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/images")
