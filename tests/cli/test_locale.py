"""Output of the program does not depend on the locale, such as one with a decimal comma; nor does that of the package
in a program that has set that locale."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

HOOKE = os.environ["HOOKE_CLI"]
SCENE = Path(os.environ["HOOKE_SOURCE_DIR"]) / "examples/scenes/six-particles.json"
COMMA = 'LC_NUMERIC\ndecimal_point ","\nthousands_sep "."\ngrouping 3;3\nEND LC_NUMERIC\n'

pytestmark = pytest.mark.skipif(shutil.which("localedef") is None, reason="there is no localedef to make a locale with a comma")


@pytest.fixture(scope="module")
def comma(tmp_path_factory):
    folder = tmp_path_factory.mktemp("locale")
    (folder / "comma").write_text(COMMA)
    subprocess.run(["localedef", "-c", "-i", folder / "comma", "-f", "UTF-8", folder / "comma.UTF-8"], capture_output=True)
    if not (folder / "comma.UTF-8").exists():
        pytest.skip("localedef has no charmap UTF-8 (Debian: package locales)")
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("LC_", "LANG"))}
    # glibc leaks a few bytes in newlocale() if LOCPATH is set, and a library of HDF5 calls it when loaded
    return environment | {"LOCPATH": str(folder), "LC_NUMERIC": "comma.UTF-8", "ASAN_OPTIONS": "detect_leaks=0"}


def test_the_locale_has_a_comma(comma):
    code = "import ctypes, locale\nlocale.setlocale(locale.LC_ALL, '')\ntext = ctypes.create_string_buffer(9)\n" \
           "ctypes.CDLL(None).snprintf(text, 9, b'%.1f', ctypes.c_double(0.5))\nprint(text.value.decode())"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=comma).stdout == "0,5\n"


@pytest.mark.parametrize("arguments", [["limit", SCENE, "--json", "--predict"],
                                       ["run", SCENE, "--step", "-0.5"], ["run", "--help"]])
def test_program(arguments, comma):
    plain = {k: v for k, v in comma.items() if k not in ("LOCPATH", "LC_NUMERIC")}
    found, expected = (subprocess.run([HOOKE, *arguments], capture_output=True, text=True, env=e) for e in (comma, plain))
    assert (found.returncode, found.stdout, found.stderr) == (expected.returncode, expected.stdout, expected.stderr)
    assert found.stdout or found.stderr


@pytest.mark.skipif("fsanitize" in Path(os.environ["HOOKE_BUILD_DIR"], "CMakeCache.txt").read_text(),
                    reason="a sanitized library does not load into Python")
@pytest.mark.everything
def test_package(comma):
    code = ("import locale\nlocale.setlocale(locale.LC_ALL, '')\nimport hooke\n"
            f"scene = hooke.Scene.load({str(SCENE)!r})\nprint(scene.system.state().q.tolist())\n"
            "try:\n    hooke.Integrator(scene.system, method='verlet', step=-0.5)\n"
            "except hooke.Error as error:\n    print(error)\n")
    texts = []
    for environment in (comma, {k: v for k, v in comma.items() if k not in ("LOCPATH", "LC_NUMERIC")}):
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, env=environment)
        assert done.returncode == 0, done.stderr
        texts.append(done.stdout)
    assert texts[0] == texts[1]
    assert re.search(r"-0\.5", texts[0])
