"""Tests every example scene, the README's cloth and twenty random scenes with three wants each, by runs and by
studies, and for the examples the estimated error of a plain run as well, against extrapolation in long double."""

from __future__ import annotations

import re
from typing import Any

from steps import ROOT, Part, Step

BUILD = "build/long/release"
ASKED = "--want 1cm --want 1mm --want 10um --study"
EVALUATIONS = 5e6  # that a solution may take: nothing in the examples needs more
LARGEST = "cloth-64"  # half an hour for the solution
LARGE = {"curl", "cloth-16", "lattice", "cloth-damped", "rope-resolution"}
# the independent solution has inertia, neither bodies nor obstacles nor wind; cloth-16 stands for three-cloths
OTHERS = {"ball-under-cloth", "buoy", "crane", "flag", "mooring", "three-cloths", "tissue"}
EXAMPLES = sorted({path.stem for path in (ROOT / "examples/scenes").glob("*.json")} - OTHERS)


def hold(name: str, scenes: str, seconds: float) -> Step:
    command = (
        f"HOOKE_EXTRAPOLATE={BUILD}/tests/long/extrapolate python3 tests/long/wanted.py --hooke {BUILD}/hooke "
        f"--kept $WORK {ASKED} --evaluations {EVALUATIONS:g} {scenes}"
    )
    return Step(name, command, seconds, kept)


def examples(names: list[str]) -> str:
    return "--plain " + " ".join(f"examples/scenes/{name}.json" for name in names)


def kept(text: str) -> dict[str, Any]:
    found = re.search(r"^(\d+) asked for, (\d+) met, (\d+) said not to be met or known, (\d+) wrong$", text, re.MULTILINE)
    if not found or found[4] != "0":
        raise ValueError("some claims do not hold")
    return {"asked": int(found[1]), "met": int(found[2]), "refused": int(found[3])}


def agreement(text: str) -> dict[str, Any]:
    found = re.findall(r"^(\d+) of (\d+) means agree$", text, re.MULTILINE)
    return {"means": sum(int(of) for _, of in found), "agreeing": sum(int(number) for number, _ in found)}


def repeats(text: str) -> dict[str, Any]:
    found = re.search(r"^(\d+) of (\d+) picks repeat$", text, re.MULTILINE)
    if not found or found[1] != found[2]:
        raise ValueError("some picks do not repeat")
    return {"repeated": int(found[1])}


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if not figures:
        return []
    if "repeated" in figures:
        return [("wants of 1 cm and 1 mm asked for ten times beside busy cores: the same pick each time", f"{figures['repeated']} of {figures['repeated']}")]
    if "means" in figures:
        return [(f"means of ensembles within 3 standard errors of those of ensembles ten times as large: {step}",
                 f"{figures['agreeing']} of {figures['means']}")]  # fmt: skip
    return [(f"wants of 1 cm, 1 mm and 10 um of runs and studies{', estimates of plain runs' * ('example' in step)}: {step}",
             f"{figures['asked']} answers, all true: {figures['met']} wants met, {figures['refused']} said not to be")]  # fmt: skip


PART = Part(
    "want",
    [],
    [
        Step("build", f"cmake --preset release -B {BUILD} -DHOOKE_EVERYTHING=ON -DHOOKE_LONG_TESTS=ON -DHOOKE_TEST_TIMEOUT=7200 && "
                      f"cmake --build {BUILD} --target hooke_cli hooke_long_extrapolate hooke_long_random_scenes", 240),
        hold("small example scenes", examples([name for name in EXAMPLES if name not in {*LARGE, LARGEST}]), 300),
        hold("twenty random scenes", "random:20", 120),
        Step("the same ten times", f"python3 tests/long/repeated.py --hooke {BUILD}/hooke "
                                   + " ".join(f"examples/scenes/{name}.json" for name in EXAMPLES if name != LARGEST), 600, repeats),
        hold("large example scenes", examples([name for name in EXAMPLES if name in LARGE]), 1200),
        hold("the largest example scene", examples([LARGEST]), 4000),
        hold("the cloth of the README", "cloth.md", 600),
        Step("twenty ensembles", f"cmake --build {BUILD} --target tests/physics_study_ensemble && "
                                 f"{BUILD}/tests/physics_study_ensemble 2>&1", 150, agreement),
    ],
    rows,
)  # fmt: skip
