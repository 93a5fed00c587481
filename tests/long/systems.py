"""From nothing to tested: `make`, `make test` and `make check` in bare roots of Debian and Ubuntu with git, make and Python alone, as
root, and then as a user who may install nothing."""

from __future__ import annotations

import re
from typing import Any

from steps import ROOT, Part, Step

DEBIAN, UBUNTU = "http://deb.debian.org/debian", "http://archive.ubuntu.com/ubuntu"
# Scripts of debootstrap: those of all versions of Ubuntu are one.
ROOTS = {"Debian 12": ("bookworm", DEBIAN, "sid"), "Debian 13": ("trixie", DEBIAN, "sid"),
         "Ubuntu 24.04": ("noble", UBUNTU, "gutsy")}  # fmt: skip

# Networks with certificates of their own: those of this machine are taken along. A mirror that cannot be reached is no
# failure.
BEGIN = """
root=$WORK/{suite}
certificates=/etc/ssl/certs/ca-certificates.crt
python3 -c 'import urllib.request as u; u.urlopen("{mirror}/dists/{suite}/Release", timeout=30)' || {{ echo not tried; exit; }}
"""
MAKE = BEGIN + """
rm -rf $root
debootstrap --variant=minbase --include=git,make,python3{more} {suite} $root {mirror} \\
  /usr/share/debootstrap/scripts/{script}
[ ! -e $certificates ] || cp $certificates $root/certificates
mount -t proc proc $root/proc
trap "umount $root/proc" EXIT
git clone --quiet . $root/hooke
inside() {{ chroot $root env PIP_CERT=/certificates bash -e -c "$1"; }}
SECONDS=0
inside "cd /hooke && make"
echo took make $SECONDS s
SECONDS=0
inside "cd /hooke && make test check"
echo took test $SECONDS s
"""
USER = BEGIN + """
mount -t proc proc $root/proc
trap "umount $root/proc" EXIT
chroot $root useradd --create-home someone
git clone --quiet . $root/home/someone/hooke
chroot $root chown -R someone /home/someone
inside() {{ chroot $root su someone -c "cd && cd hooke && env PIP_CERT=/certificates $1"; }}
SECONDS=0
inside "make"
echo took make $SECONDS s
SECONDS=0
inside "make test check"
echo took test $SECONDS s
"""


def took(text: str) -> dict[str, Any]:
    if text.rstrip().endswith("not tried"):
        return {}
    times = {what: int(seconds) for what, seconds in re.findall(r"^took (make|test) (\d+) s$", text, re.MULTILINE)}
    if times.keys() != {"make", "test"}:
        raise ValueError("not all of it was done")
    sundials = re.findall(r"^-- sundials ([0-9.]+): used$", text, re.MULTILINE)
    return times | {"sundials": sundials[0] if sundials else "none"}


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if not figures:
        return [(step, "not tried: its mirror was not reached")]
    return [(step, f"`make` {figures['make'] / 60:.0f} min, `make test check` {figures['test'] / 60:.0f} min, "
                   f"SUNDIALS {figures['sundials']}")]  # fmt: skip


def steps(name: str) -> list[Step]:
    suite, mirror, script = ROOTS[name]
    words = {"suite": suite, "mirror": mirror, "script": script,
             "more": " --no-check-gpg --components=main,universe" if mirror == UBUNTU else ""}  # fmt: skip
    return [Step(name, MAKE.format(**words), 1400, took),
            Step(f"{name}, as a user", USER.format(**words), 1200, took)]  # fmt: skip


PART = Part("systems", ["debootstrap"], [step for name in ROOTS for step in steps(name)], rows,
            page=ROOT / "docs/compatibility.md")
