"""Eight hours of work, compressed: 1e9 steps, 1e4 lives of every object, a thousand kills, every fault, long runs."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from steps import Part, Step, tests_passed

BUILD = "build/long/release"
STEPS, CYCLES = 10**9, 10**4
# Freed memory cached by threads counts as in use.
KEEPING_NOTHING = {"GLIBC_TUNABLES": "glibc.malloc.tcache_count=0"}


def billion(method: str) -> Step:
    place = f"$WORK/$SOURCES-{method}"
    whole, pieces = (f"{BUILD}/tests/long/steps {place}-{how} {method} {how} {STEPS}" for how in ("whole", "pieces"))
    command = f"{whole} >$WORK/{method}-whole.txt 2>&1 & {pieces} 2>&1; wait $!; cat $WORK/{method}-whole.txt"
    return Step(f"1e9 steps, {method}", command, 250, equal_to_the_end, KEEPING_NOTHING)


def equal_to_the_end(text: str) -> dict[str, Any]:
    hashes = re.findall(r"^final hash (\w+)$", text, re.MULTILINE)
    if len(hashes) != 2 or hashes[0] != hashes[1]:
        raise ValueError(f"in one piece and in many the steps come to {hashes}")
    marks: dict[str, set[str]] = {}
    for step, found in re.findall(r"^step (\d+) hash (\w+)$", text, re.MULTILINE):
        marks.setdefault(step, set()).add(found)
    if any(len(found) > 1 for found in marks.values()):
        raise ValueError("the two come to different numbers on the way")
    energy = re.search(r"energy off by (\S+) in the first tenth, (\S+) in the last; angular momentum by (\S+);", text)
    if not energy:
        raise ValueError("no line of energies")
    return {"hash": hashes[0], "first": energy[1], "last": energy[2], "spin": energy[3]}


def lives(seconds: float) -> Step:
    """Those of the scenarios of tests/fault."""
    cycles = f"{BUILD}/tests/long/cycles"
    command = f"{cycles} | xargs -P 2 -d '\\n' -I KIND {cycles} KIND {CYCLES}"

    def figures(text: str) -> dict[str, Any]:
        found = re.findall(r"^(.+): (\d+) cycles, .* heap (\d+) -> (\d+) bytes", text, re.MULTILINE)
        if not found:
            raise ValueError("nothing came to its end")
        return {"kinds": len(found), "cycles": max(int(cycles) for _, cycles, *_ in found),
                "grown": max(int(now) - int(start) for *_, start, now in found)}  # fmt: skip

    return Step("1e4 lives of all objects", command, seconds, figures, KEEPING_NOTHING)


def ctest(name: str, pattern: str, seconds: float, figures: Callable[[str], dict[str, Any]] = tests_passed) -> Step:
    """With all output of the tests, which the numbers are read from."""
    return Step(name, f"ctest --test-dir {BUILD} -j2 -V -R '{pattern}'", seconds, figures, {"PYTEST_ADDOPTS": "-s"})


def cloths(side: int, seconds: float) -> Step:
    """Steps of implicit methods, which `make test` has for smaller sides."""

    def figures(text: str) -> dict[str, Any]:
        if "[  PASSED  ] 1 test(s)." not in text:
            raise ValueError("a cloth failed")
        return {"tests": 1}

    return Step(f"implicit cloths of {side} x {side}", f"{BUILD}/tests/physics_implicit_cloths {side} 2>&1", seconds, figures)


def limits(seconds: float) -> Step:
    """Scenes by seed, of which `make test` has the first few."""

    def figures(text: str) -> dict[str, Any]:
        if "[  PASSED  ] 2 test(s)." not in text:
            raise ValueError("a limit is not that of the matrices")
        return {"tests": 1}

    return Step("limits of 2000 random scenes", f"HOOKE_LONG=1 {BUILD}/tests/physics_random_limits 2>&1", seconds, figures)


def faults_met(text: str) -> dict[str, Any]:
    found = re.findall(r" (\d+) points, +(\d+) faults: ", text)
    if not found:
        raise ValueError("no faults were tried")
    return tests_passed(text) | {"points": sum(int(points) for points, _ in found), "faults": sum(int(f) for _, f in found)}


def crashes_met(text: str) -> dict[str, Any]:
    kills, points = (sum(int(n) for n in re.findall(rf"(\d+) {what}", text)) for what in ("kills: ", r"of \d+ points"))
    if not kills or not points:
        raise ValueError("nothing was killed")
    return tests_passed(text) | {"kills": kills, "crashes": points}


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if "hash" in figures:
        return [(f"{step}, a free chain of 8 particles", "equal bits in one piece and in many, image in the origin "
                 f"exact to the last step (momentum 0), energy off by {figures['first']} at most in the first tenth "
                 f"and {figures['last']} in the last, angular momentum by {figures['spin']}, memory flat")]  # fmt: skip
    if "grown" in figures:
        return [("lives of objects (made, used, destroyed)",
                 f"{figures['kinds']} kinds, up to {figures['cycles']} each: equal results, "
                 f"the heap grows by {figures['grown']} bytes, no file and no thread is left")]  # fmt: skip
    met = f", {figures['faults']} faults at {figures['points']} points" if "faults" in figures else ""
    if "kills" in figures:
        met = f", {figures['kills']} kills at random moments, {figures['crashes']} at writes (before one, in its midst) and failing writes"
    return [(step, f"{figures['tests']} test programs passed{met}")] if figures else []


PART = Part(
    "soak",
    [],
    [
        Step("build", f"cmake --preset release -B {BUILD} -DHOOKE_EVERYTHING=ON -DHOOKE_LONG_TESTS=ON -DHOOKE_TEST_TIMEOUT=7200 && "
                      f"cmake --build {BUILD} --target tests", 240),
        billion("verlet"),
        billion("symplectic-euler"),
        lives(1500),
        ctest("crashes and kills", "crash|kill|frame_check", 200, crashes_met),
        ctest("every failing allocation and write", "^fault/", 2100, faults_met),
        ctest("long runs and resumes", "extremes/long_runs|resume|checkpoint", 500),
        limits(1500),
        cloths(81, 600),
        cloths(128, 1800),
    ],
    rows,
)  # fmt: skip
