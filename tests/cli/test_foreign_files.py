"""Manipulated trajectories that try to have other files opened, or code loaded: they are refused with a message, and
nothing else is opened, according to the system."""

import contextlib
import ctypes
import json
import os
import shutil
import subprocess
import time

import h5py
import pytest
from conftest import CLI, ENDLESS, SIX_PARTICLES, default_signals, interrupt

pytestmark = pytest.mark.everything

IN_OPEN = 0x20
ELSEWHERE, LINK, CODE = (
    "keeps its numbers in another file",
    "a link in it leads to another file",
    "filter that HDF5 would have to load",
)
POSITION, SPECIES, MASS, TIME = (f"particles/all/{name}" for name in ["position/value", "species", "mass", "position/time"])


@contextlib.contextmanager
def untouched(path):
    """Checks that nobody opens the file, or lists the folder, meanwhile."""
    libc = ctypes.CDLL(None, use_errno=True)
    watch = libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
    assert watch >= 0 and libc.inotify_add_watch(watch, os.fsencode(path), IN_OPEN) >= 0
    try:
        yield
        with pytest.raises(BlockingIOError):
            os.read(watch, 4096)
    finally:
        os.close(watch)


def call(folder, *words):
    environment = {**os.environ, "HDF5_PLUGIN_PATH": str(folder / "plugins")}
    done = subprocess.run([CLI, *words], cwd=folder, env=environment, capture_output=True, text=True, timeout=120, check=False)
    assert "Sanitizer" not in done.stderr and done.returncode >= 0, done.stderr
    return done


@pytest.fixture(name="made", scope="module")
def fixture_made(tmp_path_factory):
    """A finished run, one that was stopped, and a secret file."""
    folder = tmp_path_factory.mktemp("made")
    (folder / "scene.json").write_text(json.dumps(SIX_PARTICLES))
    assert call(folder, "run", "scene.json", "-o", "finished.h5", "--quiet").returncode == 0
    (folder / "endless.json").write_text(json.dumps(ENDLESS))
    words = [CLI, "run", "endless.json", "-o", "stopped.h5", "--quiet"]
    with subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, preexec_fn=default_signals) as process:
        while not (folder / "stopped.h5").exists():
            assert process.poll() is None
            time.sleep(0.01)
        interrupt(process)
    assert process.returncode == 130
    shutil.copy(folder / "finished.h5", folder / "private.h5")
    (folder / "plugins").mkdir()
    return folder


def virtual(file, name, private):
    """All rows of the other file, which HDF5 has to open it for."""
    shape, kind = file[name].shape, file[name].id.get_type()
    most, begin = (h5py.h5s.UNLIMITED, *shape[1:]), (0,) * len(shape)
    spaces = [h5py.h5s.create_simple(shape, most) for _ in range(2)]
    for space in spaces:
        space.select_hyperslab(begin, (1,) * len(shape), block=most)
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_virtual(spaces[0], private, name.encode(), spaces[1])
    del file[name]
    h5py.h5d.create(file.id, name.encode(), kind, spaces[0], dcpl=properties)


def raw(file, name, private):
    data = file[name]
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_external(private, 0, data.id.get_storage_size())
    kind, space = data.id.get_type(), data.id.get_space()
    del file[name]
    h5py.h5d.create(file.id, name.encode(), kind, space, dcpl=properties)


def link(file, name, private):
    del file[name]
    file[name] = h5py.ExternalLink(private.decode(), "/" + name)


def detour(file, name, private):
    """A link inside the file to one that leads out of it."""
    link(file, "h5md", private)
    del file[name]
    file[name] = h5py.SoftLink(f"/h5md/{name}")


def packed(file, name, _):
    shape, kind = file[name].shape, file[name].id.get_type()
    properties = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
    properties.set_chunk(shape)
    properties.set_filter(32999, h5py.h5z.FLAG_OPTIONAL)
    del file[name]
    data = h5py.h5d.create(file.id, name.encode(), kind, h5py.h5s.create_simple(shape), dcpl=properties)
    data.write_direct_chunk((0,) * len(shape), b"packed" * 8)


CASES = [
    (virtual, POSITION, ELSEWHERE),
    (virtual, TIME, ELSEWHERE),
    (virtual, MASS, ELSEWHERE),
    (virtual, SPECIES, ELSEWHERE),
    (raw, POSITION, ELSEWHERE),
    (raw, SPECIES, ELSEWHERE),
    (link, POSITION, LINK),
    (link, SPECIES, LINK),
    (detour, SPECIES, LINK),
    (packed, POSITION, CODE),
    (packed, MASS, CODE),
    (packed, SPECIES, CODE),
]


@pytest.mark.parametrize("way, name, words", CASES)
def test_no_other_file_is_opened(made, tmp_path, way, name, words):
    for path in made.iterdir():
        shutil.copytree(path, tmp_path / path.name) if path.is_dir() else shutil.copy(path, tmp_path)
    told = ""
    for whole, commands in (
        ("finished.h5", [["view"], ["verify"], ["why"], ["limit", "--predict"]]),
        ("stopped.h5", [["run", "--resume"]]),
    ):
        with h5py.File(tmp_path / whole, "r+") as file:
            way(file, name, b"private.h5")
        with untouched(tmp_path / "private.h5"), untouched(tmp_path / "plugins"):
            for command in commands:
                told += call(tmp_path, *command, whole).stderr
    assert words in told


def test_a_link_that_nothing_reads_stays_a_link(made, tmp_path):
    """A file that is made again, for a run that goes on, has it as it was: what it leads to is not copied."""
    shutil.copy(made / "stopped.h5", tmp_path)
    shutil.copy(made / "private.h5", tmp_path)
    with h5py.File(tmp_path / "stopped.h5", "r+") as file:
        link(file, "h5md/author", b"private.h5")
    before = os.stat(tmp_path / "stopped.h5").st_ino
    with untouched(tmp_path / "private.h5"):
        words = [CLI, "run", "--resume", "stopped.h5", "--quiet"]
        with subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.DEVNULL, preexec_fn=default_signals) as process:
            while os.stat(tmp_path / "stopped.h5").st_ino == before:
                assert process.poll() is None
                time.sleep(0.01)
            interrupt(process)
        assert process.returncode == 130
    with h5py.File(tmp_path / "stopped.h5") as file:
        assert isinstance(file["h5md"].get("author", getlink=True), h5py.ExternalLink)
