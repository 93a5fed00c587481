"""The scripts of bench/peers, which need packages that tests do without: they compile, and their cloth is the one
described to other programs."""

import importlib.util
import os
import sys
from pathlib import Path

import numpy as np
import pytest

FOLDER = Path(os.environ["HOOKE_SOURCE_DIR"]) / "bench/peers"
SCRIPTS = sorted(FOLDER.glob("*.py"))


def test_scripts_compile():
    assert {"run.py", "cloth.py", "with_lammps.py"} <= {path.name for path in SCRIPTS}
    for path in SCRIPTS:
        compile(path.read_text(encoding="utf-8"), str(path), "exec")


@pytest.fixture
def cloths(monkeypatch):
    spec = importlib.util.spec_from_file_location("cloth_of_peers", FOLDER / "cloth.py")
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)  # dataclasses look it up
    spec.loader.exec_module(module)
    return module


def test_a_family_is_one_material(cloths):
    n, stiffness, damping = 7, 50.0, 0.02
    cloth = cloths.make(n, stiffness, damping)
    h = 1.0 / (n - 1)
    counts = [2 * n * (n - 1), 2 * (n - 1) ** 2, 2 * n * (n - 2)]
    for family, (count, length) in enumerate(zip(counts, [h, np.sqrt(2) * h, 2 * h])):
        mine = cloth.family == family
        assert mine.sum() == count
        apart = np.diff(cloth.q[cloth.ends[mine]], axis=1)[:, 0]
        assert np.allclose(np.linalg.norm(apart, axis=1), length, rtol=1e-12)
        assert np.allclose(cloth.rest_length[mine], length, rtol=1e-12)
        assert np.allclose(cloth.kappa[mine], stiffness / length, rtol=1e-12)
        assert np.allclose(cloth.gamma[mine], damping / length, rtol=1e-12)
    assert np.flatnonzero(cloth.inverse_mass == 0).tolist() in ([0, n - 1], [n * (n - 1), n * n - 1])
    assert np.allclose(cloth.mass, 1.0 / n**2)


def test_shaking_moves_free_particles_only(cloths):
    cloth = cloths.make(6)
    flat = cloth.q.copy()
    moved = np.abs(cloth.shaken().q - flat).max(axis=1) / cloth.spacing
    assert (moved[cloth.inverse_mass == 0] == 0).all()
    assert (moved[cloth.inverse_mass > 0] > 0).all() and moved.max() <= 0.01 and not cloth.damped
