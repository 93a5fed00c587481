"""Holds `hooke run --want` and the estimate of plain runs to their word: wanted.py [--want LENGTH]... [--plain] SCENE...

`cloth.md` stands for the cloth that README.md makes, and `random:20` for twenty random scenes. For each scene and want a line: what
was picked, what it said, and its error at the end by extrapolation in long double. Ends with 1 where a run claims what does
not hold.
"""

from __future__ import annotations

import argparse
import json
import math
import os
import re
import shlex
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from truth import Truth, truth

ROOT = Path(__file__).resolve().parents[2]
FACTOR = 3.0  # by which an estimate may be off
FLOOR = 1e-12  # [m] below which errors are rounding
WITHIN = 0.1  # of a want: how well the truth has to be known to judge it
WANTS = {"1cm": 1e-2, "1mm": 1e-3, "10um": 1e-5}


def call(hooke: str, *words: str) -> tuple[int, dict[str, Any], str]:
    done = subprocess.run([hooke, *words], capture_output=True, text=True)
    return done.returncode, json.loads(done.stdout) if done.stdout.startswith("{") else {}, done.stderr


# ---- what is asked of an answer ----


def complaints(code: int, value: dict[str, Any], known: bool, error: float, want: float) -> list[str]:
    """Of a run with a want, whose error at the end is `error` where that is `known`."""
    met = value.get("want", {}).get("met")
    found = []
    if code not in (0, 7):
        return [f"exit {code}"]
    if (code == 0) != (met is True):
        found.append(f"exit {code} with met {met}")
    if code == 0 and known and not error <= want:
        found.append("claims an error that it has not")
    if code == 0 and not known:
        found.append("claims what nobody can know")
    return found + estimate_complaints(value, error if known else math.nan)


def estimate_complaints(value: dict[str, Any], error: float) -> list[str]:
    """An estimate of the error at the end is right within the factor; one of an earlier time says so."""
    estimate, until = (value.get("error", {}).get(key) for key in ("estimate", "known_until"))
    if estimate is None or until < value["time"] * (1 - 1e-9):
        return []
    if max(estimate, error) <= FLOOR or estimate / FACTOR <= error <= FACTOR * estimate or math.isnan(error):
        return []
    return [f"is estimated as {estimate:.3g} m, wrong by more than {FACTOR:g}"]


# ---- scenes ----


def readme_cloth(hooke: str, folder: Path) -> Path:
    """As the README makes it."""
    command = re.search(r"^hooke (make cloth .*?)-o cloth\.json$", (ROOT / "README.md").read_text(), re.DOTALL | re.MULTILINE)
    assert command, "README.md makes no cloth"
    path = folder / "readme-cloth.json"
    subprocess.run([hooke, *shlex.split(command[1].replace("\\\n", " ")), "-o", str(path)], check=True, capture_output=True)
    return path


def random_scenes(folder: Path, count: int) -> list[Path]:
    """Every fourth has a particle that is swung as well."""
    program = Path(os.environ.get("HOOKE_EXTRAPOLATE", "build/long/release/tests/long/extrapolate")).with_name("random_scenes")
    made = subprocess.run([program, folder, "1", str(count)], check=True, capture_output=True, text=True).stdout.split()
    for name in made[::4]:
        scene = json.loads(Path(name).read_text())
        scene["driven"] = [{"particles": [3], "motion": "harmonic", "amplitude": [0.1, 0.05, 0], "frequency": 1.5}]
        scene["particles"]["velocity"][3] = [0, 0, 0]
        Path(name).write_text(json.dumps(scene))
    return [Path(name) for name in made]


def find_scenes(hooke: str, names: list[str], folder: Path) -> list[Path]:
    folder.mkdir(parents=True, exist_ok=True)
    found = []
    for name in names:
        if name == "cloth.md":
            found.append(readme_cloth(hooke, folder))
        elif name.startswith("random:"):
            found += random_scenes(folder, int(name.removeprefix("random:")))
        else:
            found.append(Path(name))
    return found


# ---- the table ----


def picked(value: dict[str, Any]) -> str:
    setting = next((f"{key} {value[key]:.3g}" for key in ("step", "rtol") if value.get(key) is not None), "")
    return f"{value.get('method', '-')} {setting}"


def line(scene: str, asked: str, code: int, value: dict[str, Any], error: float, seconds: float, found: list[str]) -> None:
    figures = value.get("error", {})
    estimate = figures.get("estimate")
    said = "-" if estimate is None else f"{estimate:.2e}"
    print(f"{scene:16} {asked:>5} {code:4d} {str(value.get('want', {}).get('met', '-')):>5} {picked(value):30} {said:>9} "
          f"{error:9.2e} {value.get('force_evaluations', 0):9d} {seconds:7.1f}  {'; '.join(found)}", flush=True)  # fmt: skip


def judge(hooke: str, path: Path, asked: str | None, true: Truth | None, end: float) -> list[str]:
    began = time.monotonic()
    words = ["--want", asked] if asked else []
    code, value, message = call(hooke, "run", str(path), "--json", "--final", *words)
    seconds = time.monotonic() - began
    ended = value.get("status") == "finished" and true is not None
    error = true.distance(end, value["final"]["position"]) if ended and true else math.nan
    if asked:
        known = ended and true is not None and true.apart[end] <= WITHIN * WANTS[asked]
        found = complaints(code, value, known, error, WANTS[asked])
    else:
        found = [f"exit {code}"] if code != 0 else estimate_complaints(value, error)
    line(path.stem, asked or "plain", code, value, error, seconds, found + ([message.strip()[-100:]] if code not in (0, 7) else []))
    return found


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--want", action="append", default=[], choices=list(WANTS))
    parser.add_argument("--plain", action="store_true")
    parser.add_argument("--hooke", default="build/long/release/hooke")
    parser.add_argument("--kept", type=Path, default=ROOT / "build/long/want", help="folder for scenes and solutions")
    parser.add_argument("--evaluations", type=float, default=5e6, help="that the solution may take")
    given = parser.parse_args()
    print(f"{'scene':16} {'want':>5} {'exit':>4} {'met':>5} {'run':30} {'estimate':>9} {'error':>9} {'forces':>9} {'time':>7}")
    wrong = asked = 0
    for path in find_scenes(given.hooke, given.scenes, given.kept / "scenes"):
        end = json.loads(path.read_text())["run"]["duration"]
        true = truth(path, [end], given.evaluations, given.kept)
        apart = math.nan if true is None else true.apart[end]
        print(f"{path.stem:16} the solution is known to {apart:.1e} m", flush=True)
        for want in [*given.want, *([None] if given.plain else [])]:
            asked += 1
            wrong += bool(judge(given.hooke, path, want, true, end))
    print(f"{asked} runs asked for, {wrong} of them wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
