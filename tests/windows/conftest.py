"""Programs for Windows, run by wine."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
BUILD = ROOT / "build/windows"
WINE = shutil.which("wine64", path=f"{os.environ['PATH']}:/usr/lib/wine")


@pytest.fixture(scope="session")
def wine(tmp_path_factory):
    """Runs a program of the build for Windows; the result has its output as text. `start`: a running process is returned."""
    if WINE is None or not (BUILD / "states.exe").exists():
        pytest.skip("the build for Windows is not there (`make windows`), or wine is not")
    # Settings of wine are made once, beside the build.
    environment = {**os.environ, "WINEPREFIX": str(BUILD / "wine"), "WINEDEBUG": "-all", "HOME": str(tmp_path_factory.mktemp("home"))}

    def run(program, *words, expect=0, folder=ROOT, start=False):
        command = [WINE, BUILD / program, *map(str, words)]
        if start:
            return subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, encoding="utf-8", timeout=250)
        assert done.returncode == expect, done
        return done

    return run
