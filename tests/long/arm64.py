"""AArch64 under emulation: the unit tests, and the bits of every fixed-step method beside those of this machine."""

from __future__ import annotations

from typing import Any

from bits import compared
from steps import Part, Step, tests_passed

BUILD, HERE = "build/arm64", "build/long/native"


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if step == "unit tests":
        return [("unit tests under qemu-aarch64", f"{figures['tests']} programs passed")]
    if step == "equal bits":
        return [("hashes of fixed-step runs, forces and energies, AArch64 beside x86-64",
                 f"{figures['lines']} equal of {figures['lines']}")]  # fmt: skip
    return []


PART = Part(
    "arm64",
    ["qemu-user-static", "gcc-aarch64-linux-gnu", "libcmocka-dev:arm64"],
    [
        Step("build", f"cmake --preset arm64 && cmake --build {BUILD} --target hooke_long_bits hooke_unit_tests", 300),
        Step("build here", f"cmake --preset minimal -B {HERE} -DHOOKE_LONG_TESTS=ON && "
                           f"cmake --build {HERE} --target hooke_long_bits", 60),
        Step("bits", f"{HERE}/tests/long/bits >$WORK/here.txt && qemu-aarch64-static {BUILD}/tests/long/bits >$WORK/there.txt",
             100),
        Step("equal bits", "python3 tests/long/bits.py fixed $WORK/here.txt $WORK/there.txt", 1, compared),
        Step("unit tests", "ctest --preset arm64 -j2", 900, tests_passed),
    ],
    rows,
)  # fmt: skip
