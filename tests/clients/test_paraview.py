"""ParaView's reader of XDMF, as it is in VTK, reads the companion of a trajectory: the numbers of the HDF5 file, to the bit."""

import os
import shutil

import h5py
import numpy as np
import pytest
from conftest import CLOTH, DUST, there, write
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_LINE, VTK_POLY_LINE, VTK_POLY_VERTEX
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOXdmf2 import vtkXdmfReader

import hooke


def read(path):
    """Times, and a function that gives the grid of one."""
    reader = vtkXdmfReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())

    def grid(time):
        reader.UpdateTimeStep(time)
        return reader.GetOutputDataObject(0)

    return times, grid


def array(of, name):
    return vtk_to_numpy(of.GetArray(name))


def complaints(path, xdmf, frames=None):
    """Differences between the readings of VTK and h5py."""
    found = []
    times, grid = read(xdmf)
    with h5py.File(path) as file:
        t, springs = file["particles/all/position/time"][there(path)], file["connectivity/springs"][:]
        if not np.array_equal(times, t):
            return ["times"]
        for k in range(len(t)) if frames is None else frames:
            seen = grid(t[k])
            points, cells = seen.GetPointData(), seen.GetCellData()
            pairs = [("position", vtk_to_numpy(seen.GetPoints().GetData()), file["particles/all/position/value"][k]),
                     ("velocity", array(points, "velocity"), file["particles/all/velocity/value"][k]),
                     ("mass", array(points, "mass"), file["particles/all/mass"][:]),
                     ("species", array(points, "species"), file["particles/all/species"][:])]
            if len(springs):
                ends = vtk_to_numpy(seen.GetCells().GetConnectivityArray()).reshape(-1, 2)
                pairs += [("springs", ends, springs), ("rest_length", array(cells, "rest_length"), file["hooke/rest_length"][:])]
                assert seen.GetCellType(0) in (VTK_LINE, VTK_POLY_LINE)
            else:
                assert seen.GetCellType(0) == VTK_POLY_VERTEX
            found += [f"{name} of frame {k}" for name, a, b in pairs
                      if a.shape != b.shape or not np.array_equal(a, b) or (a.dtype.itemsize < b.dtype.itemsize and name != "springs")]
    return found


def test_every_frame(cloth, capfd):
    assert complaints(cloth, cloth.with_suffix(".xdmf")) == []
    times, grid = read(cloth.with_suffix(".xdmf"))
    assert len(times) == 11 and grid(times[3]).GetNumberOfCells() == 106
    assert "ERR" not in capfd.readouterr().err


def test_a_run_that_diverged(diverged, capfd):
    assert complaints(diverged, diverged.with_suffix(".xdmf")) == []
    assert "ERR" not in capfd.readouterr().err


def test_a_run_that_was_killed(killed, capfd):
    """It has no companion; one can be written afterwards, of the existing frames."""
    companion = hooke.write_xdmf(killed)
    assert companion == killed.with_suffix(".xdmf")
    assert complaints(killed, companion, [0, 1, sum(there(killed)) - 1]) == []
    assert "ERR" not in capfd.readouterr().err


def test_particles_without_springs(tmp_path):
    assert complaints(write(tmp_path, DUST), tmp_path / "out.xdmf") == []


@pytest.mark.parametrize("name", ["a b.h5", "a&b<c>.h5", "it's \"so\".h5", "100%20.hdf5", "plain"])
def test_names(tmp_path, name):
    path = write(tmp_path, DUST, name)
    stem = name.removesuffix(".h5").removesuffix(".hdf5")
    assert complaints(path, tmp_path / f"{stem}.xdmf") == []


def test_it_may_be_moved_with_its_file(cloth, tmp_path):
    for source in (cloth, cloth.with_suffix(".xdmf")):
        shutil.copy(source, tmp_path)
    assert complaints(tmp_path / "out.h5", tmp_path / "out.xdmf", [2]) == []


def test_it_may_be_elsewhere(cloth, tmp_path):
    companion = hooke.write_xdmf(os.path.relpath(cloth), tmp_path / "far.xdmf")
    assert complaints(cloth, companion, [2]) == []


def test_written_by_python(tmp_path):
    result = hooke.run(hooke.Scene.parse(CLOTH), output=tmp_path / "py.h5")
    assert complaints(tmp_path / "py.h5", tmp_path / "py.xdmf", [0, 10]) == []
    assert hooke.write_xdmf(result) == tmp_path / "py.xdmf"


def test_planted(cloth, tmp_path):
    """Frames, springs and times that differ from the file are detected."""
    text = cloth.with_suffix(".xdmf").read_text()
    shutil.copy(cloth, tmp_path)
    for old, new in [(">3 0 0 1 1 1", ">4 0 0 1 1 1"), ("/connectivity/springs", "/connectivity/others"), ('Value="0"', 'Value="0.001"'),
                     ("all/species<", "all/kinds<")]:
        assert old in text
        with h5py.File(tmp_path / "out.h5", "a") as file:
            for name, source in (("connectivity/others", "connectivity/springs"), ("particles/all/kinds", "particles/all/species")):
                if name not in file:
                    file[name] = file[source][:][::-1]
        (tmp_path / "out.xdmf").write_text(text.replace(old, new))
        assert complaints(tmp_path / "out.h5", tmp_path / "out.xdmf", [3]), (old, new)
