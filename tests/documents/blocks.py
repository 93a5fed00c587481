"""The code in a Markdown document: finds the fenced blocks and runs them."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

NOT_RUN = {"text", "json"}
KINDS = {"c", "fortran", "python", "console", "sh"} | NOT_RUN


class Block:
    def __init__(self, document, line, kind, text):
        self.document, self.line, self.kind, self.text = document, line, kind, text

    def __str__(self):
        return f"{self.document}:{self.line} ({self.kind})"


def blocks(document, text):
    """All fenced blocks; one that is never closed is an error."""
    found, start, kind, lines = [], None, None, []
    for number, line in enumerate(text.splitlines(), 1):
        fence = re.match(r"\s*```+\s*(\S*)", line)
        if fence and start is None:
            start, kind, lines = number, fence.group(1), []
        elif fence:
            found.append(Block(document, start, kind, "\n".join(lines) + "\n"))
            start = None
        elif start is not None:
            lines.append(line)
    if start is not None:
        raise ValueError(f"{document}:{start}: the block is not closed")
    return found


def commands(text):
    """(command, exit code) of each line that calls hooke; a trailing "# exit 4" states a code other than 0. Where some
    lines have a prompt, those without are output."""
    lines = re.sub(r"\\\n\s*", " ", text).splitlines()
    prompt = r"\$ " if any(line.startswith("$ ") for line in lines) else ""
    for line in lines:
        match = re.fullmatch(rf"{prompt}(hooke .*?)(?:\s+#\s*(?:exit (\d+)|.*))?", line.strip())
        if match:
            yield match.group(1), int(match.group(2) or 0)


def execute(command, folder, **more):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240, **more)


def report(where, result):
    return f"{where} ended with {result.returncode}\n{result.stdout}{result.stderr}"


def run_c(block, folder):
    if not re.search(r"\bmain\s*\(", block.text):
        return f"{block} is not a whole program; mark it ```text if it is not meant to run"
    library = Path(os.environ["HOOKE_LIBRARY"]).parent
    source, program = folder / "block.c", folder / "block"
    source.write_text(block.text)
    command = [os.environ["HOOKE_CC"], "-std=c17", "-Wall", "-Wextra", "-Werror", "-D_XOPEN_SOURCE=700", source,
               "-I" + os.environ["HOOKE_SOURCE_DIR"] + "/include", f"-L{library}", f"-Wl,-rpath,{library}",
               "-lhooke", "-lm", "-o", program]
    result = execute(command, folder)
    if result.returncode == 0:
        result = execute([program], folder)
    return report(block, result) if result.returncode else None


def run_fortran(block, folder):
    if not os.environ["HOOKE_FORTRAN"]:
        return None
    library, module = Path(os.environ["HOOKE_LIBRARY"]).parent, Path(os.environ["HOOKE_FORTRAN_LIBRARY"])
    source, program = folder / "block.f90", folder / "block"
    source.write_text(block.text)
    command = [os.environ["HOOKE_FORTRAN"], "-I" + os.environ["HOOKE_FORTRAN_MODULES"], source, module, f"-L{library}",
               f"-Wl,-rpath,{library}", "-lhooke", "-o", program]
    result = execute(command, folder)
    if result.returncode == 0:
        result = execute([program], folder)
    return report(block, result) if result.returncode else None


def run_python(block, folder):
    result = execute([sys.executable, "-"], folder, input=block.text)
    return report(block, result) if result.returncode else None


def run_console(block, folder):
    for command, code in commands(block.text):
        words = shlex.split(command)
        shell = any(w in ("|", ">", ">>", "&&", ";") for w in words)
        if shell:
            path = f"{Path(os.environ['HOOKE_CLI']).parent}:{os.environ['PATH']}"
            result = execute(["bash", "-o", "pipefail", "-c", command], folder, env=os.environ | {"PATH": path})
        else:
            result = execute([os.environ["HOOKE_CLI"], *words[1:]], folder)
        if result.returncode != code:
            return report(f"{block}: {command}", result)
    return None


RUN = {"c": run_c, "fortran": run_fortran, "python": run_python, "console": run_console, "sh": run_console}


def complaint(block, folder):
    """What is wrong with a block when it runs in `folder`; None if nothing is."""
    if block.kind not in KINDS:
        return f"{block}: mark it as one of {', '.join(sorted(KINDS))}"
    return RUN[block.kind](block, folder) if block.kind in RUN else None
