"""Every example scene, the README's cloth and twenty random scenes are asked for three wants and for what a plain run says of its
error, and held against extrapolation in long double."""

from __future__ import annotations

import re
from typing import Any

from steps import Part, Step

BUILD = "build/long/release"
ASKED = "--want 1cm --want 1mm --want 10um --plain"
EVALUATIONS = 5e6  # that a solution may take: nothing in the examples needs more
# One after the other, so that times are those of a machine with nothing else to do.
SMALL = "six-particles oscillator rope stiff-spring drag-or-damping mesh cloth-gentle cloth-stiff cantilever".split()
LARGE = "curl cloth-16 lattice cloth-damped rope-resolution cloth-64".split()


def hold(name: str, scenes: str, seconds: float) -> Step:
    command = (
        f"HOOKE_EXTRAPOLATE={BUILD}/tests/long/extrapolate python3 tests/long/wanted.py --hooke {BUILD}/hooke "
        f"--kept $WORK {ASKED} --evaluations {EVALUATIONS:g} --study {scenes}"
    )
    return Step(name, command, seconds, kept)


def kept(text: str) -> dict[str, Any]:
    found = re.search(r"^(\d+) asked for, (\d+) met, (\d+) said not to be met or known, (\d+) wrong$", text, re.MULTILINE)
    if not found or found[4] != "0":
        raise ValueError("some claims do not hold")
    return {"asked": int(found[1]), "met": int(found[2]), "refused": int(found[3])}


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if not figures:
        return []
    return [(f"wants of 1 cm, 1 mm and 10 um, and estimates of plain runs: {step}",
             f"{figures['asked']} answers, all true: {figures['met']} wants met, {figures['refused']} said not to be")]  # fmt: skip


PART = Part(
    "want",
    [],
    [
        Step("build", f"cmake --preset release -B {BUILD} -DHOOKE_LONG_TESTS=ON -DHOOKE_TEST_TIMEOUT=7200 && "
                      f"cmake --build {BUILD} --target hooke_cli hooke_long_extrapolate hooke_long_random_scenes", 240),
        hold("small example scenes", " ".join(f"examples/scenes/{name}.json" for name in SMALL), 300),
        hold("twenty random scenes", "random:20", 120),
        hold("large example scenes", " ".join(f"examples/scenes/{name}.json" for name in LARGE), 5000),
        hold("the cloth of the README", "cloth.md", 600),
    ],
    rows,
)  # fmt: skip
