"""Runs ten example scenes with fixed steps by the installed package, and compares the bits of their ends with those
listed here, which are the same for every compiler and machine: python bits.py [FOLDER OF THE SCENES]. Two threads take
part, and every fixed-step method."""

import hashlib
import sys
from pathlib import Path

import hooke

STEPS = 200
EXPECTED = {
    "cantilever": ("verlet", ""),
    "cloth-16": ("shardlow", ""),
    "cloth-64": ("symplectic-euler", ""),
    "cloth-gentle": ("backward-euler", ""),
    "curl": ("heun", ""),
    "drag-or-damping": ("implicit-midpoint", ""),
    "lattice": ("tr-bdf2", ""),
    "mesh": ("rk4", ""),
    "rope": ("symplectic-euler", ""),
    "six-particles": ("forward-euler", ""),
}


def bits(path, method):
    scene = hooke.Scene.load(path)
    step = 1e-4
    state = scene.run(method=method, step=step, duration=STEPS * step, every=STEPS * step, threads=2).state
    return hashlib.sha256(state.q.astype("<f8").tobytes() + state.v.astype("<f8").tobytes()).hexdigest()[:16]


def main(folder):
    found = {name: (method, bits(folder / f"{name}.json", method)) for name, (method, _) in EXPECTED.items()}
    different = {name: row for name, row in found.items() if row != EXPECTED[name]}
    print(f"{len(found) - len(different)} of {len(found)} runs have the bits that are listed", *different.items(), sep="\n")
    return len(different) > 0


if __name__ == "__main__":
    examples = Path(__file__).resolve().parents[2] / "examples/scenes"
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else examples))
