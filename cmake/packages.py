"""Installs the packages of packages.txt that are missing, with apt-get, as root or through sudo.

python3 cmake/packages.py build small use   # the rows with these words in the column `to`
python3 cmake/packages.py --names clang f2c # packages by their names in Debian; --foreign arm64 adds an architecture

Without the rows `build` this ends with 1. Without others hooke is built and lacks what the last column names, so that
is said and this ends with 0; with --all it ends with 1, too, where apt has them: CMake says whether the tests can do
without the rest. Where there is no apt-get, only the tools are looked for."""

import argparse
import os
import shutil
import subprocess
import sys
from pathlib import Path

TABLE = Path(__file__).with_name("packages.txt")
TOOLS = ("cc", "cmake", "ninja")


def rows():
    return [line.split(maxsplit=7) for line in TABLE.read_text().splitlines()[1:]]


def is_installed(package):
    query = subprocess.run(["dpkg-query", "-W", "-f=${Status}", package], capture_output=True, text=True)
    return query.stdout.endswith(" installed")


def is_offered(package):
    """Whether apt has a version of it to install, as far as it knows: a new system has no lists yet."""
    if not any(Path("/var/lib/apt/lists").glob("*Packages*")):
        return True
    policy = subprocess.run(["apt-cache", "policy", package], capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    return "Candidate:" in policy.stdout and "Candidate: (none)" not in policy.stdout


def as_root(*command):
    prefix = [] if os.geteuid() == 0 else ["sudo"]
    if prefix and not shutil.which("sudo"):
        return False
    return subprocess.run([*prefix, "env", "DEBIAN_FRONTEND=noninteractive", *command]).returncode == 0


def install(packages, foreign):
    """Installs what apt has of these; False if it could not."""
    if foreign:
        as_root("dpkg", "--add-architecture", foreign)
    as_root("apt-get", "update")
    offered = list(filter(is_offered, packages))
    return not offered or as_root("apt-get", "install", "--yes", "--no-install-recommends", *offered)


def say_lacking(packages, foreign):
    first = f"dpkg --add-architecture {foreign}; apt-get update" if foreign else "apt-get update"
    offered = " ".join(filter(is_offered, packages))
    print("Debian packages are missing." + (f" As root:\n\n  {first}; apt-get install {offered}\n" if offered else ""))
    for package in packages:
        lost = next((row[7] for row in rows() if row[1] == package), "-")
        print(f"{package}: {'apt does not have it; ' if not is_offered(package) else ''}"
              + ("needed" if lost == "-" else f"without it there are no {lost}"))


def look_for_tools():
    missing = [name for name in TOOLS if not shutil.which(name)]
    if missing:
        print(f"{missing[0]} is missing, and there is no apt-get to install it. These packages have what hooke is built with\n"
              "(build), what it can do without (small, use) and what its tests need besides (test):\n\n" + TABLE.read_text())
    return 1 if missing else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("words", nargs="+")
    parser.add_argument("--names", action="store_true")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--foreign")
    arguments = parser.parse_args()
    if not shutil.which("apt-get"):
        return look_for_tools()
    wanted = arguments.words if arguments.names else [row[1] for row in rows() if row[6] in arguments.words]
    missing = [package for package in wanted if not is_installed(package)]
    if missing and install(missing, arguments.foreign):
        missing = [package for package in missing if not is_installed(package)]
    if missing:
        say_lacking(missing, arguments.foreign)
    needed = wanted if arguments.names else [row[1] for row in rows() if row[6] == "build"]
    return 1 if any(package in needed or (arguments.all and is_offered(package)) for package in missing) else 0


if __name__ == "__main__":
    sys.exit(main())
