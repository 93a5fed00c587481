"""Makes the picture of docs/needs.md and prints its table: python docs/make_needs.py

This takes some minutes. Times depend on the machine, and on what else it is doing; changes do not.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import hooke
import hooke.plot

ROOT = Path(__file__).resolve().parents[1]
NAME = "cloth-64"
WANT = 2e-2  # [m]
REPEATS = 3


def print_table(found: hooke.Needs) -> None:
    print("| without | change [m] | ns a step | steps | wall time [s] | largest step [s] | |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    print_row("nothing (the full scene)", "", found.full._asdict(), "")
    for row in found.rows:
        change = "-" if np.isnan(row["error"]) else f"{row['error']:.2g}"
        print_row(f"`{row['without']}`", change, row, "needed" if row["needed"] else "not needed")
    print_row("nothing, within the wanted error", f"{found.cheapest_error:.2g}", found.cheapest._asdict(), "")
    print_row("all that is left out, within the wanted error", f"{found.lean_error:.2g}", found.lean_cost._asdict(), "")
    print(f"\nleft out: {', '.join(found.left_out) or 'nothing'}; judged until {found.judged_until:g} s", flush=True)


def print_row(name: str, change: str, cost: Any, says: str) -> None:
    wall, steps, limit = cost["wall_seconds"], cost["steps"], cost["step_limit"]
    print(f"| {name} | {change} | {1e9 * wall / steps:.3g} | {steps:.0f} | {wall:.2g} | {limit:.2g} | {says} |")


def run_all(found: hooke.Needs, scene: hooke.Scene) -> tuple[list[Any], list[float]]:
    """Runs the full scene to a tenth of the wanted error, and the lean and the full scene to the wanted error. States are
    those at the last judged time; times are the shortest of several runs, which alternate."""
    runs = [(scene, {"step": found.full.step}), (found.lean, found.lean_options), (scene, {"step": found.cheapest.step})]
    least, results = [float("inf")] * 3, [None] * 3
    for _ in range(REPEATS):
        for k, (system, options) in enumerate(runs):
            results[k] = hooke.run(system, **{**options, "duration": found.judged_until})
            least[k] = min(least[k], results[k].wall_seconds)
    return results, least


def draw(found: hooke.Needs, results: list[Any], path: Path) -> None:
    full, lean = results[0].state.q, found.lean_position(results[1].state.q)
    springs = results[0].system.spring_ends[: results[0].system.groups[0][1]]
    figure = plt.figure(figsize=(9, 6.5), layout="constrained")
    ax = figure.add_subplot(projection="3d")
    for q, color, width, label in ((full, "tab:blue", 1.0, "full"), (lean, "tab:red", 0.4, "lean")):
        hooke.plot.cloth((q, springs), ax, color=color, linewidth=width, label=label)
    ax.set(xlabel="z [m]", ylabel="x [m]", zlabel="y [m]", title=f"{NAME} at t = {found.judged_until:g} s")
    ax.legend()
    figure.savefig(path, dpi=67)


def main(folder: Path) -> None:
    scene = hooke.Scene.load(ROOT / "examples/scenes" / f"{NAME}.json")
    found = hooke.needs(scene, WANT)
    print_table(found)
    results, least = run_all(found, scene)
    apart = results[0].state.q - found.lean_position(results[1].state.q)
    print(f"within the want full {least[2]:.3g} s, lean {least[1]:.3g} s: {least[2] / least[1]:.2g} times less; full and")
    print(f"lean apart at the end {found.judged_until:g} s:")
    print(f"{np.sqrt((apart**2).sum(axis=1).mean()):.2g} m, at most {np.sqrt((apart**2).sum(axis=1)).max():.2g} m")
    draw(found, results, folder / f"needs-{NAME}.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/images")
