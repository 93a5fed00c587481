"""The recipes in packaging/ are of the version of the public header, and well formed."""

import ast
import json
import os
import re
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
VERSION = re.search(r'#define HOOKE_VERSION +"(.+)"', (ROOT / "include/hooke/base.h").read_text()).group(1)


@pytest.mark.parametrize("file, pattern", [
    ("conda-forge/recipe.yaml", r'^  version: "([^"]+)"'),
    ("spack/package.py", r'^    version\("([^"]+)"'),
    ("spack/package.py", r"/v([^/]+)/hooke-\1\.tar\.gz"),
    ("vcpkg/vcpkg.json", r'^  "version": "([^"]+)"'),
    ("homebrew/hooke.rb", r"/v([^/]+)/hooke-\1\.tar\.gz"),
    ("debian/changelog", r"^hooke \(([^-]+)-[^)]*\)"),
    ("../CITATION.cff", r"^version: (.+)"),
])
def test_version(file, pattern):
    assert re.search(pattern, (ROOT / "packaging" / file).read_text(), re.MULTILINE).group(1) == VERSION


def test_changelog():
    assert re.search(r"^## ([0-9.]+)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE).group(1) == VERSION


@pytest.mark.parametrize("file", ["conda-forge/recipe.yaml", "homebrew/hooke.rb", "spack/package.py"])
def test_place_of_the_digest(file):
    """Which `make release` fills."""
    assert len(re.findall(r"\b0{64}\b", (ROOT / "packaging" / file).read_text())) == 1
    assert f'"{file}"' in (ROOT / "packaging/dist.py").read_text()


def test_form():
    json.loads((ROOT / "packaging/vcpkg/vcpkg.json").read_text())
    ast.parse((ROOT / "packaging/spack/package.py").read_text())


def test_options():
    """A recipe that leaves a library out, or asks for it, does so by an option that there is."""
    parts = set(re.search(r"foreach\(part ([a-z0-9 ]+)\)", (ROOT / "CMakeLists.txt").read_text()).group(1).upper().split())
    others = set(re.findall(r"option\(HOOKE_(\w+)", "".join(
        (ROOT / file).read_text() for file in ("CMakeLists.txt", "cmake/missing.cmake"))))
    for file in ("conda-forge/recipe.yaml", "spack/package.py", "homebrew/hooke.rb", "debian/rules", "vcpkg/portfile.cmake"):
        named = set(re.findall(r"-DHOOKE_([A-Z0-9_]+)=", (ROOT / "packaging" / file).read_text()))
        assert named <= parts | others, file
