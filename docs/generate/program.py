"""Writes the reference of the command line from the output of `--help`."""

from __future__ import annotations

import re
import subprocess

INTRO = """# Command-line reference

What `hooke --help` and `hooke VERB --help all` print. [The command line](../command-line.md) explains results, exit codes and
JSON.

```console
$ hooke --version
```"""


def printed(program: str, *words: str) -> str:
    return subprocess.run([program, *words], check=True, capture_output=True, text=True).stdout.rstrip()


def page(program: str) -> str:
    general = printed(program, "--help")
    verbs = re.findall(r"^  ([\w-]+) ", general.split("verbs:\n")[1].split("\n\n")[0], re.MULTILINE)
    pieces = [INTRO, f"```text\n{general}\n```"]
    for verb in verbs:
        pieces += [f"## hooke {verb}", f"```text\n{printed(program, verb, '--help', 'all')}\n```"]
    return "\n\n".join(pieces) + "\n"
