"""Trajectory files that were manipulated, by h5py: an error, and no data from outside the file."""

import h5py
import numpy as np
import pytest
from conftest import SIX_PARTICLES

import hooke
from hooke._library import lib


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "out.h5"
    hooke.run(hooke.Scene.parse(SIX_PARTICLES), output=path)
    return path


def put_text(group, name, length, **storage):
    """A text of fixed length; h5py's high-level interface cannot lay it out in every way."""
    kind = h5py.h5t.C_S1.copy()
    kind.set_size(length)
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    space = h5py.h5s.create(h5py.h5s.SCALAR)
    if "external" in storage:
        properties.set_external(str(storage["external"]).encode(), 0, length)
    if "count" in storage:
        space = h5py.h5s.create_simple((storage["count"],))
        properties.set_chunk((1,))
    del group[name]
    return h5py.Dataset(h5py.h5d.create(group.id, name.encode(), kind, space, dcpl=properties))


@pytest.mark.parametrize("name", ["scene", "status"])
def test_a_text_is_not_taken_from_another_file(path, tmp_path, name):
    other = tmp_path / "other.txt"
    other.write_text("secret " * 10)
    with h5py.File(path, "r+") as file:
        put_text(file["hooke"], name, 40, external=other)
        del file["hooke/file_check"]
    if name == "status":
        with pytest.raises(hooke.Error, match="no trajectory of hooke"):
            hooke.open(path)
    else:
        assert hooke.open(path).scene is None


def test_a_text_of_many_pieces_is_none(path):
    """One chunk of a thousand is stored: as many bytes as a chunk has, and a thousandth of the data to read."""
    with h5py.File(path, "r+") as file:
        text = put_text(file["hooke"], "status", 64, count=1000)
        text[0] = b"finished"
        assert text.id.get_storage_size() == 64
    with pytest.raises(hooke.Error, match="no trajectory of hooke"):
        hooke.open(path)


@pytest.mark.parametrize("shape", [(5000, 0), (5, 2), (0, 5)])
def test_times_are_a_column(path, shape):
    with h5py.File(path, "r+") as file:
        del file["particles/all/position/time"]
        file["particles/all/position/time"] = np.zeros(shape)
    with pytest.raises(hooke.Error, match="position/time is no column"):
        hooke.open(path)


@pytest.mark.parametrize("value", [[1e-3, 2e-3], np.bytes_(b"0.001"), np.array([], "f8"), h5py.Empty("f8")])
def test_an_option_that_cannot_be_read_is_not_left_out(path, value):
    with h5py.File(path, "r+") as file:
        file["hooke/options"].attrs["step"] = value
    with pytest.raises(hooke.Error, match=r"out.h5: step: is neither a single number nor a text"):
        hooke.open(path)


def test_a_state_is_never_half_of_a_frame(path):
    """Positions can be read, velocities cannot: the state is unchanged."""
    with h5py.File(path, "r+") as file:
        del file["hooke/frame_check"], file["particles/all/velocity/value"]
        file["particles/all/velocity/value"] = np.zeros((len(file["particles/all/position/value"]), 5, 3))
    record = hooke.open(path)
    state = record.system.state()
    state.q[:], state.v[:], state.t = 0.25, 0.5, 3.0
    with pytest.raises(hooke.Error, match="velocity/value has 15 numbers a frame; the state has 18"):
        lib.hooke_record_read(record._handle, -1, state._handle)
    assert np.all(state.q == 0.25) and np.all(state.v == 0.5) and state.t == 3.0


def test_a_small_file_cannot_claim_much_memory(path):
    """The extent of an array and its allocated size are patched, beyond the end of the file."""
    with h5py.File(path, "r+") as file:
        file["hooke/rest_length"].id.get_storage_size()
        size, data = file["hooke/rest_length"].shape[0], file["particles/all/mass"]
        assert data.shape[0] == 6 and size != 6
        where, room = h5py.h5o.get_info(data.id).addr, data.id.get_storage_size()
    whole = bytearray(path.read_bytes())
    header = whole[where : where + 512]
    for old, new in ((6, 6 << 26), (room, room << 26)):
        header = header.replace(old.to_bytes(8, "little"), new.to_bytes(8, "little"))
    whole[where : where + 512] = header
    path.write_bytes(whole)
    with pytest.raises(hooke.Error, match="only|could not|claims"):
        _ = hooke.open(path).mass


def grown(data, columns):
    """The file of a dataset, with so many columns in its header; the stored data are unchanged."""
    where, old = h5py.h5o.get_info(data.id).addr, data.shape[1].to_bytes(8, "little")
    name = data.file.filename
    data.file.close()
    with open(name, "r+b") as file:
        file.seek(where)
        header = file.read(256)
        assert old in header
        file.seek(where)
        file.write(header.replace(old, columns.to_bytes(8, "little")))


@pytest.mark.parametrize("layout", [h5py.h5d.COMPACT, h5py.h5d.CONTIGUOUS])
def test_an_array_in_one_piece_is_not_read_beyond_it(tmp_path, layout):
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_layout(layout)
    with h5py.File(tmp_path / "state.h5", "w") as file:
        space = h5py.h5s.create_simple((4, 29))
        made = h5py.h5d.create(file.id, b"position", h5py.h5t.NATIVE_DOUBLE, space, dcpl=properties)
        data = h5py.Dataset(made)
        data[:] = 1.0
        grown(data, 1000)
    scene = {"hooke": 1, "particles": {"position": {"file": "state.h5", "dataset": "position"}, "mass": 1}}
    by_hdf5 = "could not find the dataset position: (bad value from dataset header|invalid dataset size)"  # since 1.14
    with pytest.raises(hooke.Error, match=f"dataset position claims 4000 numbers, but only 928 bytes are stored|{by_hdf5}"):
        hooke.Scene.parse(scene, folder=tmp_path)


@pytest.mark.parametrize("times, need", [(False, "49.2"), (True, "16.4")])
def test_an_array_of_many_pieces_needs_their_memory(tmp_path, times, need):
    """HDF5 takes kilobytes for each chunk, of any size."""
    position, pieces = np.ones((2000, 3)), {"chunks": (1, 1)}
    if times:
        position, pieces = np.ones((2000, 1, 3)), {}
    with h5py.File(tmp_path / "state.h5", "w") as file:
        file.create_dataset("run/value", data=position, **pieces)
        file.create_dataset("run/time", data=np.arange(2000.0), chunks=(1,) if times else None)
    scene = {"hooke": 1, "particles": {"position": {"file": "state.h5", "dataset": "run/value"}, "mass": 1}}
    with pytest.raises(hooke.NoMemory, match=rf"run/value needs {need} MB of memory; there are 10 MB"):
        hooke.Scene.parse(scene, folder=tmp_path, memory=0.01)
    expected = 1 if times else len(position)
    assert hooke.Scene.parse(scene, folder=tmp_path).system.particle_count == expected
