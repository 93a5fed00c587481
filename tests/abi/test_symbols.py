"""Exported symbols: the shared library has those declared in the headers; the static one has no global name outside hooke_
and hk_."""

import os
import re
import subprocess
from pathlib import Path

import headers
import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
ABI = int(re.search(r"#define HOOKE_ABI +(\d+)", (ROOT / "include/hooke/base.h").read_text()).group(1))


def nm(*arguments):
    command = [os.environ["HOOKE_NM"], "--defined-only", *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def exported(text):
    """(name, version) of each symbol in the output of nm -D, without the version's own node."""
    for line in text.splitlines():
        kind, _, name = line[17:].partition(" ")
        if kind != "A":
            base, _, version = name.partition("@")
            yield base, version.strip("@")


def strangers(text):
    """Global names in the output of nm -g that start neither with hooke_ nor with hk_."""
    names = re.findall(r"^[0-9a-f]{8,} [A-Z] (\S+)$", text, flags=re.MULTILINE)
    return sorted({n for n in names if not n.startswith(("hooke_", "hk_"))})


def differences(have, want, what):
    return [f"+ {n}: not in {what}" for n in sorted(have - want)] + [f"- {n}: missing" for n in sorted(want - have)]


def declared():
    return {n for p in (ROOT / "include").rglob("*.h") for n in headers.functions(p.read_text())}


def test_shared_library():
    symbols = list(exported(nm("-D", os.environ["HOOKE_LIBRARY"])))
    found = differences({n for n, _ in symbols}, declared(), "the headers")
    assert not found, "libhooke.so against the headers:\n" + "\n".join(found)
    assert {v for _, v in symbols} == {f"HOOKE_{ABI}"}


def test_soname():
    real = Path(os.environ["HOOKE_LIBRARY"]).resolve()
    assert (real.parent / f"libhooke.so.{ABI}").resolve() == real


def test_static_library():
    text = nm("-g", os.environ["HOOKE_STATIC_LIBRARY"])
    assert " T hooke_version\n" in text
    assert strangers(text) == []


def build(tmp_path, text):
    source, library = tmp_path / "bad.c", tmp_path / "libbad.so"
    source.write_text(text)
    subprocess.run([os.environ["HOOKE_CC"], "-shared", "-fPIC", source, "-o", library], check=True)
    return library


def test_planted_symbol(tmp_path):
    library = build(tmp_path, "int hooke_version(void) { return 1; }\nint hooke_inside(void) { return 2; }\n")
    symbols = set(exported(nm("-D", str(library))))
    assert symbols == {("hooke_version", ""), ("hooke_inside", "")}
    found = differences({n for n, _ in symbols}, {"hooke_version", "hooke_gone"}, "the list")
    assert found == ["+ hooke_inside: not in the list", "- hooke_gone: missing"]


def test_planted_stranger(tmp_path):
    library = build(tmp_path, "int hooke_a(void) { return 1; }\nint allocate(void) { return 2; }\nint counter = 3;\n")
    assert {"allocate", "counter"} <= set(strangers(nm("-g", str(library))))


@pytest.mark.parametrize("text, names", [("HOOKE_API int32_t hooke_a(void);", {"hooke_a"}),
                                         ("int32_t hooke_a(void);", set()),
                                         ("HOOKE_API const char *hooke_a(void);\n/* HOOKE_API int hooke_b(void); */",
                                          {"hooke_a"})])
def test_reading_of_headers(text, names):
    assert headers.functions(text) == names
