"""Runs the tests of a tier and adds up what they take of the processors: python tests/tier.py test | check

With CI set, more than the budget of the tier is a failure, and so is a quick test that takes longer than one may.
Machines differ by more than twice, so all times are given as on a processor of one speed, which a fixed loop measures
before and after. The last lines are the summaries, then a line that names everything that failed."""

from __future__ import annotations

import os
import re
import resource
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# Presets of CTest, and the budget [s of processor].
TIERS = {"test": (("release",), 300), "check": (("check", "minimal", "asan"), 1500)}
# A loop of the interpreter, and what it takes on a processor of that speed [s].
LOOP, LOOP_SECONDS = "found = {}\nfor i in range(2_000_000): found[i % 997] = found.get(i % 991, 0) + i", 0.28
# A quick test takes at most so long [s of processor] on an idle machine, and beside other work up to a third more, of
# caches and cores that it shares.
QUICK, BUSY = 3.0, 4 / 3


def seconds(times: Path) -> float:
    """User and system time of the children, the second line that `times` of the shell prints."""
    parts = re.findall(r"(\d+)m([\d.]+)s", times.read_text().splitlines()[1])
    return sum(60 * int(minutes) + float(rest) for minutes, rest in parts)


def slowness() -> float:
    """How many times longer than on a processor of that speed a computation takes here and now."""
    begun = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([sys.executable, "-c", LOOP], check=True)
    return (resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - begun) / LOOP_SECONDS


def run(preset: str) -> tuple[list[str], list[str], dict[str, float]]:
    """What failed, the lines of the summary, and what each test took."""
    folder = ROOT / "build" / ("release" if preset == "check" else preset)
    taken, log = folder / "tests/taken", folder / f"{preset}.log"
    for path in taken.glob("*"):
        path.unlink()
    done = subprocess.run(["ctest", "--preset", preset, "--output-log", str(log)], cwd=ROOT)
    text = log.read_text(errors="replace")
    failed = re.findall(r"^\t *\d+ - (\S+) \(", text, re.MULTILINE)
    if done.returncode and not failed:
        failed = ["no summary"]
    summary = re.search(r"^.*tests passed.*", text, re.MULTILINE | re.DOTALL)
    lines = summary[0].splitlines() if summary else []
    return failed, lines, {path.name.replace(".", "/"): seconds(path) for path in taken.iterdir()}


def fuzzed() -> tuple[list[str], list[str]]:
    print("== fuzz", flush=True)
    done = subprocess.run([sys.executable, "tests/fuzz/run.py", "--seconds", "3"], cwd=ROOT, capture_output=True, text=True)
    print(done.stdout + done.stderr, flush=True)
    findings = re.findall(r"^== fuzz/(.*): a finding", done.stdout, re.MULTILINE)
    return (findings or ["failed"]) if done.returncode else [], done.stdout.splitlines()[-1:]


def too_long(tier: str, taken: dict[str, float]) -> list[str]:
    limit, budget = QUICK * BUSY if tier == "test" else float("inf"), TIERS[tier][1]
    found = [f"{name} took {spent:.1f} s, of at most {limit:.1f}" for name, spent in sorted(taken.items()) if spent > limit]
    return found + ["more time than the tier may take"] * (sum(taken.values()) > budget)


def told_time(tier: str, taken: dict[str, float]) -> str:
    longest = ", ".join(f"{name} {taken[name]:.1f}" for name in sorted(taken, key=taken.__getitem__)[:-6:-1])
    return f"== make {tier}: {sum(taken.values()):.0f} s of processor, of at most {TIERS[tier][1]}; the longest: {longest}"


def main(tier: str) -> int:
    failures, told, taken, before = [], [], {}, slowness()
    for preset in TIERS[tier][0]:
        failed, lines, times = run(preset)
        after = slowness()
        factor, before = (before + after) / 2, after
        print(f"== {preset}: a processor here takes {factor:.2f} times as long as one of the speed of the budget", flush=True)
        failures += [f"{preset}: {name}" for name in failed]
        told += ["", f"== {preset}", *lines]
        taken |= {name if preset == "release" else f"{preset} {name}": spent / factor for name, spent in times.items()}
    if tier == "check":
        failed, lines = fuzzed()
        failures += [f"fuzz: {name}" for name in failed]
        told += ["", "== fuzz", *lines]
    if "CI" in os.environ:
        failures += too_long(tier, taken)
    print(*told, "", told_time(tier, taken), sep="\n")
    if failures:
        print("\nfailed:", "; ".join(failures))
    return bool(failures)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
