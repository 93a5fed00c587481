"""Final positions of the particles of a scene, by extrapolation in long double (`extrapolate.c`), which shares
nothing with the library but its reading of parts; and the distance between two tolerances."""

from __future__ import annotations

import hashlib
import json
import math
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from wants import distance

ROOT = Path(__file__).resolve().parents[2]

TOLERANCES = (1e-14, 1e-15)  # of a step
EVALUATIONS = 5e6  # limit beyond which the reference is abandoned: too stiff, or too long


@dataclass
class Truth:
    free: list[int]
    positions: dict[float, list[float]]  # 3n numbers a time
    apart: dict[float, float]  # [m] of the two tolerances

    def distance(self, time: float, positions: Any) -> float:
        """The largest distance of a free particle from here [m]."""
        return distance(self.free, self.positions[time], [x for row in positions for x in row])


# ---- facts that a system has no queries for ----


def part_size(part: dict[str, Any]) -> int:
    if part["kind"] in ("cloth", "lattice"):
        return math.prod(part["size"])
    if part["kind"] == "rope":
        return part["segments"] + 1
    raise ValueError(f"particles after a {part['kind']} cannot be numbered here")


def number_of(scene: dict[str, Any], particle: Any) -> int:
    if isinstance(particle, int):
        return particle
    first = len(scene.get("particles", {}).get("position", []))
    for part in scene["parts"]:
        if part.get("name") == particle[0]:
            return first + particle[1]
        first += part_size(part)
    raise ValueError(f"no part is called {particle[0]}")


def facts(scene: dict[str, Any]) -> list[str]:
    lines = [f"gravity {' '.join(map(repr, scene['gravity']))}"] if "gravity" in scene else []
    lines += [f"drag {scene['drag']!r}"] if scene.get("drag") else []
    lines += [f"pulls {k}" for k, group in enumerate(scene.get("springs", [])) if group.get("compression") is False]
    for k, part in enumerate(scene.get("parts", [])):
        name = part.get("name", f"{part['kind']}{k}")
        families = [key for key, value in part.items() if isinstance(value, dict) and value.get("compression") is False]
        lines += [f"pulls-named {name}.{family}" for family in families]
    return lines + [line for drive in scene.get("driven", []) for line in motions(scene, drive)]


def motions(scene: dict[str, Any], drive: dict[str, Any]) -> list[str]:
    if drive["motion"] == "harmonic":
        words = [*drive["amplitude"], drive["frequency"], drive.get("phase", 0)]
        kind = "harmonic"
    else:
        words = [len(drive["time"])] + [x for t, row in zip(drive["time"], drive["position"]) for x in (t, *row)]
        kind = "table"
    return [" ".join(map(str, [kind, number_of(scene, particle), *words])) for particle in drive["particles"]]


# ---- the motion ----


def extrapolate(path: Path, times: list[float], tolerance: float, evaluations: float) -> dict[str, Any] | None:
    """None if it does not finish."""
    program = os.environ.get("HOOKE_EXTRAPOLATE", "build/long/release/tests/long/extrapolate")
    words = [program, str(path), repr(tolerance), repr(evaluations), *map(repr, times)]
    done = subprocess.run(words, input="\n".join(facts(json.loads(path.read_text()))), capture_output=True, text=True)
    if done.returncode not in (0, 1):
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout) if done.returncode == 0 else None


def known(path: Path, times: list[float], tolerance: float, evaluations: float, kept: Path | None) -> dict[str, Any] | None:
    """The same from a file in the folder `kept`, if it exists."""
    if kept is None:
        return extrapolate(path, times, tolerance, evaluations)
    mark = hashlib.sha256(repr((path.read_text(), times, tolerance, evaluations)).encode()).hexdigest()[:16]
    file = kept / f"{path.stem}-{mark}.json"
    if not file.exists():
        kept.mkdir(parents=True, exist_ok=True)
        file.write_text(json.dumps(extrapolate(path, times, tolerance, evaluations)))
    return json.loads(file.read_text())


def truth(path: Path, times: list[float], evaluations: float = EVALUATIONS, kept: Path | None = None) -> Truth | None:
    with ThreadPoolExecutor() as pool:
        loose, tight = pool.map(lambda tolerance: known(path, times, tolerance, evaluations, kept), TOLERANCES)
    if loose is None or tight is None:
        return None
    free = tight["free"]
    positions = {state["time"]: state["position"] for state in tight["states"]}
    apart = {state["time"]: distance(free, state["position"], positions[state["time"]]) for state in loose["states"]}
    return Truth(free, positions, apart)
