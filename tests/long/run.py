"""What `make test-long` runs: python tests/long/run.py [PART ...]; all parts without arguments.

--packages PART ... prints what Debian has to have for them, --figures PART ... writes the figures of what is done so far,
--only WORD PART ... runs the steps alone that have the word in their names.
"""

from __future__ import annotations

import sys

import arm64
import calibration
import fuzz
import fuzz_hdf5
import mutants
import sanitizers
import soak
import systems
import want
import wheels
import windows
from steps import load, main, write_figures

PARTS = {part.PART.name: part.PART for part in (soak, fuzz, fuzz_hdf5, sanitizers, arm64, windows, want, calibration, wheels, systems, mutants)}

if __name__ == "__main__":
    option, *names = sys.argv[1:] or [""]
    if option == "--packages":
        print(" ".join(dict.fromkeys(package for name in names or PARTS for package in PARTS[name].packages)))
    elif option == "--figures":
        for name in names or PARTS:
            write_figures(PARTS[name], load(PARTS[name]))
    elif option == "--only":
        main(PARTS, names[1:], names[0])
    else:
        main(PARTS, [name for name in sys.argv[1:] if name])
