"""Tests runs and studies with a want, and the estimated error of plain runs: wanted.py [--want LENGTH]... [--plain]
[--study] SCENE...

`cloth.md` stands for the cloth that README.md makes, and `random:20` for twenty random scenes. For each scene and
want a line: what was picked, what it said, and its error at the end by extrapolation in long double. Ends with 1
where a run claims what does not hold.
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

from truth import ROOT, truth
from wants import WANTS, WITHIN, at_end, complaints, estimate_complaints, study_complaints  # of tests/cli


def call(hooke: str, *words: str) -> tuple[int, dict[str, Any], str]:
    done = subprocess.run([hooke, *words], capture_output=True, text=True)
    return done.returncode, json.loads(done.stdout) if done.stdout.startswith("{") else {}, done.stderr


# ---- scenes ----


def readme_cloth(hooke: str, folder: Path) -> Path:
    """As in the README."""
    command = re.search(r"^hooke (make cloth .*?)-o cloth\.json$", (ROOT / "README.md").read_text(), re.DOTALL | re.MULTILINE)
    assert command, "README.md makes no cloth"
    path = folder / "readme-cloth.json"
    subprocess.run([hooke, *shlex.split(command[1].replace("\\\n", " ")), "-o", str(path)], check=True, capture_output=True)
    return path


def random_scenes(folder: Path, count: int) -> list[Path]:
    """Every fourth has a driven particle as well."""
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
    return f"{value.get('method') or '-'} {setting}"


class Judge:
    """For one program, one scene after the other; counts the results."""

    def __init__(self, hooke: str, kept: Path, evaluations: float, budget: float):
        self.hooke, self.kept, self.evaluations, self.budget = hooke, kept, evaluations, budget
        self.asked = self.met = self.refused = self.wrong = 0
        print(f"{'scene':16} {'asked':>11} {'exit':>4} {'met':>5} {'run':30} {'estimate':>9} {'error':>9} {'forces':>9} {'time':>7}")

    def take(self, path: Path) -> None:
        self.path, self.end = path, json.loads(path.read_text())["run"]["duration"]
        self.true = truth(path, [self.end], self.evaluations, self.kept)
        apart = f"known to {self.true.apart[self.end]:.1e} m" if self.true else "not known"
        print(f"{path.stem:16} the solution is {apart}", flush=True)

    def error(self, value: dict[str, Any]) -> float:
        there = self.true is not None and value.get("status") == "finished" and at_end(value["time"], self.end)
        return self.true.distance(self.end, value["final"]["position"]) if self.true and there else math.nan

    def known(self, asked: str, error: float) -> bool | None:
        if self.true is None:
            return None
        return self.true.apart[self.end] <= WITHIN * WANTS[asked] and not math.isnan(error)

    def note(self, asked: str, code: int, met: Any, value: dict[str, Any], said: float | None, seconds: float, found: list[str]) -> None:
        self.asked += 1
        self.met += met is True and not found
        self.refused += code == 7 and not found
        self.wrong += bool(found)
        estimate = "-" if said is None else f"{said:.2e}"
        print(f"{self.path.stem:16} {asked:>11} {code:4d} {met!s:>5} {picked(value):30} {estimate:>9} {self.error(value):9.2e} "
              f"{value.get('force_evaluations') or 0:9d} {seconds:7.1f}  {'; '.join(found)}", flush=True)  # fmt: skip

    def run(self, asked: str | None) -> None:
        began = time.monotonic()
        words = ["--want", asked] if asked else []
        code, value, _ = call(self.hooke, "run", str(self.path), "--json", "--final", *words)
        seconds, error = time.monotonic() - began, self.error(value)
        if asked:
            found = complaints(code, value, self.known(asked, error), error, WANTS[asked])
        else:
            found = [f"exit {code}"] if code != 0 else estimate_complaints(value, error)
        met = value.get("want", {}).get("met")
        self.note(asked or "plain", code, met, value, value.get("error", {}).get("estimate"), seconds, found)

    def study(self, asked: str) -> None:
        began = time.monotonic()
        code, value, message = call(self.hooke, "study", str(self.path), "--want", asked, "--budget", str(self.budget), "--json")
        seconds, one = time.monotonic() - began, value.get("recommendation") or {}
        if not one:
            return self.note("study " + asked, code, None, {}, None, seconds, [f"exit {code} {message.strip()[-80:]}"])
        again, run = 0, {}
        if one["met"]:
            again, run, _ = call(self.hooke, *shlex.split(one["command"])[1:], "--json", "--final")
        found = study_complaints(code, value, again, self.error(run), WANTS[asked], self.known(asked, self.error(run)))
        return self.note("study " + asked, code, one["met"], run, one["error"], seconds, found)


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("scenes", nargs="+")
    parser.add_argument("--want", action="append", default=[], choices=list(WANTS))
    parser.add_argument("--plain", action="store_true", help="hold plain runs to their estimates")
    parser.add_argument("--study", action="store_true", help="hold studies to the wants, too")
    parser.add_argument("--hooke", default="build/long/release/hooke")
    parser.add_argument("--kept", type=Path, default=ROOT / "build/long/want", help="folder for scenes and solutions")
    parser.add_argument("--evaluations", type=float, default=5e6, help="that a solution may take")
    parser.add_argument("--budget", type=float, default=30.0, help="[s] of a study")
    given = parser.parse_args()
    judge = Judge(given.hooke, given.kept, given.evaluations, given.budget)
    for path in find_scenes(given.hooke, given.scenes, given.kept / "scenes"):
        judge.take(path)
        for want in [*given.want, *([None] if given.plain else [])]:
            judge.run(want)
        for want in given.want if given.study else []:
            judge.study(want)
    print(f"{judge.asked} asked for, {judge.met} met, {judge.refused} said not to be met or known, {judge.wrong} wrong")
    return 1 if judge.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
