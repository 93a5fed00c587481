"""From nothing to tested: `make` and the tests in bare roots of Debian and Ubuntu with git, make and Python alone, as root,
and then as a user who may install nothing."""

from __future__ import annotations

import re
from typing import Any

from steps import ROOT, Part, Step

DEBIAN = "http://deb.debian.org/debian sid"
UBUNTU = "http://archive.ubuntu.com/ubuntu gutsy --no-check-gpg --components=main,universe"
# The suite, the mirror, the script of debootstrap (those of all versions of Ubuntu are one) and its options.
ROOTS = {"Debian 13": f"trixie {DEBIAN}", "Ubuntu 24.04": f"noble {UBUNTU}", "Debian 12": f"bookworm {DEBIAN}"}

# Networks with certificates of their own: those of this machine are taken along, and nothing else of its environment. A
# mirror that cannot be reached is no failure.
BEGIN = """
set -- {words}
suite=$1 mirror=$2 script=$3
shift 3
root=$WORK/$suite
certificates=/etc/ssl/certs/ca-certificates.crt
python3 -c 'import sys, urllib.request as u; u.urlopen(sys.argv[1], timeout=30)' $mirror/dists/$suite/Release \\
  || {{ echo not tried; exit; }}
"""
NEW = """
rm -rf $root
debootstrap --variant=minbase --include=git,make,python3 "$@" $suite $root $mirror /usr/share/debootstrap/scripts/$script
[ ! -e $certificates ] || cp $certificates $root/certificates
git clone --quiet . $root/hooke
folder=/hooke someone=root
"""
USER = """
someone=someone folder=/home/someone/hooke
[ -d $root/home/someone ] || chroot $root useradd --create-home someone
rm -rf $root$folder
git clone --quiet . $root$folder
chroot $root chown -R someone /home/someone
"""
SAME = "folder=/hooke someone=root\n"
INSIDE = """
mount -t proc proc $root/proc
trap "umount $root/proc" EXIT
timed() {
  SECONDS=0
  chroot $root env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin PIP_CERT=/certificates su $someone -c "cd $folder && $2"
  echo took $1 $SECONDS s
}
"""
TESTED = """
timed make make
timed tests "make test"
chroot $root sh -c "gcc --version; cmake --version; python3 --version"
"""
REST = "timed rest \"make check\""
VERSIONS = {"SUNDIALS": r"-- sundials ([0-9.]+): used", "gcc": r"gcc \(.*\) ([0-9.]+)", "CMake": "cmake version ([0-9.]+)",
            "Python": "Python ([0-9.]+)"}  # fmt: skip


def took(text: str) -> dict[str, Any]:
    """Seconds of what was timed, and the versions of what it was timed with."""
    if text.rstrip().endswith("not tried"):
        return {}
    found = {name: re.findall(f"^{version}$", text, re.MULTILINE) for name, version in VERSIONS.items()}
    return {what: int(seconds) for what, seconds in re.findall(r"^took (\w+) (\d+) s$", text, re.MULTILINE)} | {
        "with": {name: versions[-1] for name, versions in found.items() if versions}}  # fmt: skip


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if not figures:
        return [(step, "not tried: its mirror was not reached")]
    names = {"make": "`make`", "tests": "`make test`", "rest": "`make check`"}
    times = [f"{name} {figures[key] / 60:.0f} min" for key, name in names.items() if key in figures]
    return [(step, ", ".join(times + [f"{name} {version}" for name, version in figures["with"].items()]))]


def steps(name: str) -> list[Step]:
    begin = BEGIN.format(words=ROOTS[name])
    return [Step(name, begin + NEW + INSIDE + TESTED, 1100, took),
            Step(f"{name}, as a user", begin + USER + INSIDE + TESTED, 900, took),
            Step(f"{name}, other presets", begin + SAME + INSIDE + REST, 900, took)]  # fmt: skip


PART = Part("systems", ["debootstrap"], [step for name in ROOTS for step in steps(name)], rows,
            page=ROOT / "docs/compatibility.md")
