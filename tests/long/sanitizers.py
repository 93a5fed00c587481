"""The library watched: sanitizers, valgrind, two compilers at four levels of optimisation, and the lines that tests reach."""

from __future__ import annotations

import re
from typing import Any

from bits import compared
from steps import Part, Step, tests_passed

C_TESTS = "-L 'unit|physics|determinism'"
# C alone, no program and no interpreter: what is compiled and run many times.
PLAIN = "-G Ninja -DCMAKE_BUILD_TYPE=None -DHOOKE_LONG_TESTS=ON -DHOOKE_TEST_TIMEOUT=3600 -DCMAKE_Fortran_COMPILER=NOTFOUND"
LEVELS = ("-O0", "-O1", "-O2", "-O3")
COMPILERS = ("gcc", "clang")
# Units under valgrind, which takes thirty times as long: those left out spin in threads that wait for each other.
VALGRIND_LEAVES = "crew|canonical|million"
CLANG_SANITIZERS = (
    "-O1 -g -fno-omit-frame-pointer -fno-sanitize-recover=all -Wno-pass-failed "
    "-fsanitize=address,undefined,float-cast-overflow,implicit-integer-truncation"
)
COVERAGE = "build/long/coverage"
SHORT = {"HOOKE_LONG": ""}  # without the long cases


def preset(name: str, options: str = "", tests: str = "") -> str:
    return (f"cmake --preset {name} -DHOOKE_TEST_TIMEOUT=7200 {options} && cmake --build --preset {name} && "
            f"ctest --test-dir build/{name} -j2 --output-on-failure {tests}")  # fmt: skip


def level(compiler: str, optimised: str) -> Step:
    build = f"build/long/{compiler}{optimised}"
    return Step(
        f"{compiler} {optimised}",
        f"cmake -S . -B {build} {PLAIN} -DCMAKE_C_COMPILER={compiler} -DCMAKE_C_FLAGS={optimised} "
        f"-DHOOKE_KERNEL_OPTIMISATION={optimised} && cmake --build {build} && "
        f"{build}/tests/long/bits >$WORK/{compiler}{optimised}.txt && "
        f"ctest --test-dir {build} -j2 --output-on-failure {C_TESTS} && rm -r {build}",
        {"-O0": 400, "-O1": 300, "-O2": 210, "-O3": 210}[optimised],
        tests_passed,
        SHORT,
    )


def valgrind(text: str) -> dict[str, Any]:
    programs = re.findall(r"^valgrind: (\S+) clean$", text, re.MULTILINE)
    if not programs:
        raise ValueError("nothing ran")
    return {"programs": len(programs)}


def reached(text: str) -> dict[str, Any]:
    """Totals and the files with most left, of the output of coverage.py."""
    found = re.search(r"^lines (\d+) of (\d+), (\S+) %\nbranches (\d+) of (\d+), (\S+) %$", text, re.MULTILINE)
    files = re.findall(r"^ +(\d+) +\d+ +(\d+) +\d+  src/(\S+)$", text, re.MULTILINE)
    kinds = re.search(r"^branches left where failures are looked for: (\d+); elsewhere: (\d+)$", text, re.MULTILINE)
    if not found or not kinds:
        raise ValueError("no totals")
    return {"lines": found[3], "of_lines": int(found[2]), "branches": found[6], "of_branches": int(found[5]),
            "kinds": list(kinds.groups()),
            "left": [f"{file} {lines} lines, {branches} branches" for lines, branches, file in files[:12]]}  # fmt: skip


def rows(done: dict[str, dict[str, Any]]) -> list[tuple[str, str]]:
    told = [(name, f"{figures['tests']} test programs passed") for name, figures in done.items() if "tests" in figures]
    if "equal bits" in done:
        figures = done["equal bits"]
        told.append(("hashes of all methods in the builds of two compilers at four levels",
                     f"{figures['lines']} equal in {figures['files']} builds"))  # fmt: skip
    if "valgrind" in done:
        told.append(("valgrind memcheck, unit tests", f"{done['valgrind']['programs']} programs without an error or a leak"))
    if "coverage" in done:
        figures = done["coverage"]
        told += [("lines of `src/` reached", f"{figures['lines']} % of {figures['of_lines']}"),
                 ("branches of `src/` reached", f"{figures['branches']} % of {figures['of_branches']}"),
                 ("branches left", "{} where a failure of memory, of a file or of a library is looked for, {} elsewhere".format(
                     *figures["kinds"])),
                 ("most left", "; ".join(figures["left"]))]  # fmt: skip
    return told


PART = Part(
    "sanitizers",
    ["clang", "libclang-rt-14-dev", "valgrind"],
    [
        Step("minimal", preset("minimal"), 120, tests_passed),
        *(level(compiler, optimised) for compiler in COMPILERS for optimised in LEVELS),
        Step("equal bits", "python3 tests/long/bits.py all " + " ".join(
            f"$WORK/{compiler}{optimised}.txt" for compiler in COMPILERS for optimised in LEVELS), 1, compared),
        Step("tsan", preset("tsan", tests=C_TESTS), 1200, tests_passed),
        Step("clang, address, undefined and truncation",
             f"cmake -S . -B build/long/clang-asan {PLAIN} -DCMAKE_C_COMPILER=clang '-DCMAKE_C_FLAGS={CLANG_SANITIZERS}' "
             "-DHOOKE_KERNEL_OPTIMISATION=-O1 && cmake --build build/long/clang-asan && "
             f"ctest --test-dir build/long/clang-asan -j2 --output-on-failure {C_TESTS}", 600, tests_passed,
             SHORT),
        Step("valgrind",
             f"cmake -S . -B build/long/valgrind {PLAIN} -DCMAKE_C_FLAGS='-O1 -g' && cmake --build build/long/valgrind && "
             "printf '%s\\n' build/long/valgrind/tests/unit_* | grep -v -E '"
             f"{VALGRIND_LEAVES}' | OPENBLAS_CORETYPE=Haswell xargs -P 2 -I PROGRAM sh -c 'valgrind -q --error-exitcode=9 "
             "--leak-check=full --errors-for-leak-kinds=definite PROGRAM && echo valgrind: $(basename PROGRAM) clean'",
             1200, valgrind, SHORT),
        Step("coverage",
             f"cmake -S . -B {COVERAGE} -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS='-O1 --coverage' "
             f"-DHOOKE_KERNEL_OPTIMISATION=-O1 -DHOOKE_TEST_TIMEOUT=7200 && cmake --build {COVERAGE} && "
             f"find {COVERAGE} -name '*.gcda' -delete && "
             f"ctest --test-dir {COVERAGE} -j2 --output-on-failure -LE 'abi|layers|documents|clients|fortran' && "
             f"python3 tests/long/coverage.py {COVERAGE}", 1200, reached, SHORT | {"HOOKE_FAULT_PLACES": "1"}),
        Step("address and undefined-behaviour sanitizers, every case", preset("asan"), 2400, tests_passed),
    ],
    rows,
)  # fmt: skip
