"""The code in a Markdown document: finds the fenced blocks and runs them."""

import multiprocessing
import os
import re
import shlex
import subprocess
import sys
import traceback
from pathlib import Path

import outputs

WORDS = {"prototypes", "loky", "distributed", "mpi4py", "ray"}
NOT_RUN = {"text", "json"}
KINDS = {"c", "fortran", "python", "console", "sh"} | NOT_RUN


class Block:
    """`word` is the word after the kind in the fence: for C and Python "prototypes", declarations that are not run, or a
    package of others, that test_many.py runs it with."""

    def __init__(self, document, line, kind, text, word=""):
        self.document, self.line, self.kind, self.text, self.word = document, line, kind, text, word

    def __str__(self):
        return f"{self.document}:{self.line} ({self.kind})"


def blocks(document, text):
    """All fenced blocks; one that is never closed is an error."""
    found, start, kind, lines = [], None, None, []
    for number, line in enumerate(text.splitlines(), 1):
        fence = re.match(r"\s*```+\s*(\S*)\s*(.*)", line)
        if fence and start is None:
            start, (kind, word), lines = number, fence.groups(), []
        elif fence:
            found.append(Block(document, start, kind, "\n".join(lines) + "\n", word))
            start = None
        elif start is not None:
            lines.append(line)
    if start is not None:
        raise ValueError(f"{document}:{start}: the block is not closed")
    return found


COMMAND = re.compile(r"(hooke .*?)(?:\s+#\s*(?:exit (\d+)|.*))?")


def conversations(text):
    """(command, exit code, shown output) of each line that calls hooke; a trailing "# exit 4" states a code other than
    0. If some lines have a prompt, those without are output."""
    text = re.sub(r"\\\n\s*", " ", text)
    prompts = re.search(r"^\$ ", text, re.MULTILINE)
    for piece in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:] if prompts else text.splitlines():
        line, _, shown = piece.partition("\n")
        match = COMMAND.fullmatch(line.strip())
        if match:
            yield match[1], int(match[2] or 0), shown


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
    """In a copy of this process, with the packages imported already: most blocks take less time than the imports."""
    import h5py  # noqa: F401
    import matplotlib.pyplot  # noqa: F401
    import numpy  # noqa: F401

    import hooke.plot  # noqa: F401

    output = folder / "output.txt"
    child = multiprocessing.get_context("fork").Process(target=in_python, args=(block.text, str(block), folder, output))
    child.start()
    child.join(240)
    if child.is_alive():
        child.kill()
        return f"{block} is not at its end after 240 s"
    return f"{block} ended with {child.exitcode}\n{output.read_text()}" if child.exitcode else None


def in_python(text, name, folder, output):
    os.chdir(folder)
    with open(output, "w") as file:
        os.dup2(file.fileno(), 1)
        os.dup2(file.fileno(), 2)
    try:
        exec(compile(text, name, "exec"), {"__name__": "__main__"})
    except BaseException:
        traceback.print_exc()
        raise SystemExit(1) from None
    finally:
        sys.stdout.flush()
        sys.stderr.flush()


def run_command(command, folder):
    words = shlex.split(command)
    if any(w in ("|", ">", ">>", "<", "&&", ";") for w in words):
        path = f"{Path(os.environ['HOOKE_CLI']).parent}:{os.environ['PATH']}"
        return execute(["bash", "-o", "pipefail", "-c", command], folder, env=os.environ | {"PATH": path})
    return execute([os.environ["HOOKE_CLI"], *words[1:]], folder)


def run_console(block, folder):
    """Runs the commands; where output is shown it is compared, that of standard error included."""
    for command, code, shown in conversations(block.text):
        result = run_command(command, folder)
        if result.returncode != code or (shown.strip() and not outputs.same(shown, result.stdout + result.stderr)):
            return report(f"{block}: {command}\nshown:\n{shown}", result)
    return None


RUN = {"c": run_c, "fortran": run_fortran, "python": run_python, "console": run_console, "sh": run_console}


def runs(block):
    """Whether any part of the block is run."""
    if block.word in WORDS:
        return False
    if block.kind in ("console", "sh"):
        return any(True for _ in conversations(block.text))
    return block.kind in RUN


def complaint(block, folder):
    """The fault of a block when it runs in `folder`; None if there is none."""
    if block.kind not in KINDS:
        return f"{block}: mark it as one of {', '.join(sorted(KINDS))}"
    if block.word and block.word not in WORDS:
        return f"{block}: there is no word {block.word!r} for a fence"
    return RUN[block.kind](block, folder) if runs(block) else None
