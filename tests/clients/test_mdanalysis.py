"""MDAnalysis reads hooke's files, to the last bit of its single precision."""

import warnings

import h5py
import MDAnalysis
import numpy as np
import pytest
from MDAnalysis.coordinates.H5MD import H5MDReader

pytestmark = pytest.mark.filterwarnings("ignore:Reader has no dt information")


def check(path, frames):
    reader = H5MDReader(str(path), convert_units=False)
    with h5py.File(path) as file:
        q, v, t = (file[f"particles/all/{name}"] for name in ("position/value", "velocity/value", "position/time"))
        assert (reader.n_frames, reader.n_atoms) == (len(t), q.shape[1]) and reader.ts.dimensions is None
        for k in frames:
            ts = reader[k]
            assert np.array_equal(ts.positions, q[k].astype(np.float32))
            assert np.array_equal(ts.velocities, v[k].astype(np.float32))
            assert ts.time == t[k] and ts.data["step"] == file["particles/all/position/step"][k]
            for name in ("kinetic_energy", "potential_energy", "total_energy", "dissipated_power"):
                assert ts.data[name] == file[f"observables/{name}/value"][k]
            for name in ("momentum", "angular_momentum"):
                assert np.array_equal(ts.data[name], file[f"observables/{name}/value"][k])
    reader.close()


def test_every_frame(cloth):
    check(cloth, range(11))


def test_a_run_that_diverged(diverged):
    with h5py.File(diverged) as file:
        count = len(file["particles/all/position/time"])
    assert 1 < count < 101
    check(diverged, range(count))


def test_a_universe(cloth):
    """Masses and bonds of the file, and the springs that MDAnalysis then finds."""
    with h5py.File(cloth) as file:
        mass, springs = file["particles/all/mass"][:], file["connectivity/springs"][:]
        q = file["particles/all/position/value"][-1]
    universe = MDAnalysis.Universe.empty(len(mass))
    universe.add_TopologyAttr("masses", mass)
    universe.add_TopologyAttr("bonds", springs)
    universe.load_new(str(cloth), format="H5MD", convert_units=False)
    universe.trajectory[-1]
    centre = (mass[:, None] * q).sum(axis=0) / mass.sum()
    assert np.allclose(universe.atoms.center_of_mass(), centre, atol=1e-6)
    lengths = np.linalg.norm(q[springs[:, 0]] - q[springs[:, 1]], axis=1)
    assert np.allclose(np.sort(universe.bonds.values()), np.sort(lengths), atol=1e-6)


def test_planted(cloth, tmp_path):
    """A file with a number that is not the run's is detected."""
    other = tmp_path / "other.h5"
    other.write_bytes(cloth.read_bytes())
    reader = H5MDReader(str(other), convert_units=False)
    with h5py.File(cloth) as file, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        assert not np.array_equal(reader[3].positions, file["particles/all/position/value"][4].astype(np.float32))
    reader.close()
