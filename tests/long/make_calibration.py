"""Writes what tests/cli/test_calibration.py and tests/cli/test_cases.py hold printed errors against: the runs of
tests/data/calibration.json with their true positions, and the largest true error of each run in
tests/data/cases/right.json, by extrapolation in long double.

HOOKE_EXTRAPOLATE=build/release/tests/long/extrapolate python tests/long/make_calibration.py build/release/hooke
"""

from __future__ import annotations

import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from calibrate import KNOWN, PER_SCENE, Truth, call, farthest, frames
from calibration_scenes import options_of, scene_of
from truth import EVALUATIONS, ROOT

RUNS = ROOT / "tests/data/calibration.json"
CASES = ROOT / "tests/data/cases"
SEEDS = [5, 21, 79, 94, 107, 151, 153, 179, 211, 217, 406, 859]  # of calibrate.py: every method, each of another kind


def random_run(hooke: str, seed: int, folder: Path) -> dict[str, Any]:
    one = scene_of(seed // PER_SCENE)
    options, path, output = options_of(seed, one), folder / "scene.json", folder / "output.h5"
    path.write_text(json.dumps(one.scene))
    assert call(hooke, path, output, options) is not None, seed
    times, positions = frames(output)
    truth = Truth(path, list(map(float, times[1:])), None)
    error, unknown = truth.error(positions[1:], len(times) - 1)
    assert error > KNOWN * unknown, (seed, error, unknown)
    print(f"seed {seed}: {one.kind} by {' '.join(options)}, error {error:.3g} m")
    return {"seed": seed, "kind": one.kind, "options": " ".join(options), "scene": one.scene, "free": truth.free,
            "positions": truth.tight[:, truth.free].tolist()}  # fmt: skip


def case_run(hooke: str, case: dict[str, Any], run: dict[str, Any], folder: Path) -> float:
    """The largest error [m] of the run; the right value of the case is that of the extrapolation, too."""
    path, output = CASES / f"{case['scene']}.json", folder / "output.h5"
    assert call(hooke, path, output, run["options"].split()) is not None, path
    times, positions = frames(output)
    truth = Truth(path, list(map(float, times[1:])), None, EVALUATIONS)
    for particle, right in case["right"].items():
        number = int(particle)
        off = float(farthest(truth.tight[-1:], truth.tight[-1:] * 0 + right, [number])[0])
        assert off <= case["known"], (path, particle, truth.tight[-1, number].tolist(), right, off)
    error = truth.error(positions[1:], len(times) - 1)[0]
    print(f"{case['scene']} by {run['options'] or 'its own method'}: error {error:.3g} m")
    return float(f"{error:.4g}")


def main(hooke: str) -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        runs = [random_run(hooke, seed, folder) for seed in SEEDS]
        RUNS.write_text("[\n" + ",\n".join(json.dumps(run) for run in runs) + "\n]\n")
        cases = json.loads((CASES / "right.json").read_text())
        for case in cases:
            for run in case.get("runs", []):
                run["error"] = case_run(hooke, case, run, folder)
        (CASES / "right.json").write_text("[\n" + ",\n".join(" " + json.dumps(case) for case in cases) + "\n]\n")


if __name__ == "__main__":
    main(sys.argv[1])
