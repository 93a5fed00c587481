"""`make dist`: the sources of HEAD, made twice with equal bits; a bill of materials (CycloneDX) of the libraries that this
build links; and the digests of both, in build/dist. `make release`, with --whole: besides, the wheels of build/wheel, the
Debian packages, built from those sources, and the recipes with the digest of the sources in them."""

from __future__ import annotations

import gzip
import hashlib
import os
import re
import shutil
import subprocess
import sys
import uuid
from datetime import datetime, timezone
from pathlib import Path

from cyclonedx.contrib.license.factories import LicenseFactory
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.output.json import JsonV1Dot5

import hooke

ROOT = Path(__file__).resolve().parent.parent
DIST = ROOT / "build/dist"
RECIPES = ("conda-forge/recipe.yaml", "homebrew/hooke.rb", "spack/package.py")
LICENCES = {
    "sundials": "BSD-3-Clause",
    "cholmod": "LGPL-2.1-or-later AND GPL-2.0-or-later",
    "lapack": "BSD-3-Clause",
    "gsl": "GPL-3.0-or-later",
    "hdf5": "BSD-3-Clause",
    "chartjs": "MIT",
    "threejs": "MIT",
}


def git(*words: str) -> bytes:
    return subprocess.run(["git", "-C", ROOT, *words], check=True, capture_output=True).stdout


def archive(name: str) -> bytes:
    return gzip.compress(git("archive", "--format=tar", f"--prefix={name}/", "HEAD"), mtime=0)


def component(name: str, version: str, licence: str, kind: ComponentType = ComponentType.LIBRARY) -> Component:
    return Component(name=name, version=version, type=kind, bom_ref=f"{name}@{version}",
                     licenses=[LicenseFactory().make_from_string(licence)])


def bill(facts: dict[str, str]) -> bytes:
    """The time and the serial number are those of the commit, so that the same commit has the same bill."""
    whole = component("hooke", facts["version"], "MIT")
    parts = [component(name, facts[name], licence) for name, licence in LICENCES.items() if facts[name]]
    bom = Bom(components=parts, serial_number=uuid.uuid5(uuid.NAMESPACE_OID, git("rev-parse", "HEAD").decode()))
    bom.metadata.component = whole
    bom.metadata.timestamp = datetime.fromtimestamp(int(git("log", "-1", "--format=%ct")), timezone.utc)
    bom.register_dependency(whole, parts)
    return (JsonV1Dot5(bom).output_as_string(indent=2) + "\n").encode()


def twice(name: str) -> None:
    """Writes a file that comes out with equal bits when it is made again."""
    facts = hooke.build_facts()
    data, again = (archive(f"hooke-{facts['version']}") if name.endswith(".tar.gz") else bill(facts) for _ in range(2))
    if data != again:
        raise SystemExit(f"{name} has other bits when it is made again")
    (DIST / name).write_bytes(data)


def digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()


def debian(sources: Path) -> list[Path]:
    """The packages, from the sources with the folder `debian` that they bring along."""
    work = DIST / "debian"
    shutil.rmtree(work, ignore_errors=True)
    shutil.unpack_archive(sources, work)
    tree = next(work.iterdir())
    shutil.copytree(tree / "packaging/debian", tree / "debian")
    options = {"DEB_BUILD_OPTIONS": f"noautodbgsym parallel={os.cpu_count()}"}
    subprocess.run(["dpkg-buildpackage", "--build=binary", "--no-sign"], cwd=tree, env=os.environ | options, check=True)
    return sorted(work.glob("*.deb"))


def recipe(name: str, sources: Path) -> None:
    text, places = re.subn(r"\b0{64}\b", digest(sources), (ROOT / "packaging" / name).read_text())
    if places != 1:
        raise SystemExit(f"packaging/{name} has {places} places for the digest of the sources")
    (DIST / name).parent.mkdir(exist_ok=True)
    (DIST / name).write_text(text)


def main(whole: bool) -> None:
    name = f"hooke-{hooke.build_facts()['version']}"
    files = [f"{name}.tar.gz", f"{name}.cdx.json"]
    DIST.mkdir(parents=True, exist_ok=True)
    for file in files:
        twice(file)
    if whole:
        sources = DIST / files[0]
        for made in (*sorted((ROOT / "build/wheel").glob("libhooke-*")), *debian(sources)):
            files.append(shutil.copy(made, DIST / made.name).name)
        for file in RECIPES:
            recipe(file, sources)
        files += RECIPES
    sums = "".join(f"{digest(DIST / file)}  {file}\n" for file in files)
    (DIST / "SHA256SUMS").write_text(sums)
    print(sums, end="")


main("--whole" in sys.argv)
