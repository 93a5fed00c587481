"""Holds the error that `hooke run` prints against the truth, on random runs by seed: calibrate.py [--runs N] [--seed K]

A run counts if it finishes and its error is known: by extrapolation in long double (truth.py), where two tolerances
of it agree to a twentieth of the error. The error is the largest distance of a free particle from where it should be,
over the frames for which the figure is printed. Every run is kept as soon as it is done, and a later call goes on.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import math
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import h5py
import numpy as np
from calibration_scenes import options_of, scene_of
from truth import ROOT, TOLERANCES, known

PER_SCENE = 4  # runs, whose truth is computed once
EVALUATIONS = 3e5  # that a truth may take
KNOWN = 20.0  # times that a true error has to be above what is unknown of it
LOW = 3.0  # a true error above this many times the figure is named
EPSILON = 2.0**-52
NORMAL = 1.959964  # of 95 %
EDGES = [0, 0.1, 1 / 3, 1, 2, 3, 5, 10, 30, 100, math.inf]  # of figure over truth


# ---- one run ----


def frames(path: Path) -> tuple[np.ndarray, np.ndarray]:
    with h5py.File(path) as file:
        positions = file["particles/all/position"]
        return np.array(positions["time"]), np.array(positions["value"])


def farthest(a: np.ndarray, b: np.ndarray, free: list[int]) -> np.ndarray:
    """The largest distance of a free particle [m], for every frame."""
    return np.sqrt(((a - b)[:, free] ** 2).sum(axis=2)).max(axis=1)


def positions_of(solution: dict[str, Any]) -> np.ndarray:
    states = [state["position"] for state in solution["states"]]
    return np.array(states).reshape(len(states), -1, 3)


class Truth:
    """At the times of the frames, [frames][particles][3], by two tolerances; None if one takes too long."""

    def __init__(self, path: Path, times: list[float], kept: Path | None, evaluations: float = EVALUATIONS):
        with ThreadPoolExecutor() as pool:
            found = list(pool.map(lambda tolerance: known(path, times, tolerance, evaluations, kept), TOLERANCES))
        self.free = found[1]["free"] if found[1] else []
        self.loose, self.tight = (one and positions_of(one) for one in found)

    def known(self) -> bool:
        return self.loose is not None and self.tight is not None

    def error(self, positions: np.ndarray, last: int) -> tuple[float, float]:
        """Of the frames after the start up to number `last`: the error, and how much of it is unknown, the rounding of
        positions in the file among it."""
        of, unknown = farthest(positions, self.tight, self.free), farthest(self.loose, self.tight, self.free)
        return float(of[:last].max()), float(unknown[:last].max() + EPSILON * abs(self.tight[:last]).max())


def call(hooke: str, path: Path, output: Path, options: list[str]) -> dict[str, Any] | None:
    done = subprocess.run([hooke, "run", str(path), "-o", str(output), "--json", *options], capture_output=True, text=True)
    value = json.loads(done.stdout) if done.stdout.startswith("{") else {}
    return value if done.returncode == 0 and value.get("status") == "finished" else None


def judge(path: Path, output: Path, value: dict[str, Any], kept: Path, truths: dict[Any, Truth]) -> dict[str, Any]:
    """What became of a finished run: the figure, the truth, and how both are known."""
    error, (times, positions) = value.get("error", {}), frames(output)
    times = [float(t) for t in times[1:]]
    if tuple(times) not in truths:
        truths[tuple(times)] = Truth(path, times, kept)
    truth, figure = truths[tuple(times)], error.get("estimate")
    row = {"method": value["method"], "step": value.get("step"), "rtol": value.get("rtol"), "figure": figure, "by": error.get("by"),
           "reason": error.get("reason", error.get("note"))}  # fmt: skip
    if not truth.known():
        return row | {"left_out": "the truth takes too long"}
    until = error.get("known_until") if figure is not None else None
    last = len(times) if until is None else max(1, sum(t <= until * (1 + 1e-9) for t in times))
    true, unknown = truth.error(positions[1:], last)
    left_out = {} if true >= KNOWN * unknown and true > 0 else {"left_out": "the truth is not known well enough"}
    return row | {"true": true, "unknown": unknown, "part": last < len(times)} | left_out


def take_scene(hooke: str, seeds: list[int], kept: Path) -> list[dict[str, Any]]:
    """The runs of these seeds, which share a scene."""
    one, truths, rows = scene_of(seeds[0] // PER_SCENE), {}, []
    with tempfile.TemporaryDirectory() as folder:
        path, output = Path(folder) / f"scene-{seeds[0] // PER_SCENE}.json", Path(folder) / "output.h5"
        path.write_text(json.dumps(one.scene))
        for seed in seeds:
            options = options_of(seed, one)
            value = call(hooke, path, output, options)
            row = judge(path, output, value, kept, truths) if value else {"left_out": "the run does not finish"}
            rows.append({"seed": seed, "kind": one.kind, "options": " ".join(options), **row})
    return rows


# ---- all runs ----


def read_rows(file: Path) -> dict[int, dict[str, Any]]:
    """Of finished scenes; a last line that was cut off does not count."""
    rows: dict[int, dict[str, Any]] = {}
    for line in file.read_text().split("\n")[:-1] if file.exists() else []:
        rows |= {row["seed"]: row for row in json.loads(line)}
    return rows


def counting(rows: dict[int, dict[str, Any]]) -> list[dict[str, Any]]:
    return [row for _, row in sorted(rows.items()) if "left_out" not in row]


def gather(hooke: str, wanted: int, file: Path, truths: Path) -> dict[int, dict[str, Any]]:
    """Until so many runs count."""
    rows, scene = read_rows(file), 0
    file.parent.mkdir(parents=True, exist_ok=True)
    whole = "".join(line + "\n" for line in file.read_text().split("\n")[:-1]) if file.exists() else ""
    file.write_text(whole)
    with file.open("a") as output:
        while len(counting({seed: row for seed, row in rows.items() if seed < PER_SCENE * scene})) < wanted:
            seeds = list(range(PER_SCENE * scene, PER_SCENE * (scene + 1)))
            if seeds[0] not in rows:
                found = take_scene(hooke, seeds, truths)
                output.write(json.dumps(found) + "\n")
                output.flush()
                rows |= {row["seed"]: row for row in found}
                if scene % 25 == 24:
                    print(f"{len(counting(rows))} runs of {wanted}", flush=True)
            scene += 1
    return {seed: row for seed, row in rows.items() if seed < PER_SCENE * scene}


# ---- figures ----


def wilson(found: int, of: int) -> tuple[float, float]:
    """The interval of 95 % of a share."""
    if of == 0:
        return 0.0, 1.0
    share, z = found / of, NORMAL**2 / of
    middle, half = share + z / 2, NORMAL * math.sqrt(share * (1 - share) / of + z / of / 4)
    return max((middle - half) / (1 + z), 0.0), min((middle + half) / (1 + z), 1.0)


def median(values: list[float]) -> list[float]:
    """The median, and the ranks between which it lies."""
    if not values:
        return [math.nan] * 3
    values = sorted(values)
    low, high = wilson((len(values) + 1) // 2, len(values))
    return [values[len(values) // 2], values[int(low * len(values))], values[min(math.ceil(high * len(values)), len(values) - 1)]]


def share(rows: list[dict[str, Any]], holds: Callable[[dict[str, Any]], bool]) -> list[float]:
    found = sum(map(holds, rows))
    return [found / len(rows) if rows else math.nan, *wilson(found, len(rows))]


def is_low(row: dict[str, Any]) -> bool:
    return row["true"] > LOW * row["figure"]


def summary(rows: list[dict[str, Any]]) -> dict[str, Any]:
    told = [row for row in rows if row["figure"] is not None]
    return {
        "runs": len(rows),
        "covered": share(told, lambda row: row["true"] <= row["figure"]),
        "low": share(told, is_low),
        "excess": median([row["figure"] / row["true"] for row in told]),
        "unknown": share(rows, lambda row: row["figure"] is None),
    }


def histogram(rows: list[dict[str, Any]]) -> list[int]:
    ratios = [row["figure"] / row["true"] for row in rows if row["figure"] is not None]
    return [sum(low <= ratio < high for ratio in ratios) for low, high in zip(EDGES, EDGES[1:])]


def by(rows: list[dict[str, Any]], key: str) -> dict[str, dict[str, Any]]:
    names = sorted({str(row[key]) for row in rows})
    return {name: summary([row for row in rows if str(row[key]) == name]) for name in names}


def figures(rows: list[dict[str, Any]]) -> dict[str, Any]:
    return {"all": summary(rows), "by method": by(rows, "method"), "histogram": histogram(rows)}


def percent(found: list[float]) -> str:
    return " - " if math.isnan(found[0]) else f"{100 * found[0]:.1f} ({100 * found[1]:.1f} to {100 * found[2]:.1f})"


def row_of(name: str, one: dict[str, Any]) -> str:
    middle, low, high = one["excess"]
    return f"{name:22} {one['runs']:5} {percent(one['covered']):>22} {percent(one['low']):>22} " \
           f"{f'{middle:.3g} ({low:.3g} to {high:.3g})':>24} {percent(one['unknown']):>22}"  # fmt: skip


def bin_name(low: float, high: float) -> str:
    ends = [f"{x:.3g}" if x >= 1 or x == 0 else f"1/{1 / x:.3g}" for x in (low, high)]
    return f"above {ends[0]}" if high == math.inf else f"below {ends[1]}" if low == 0 else f"{ends[0]} to {ends[1]}"


BINS = [bin_name(low, high) for low, high in zip(EDGES, EDGES[1:])]


def report(rows: list[dict[str, Any]], left_out: dict[int, dict[str, Any]]) -> None:
    heads = ("", "runs", "covered [%]", "above 3 x [%]", "figure / error", "not known [%]")
    head = f"{heads[0]:22} {heads[1]:>5} {heads[2]:>22} {heads[3]:>22} {heads[4]:>24} {heads[5]:>22}"
    for title, key in (("by method", "method"), ("by kind of scene", "kind"), ("by the way the figure is known", "by")):
        print(f"\n{title}\n{head}")
        for name, one in by(rows, key).items():
            print(row_of(name, one))
    print(row_of("all", summary(rows)))
    print("\nfigure / error")
    counts = histogram(rows)
    for name, count in zip(BINS, counts):
        print(f"{name:14} {count:5} {'#' * round(60 * count / max(1, *counts))}")
    low = [row for row in rows if row["figure"] is not None and is_low(row)]
    print(f"\n{len(low)} errors above {LOW:g} times the figure")
    for row in low:
        print(f"seed {row['seed']:5} {row['kind']:15} {row['method']:17} step {row['step'] or row['rtol']:.3g} by {row['by']}: "
              f"figure {row['figure']:.3g} m, error {row['true']:.3g} m")  # fmt: skip
    reasons = [row["left_out"] for row in left_out.values() if "left_out" in row]
    print("\nleft out: " + ", ".join(f"{reasons.count(why)} where {why}" for why in sorted(set(reasons))))


# ---- the picture ----


def picture(counts: list[int]) -> str:
    """The histogram as SVG."""
    total, wide, high, top = max(1, sum(counts)), 60, 150, 20
    bars = []
    for k, (name, count) in enumerate(zip(BINS, counts)):
        size, x = round(high * count / max(1, *counts)), 10 + wide * k
        colour = "#b03a2e" if EDGES[k + 1] <= 1 / LOW else "#d9902f" if EDGES[k + 1] <= 1 else "#3a6ea5"
        bars += [f'<rect x="{x + 4}" y="{top + high - size}" width="{wide - 8}" height="{size}" fill="{colour}"/>',
                 f'<text x="{x + wide / 2:g}" y="{top + high - size - 4}">{100 * count / total:.1f} %</text>',
                 f'<text x="{x + wide / 2:g}" y="{top + high + 14}">{name}</text>']  # fmt: skip
    width = 20 + wide * len(counts)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {top + high + 40}" font-family="sans-serif" font-size="10" '
            f'text-anchor="middle">\n<rect width="{width}" height="{top + high + 40}" fill="white"/>\n' + "\n".join(bars) +
            f'\n<text x="{width / 2:g}" y="{top + high + 32}">printed figure / true error</text>\n</svg>\n')  # fmt: skip


# ---- calls ----


def mark(hooke: str) -> str:
    """Identifies the program, its library and what is run: runs of others are not these."""
    digest = hashlib.sha256()
    beside = sorted(Path(hooke).resolve().parent.glob("libhooke.so.*"))
    for path in [Path(hooke), *beside, *(Path(__file__).with_name(name) for name in ("calibration_scenes.py", "calibrate.py"))]:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--runs", type=int, default=1000, help="that count")
    parser.add_argument("--seed", type=int, help="run this one alone, and print its scene and its row")
    parser.add_argument("--hooke", default=str(ROOT / "build/long/release/hooke"))
    parser.add_argument("--kept", type=Path, default=ROOT / "build/long/calibration", help="folder for runs and truths")
    parser.add_argument("--picture", type=Path)
    given = parser.parse_args()
    if given.seed is not None:
        print(json.dumps(scene_of(given.seed // PER_SCENE).scene))
        print(json.dumps(take_scene(given.hooke, [given.seed], given.kept / "truths")[0]))
        return 0
    rows = gather(given.hooke, given.runs, given.kept / f"runs-{mark(given.hooke)}.jsonl", given.kept / "truths")
    report(counting(rows), rows)
    found = figures(counting(rows))
    if given.picture:
        given.picture.write_text(picture(found["histogram"]))
    print("figures " + json.dumps(found))
    return 0


if __name__ == "__main__":
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    sys.exit(main())
