"""Asks for the same want ten times beside a busy second core: repeated.py --hooke HOOKE [--times N] SCENE...

Prints a line for each scene and want, and ends with 1 where two picks differ."""

from __future__ import annotations

import argparse
import json
import multiprocessing
import subprocess
import sys
from pathlib import Path

WANTS = ["1cm", "1mm"]


def spin() -> None:
    while True:
        pass


def pick(hooke: str, scene: str, want: str) -> tuple[object, ...]:
    done = subprocess.run([hooke, "run", scene, "--want", want, "--json"], capture_output=True, text=True)
    value = json.loads(done.stdout) if done.stdout.startswith("{") else {}
    return done.returncode, value.get("method"), value.get("step"), value.get("rtol")


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--hooke", required=True)
    parser.add_argument("--times", type=int, default=10)
    parser.add_argument("scenes", nargs="+")
    asked = parser.parse_args()
    busy = [multiprocessing.Process(target=spin, daemon=True) for _ in range(multiprocessing.cpu_count())]
    for process in busy:
        process.start()
    same = count = 0
    for scene in asked.scenes:
        for want in WANTS:
            picks = {pick(asked.hooke, scene, want) for _ in range(asked.times)}
            count, same = count + 1, same + (len(picks) == 1)
            print(f"{Path(scene).stem}, {want}: {' or '.join(map(str, sorted(picks, key=str)))}", flush=True)
    for process in busy:
        process.terminate()
    print(f"{same} of {count} picks repeat")
    return same != count


if __name__ == "__main__":
    sys.exit(main())
