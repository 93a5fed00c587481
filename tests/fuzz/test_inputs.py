"""The archives of inputs are as inputs.py writes them, and a damaged one is refused."""

import importlib.util
import lzma
import os
from pathlib import Path

import pytest

HERE = Path(os.environ["HOOKE_SOURCE_DIR"]) / "tests/fuzz"
TARGETS = sorted(path.stem.removeprefix("fuzz_") for path in HERE.glob("fuzz_*.c"))
SOME = {"found/b": b"two", "corpus/a": b"", "found/a": b"one"}

spec = importlib.util.spec_from_file_location("inputs", HERE / "inputs.py")
inputs = importlib.util.module_from_spec(spec)
spec.loader.exec_module(inputs)


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.setattr(inputs, "ROOT", tmp_path)
    (tmp_path / "tests/fuzz").mkdir(parents=True)
    inputs.write("one", SOME)
    return tmp_path


@pytest.mark.parametrize("target", TARGETS)
def test_archive_is_as_it_is_made(target):
    """The uncompressed contents, to the byte; versions of the compressor may differ."""
    data = inputs.archive(target).read_bytes()
    assert lzma.decompress(inputs.packed(inputs.unpacked(data))) == lzma.decompress(data)


def test_order_does_not_matter():
    assert inputs.packed(SOME) == inputs.packed(dict(sorted(SOME.items())))
    assert inputs.unpacked(inputs.packed(SOME)) == SOME


def test_an_input_is_added(here):
    (here / "crash-1234").write_bytes(b"three")
    folder = inputs.unpack("one")
    inputs.add("one", here / "crash-1234", "found/c")
    assert inputs.read("one") == SOME | {"found/c": b"three"}
    assert not (folder / "found/c").exists()
    assert (inputs.unpack("one") / "found/c").read_bytes() == b"three"
    with pytest.raises(SystemExit, match="found/c already"):
        inputs.add("one", here / "crash-1234", "found/c")


def test_a_folder_is_packed_again(here):
    (inputs.unpack("one") / "found/b").unlink()
    inputs.pack("one")
    assert inputs.read("one") == {"corpus/a": b"", "found/a": b"one"}
    inputs.write("one", SOME)
    with pytest.raises(SystemExit, match="unpack it first"):
        inputs.pack("one")


@pytest.mark.parametrize("name", ["found/../a", "/found/a", "other/a", "found/.a", "found/a/b", "found/", "a"])
def test_planted_name(name, monkeypatch):
    with pytest.raises(ValueError, match="no name of an input"):
        inputs.packed({name: b""})
    monkeypatch.setattr(inputs, "check_name", lambda name: None)
    archive = inputs.packed({name: b""})
    monkeypatch.undo()
    with pytest.raises(ValueError):
        inputs.unpacked(archive)


def test_planted_damage(here):
    archive = inputs.archive("one")
    whole = archive.read_bytes()
    flipped = [whole[:k] + bytes([whole[k] ^ 1]) + whole[k + 1 :] for k in range(len(whole))]
    for damaged in [*flipped, whole[:-1], whole[: len(whole) // 2], b"", inputs.packed({}), lzma.compress(b"no archive")]:
        archive.write_bytes(damaged)
        with pytest.raises(SystemExit, match="damaged"):
            inputs.unpack("one")
    archive.unlink()
    with pytest.raises(SystemExit, match="no archive"):
        inputs.unpack("one")
