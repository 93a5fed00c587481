"""One value, or one bit, of a finished trajectory is changed, in every dataset and attribute in turn: verifying finds it,
or nothing of hooke reads it. (unit/checkpoint does so with every byte of a checkpoint.)"""

import shutil
import zlib

import h5py
import numpy as np
import pytest
from conftest import SIX_PARTICLES

import hooke

# Attributes for other programs, which may set them.
UNREAD = [
    "h5md version",
    "h5md/author name",
    "h5md/creator name",
    "h5md/creator version",
    "particles/all/box boundary",
    "particles/all/box dimension",
    "connectivity/springs particles_group",
    "hooke/error numbers",
]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = tmp_path_factory.mktemp("whole") / "out.h5"
    scene = hooke.Scene.parse(SIX_PARTICLES)
    hooke.run(scene, method="verlet", duration=0.2, every=0.02, output=path, estimate=True)
    return path


@pytest.fixture
def path(whole, tmp_path):
    return shutil.copy(whole, tmp_path / "out.h5")


def places(path):
    """Every dataset, as (name, None), and every attribute, as (name, attribute)."""
    found = []
    with h5py.File(path) as file:
        def see(name, thing):
            found.extend((name, attribute) for attribute in thing.attrs)
            if isinstance(thing, h5py.Dataset):
                found.append((name, None))

        file.visititems(see)
    return found


def other(value, bit):
    """The value, or the first of an array, with one bit changed or another one instead."""
    if isinstance(value, (str, bytes)):
        first = value[:1] if isinstance(value, bytes) else value[:1].encode()
        changed = bytes([first[0] ^ 1]) if bit and first else b"#"
        return (changed if isinstance(value, bytes) else changed.decode()) + value[1:]
    changed = np.array(value)
    if changed.dtype.kind in "SO":
        return other(changed[()], bit) if changed.ndim == 0 else changed[::-1]
    flat = changed.reshape(-1)
    if bit:
        flat.view(np.uint8)[flat.itemsize - 2] ^= 4
    else:
        flat[0] = 3 if np.isnan(float(flat[0])) else flat[0] + 1
    return flat.reshape(changed.shape)


def change(path, name, attribute, bit):
    with h5py.File(path, "r+") as file:
        thing = file[name]
        if attribute is None:
            before = thing[()]
            thing[...] = other(before, bit)
            assert not np.array_equal(thing[()], before)
        elif attribute == "particles_group":
            thing.attrs[attribute] = file["hooke"].ref
        else:
            thing.attrs[attribute] = other(thing.attrs[attribute], bit)


def fault(path):
    """What is wrong with it in words; "" if it verifies."""
    try:
        found = hooke.verify(path, bits=True)
    except hooke.Error as error:
        return str(error)
    assert bool(found) == (found.difference == "")
    return found.difference


@pytest.mark.parametrize("bit", [False, True])
def test_every_value_is_under_a_check_value(whole, tmp_path, bit):
    assert fault(whole) == ""
    unfound, seen = [], places(whole)
    assert len(seen) > 50
    for name, attribute in seen:
        path = shutil.copy(whole, tmp_path / "out.h5")
        change(path, name, attribute, bit)
        said = fault(path)
        assert not said or str(path) in said, (name, attribute, said)
        if not said:
            unfound.append(f"{name} {attribute}")
    assert sorted(unfound) == sorted(UNREAD)


@pytest.mark.parametrize("frame", [0, 4, 10])
def test_a_frame_without_a_time_is_missed(path, frame):
    with h5py.File(path, "r+") as file:
        file["particles/all/position/time"][frame] = np.nan
    out = hooke.open(path)
    assert len(out) == 11
    with pytest.raises(hooke.BadValue, match=f"frame {frame} of .* is damaged: it has no time"):
        out.state(frame)
    assert f"frame {frame} of {path} is damaged" in fault(path)
    state = {"file": "out.h5", "dataset": "/particles/all/position/value", "frame": -1}
    scene = {"hooke": 1, "particles": {"position": state, "mass": 1}}
    if frame == 10:
        with pytest.raises(hooke.BadValue, match="frame 10 of .* is damaged"):
            hooke.Scene.parse(scene, folder=path.parent)
    else:
        hooke.Scene.parse(scene, folder=path.parent)


@pytest.mark.parametrize(("name", "value", "frames"), [("duration", 0.4, 21), ("every", 0.1, 3)])
def test_a_finished_run_has_all_its_frames(path, name, value, frames):
    with h5py.File(path, "r+") as file:
        del file["hooke/file_check"]  # as in an older file
        file["hooke/options"].attrs[name] = value
    assert f"it has 11 frames, and its finished run has {frames}" in fault(path)


def test_an_older_file_says_what_is_not_covered(path):
    assert hooke.verify(path).texts["parts"] == "checked"
    with h5py.File(path, "r+") as file:
        del file["hooke/file_check"]
        file["particles/all/mass"][0] = 7
    found = hooke.verify(path)
    assert found and found.texts["parts"] == "not-covered"


@pytest.mark.parametrize("name", ["error", "error_by", "error_reason"])
def test_a_false_error_is_refused(path, name):
    known = hooke.open(path).error
    assert known is not None and known.estimate > 0
    change(path, f"hooke/{name}", None, bit=True)
    assert fault(path).endswith("is damaged: the outcome of its run, its number of frames or its error are not those "
                                "that were written, by their check value")


def test_an_error_is_of_the_run_as_it_ended(path):
    """Numbers that are not yet there as a whole, or are of an earlier end of the run, count for nothing."""
    with h5py.File(path, "r+") as file:
        file["hooke/file_check"][0] = end(file)
        file["hooke/error"][1] *= 2
    out = hooke.open(path)
    assert out.error is None and np.isnan(out._numbers("error")).all()
    assert fault(path) == ""


def description(file):
    """The check value of what is known before the run, as documented."""
    value = b""
    for group in file["hooke"], file["hooke/options"]:
        for name in sorted(set(group.attrs) - {"run"}):
            thing = group.attrs[name]
            value += name.encode() + b"\0"
            value += thing.encode() + b"\0" if isinstance(thing, str) else np.asarray(thing, float).tobytes()
    for name in "particles/all/mass", "particles/all/species", "connectivity/springs", "hooke/rest_length":
        value += np.asarray(file[name], float).tobytes()
    return zlib.crc32(value + file["hooke/scene"][()])


def end(file):
    """The check value of a run that is over before its error is known."""
    outcome = file["hooke/status"][()].ljust(16, b"\0") + file["hooke/beyond"][:].tobytes()
    return zlib.crc32(outcome + np.int64(len(file["particles/all/position/time"])).tobytes(), description(file))


def test_the_check_value_is_continued(path, tmp_path):
    """From the name of the run to its outcome to its error."""
    hooke.run(hooke.open(path).scene, output=tmp_path / "bare.h5", estimate=False)
    with h5py.File(path) as file, h5py.File(tmp_path / "bare.h5") as bare:
        for each in file, bare:
            run = each["hooke"].attrs["run"]
            assert int(run[24:], 16) == zlib.crc32(run[:24].encode(), description(each))
        error = file["hooke/error"][:].tobytes() + file["hooke/error_by"][()].ljust(16, b"\0")
        error += file["hooke/error_reason"][()].ljust(256, b"\0")
        assert file["hooke/file_check"][:] == zlib.crc32(error, end(file))
        assert bare["hooke/file_check"][:] == end(bare)
    assert hooke.open(tmp_path / "bare.h5").error is None and fault(tmp_path / "bare.h5") == ""


@pytest.mark.parametrize("name", ["hooke/scene", "hooke/rest_length", "hooke/options method", "hooke run"])
def test_an_unfinished_run_of_another_description_is_refused(path, name):
    with h5py.File(path, "r+") as file:
        file["hooke/status"][...] = b"running"
    hooke.open(path)
    change(path, *(name.split() + [None])[:2], bit=False)
    with pytest.raises(hooke.BadValue, match="damaged: the name of its run, its scene, options, masses or springs"):
        hooke.open(path)
