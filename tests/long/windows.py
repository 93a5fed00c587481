"""Windows under wine: the unit tests, what tests/windows has, and the bits of every fixed-step method beside those of Linux."""

from __future__ import annotations

from typing import Any

from bits import compared
from steps import Part, Step, tests_passed

BUILD, HERE = "build/windows", "build/long/native"
WINE = f"WINEPREFIX=$PWD/{BUILD}/wine WINEDEBUG=-all PATH=$PATH:/usr/lib/wine wine64"


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if step == "unit tests":
        return [("unit tests for Windows under wine", f"{figures['tests']} programs passed")]
    if step == "equal bits":
        return [("hashes of fixed-step runs, forces and energies, Windows under wine beside Linux",
                 f"{figures['lines']} equal of {figures['lines']}")]  # fmt: skip
    return []


PART = Part(
    "windows",
    ["gcc-mingw-w64-x86-64-posix", "libz-mingw-w64-dev", "wine64", "f2c", "libcmocka-dev"],
    [
        Step("build", f"cmake --preset windows && cmake --build {BUILD} && "
                      f"cmake --build {BUILD} --target hooke_unit_tests hooke_long_bits", 600),
        Step("build here", f"cmake --preset minimal -B {HERE} -DHOOKE_LONG_TESTS=ON && "
                           f"cmake --build {HERE} --target hooke_long_bits", 60),
        Step("bits", f"{HERE}/tests/long/bits >$WORK/here.txt && {WINE} {BUILD}/bits.exe >$WORK/there.txt", 100),
        Step("equal bits", "python3 tests/long/bits.py fixed $WORK/here.txt $WORK/there.txt", 1, compared),
        Step("unit tests", "ctest --preset windows -j2", 300, tests_passed),
    ],
    rows,
)  # fmt: skip
