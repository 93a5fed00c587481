"""The wheels: made, used in an empty environment and on an older system, and the bits of those for AArch64 and musl."""

from __future__ import annotations

import re
from typing import Any

from steps import Part, Step

SCENES = "cloth-16 cloth-gentle curl drag-or-damping lattice mesh oscillator rope six-particles stiff-spring"


def verified(text: str) -> dict[str, Any]:
    """Number of runs elsewhere that this machine repeated to the bit."""
    same = len(re.findall(r"^verdict +the file agrees with its scene to the bit ", text, re.MULTILINE))
    if same != len(SCENES.split()):
        raise ValueError(f"{same} of {len(SCENES.split())} runs have the same bits")
    return {"scenes": same}


def took(text: str) -> dict[str, Any]:
    found = re.findall(r"^(install|cloth) (\d+) s$", text, re.MULTILINE)
    if len(found) != 2 or not re.search(r"^(\d+) of \1 runs have the bits", text, re.MULTILINE):
        raise ValueError("not all of it was done")
    return {what: int(seconds) for what, seconds in found}


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if step.startswith("bits of "):
        system = step.removeprefix("bits of ")
        return [(f"scenes run by the wheel for {system} and verified here", f"{figures['scenes']} with equal bits")]
    if step == "Debian 11":
        return [("`pip install` of the wheel on Debian 11, from files", f"{figures['install']} s"),
                ("a cloth from `hooke make` to its page there", f"{figures['cloth'] or 'less than 1'} s")]  # fmt: skip
    return []


def bits(wheel: str, run: str = "") -> str:
    return f"""
there=$WORK/{wheel}
rm -rf $there; mkdir $there
python3 -m zipfile -e build/wheel/*-{wheel}*.whl $there
chmod +x $there/hooke/hooke
for scene in {SCENES}; do
  {run} $there/hooke/hooke run examples/scenes/$scene.json --duration 0.02 --every 0.01 -o $there/$scene.h5 --quiet
  build/wheel/bare/bin/hooke verify $there/$scene.h5 --all --bits
done
"""


# NumPy comes from outside, so that the system inside needs no network.
DEBIAN_11 = """
root=$WORK/root
rm -rf $root
debootstrap --variant=minbase --include=python3-venv bullseye $root http://deb.debian.org/debian
mount -t proc proc $root/proc
trap "umount $root/proc" EXIT
python3 -m pip download --quiet --only-binary :all: --python-version 3.9 --platform manylinux2014_x86_64 --dest $root/wheels numpy
cp build/wheel/*manylinux*_x86_64.whl $root/wheels
mkdir -p $root/hooke/tests $root/hooke/examples
cp -r tests/wheel $root/hooke/tests
cp -r examples/scenes $root/hooke/examples
inside() { chroot $root bash -e -c "$1"; }
inside "python3 -m venv /venv"
SECONDS=0
inside "/venv/bin/pip install --quiet --no-index --find-links /wheels libhooke"
echo install $SECONDS s
SECONDS=0
inside "cd /hooke; . /venv/bin/activate
  hooke make cloth --edges '1,0,0;0,0,1' --size 24x24 --mass 0.5 --pinned top-corners --structural.stiffness 60 -o cloth.json
  hooke run cloth.json --method symplectic-euler --step 5e-4 --duration 1 --every 0.02 -o cloth.h5
  hooke view cloth.h5 -o cloth.html"
test -s $root/hooke/cloth.html
echo cloth $SECONDS s
inside "/venv/bin/python /hooke/tests/wheel/bits.py"
"""

PART = Part(
    "wheels",
    ["qemu-user-static", "libc6-arm64-cross", "musl", "debootstrap"],
    [
        Step("wheel", "make wheel-test", 500),
        Step("wheel for AArch64", "make wheel WHEEL=aarch64-linux-gnu.2.28", 400),
        Step("bits of AArch64", bits("manylinux_2_28_aarch64", "qemu-aarch64-static -L /usr/aarch64-linux-gnu"), 30, verified),
        Step("wheel for musl", "make wheel WHEEL=x86_64-linux-musl", 400),
        Step("bits of musl", bits("musllinux_1_2_x86_64"), 30, verified),
        Step("Debian 11", DEBIAN_11, 120, took),
    ],
    rows,
)
