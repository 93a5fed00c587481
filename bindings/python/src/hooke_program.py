"""Starts the program that the package `hooke` holds. It stands beside the package, since importing that takes longer than
many commands do."""

from __future__ import annotations

import importlib.util
import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import NoReturn


def find() -> str:
    """The path of the program."""
    name = "hooke.exe" if sys.platform == "win32" else "hooke"
    spec = importlib.util.find_spec("hooke")
    folders = (spec and spec.submodule_search_locations) or []
    paths = [path for folder in folders if (path := Path(folder) / name).is_file()]
    if not paths:
        sys.exit(f"hooke: there is no program {name} in {', '.join(folders)}; install this package again")
    return str(paths[0])


def main() -> NoReturn:
    """Runs the program with the arguments of this process, in its place where the system can do that."""
    command = [find(), *sys.argv[1:]]
    if sys.platform == "win32":
        signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the program's
        sys.exit(subprocess.call(command))
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # which Python ignores
    os.execv(command[0], command)
