"""Makes the diagrams of docs/choosing.md and prints its table: python docs/make_choosing.py

This takes a few minutes. Times are of the processor; they depend on the machine, the errors do not.
docs/make_front.py makes the diagram of stiff cloths.
"""

from __future__ import annotations

import sys
import time
import warnings
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")

import hooke

ROOT = Path(__file__).resolve().parents[1]
SCENES = ("cloth-stiff", "cloth-damped", "cloth-gentle")
WANT = 1e-4  # [m]
BUDGET = 25.0  # [s] for one study
POINTS = 8
OTHERS = 2  # methods shown beside the recommended one
REPEATS = 15


def study(scene: Path, methods: list[str] | None = None) -> hooke.Study:
    return hooke.study(scene, methods, want=WANT, budget=BUDGET, points=POINTS)


def candidates(scene: Path, first: hooke.Study) -> list[Any]:
    """The recommended run, and the cheapest runs of a few other methods."""
    found = [first.recommendation]
    rows = first.rows[(first.error <= WANT) & (first.method != found[0].method)]
    rows.sort(order="wall_seconds")
    for method in list(dict.fromkeys(rows["method"]))[:OTHERS]:
        found.append(study(scene, [str(method)]).recommendation)
    return [one for one in found if one.met]


def processor_seconds(scene: hooke.Scene, options: dict[str, Any]) -> float:
    """Of the steps alone."""
    integrator, state = hooke.Integrator(scene.system, scene.run_options, **options), scene.system.state()
    begun = time.process_time()
    integrator.run(state)
    return time.process_time() - begun


def seconds(path: Path, runs: list[dict[str, Any]], repeats: int) -> list[float]:
    """The shortest time of each run. Runs alternate, so that changes of the machine affect all of them."""
    scene, least = hooke.Scene.load(path), [float("inf")] * len(runs)
    for _ in range(repeats):
        for k, options in enumerate(runs):
            least[k] = min(least[k], processor_seconds(scene, options))
    return least


def time_rows(scene: Path, found: hooke.Study) -> None:
    """Has times of the processor take the place of those of the wall, which other programs may have lengthened."""
    found.rows = found.rows.copy()
    for row in found.rows[found.status == "finished"]:
        value = {"step": row["step"]} if row["step"] > 0 else {"rtol": row["rtol"], "atol": row["atol"]}
        this = (found.method == row["method"]) & (found.steps == row["steps"])
        found.rows["wall_seconds"][this] = seconds(scene, [{"method": row["method"], **value}], 3)[0]


def words(found: Any) -> str:
    setting = f"step {found.step:.2g} s" if found.step > 0 else f"rtol {found.rtol:.1g}"
    return f"`{found.method}`, {setting}, {found.error:.1e} m"


def main(folder: Path) -> None:
    warnings.simplefilter("ignore", hooke.StepWarning)
    print("| scene | wanted error | winner | second | ratio of times |\n| --- | --- | --- | --- | --- |")
    for name in SCENES:
        scene = ROOT / "examples/scenes" / f"{name}.json"
        first = study(scene)
        time_rows(scene, first)
        found = candidates(scene, first)
        times = seconds(scene, [one.options for one in found], REPEATS)
        order = sorted(range(len(found)), key=times.__getitem__)
        one, two = (words(found[k]) for k in order[:2])
        ratio = times[order[1]] / times[order[0]]
        print(f"| `{name}` | {WANT:g} m | {one} | {two} | {ratio:.1f} |", flush=True)
        axes = first.plot(want=WANT)
        axes[0].figure.suptitle(f"{name}: error up to {first.reference.trusted_until:g} s")
        axes[0].figure.savefig(folder / f"choosing-{name.removeprefix('cloth-')}.png", dpi=100)
        print(first, *zip(found, times), sep="\n", file=sys.stderr)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs/images")
