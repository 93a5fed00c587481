"""The wheels: made, used in an empty environment and on an older system, and the bits of the one for AArch64."""

from __future__ import annotations

import re
from typing import Any

from steps import Part, Step

AARCH64 = "aarch64-linux-gnu.2.28"
SCENES = "cloth-16 cloth-gentle curl drag-or-damping lattice mesh oscillator rope six-particles stiff-spring"


def verified(text: str) -> dict[str, Any]:
    """Number of runs on AArch64 that this machine repeated to the bit."""
    same = len(re.findall(r"reproduces", text))
    if same != len(SCENES.split()):
        raise ValueError(f"{same} of {len(SCENES.split())} runs have the same bits")
    return {"scenes": same}


def took(text: str) -> dict[str, Any]:
    found = re.findall(r"^(\S+) (\d+) s$", text, re.MULTILINE)
    if [what for what, _ in found] != ["install", "cloth"]:
        raise ValueError("not all of it was done")
    return {what: int(seconds) for what, seconds in found}


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if step == "bits of AArch64":
        return [("scenes run by the wheel for AArch64 and verified here", f"{figures['scenes']} with equal bits")]
    if step == "Debian 11":
        return [("`pip install` of the wheel on Debian 11, from files", f"{figures['install']} s"),
                ("a cloth from `hooke make` to its page there", f"{figures['cloth']} s")]  # fmt: skip
    return []


BITS = f"""
rm -rf $WORK/there; mkdir $WORK/there; cd $WORK/there
python3 -m zipfile -e ../../../wheel/*manylinux*_aarch64.whl .
for scene in {SCENES}; do
  qemu-aarch64-static -L /usr/aarch64-linux-gnu ./hooke/hooke run ../../../../examples/scenes/$scene.json --duration 0.02 \\
    -o $scene.h5 --quiet
  ../../../wheel/bare/bin/hooke verify $scene.h5
done
"""

# NumPy comes from outside, so that the system inside needs no network.
DEBIAN_11 = """
rm -rf $WORK/root $WORK/wheels
debootstrap --variant=minbase --include=python3-venv bullseye $WORK/root http://deb.debian.org/debian
python3 -m pip download --quiet --only-binary :all: --python-version 3.9 --platform manylinux2014_x86_64 \\
  --dest $WORK/root/wheels build/wheel/*manylinux*_x86_64.whl
inside() { chroot $WORK/root bash -e -c "$1"; }
inside "python3 -m venv /venv"
SECONDS=0; inside "/venv/bin/pip install --quiet --no-index --find-links /wheels libhooke"; echo install $SECONDS s
SECONDS=0
inside "cd /root; . /venv/bin/activate; hooke make cloth --edges 1,0,0,0,0,1 --size 24,24 --mass 0.5 --structural.stiffness 60 \\
  --pinned top-corners >cloth.json; hooke run cloth.json --step 1e-3 --duration 1 --every 0.02 -o cloth.h5; hooke view cloth.h5"
test -s $WORK/root/root/cloth.html; echo cloth $SECONDS s
"""

PART = Part(
    "wheels",
    ["qemu-user-static", "libc6-arm64-cross", "debootstrap"],
    [
        Step("wheel", "make wheel-test", 500),
        Step("wheel for AArch64", f"make wheel WHEEL={AARCH64}", 400),
        Step("bits of AArch64", BITS, 30, verified),
        Step("Debian 11", DEBIAN_11, 120, took),
    ],
    rows,
)
