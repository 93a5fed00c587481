"""hooke beside LAMMPS, OpenMM, Numba and SciPy on the same cloth, in turns; docs/notes/performance.md says how to
read it.

    python bench/peers/run.py [--install] [--library FILE] [--sizes N,...] [--threads N] [--seconds S]
                              [--only fixed,tolerances,stiff] [--slow] [--csv | --markdown]

--install creates the virtual environment build/peers and installs the packages of requirements.txt into it; without
it the existing one is used. Returns 1 if a peer does not compute the same motion.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
ENVIRONMENT = ROOT / "build" / "peers"
PARTS = ("fixed", "tolerances", "stiff")


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--install", action="store_true", help="make build/peers and install the peers there")
    parser.add_argument("--library", default=str(ROOT / "build/release/libhooke.so"), help="libhooke.so to measure")
    parser.add_argument("--sizes", default="32,128,512,1024", help="particles of a side, for fixed steps")
    parser.add_argument("--threads", type=int, default=1, help="of fixed steps")
    parser.add_argument("--seconds", type=float, default=3.0, help="for the turns of each row")
    parser.add_argument("--only", default=",".join(PARTS), help="parts: fixed,tolerances,stiff")
    parser.add_argument("--slow", action="store_true", help="SciPy on the stiff cloth as well, some minutes")
    form = parser.add_mutually_exclusive_group()
    form.add_argument("--csv", dest="form", action="store_const", const="csv", default="text")
    form.add_argument("--markdown", dest="form", action="store_const", const="markdown")
    found = parser.parse_args()
    found.sizes, found.only = [int(size) for size in found.sizes.split(",")], found.only.split(",")
    if not set(found.only) <= set(PARTS):
        parser.error(f"--only takes {', '.join(PARTS)}")
    return found


def enter_environment(install: bool) -> None:
    """Restarts in build/peers, with one thread by default."""
    python = ENVIRONMENT / "bin" / "python"
    if install:
        venv.create(ENVIRONMENT, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r",
                        HERE / "requirements.txt"], check=True)
    if Path(sys.prefix) == ENVIRONMENT:
        return
    if not python.exists():
        sys.exit(f"{ENVIRONMENT} is not there: --install makes it, and installs the peers from their packages")
    words = [word for word in sys.argv[1:] if word != "--install"]
    environment = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", **os.environ, "PYTHONDONTWRITEBYTECODE": "1"}
    os.execve(python, [str(python), str(Path(__file__).resolve()), *words], environment)


def main() -> int:
    wanted = arguments()
    enter_environment(wanted.install)
    os.environ["HOOKE_LIBRARY"] = wanted.library
    sys.path.insert(0, str(Path(wanted.library).resolve().parent / "python"))
    import compare
    from fixed import Different
    from rows import Printer

    printer = Printer(wanted.form)
    try:
        if "fixed" in wanted.only:
            for rows in compare.fixed_steps(wanted.sizes, wanted.threads, wanted.seconds):
                printer.show(rows)
        if "tolerances" in wanted.only:
            for rows in compare.tolerances(wanted.seconds):
                printer.show(rows)
        if "stiff" in wanted.only:
            for rows in compare.stiff(wanted.slow, wanted.seconds):
                printer.show(rows)
    except Different as difference:
        print(difference, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
