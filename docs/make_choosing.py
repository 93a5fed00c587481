"""Makes the diagrams of docs/choosing.md and prints its table: python docs/make_choosing.py

This takes a few minutes. Times depend on the machine, and on what else it is doing; the errors do not.
"""

from __future__ import annotations

import sys
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
OTHERS = 4  # methods shown beside the recommended one
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


def seconds(scene: Path, runs: list[dict[str, Any]]) -> list[float]:
    """The shortest time of each run. Runs alternate, so that changes of the machine affect all of them."""
    least = [float("inf")] * len(runs)
    for _ in range(REPEATS):
        for k, options in enumerate(runs):
            least[k] = min(least[k], hooke.run(scene, **options).wall_seconds)
    return least


def words(found: Any) -> str:
    setting = f"step {found.step:.2g} s" if found.step > 0 else f"rtol {found.rtol:.1g}"
    return f"`{found.method}`, {setting}, {found.error:.1e} m"


def main(folder: Path) -> None:
    print("| scene | wanted error | winner | second | ratio of wall times |\n| --- | --- | --- | --- | --- |")
    for name in SCENES:
        scene = ROOT / "examples/scenes" / f"{name}.json"
        first = study(scene)
        found = candidates(scene, first)
        times = seconds(scene, [one.options for one in found])
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
