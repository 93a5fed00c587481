"""Runs ten example scenes with fixed steps by the installed package, and compares the bits of their ends with those
listed here, which are the same for every compiler and machine. Every fixed-step method takes part."""

import hashlib
import sys
import warnings
from pathlib import Path

import hooke

STEP, STEPS = 1e-5, 200  # [s]
EXPECTED = {
    "cantilever": ("verlet", "382a1a3ea3035887"),
    "cloth-16": ("shardlow", "78488e283d8f8edb"),
    "cloth-64": ("symplectic-euler", "d4832b23e88294d7"),
    "cloth-gentle": ("backward-euler", "538bcf9eaea87adb"),
    "curl": ("heun", "7645eb83490b81ef"),
    "drag-or-damping": ("implicit-midpoint", "35938861644d5bba"),
    "lattice": ("tr-bdf2", "1fe330cda0355e62"),
    "mesh": ("rk4", "a9fd5bf4a01f55f7"),
    "rope": ("symplectic-euler", "f2efc6408e1713d1"),
    "six-particles": ("forward-euler", "9812d85485d9c9db"),
}


def bits(path, method):
    warnings.simplefilter("ignore", hooke.StepWarning)  # forward-euler has no stable step
    state = hooke.run(path, method=method, step=STEP, duration=STEPS * STEP, every=STEPS * STEP, threads=2).state
    return hashlib.sha256(state.q.astype("<f8").tobytes() + state.v.astype("<f8").tobytes()).hexdigest()[:16]


def main():
    scenes = Path(__file__).resolve().parents[2] / "examples/scenes"
    found = {name: (method, bits(scenes / f"{name}.json", method)) for name, (method, _) in EXPECTED.items()}
    different = {name: row for name, row in found.items() if row != EXPECTED[name]}
    print(f"{len(found) - len(different)} of {len(found)} runs have the bits that are listed", *different.items(), sep="\n")
    return len(different) > 0


if __name__ == "__main__":
    sys.exit(main())
