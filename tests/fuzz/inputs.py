"""The inputs of each target, in one archive: tests/fuzz/inputs/<target>.tar.xz.

    inputs.py add TARGET FILE found/NAME   keeps an input that was a finding, under a name that says what it was
    inputs.py unpack TARGET                writes the inputs into build/fuzz/inputs/TARGET
    inputs.py pack TARGET                  makes the archive of that folder again

An archive holds corpus/, inputs to begin with, found/, inputs that were findings once, and for some targets campaign/.
The same inputs give the same bytes: members are sorted and have neither times nor owners.
"""

import argparse
import hashlib
import io
import lzma
import pathlib
import re
import shutil
import sys
import tarfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NAME = re.compile(r"(corpus|found|campaign)/\w[\w.-]*")


def archive(target):
    return ROOT / "tests" / "fuzz" / "inputs" / f"{target}.tar.xz"


def folder(target):
    return ROOT / "build" / "fuzz" / "inputs" / target


def check_name(name):
    if not NAME.fullmatch(name):
        raise ValueError(f"'{name}' is no name of an input, which is corpus/NAME, found/NAME or campaign/NAME")


def packed(inputs):
    """The archive of {name: bytes}."""
    stream = io.BytesIO()
    with tarfile.open(fileobj=stream, mode="w", format=tarfile.USTAR_FORMAT) as tar:
        for name in sorted(inputs):
            check_name(name)
            member = tarfile.TarInfo(name)  # of time 0 and owner 0
            member.size = len(inputs[name])
            tar.addfile(member, io.BytesIO(inputs[name]))
    return lzma.compress(stream.getvalue(), preset=9 | lzma.PRESET_EXTREME)


def unpacked(data):
    """{name: bytes} of an archive; ValueError unless it is whole and holds inputs only."""
    inputs = {}
    try:
        with tarfile.open(fileobj=io.BytesIO(lzma.decompress(data)), mode="r:") as tar:
            for member in tar:
                check_name(member.name)
                if not member.isreg() or member.name in inputs:
                    raise ValueError(f"'{member.name}' is there twice, or is no file")
                inputs[member.name] = tar.extractfile(member).read()
    except (lzma.LZMAError, tarfile.TarError) as error:
        raise ValueError(str(error)) from error
    if not inputs:
        raise ValueError("it holds no input")
    return inputs


def read(target):
    try:
        return unpacked(archive(target).read_bytes())
    except OSError as error:
        sys.exit(f"fuzz/{target} has no archive of inputs, which `inputs.py add` makes: {error}")
    except ValueError as error:
        sys.exit(f"{archive(target)} is damaged: {error}")


def write(target, inputs):
    new = archive(target).with_suffix(".new")
    new.parent.mkdir(exist_ok=True)
    new.write_bytes(packed(inputs))
    new.replace(archive(target))
    count = len(inputs)
    print(f"{target}: {count} inputs of {sum(map(len, inputs.values()))} bytes, {archive(target).stat().st_size} in the archive")


def digest(target):
    return hashlib.sha256(archive(target).read_bytes()).hexdigest()


def unpack(target):
    """The folder with the current inputs of the archive; it is rewritten if it holds older ones."""
    into = folder(target)
    stamp = into / "archive.sha256"
    if archive(target).exists() and stamp.exists() and stamp.read_text() == digest(target):
        return into
    inputs = read(target)
    shutil.rmtree(into, ignore_errors=True)
    for name, data in inputs.items():
        (into / name).parent.mkdir(parents=True, exist_ok=True)
        (into / name).write_bytes(data)
    stamp.write_text(digest(target))
    return into


def pack(target):
    into = folder(target)
    stamp = into / "archive.sha256"
    if not stamp.exists() or stamp.read_text() != digest(target):
        sys.exit(f"{into} does not come from the archive as it is: unpack it first")
    write(target, {p.relative_to(into).as_posix(): p.read_bytes() for p in into.glob("*/*")})
    stamp.write_text(digest(target))


def add(target, file, name):
    inputs = read(target) if archive(target).exists() else {}
    if name in inputs:
        sys.exit(f"fuzz/{target} has a {name} already")
    write(target, inputs | {name: pathlib.Path(file).read_bytes()})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    for verb in "add", "unpack", "pack":
        verbs.add_parser(verb).add_argument("target")
    for word in "file", "name":
        verbs.choices["add"].add_argument(word)
    asked = parser.parse_args()
    if not (ROOT / "tests" / "fuzz" / f"fuzz_{asked.target}.c").exists():
        parser.error(f"no such target: {asked.target}")
    if asked.verb == "add":
        add(asked.target, asked.file, asked.name)
    elif asked.verb == "pack":
        pack(asked.target)
    else:
        print(unpack(asked.target))


if __name__ == "__main__":
    sys.exit(main())
