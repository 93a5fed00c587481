"""Runs clang-tidy with the settings of .clang-tidy over src, cli, bench and examples/c, and prints its findings.

`python cmake/tidy.py build/tidy [name ...]`, where build/tidy is configured with CMAKE_EXPORT_COMPILE_COMMANDS, looks at the
files whose paths contain one of the names, or at all.
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("src", "cli", "bench")


def commands(build):
    """One command a file, its last: a loop that is compiled for several instruction sets is checked for the widest."""
    found = {}
    for entry in json.loads((build / "compile_commands.json").read_text()):
        path = Path(entry["file"])
        if path.suffix == ".c" and path.relative_to(ROOT).parts[0] in FOLDERS:
            found[path] = entry
    for path in (ROOT / "examples/c").glob("*.c"):
        found[path] = {"directory": str(ROOT), "file": str(path), "command": f"cc -std=c17 -I{ROOT}/include -c {path}"}
    return list(found.values())


def main(build, *names):
    build = Path(build).resolve()
    looked_at = [entry for entry in commands(build) if not names or any(name in entry["file"] for name in names)]
    if not looked_at:
        sys.exit("no source has such a path")
    database = build / "once"
    database.mkdir(exist_ok=True)
    (database / "compile_commands.json").write_text(json.dumps(looked_at))
    tool = ["run-clang-tidy-14", "-quiet", f"-j{os.cpu_count()}", "-p", database]
    ran = subprocess.run(tool, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    for line in re.sub(r"\x1b\[[0-9;]*m", "", ran.stdout).splitlines():
        if line and not re.match(r"clang-tidy-14 |\d+ warnings?.* generated|Suppressed |Use -", line):
            print(line)
    print(f"{len(looked_at)} files: {'clean' if ran.returncode == 0 else 'findings'}")
    return ran.returncode


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
