"""hooke.verify: the library's findings, as a result."""

import pytest

import hooke


def test_a_result_verifies(tmp_path):
    hooke.run("examples/scenes/rope.json", output=tmp_path / "out.h5", duration=0.1, every=0.01)
    told = []
    found = hooke.verify(tmp_path / "out.h5", all=True, progress=lambda done, what: told.append(what))
    assert found and found.verdict == "agrees" and found.difference == ""
    assert found.numbers["frames"] == found.numbers["frames_checked"] == 11
    assert {"check values", "the slice"} <= set(told)
    assert "agrees" in repr(found)


def test_a_changed_file_is_a_result(tmp_path):
    h5py = pytest.importorskip("h5py")
    hooke.run("examples/scenes/rope.json", output=tmp_path / "out.h5", duration=0.1, every=0.01)
    with h5py.File(tmp_path / "out.h5", "r+") as file:
        file["particles/all/position/value"][3, 1, 0] += 1e-3
    found = hooke.verify(tmp_path / "out.h5")
    assert not found and found.verdict == "disagrees" and "frame 3" in found.difference


def test_stopping_and_failures(tmp_path):
    hooke.run("examples/scenes/rope.json", output=tmp_path / "out.h5", duration=0.1, every=0.01)
    assert hooke.verify(tmp_path / "out.h5", progress=lambda done, what: 1).verdict == "stopped"
    with pytest.raises(hooke.IOFailed):
        hooke.verify(tmp_path / "none.h5")
    with pytest.raises(hooke.BadValue):
        hooke.verify(tmp_path / "out.h5", slice=(0.05, 0.01))
    with pytest.raises(hooke.NoMemory):
        hooke.verify(tmp_path / "out.h5", memory=1e-6)
