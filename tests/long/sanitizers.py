"""The library watched: sanitizers, valgrind, two compilers at four levels of optimisation, and the lines that tests
reach.

Every test of C runs in every step, with the exceptions in this file. Limited to one step: - large and many cases of
what is arithmetic (`left_out()`, `short_of_time()` of tests/support/sanitized.h) run at -O3 with both
  compilers, which is what users have, and with the address sanitizer; other levels and valgrind take a share of them;
- the thread sanitizer sees the tests that start a thread, of which a preset has the names: in others there is nothing
to race; - valgrind sees the unit tests but for two; - tests/fault, and the programs and pages of tests/cli, are for
the address sanitizer of gcc; - every point of tests/fault, where those that make whole studies have a tenth of their
points sanitized, runs of 1e8 steps and
  a thousand kills are for `soak`.
"""

from __future__ import annotations

import re
from typing import Any

from bits import compared
from steps import Part, Step, tests_passed

C_TESTS = "-L 'unit|physics|determinism|guest'"
# C alone, no program and no interpreter: what is compiled and run many times.
PLAIN = "-G Ninja -DCMAKE_BUILD_TYPE=None -DHOOKE_LONG_TESTS=ON -DHOOKE_TEST_TIMEOUT=3600 -DCMAKE_Fortran_COMPILER=NOTFOUND"
LEVELS = ("-O0", "-O1", "-O2", "-O3")
COMPILERS = ("gcc", "clang")
# Units under valgrind, which takes thirty times as long: `thread_pool` spins in threads that wait for each other. Memory of
# a killed child is no leak.
VALGRIND_LEAVES = "unit_thread_pool$"
CLANG_SANITIZERS = (
    "-O1 -g -fno-omit-frame-pointer -fno-sanitize-recover=all -Wno-pass-failed "
    "-fsanitize=address,undefined,float-cast-overflow,implicit-integer-truncation"
)
SOAKED = "'cli/kill|extremes/long_runs'"  # whose long cases are those of `soak`
COVERAGE = "build/long/coverage"
# Branches are those of the sources: no function is copied into another before they are counted.
COUNTED = '-O1 -fno-early-inlining --coverage "-DHOOKE_INLINE=static inline"'
SHORT = {"HOOKE_LONG": ""}  # without the long cases, as in `make test`
SHORTER = SHORT | {"HOOKE_SHORT": "1"}  # and of large and many cases a share


def configured(preset: str) -> str:
    return f"cmake --preset {preset} -DHOOKE_EVERYTHING=ON -DHOOKE_TEST_TIMEOUT=7200 && cmake --build --preset {preset} --target tests"


def ctest(build: str, tests: str = "") -> str:
    return f"ctest --test-dir {build} -j2 --output-on-failure {tests}"


def level(compiler: str, optimised: str) -> Step:
    build = f"build/long/{compiler}{optimised}"
    return Step(
        f"{compiler} {optimised}",
        f"cmake -S . -B {build} {PLAIN} -DCMAKE_C_COMPILER={compiler} -DCMAKE_C_FLAGS={optimised} "
        f"-DHOOKE_KERNEL_OPTIMISATION={optimised} && cmake --build {build} --target tests && "
        f"{build}/tests/long/bits >$WORK/{compiler}{optimised}.txt && "
        f"{ctest(build, C_TESTS)} && rm -r {build}",
        {"-O0": 220, "-O1": 200, "-O2": 200, "-O3": 240}[optimised],
        tests_passed,
        SHORT if optimised == "-O3" else SHORTER,
    )


def valgrind(text: str) -> dict[str, Any]:
    programs = re.findall(r"^valgrind: (\S+) clean$", text, re.MULTILINE)
    if not programs:
        raise ValueError("nothing ran")
    return {"programs": len(programs)}


def reached(text: str) -> dict[str, Any]:
    """Totals and the files with the lowest coverage, from the output of coverage.py."""
    found = re.search(r"^lines (\d+) of (\d+), (\S+) %\nbranches (\d+) of (\d+), (\S+) %$", text, re.MULTILINE)
    files = re.findall(r"^ +(\d+) +\d+ +(\d+) +\d+  src/(\S+)$", text, re.MULTILINE)
    kinds = re.search(r"^branches left where failures are looked for: (\d+); elsewhere: (\d+)$", text, re.MULTILINE)
    rooms = re.findall(r"^branches of (src/\S+): (\d+) of (\d+); left: (.+)$", text, re.MULTILINE)
    if not found or not kinds:
        raise ValueError("no totals")
    return {"lines": found[3], "of_lines": int(found[2]), "branches": found[6], "of_branches": int(found[5]),
            "kinds": list(kinds.groups()), "rooms": rooms,
            "left": [f"{file} {lines} lines, {branches} branches" for lines, branches, file in files[:12]]}  # fmt: skip


def rows(step: str, figures: dict[str, Any]) -> list[tuple[str, str]]:
    if step == "equal bits":
        return [("hashes of all methods in the builds of two compilers at four levels",
                 f"{figures['lines']} equal in {figures['files']} builds")]  # fmt: skip
    if step == "valgrind":
        return [("valgrind memcheck, unit tests", f"{figures['programs']} programs without an error or a leak")]
    if step == "coverage":
        where = "{} where a failure of memory, of a file or of a library is looked for, {} elsewhere".format(*figures["kinds"])
        return [("lines of `src/` reached", f"{figures['lines']} % of {figures['of_lines']}"),
                ("branches of `src/` reached", f"{figures['branches']} % of {figures['of_branches']}"),
                *((f"branches of `{room}` reached", f"{100 * int(taken) / int(of_taken):.1f} % of {of_taken}; left: {kinds}")
                  for room, taken, of_taken, kinds in figures.get("rooms", [])),
                ("branches left", where),
                ("most left", "; ".join(figures["left"]))]  # fmt: skip
    return [(step, f"{figures['tests']} test programs passed")]


PART = Part(
    "sanitizers",
    ["clang", "libclang-rt-dev", "valgrind"],
    [
        Step("minimal", f"{configured('minimal')} && {ctest('build/minimal')}", 120, tests_passed),
        *(level(compiler, optimised) for compiler in COMPILERS for optimised in LEVELS),
        Step("equal bits", "python3 tests/long/bits.py all " + " ".join(
            f"$WORK/{compiler}{optimised}.txt" for compiler in COMPILERS for optimised in LEVELS), 1, compared),
        Step("tsan", f"{configured('tsan')} && ctest --preset tsan", 400, tests_passed, SHORT),
        Step("clang, address, undefined and truncation",
             f"cmake -S . -B build/long/clang-asan {PLAIN} -DCMAKE_C_COMPILER=clang '-DCMAKE_C_FLAGS={CLANG_SANITIZERS}' "
             "-DHOOKE_KERNEL_OPTIMISATION=-O1 -DHOOKE_KERNEL_COPIES=OFF && cmake --build build/long/clang-asan --target tests && "
             f"{ctest('build/long/clang-asan', C_TESTS)}", 340, tests_passed,
             SHORTER),
        Step("valgrind",
             f"cmake -S . -B build/long/valgrind {PLAIN} -DCMAKE_C_FLAGS='-O1 -g' && cmake --build build/long/valgrind --target tests && "
             "printf '%s\\n' build/long/valgrind/tests/unit_* | grep -v -E '"
             f"{VALGRIND_LEAVES}' | OPENBLAS_CORETYPE=Haswell xargs -P 2 -I PROGRAM sh -c 'valgrind -q --error-exitcode=9 "
             "--child-silent-after-fork=yes --leak-check=full --errors-for-leak-kinds=definite PROGRAM && echo valgrind: $(basename PROGRAM) clean'",
             480, valgrind, SHORTER),
        Step("coverage",
             f"cmake -S . -B {COVERAGE} -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS='{COUNTED}' "
             f"-DHOOKE_KERNEL_OPTIMISATION=-O1 -DHOOKE_TEST_TIMEOUT=7200 && cmake --build {COVERAGE} --target tests && "
             f"find {COVERAGE} -name '*.gcda' -delete && "
             f"ctest --test-dir {COVERAGE} -j2 --output-on-failure -LE 'abi|layers|documents|clients|fortran' && "
             f"python3 tests/long/coverage.py {COVERAGE}", 1200, reached, SHORT | {"HOOKE_FAULT_PLACES": "1"}),
        Step("address and undefined-behaviour sanitizers, every case",
             f"{configured('asan')} && {ctest('build/asan', f'-E {SOAKED}')} && "
             f"env -u HOOKE_LONG {ctest('build/asan', f'-R {SOAKED}')}", 1600, tests_passed),
    ],
    rows,
)  # fmt: skip
