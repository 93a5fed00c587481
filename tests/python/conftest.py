"""Shared parts of the tests of the Python package. The package is imported from the build tree, HOOKE_BUILD_DIR;
HOOKE_LIBRARY names the library to test (CTest sets both)."""

import os
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("HOOKE_BUILD_DIR", ROOT / "build/release"))
PACKAGES = BUILD / "python"  #: holds the package

sys.path[:0] = [str(PACKAGES), str(ROOT / "bindings/generate")]
os.environ.setdefault("HOOKE_LIBRARY", str(BUILD / "libhooke.so"))
os.environ.setdefault("MPLBACKEND", "Agg")

import hooke  # noqa: E402

SIX_PARTICLES = {
    "hooke": 1,
    "title": "six particles",
    "gravity": [0, -9.81, 0],
    "particles": {
        "position": [[0, 0, 0], [1, 0, 0.1], [2, 0.2, 0], [2, 1.1, 0.3], [0.7, 1.2, 0], [3, 2, 0.2]],
        "velocity": [[0, 0.1, 0], [0, 0, 0], [0.2, 0, 0], [0, 0, 0], [0, 0, -0.1], [0, 0, 0]],
        "mass": [1, 2, 3, 4, 5, 6],
        "pinned": [5],
    },
    "springs": [
        {
            "name": "edges",
            "between": [[0, 1], [0, 4], [1, 2], [1, 4], [2, 3], [3, 4], [3, 5]],
            "stiffness": 100,
            "damping": 0.5,
            "rest_scale": 0.9,
        }
    ],
    "run": {"method": "symplectic-euler", "step": 1e-3, "duration": 0.5, "every": 0.05},
}


def build_six_particles():
    """The same by calls."""
    system = hooke.System()
    particles, springs = SIX_PARTICLES["particles"], SIX_PARTICLES["springs"][0]
    system.set_gravity(SIX_PARTICLES["gravity"])
    system.add_particles(particles["position"], particles["velocity"], mass=particles["mass"])
    system.pin(particles["pinned"])
    system.add_springs(springs["name"], springs["between"], stiffness=100, damping=0.5, rest_scale=0.9)
    return system


def build_oscillator(k=20.0, m=0.5, stretch=0.25):
    """One spring of rest length 1 along x, its first end pinned: x'' = -(k/m) (x - 1)."""
    system = hooke.System()
    system.add_particles([[0, 0, 0], [1 + stretch, 0, 0]], mass=[1, m])
    system.pin(0)
    system.add_springs("spring", [[0, 1]], stiffness=k, rest_length=1)
    return system


@pytest.fixture
def scene():
    return hooke.Scene.parse(SIX_PARTICLES)


@pytest.fixture
def system():
    return build_six_particles()
