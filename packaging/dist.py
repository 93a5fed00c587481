"""`make dist`: what a release hands on, in build/dist: the sources of HEAD, made twice with equal bits; a bill of materials
(CycloneDX) of the libraries that this build links; and the checksums of both."""

from __future__ import annotations

import gzip
import hashlib
import subprocess
import uuid
from datetime import datetime, timezone
from pathlib import Path

from cyclonedx.contrib.license.factories import LicenseFactory
from cyclonedx.model.bom import Bom
from cyclonedx.model.component import Component, ComponentType
from cyclonedx.output.json import JsonV1Dot5

import hooke

ROOT = Path(__file__).resolve().parent.parent
LICENCES = {
    "sundials": "BSD-3-Clause",
    "cholmod": "LGPL-2.1-or-later AND GPL-2.0-or-later",
    "lapack": "BSD-3-Clause",
    "gsl": "GPL-3.0-or-later",
    "arpack": "BSD-3-Clause",
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


def main() -> None:
    facts = hooke.build_facts()
    name = f"hooke-{facts['version']}"
    files = {f"{name}.tar.gz": lambda: archive(name), f"{name}.cdx.json": lambda: bill(facts)}
    folder = ROOT / "build/dist"
    folder.mkdir(parents=True, exist_ok=True)
    sums = ""
    for file, make in files.items():
        data = make()
        if make() != data:
            raise SystemExit(f"{file} has other bits when it is made again")
        (folder / file).write_bytes(data)
        sums += f"{hashlib.sha256(data).hexdigest()}  {file}\n"
    (folder / "SHA256SUMS").write_text(sums)
    print(sums, end="")


main()
