"""Runs the steps of a part of `make test-long` one after the other and records finished ones in
build/long/<part>.json.

A part that was interrupted or killed goes on with the steps that are not done for the sources as they are; a step
that failed is run again. Then what each step came to last, for whatever sources, goes into
docs/notes/reliability.json, with its date and commit, and from there into the tables of docs/notes/reliability.md, or of the page that the part names.
"""

from __future__ import annotations

import contextlib
import ctypes
import fcntl
import hashlib
import json
import os
import re
import resource
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "build/long"
PAGE = ROOT / "docs/notes/reliability.md"
MEASURED = ROOT / "docs/notes/reliability.json"
SOURCES = ("src", "include", "cli", "bindings", "cmake", "examples", "tests", "CMakeLists.txt", "CMakePresets.json")
TELL_EVERY = 60  # [s] between lines during a step
LIMIT = 150 * 60  # [s] a part has


@dataclass
class Step:
    """A shell command, run in the root, and the results in its output. HOOKE_LONG is set, WORK is a folder that stays
    from one start to the next, and SOURCES identifies the current sources."""

    name: str
    command: str
    seconds: float  # estimate for two processors; the next time, the measured time
    figures: Callable[[str], dict[str, Any]] = lambda text: {}  # from the output; raises if it is not as expected
    environment: dict[str, str] = field(default_factory=dict)  # "": not set


@dataclass
class Part:
    name: str
    packages: list[str]
    steps: list[Step]
    rows: Callable[[str, dict[str, Any]], list[tuple[str, str]]]  # names and results, from a step's name and its results
    so_far: Callable[[dict[str, Any]], dict[str, Any]] = lambda known: known  # with the data of steps that continue later
    page: Path | None = None  # with the marks for its figures, if not PAGE


def git(*arguments: str) -> str:
    return subprocess.run(["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False).stdout


def sources() -> tuple[str, str]:
    """A digest of the current sources, and their name: the commit."""
    digest = hashlib.sha256()
    for name in sorted(set(git("ls-files", "-co", "--exclude-standard", "--", *SOURCES).split("\n")) - {""}):
        if (ROOT / name).is_file():
            digest.update(name.encode() + b"\0" + (ROOT / name).read_bytes())
    commit = git("log", "-1", "--format=%h", "--", *SOURCES).strip() or "unknown"
    changed = git("status", "--porcelain", "--", *SOURCES).strip()
    return digest.hexdigest(), commit + (" with changes" if changed else "")


def write_whole(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    other = path.with_name(path.name + ".new")
    other.write_text(text)
    os.replace(other, path)


# ---- state ----


def load(part: Part) -> dict[str, Any]:
    """Finished steps for the current sources; of others only the times."""
    digest, commit = sources()
    state: dict[str, Any] = {"sources": digest, "commit": commit, "done": {}, "took": {}, "failed": []}
    try:
        old = json.loads((KEPT / f"{part.name}.json").read_text())
        state["took"] = old["took"]
        if old["sources"] == digest:
            state["done"] = {step.name: old["done"][step.name] for step in part.steps if step.name in old["done"]}
    except (OSError, ValueError, KeyError):
        pass
    return state


def save(part: Part, state: dict[str, Any]) -> None:
    write_whole(KEPT / f"{part.name}.json", json.dumps(state, indent=1))


# ---- running ----


class SourcesChanged(Exception):
    """The results of a step are of outdated sources."""


def words(seconds: float) -> str:
    return f"{seconds:.0f} s" if seconds < 100 else f"{seconds / 60:.0f} min"


def die_with_parent() -> None:
    """If this process is killed the step ends, too: its shell gets a signal, and passes it on."""
    ctypes.CDLL(None).prctl(1, signal.SIGTERM)


# All processes of a step are of one process group, which ends as a whole.
SHELL = "trap 'trap - TERM; kill -TERM 0' TERM\n(\n{command}\n) &\nwait $!"


def processor_seconds() -> float:
    """Output of all finished processes so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def last_line(log: Path) -> str:
    lines = log.read_text(errors="replace").strip().splitlines()
    return lines[-1][:100] if lines else ""


def run(step: Step, log: Path, folder: Path, mark: str, told: Callable[[str], None]) -> int:
    environment = os.environ | {"HOOKE_LONG": "1", "WORK": str(folder), "SOURCES": mark, "OPENBLAS_NUM_THREADS": "1"} | step.environment
    environment = {name: value for name, value in environment.items() if value}
    with log.open("w") as output:
        process = subprocess.Popen(
            ["bash", "-e", "-u", "-o", "pipefail", "-c", SHELL.format(command=step.command)],
            cwd=ROOT, env=environment, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
            preexec_fn=die_with_parent, start_new_session=True,
        )  # fmt: skip
        try:
            while True:
                try:
                    return process.wait(timeout=TELL_EVERY)
                except subprocess.TimeoutExpired:
                    told(last_line(log))
        finally:  # processes left by a failed or interrupted step
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGTERM)
            process.wait()


def run_part(part: Part, only: str = "") -> int:
    """Runs the remaining steps, or those with `only` in their names; returns the number of failed steps."""
    folder = KEPT / part.name
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            print(f"{part.name} is running already")
            return 1
        return run_steps(part, only, folder)


def run_steps(part: Part, only: str, folder: Path) -> int:
    state, failed = load(part), 0
    print(f"== {part.name} of {state['commit']}: {len(state['done'])} of {len(part.steps)} steps are done", flush=True)
    try:
        asked = [(k, step) for k, step in enumerate(part.steps, 1) if only in step.name]
        waiting = [(k, step) for k, step in asked if step.name not in state["done"]]
        for n, (k, step) in enumerate(waiting):
            left = sum(state["took"].get(later.name, later.seconds) for _, later in waiting[n:])
            failed += not run_step(part, state, k, step, left, folder)
    except SourcesChanged:
        print(f"the sources have changed meanwhile; start it again with them as they are: make test-long PART={part.name}")
        failed += 1
    except KeyboardInterrupt:
        print(f"\ninterrupted; start it again, and it goes on: make test-long PART={part.name}")
        failed += 1
    write_figures(part, state)
    return failed


def run_step(part: Part, state: dict[str, Any], k: int, step: Step, left: float, folder: Path) -> bool:
    """Runs step `k` of the part; the remaining steps take `left` seconds; returns whether it passed."""
    began, used, log = time.monotonic(), processor_seconds(), folder / (re.sub(r"[^a-zA-Z0-9.-]+", "_", step.name) + ".log")
    print(f"[{k}/{len(part.steps)}] {step.name} (about {words(left)} left)", flush=True)

    def tell(line: str) -> None:
        spent = time.monotonic() - began
        print(f"    {words(spent)}, about {words(max(left - spent, 0))} left: {line}", flush=True)

    status = run(step, log, folder, state["sources"][:12], tell)
    took = time.monotonic() - began
    try:
        if status != 0:
            raise ValueError(f"ended with status {status}")
        figures = step.figures(log.read_text(errors="replace"))
    except (ValueError, LookupError, OSError) as error:
        print(f"    FAILED after {words(took)}: {error}; {os.path.relpath(log, ROOT)} ends with")
        print("\n".join("    | " + line for line in log.read_text(errors="replace").splitlines()[-15:]), flush=True)
        state["failed"].append(step.name)
        return False
    if sources()[0] != state["sources"]:
        raise SourcesChanged
    state["took"][step.name] = round(took, 1)
    state["done"][step.name] = {"date": time.strftime("%Y-%m-%d"), "seconds": round(took, 1),
                                "processor": round(processor_seconds() - used, 1), "figures": figures}  # fmt: skip
    save(part, state)
    return True


# ---- figures ----


def measured(part: Part, state: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """Writes finished steps into the file of results, and removes failed ones; returns all results of the part's
    steps."""
    try:
        kept = json.loads(MEASURED.read_text())
    except OSError:
        kept = {}
    here = {name: step | {"commit": state["commit"]} for name, step in state["done"].items()}
    before = {name: step for name, step in kept.get(part.name, {}).items() if name not in state["failed"]}
    known = part.so_far(before | here)
    kept[part.name] = {step.name: known[step.name] for step in part.steps if step.name in known}
    write_whole(MEASURED, json.dumps(kept, indent=1) + "\n")
    return kept[part.name]


def table(part: Part, known: dict[str, dict[str, Any]]) -> list[str]:
    spent, used = (sum(step[kind] for step in known.values()) for kind in ("seconds", "processor"))
    missing = [step.name for step in part.steps if step.name not in known]
    lines = [f"{len(known)} of {len(part.steps)} steps, {spent / 60:.0f} minutes, {used / 60:.0f} of a processor."]
    if missing:
        lines.append("Not run yet, or failed: " + "; ".join(missing) + ".")
    lines += ["", "| what | figure | measured |", "| --- | --- | --- |"]
    for name, step in known.items():
        lines += [f"| {what} | {figure} | {step['date']}, {step['commit']} |" for what, figure in part.rows(name, step["figures"])]
    return lines


def write_figures(part: Part, state: dict[str, Any]) -> None:
    """Text between the marks of this part in the page, if a step of it was ever done."""
    known = measured(part, state)
    if not known:
        return
    marks = re.compile(rf"(<!-- figures of {part.name} -->\n).*?(<!-- end -->)", re.DOTALL)
    lines = "\n".join(table(part, known))
    page = part.page or PAGE
    text, count = marks.subn(lambda found: found[1] + lines + "\n" + found[2], page.read_text())
    if count != 1:
        raise SystemExit(f"{os.path.relpath(page, ROOT)} has no place for the figures of {part.name}")
    write_whole(page, text)
    print(f"figures of {part.name}: {os.path.relpath(page, ROOT)}", flush=True)


def number(pattern: str, text: str) -> int:
    """The integer in the last match of the pattern's group; an error if there is none."""
    found = re.findall(pattern, text)
    if not found:
        raise ValueError(f"the output has nothing like {pattern}")
    return int(found[-1])


def tests_passed(text: str) -> dict[str, Any]:
    """Number of passed tests in the output of one or more runs of CTest."""
    passed = re.findall(r"100% tests passed, 0 tests failed out of (\d+)", text)
    if not passed:
        raise ValueError("not all tests passed")
    return {"tests": sum(map(int, passed))}


def main(parts: dict[str, Part], asked: list[str], only: str = "") -> None:
    unknown = [name for name in asked if name not in parts]
    if unknown:
        sys.exit(f"no part is called {' '.join(unknown)}; there are {', '.join(parts)}")
    failed = sum(run_part(parts[name], only) for name in asked or parts)
    sys.exit(f"{failed} steps failed" if failed else 0)
