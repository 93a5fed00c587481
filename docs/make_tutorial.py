"""Makes the pictures of docs/tutorial.md: python docs/make_tutorial.py

This takes some seconds.
"""

from __future__ import annotations

import warnings
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import hooke

IMAGES = Path(__file__).resolve().parent / "images"


def spring() -> hooke.System:
    """Runs the spring of the tutorial: 1 m, 20 N, stretched to 1.25 m, with 1 kg at its end."""
    system = hooke.System()
    system.add_particles([[0, 0, 0], [1.25, 0, 0]], mass=1)
    system.pin(0)
    system.add_springs("spring", [[0, 1]], stiffness=20, rest_length=1)
    return system


def energies() -> None:
    figure, ax = plt.subplots(figsize=(6, 3.2), layout="constrained")
    for method in ("forward-euler", "symplectic-euler", "verlet"):
        result = hooke.run(spring(), method=method, step=0.01, duration=10, every=0.05, frames=True)
        energy = [result.system.energy(q, v) for q, v in zip(result.frames.q, result.frames.v)]
        ax.plot(result.frames.t, energy, label=method, linewidth=1)
    ax.set(xlabel="t [s]", ylabel="energy [J]", ylim=(0, 2))
    ax.legend(fontsize="small")
    figure.savefig(IMAGES / "tutorial-energy.png", dpi=90)


def cloths() -> None:
    """Draws the cloth of the tutorial after 0.5 s with one, two and three kinds of springs, from the front."""
    figure, axes = plt.subplots(1, 3, figsize=(9, 3.4), sharey=True, layout="constrained")
    for ax, families in zip(axes, (("structural",), ("structural", "shear"), ("structural", "shear", "bend"))):
        system = hooke.System()
        springs = {family: {"stiffness": 50, "damping": 0.01} for family in families}
        system.add_part("cloth", origin=[0, 0, 0], edges=[[1, 0, 0], [0, 0, 1]], size=[12, 12], mass=1,
                        pinned="top-corners", **springs)
        system.set_gravity([0, -9.81, 0])
        result = hooke.run(system, method="symplectic-euler", step=1e-4, duration=0.5)
        for a, b in system.spring_ends:
            ax.plot(*result.state.q[[a, b]][:, :2].T, color="tab:blue", linewidth=0.5)
        ax.set(title=", ".join(families), xlabel="x [m]", aspect="equal")
    axes[0].set(ylabel="y [m]")
    figure.savefig(IMAGES / "tutorial-cloth.png", dpi=90)


if __name__ == "__main__":
    warnings.simplefilter("ignore", hooke.StepWarning)
    energies()
    cloths()
