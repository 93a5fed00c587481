"""Plants small faults one at a time and tells whether a test notices: python tests/long/mutants.py [--count N] [--seed N] [PATH...]

The faults are those of universalmutator, a sample by seed of the files below PATH. They are planted in a copy of the
sources, build/mutants/tree. One that does not compile, or leaves the library and the program as they are, does not
count, nor does one in a comment or in the text of a message, nor one of mutants_equal.txt. The others are run against
the quick tests that reach the line and all with the name of the room or of the file, the shortest first, until one
fails. What is known is kept in build/mutants and goes on from there.
"""

from __future__ import annotations

import argparse
import ast
import difflib
import hashlib
import json
import math
import os
import random
import re
import shutil
import subprocess
import sys
from collections import defaultdict
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from steps import ROOT, Part, Step
from tier import seconds

KEPT = ROOT / "build/mutants"
TREE, REACHED, RESULTS = KEPT / "tree", KEPT / "reached", KEPT / "results.json"
BUILD, COVERED = TREE / "build/release", TREE / "build/covered"
ROOMS = ("src", "cli", "bindings/python/src")
EQUAL = Path(__file__).with_name("mutants_equal.txt")
NO_CODE = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\s+', re.DOTALL)


def call(*words: str | Path, **more: Any) -> subprocess.CompletedProcess[str]:
    return subprocess.run([str(word) for word in words], cwd=TREE, capture_output=True, text=True, errors="replace", **more)


def built(*targets: str, build: Path = BUILD) -> bool:
    return call("cmake", "--build", build, "-j", str(os.cpu_count()), "--target", *targets).returncode == 0


# ---- before the first fault ----


def copy_sources() -> None:
    """Files that are as they were keep their dates, so that little is compiled again; what tests reach of others is
    looked at anew."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    names = [name for name in listed.split("\0") if name]
    copied = {path for top in TREE.glob("*") if top.name != "build" for path in top.rglob("*") if path.is_file()}
    for left in copied - {TREE / name for name in names}:
        left.unlink()
    for name in names:
        source, copy = ROOT / name, TREE / name
        if not copy.is_file() or copy.read_bytes() != source.read_bytes():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, copy)
            shutil.rmtree(REACHED, ignore_errors=True)
    (TREE / "build").mkdir(exist_ok=True)
    if not (TREE / "build/venv").exists():
        (TREE / "build/venv").symlink_to(ROOT / "build/venv")


def configure() -> None:
    plain = ("-DCMAKE_C_FLAGS_RELWITHDEBINFO=-O2 -DNDEBUG", "-DCMAKE_LINK_DEPENDS_NO_SHARED=ON")
    for build, options in ((BUILD, plain), (COVERED, ("-DCMAKE_C_FLAGS=--coverage",))):
        if call("cmake", "--preset", "release", "-B", build, *options).returncode or not built("tests", build=build):
            raise SystemExit(f"{build} could not be built")


def tests_of(preset: str) -> list[str]:
    told = call("ctest", "--preset", preset, "--show-only=json-v1").stdout
    return [test["name"] for test in json.loads(told)["tests"]]


def file_of(test: str) -> str:
    return test.replace("/", ".")


def see_reached(test: str) -> None:
    folder = REACHED / file_of(test)
    if not folder.exists():
        call("ctest", "--test-dir", COVERED, "-R", f"^{test}$", env={**os.environ, "GCOV_PREFIX": str(folder)})


def prepare() -> dict[str, float]:
    """The quick tests that pass, with what they take of the processor [s], and the others, of which that is not known."""
    copy_sources()
    configure()
    tests = tests_of("release")
    run_tests(tests, stop=False)
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        list(pool.map(see_reached, tests))
    failed = {line.split(":", 1)[1].strip() for line in last_failed()}
    times = {test: BUILD / "tests/taken" / file_of(test) for test in tests if test not in failed}
    known = {test: seconds(path) if path.exists() else 0.0 for test, path in times.items()}
    return known | dict.fromkeys(tests_of("check"), math.inf)


# ---- a fault ----


def code(text: str) -> str:
    return NO_CODE.sub(lambda found: '""' if found[0].startswith('"') else " ", text)


def python_code(text: str) -> str:
    """Without texts and types."""
    tree = ast.parse(text)
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            node.value = ""
        for types in {"annotation", "returns"} & set(node._fields):
            setattr(node, types, None)
    return ast.dump(tree)


def is_other_code(path: Path, before: str, after: str) -> bool:
    if path.suffix != ".py":
        return code(before) != code(after)
    try:
        return python_code(before) != python_code(after)
    except SyntaxError:
        return False


def faults(path: Path, scratch: Path) -> list[str]:
    """Texts of the file with one fault each."""
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    call(KEPT / "tools/bin/mutate", path, "python" if path.suffix == ".py" else "c", "--noCheck", "--mutantDir", scratch)
    before = path.read_text()
    texts = [made.read_text() for made in sorted(scratch.iterdir())]
    return [text for text in texts if is_other_code(path, before, text)]


def change(before: str, after: str) -> tuple[int, str, str]:
    """The first line that differs, by its number, and its two texts."""
    old, new = before.splitlines(), after.splitlines()
    _, first, end, first_new, end_new = next(step for step in difflib.SequenceMatcher(None, old, new, False).get_opcodes()
                                             if step[0] != "equal")  # fmt: skip
    return first + 1, "\n".join(old[first:end]).strip(), "\n".join(new[first_new:end_new]).strip()


def fingerprint() -> bytes:
    """Of what is installed, where a fault that changes nothing leaves no trace."""
    files = [BUILD / "hooke", *sorted(BUILD.glob("libhooke.so.*")), *sorted((BUILD / "python").rglob("*.py"))]
    return hashlib.sha256(b"".join(file.read_bytes() for file in files if file.is_file())).digest()


def objects_of(path: str) -> list[str]:
    """Objects with code of this file, which may be a header, and those for each instruction set."""
    told, found, name = call("ninja", "-C", COVERED, "-t", "deps").stdout, [], ""
    for line in told.splitlines():
        if not line.startswith(" "):
            name = line.split(":")[0]
        elif (COVERED / line.strip()).resolve() == TREE / path and name.startswith("CMakeFiles/"):
            found.append(name)
    return found


def reaches(test: str, objects: list[str], path: str, line: int) -> bool:
    for name in objects:
        data = Path(f"{REACHED / file_of(test)}{COVERED / name}").with_suffix(".gcda")
        notes = data.with_suffix(".gcno")
        if not data.exists():
            continue
        if not notes.exists():
            notes.symlink_to((COVERED / name).with_suffix(".gcno"))
        told = call("gcov", "--json-format", "--stdout", data.resolve()).stdout
        for file in json.loads(told)["files"] if told.startswith("{") else []:
            if (COVERED / file["file"]).resolve() == TREE / path:
                if any(row["count"] and row["line_number"] == line for row in file["lines"]):
                    return True
    return False


def asked(tests: dict[str, float], path: str, line: int) -> list[str]:
    """Quick tests that reach the line and all that have the name of its file or room, the shortest first."""
    words = {Path(path).stem, Path(path).parent.name}
    quick = [test for test, time in tests.items() if time < math.inf]
    if path.endswith(".py"):
        found = {test for test in quick if test.startswith("python/")}
    elif path.startswith("cli/"):
        found = {test for test in quick if test.startswith(("cli/", "guest/"))}
    else:
        objects = objects_of(path)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            found = {test for test, yes in zip(quick, pool.map(lambda test: reaches(test, objects, path, line), quick)) if yes}
    found |= {test for test in tests if words & set(re.split(r"[/_]", test))}
    return sorted(found, key=tests.__getitem__)


def last_failed() -> list[str]:
    listed = BUILD / "Testing/Temporary/LastTestsFailed.log"
    return listed.read_text().splitlines() if listed.exists() else []


def run_tests(tests: list[str], stop: bool = True) -> str | None:
    """The test that failed first."""
    (BUILD / "Testing/Temporary/LastTestsFailed.log").unlink(missing_ok=True)
    names = "|".join(map(re.escape, tests))
    call("ctest", "--test-dir", BUILD, "-j", str(os.cpu_count()), "--timeout", "100", "-R", f"^({names})$",
         *(["--stop-on-failure"] if stop else []))  # fmt: skip
    failed = last_failed()
    return failed[0].split(":", 1)[1].strip() if failed else None


def noticed_by(tests: list[str]) -> str | None:
    for first, end in ((0, 8), (8, 40), (40, len(tests))):
        if tests[first:end] and (found := run_tests(tests[first:end])):
            return found
    return None


def plant(path: str, text: str, tests: dict[str, float]) -> dict[str, Any] | None:
    """What came of a fault; None if it does not count."""
    file = TREE / path
    before = file.read_text()
    line, old, new = change(before, text)
    if f"{path} | {old} | {new} |" in (EQUAL.read_text() if EQUAL.exists() else ""):
        return None
    built("hooke", "hooke_cli", "hooke_python")
    sound = fingerprint()
    try:
        file.write_text(text)
        if not built("hooke", "hooke_cli", "hooke_python") or fingerprint() == sound:
            return None
        by = noticed_by(asked(tests, path, line)) if built("tests") else "compiler"
        return {"path": path, "line": line, "before": old, "after": new, "by": by}
    finally:
        file.write_text(before)


# ---- the sample ----


def sample(paths: list[str], seed: int) -> Any:
    """Endless: (path, text with a fault), files by their size."""
    files = [file for path in paths for file in sorted([TREE / path] if (TREE / path).is_file() else (TREE / path).rglob("*"))
             if file.suffix in (".c", ".h", ".py")]  # fmt: skip
    drawn = random.Random(seed)
    while files:
        file = drawn.choices(files, [path.stat().st_size for path in files])[0]
        texts = faults(file, KEPT / "scratch")
        if texts:
            yield str(file.relative_to(TREE)), drawn.choice(texts)


def room(path: str) -> str:
    return "/".join(path.split("/")[:2]) if path.startswith("src/") else next(r for r in ROOMS if path.startswith(r))


def table(results: list[dict[str, Any]]) -> dict[str, tuple[int, int]]:
    """Noticed and planted, by room."""
    counts: dict[str, list[bool]] = defaultdict(list)
    for result in results:
        counts[room(result["path"])].append(bool(result["by"]))
    return {name: (sum(found), len(found)) for name, found in sorted(counts.items())}


def say(result: dict[str, Any]) -> None:
    print(f"{result['path']}:{result['line']}: {result['before']}\n    -> {result['after']}\n    "
          f"{result['by'] or 'NOT NOTICED'}", flush=True)  # fmt: skip


def main(count: int, seed: int, paths: list[str]) -> None:
    tests = prepare()
    known = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    results: list[dict[str, Any]] = []
    for path, text in sample(paths, seed):
        key = hashlib.sha256(f"{path} {text}".encode()).hexdigest()
        if key not in known:
            known[key] = plant(path, text, tests)
            RESULTS.write_text(json.dumps(known, indent=1))
        if known[key] and known[key] not in results:
            results.append(known[key])
            say(known[key])
        if len(results) == count:
            break
    for name, (found, planted) in table(results).items():
        print(f"{name}: {found} of {planted} noticed")
    print(f"all: {sum(bool(result['by']) for result in results)} of {len(results)} noticed")


# ---- a part of `make test-long` ----


def figures(text: str) -> dict[str, Any]:
    return {name: f"{found} of {planted}" for name, found, planted in re.findall(r"^(\S+): (\d+) of (\d+) noticed$", text, re.M)}


PART = Part("mutants", [], [Step("planted faults", "make mutants N=200", 8400, figures)],
            lambda step, known: [(f"{step} noticed, {name}", words) for name, words in known.items()])  # fmt: skip

if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("path", nargs="*", default=list(ROOMS))
    options = parser.parse_args()
    main(options.count, options.seed, options.path)
