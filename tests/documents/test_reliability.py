"""The promises of docs/notes/reliability.md name existing tests, and `make test-long` fills its numbers."""

import importlib.util
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
PAGE = (ROOT / "docs/notes/reliability.md").read_text(encoding="utf-8")
OTHERS = [(ROOT / "docs" / name).read_text(encoding="utf-8") for name in ("notes/errors.md", "compatibility.md")]  # of one part each
LONG = ROOT / "tests/long"


def promises(page):
    """Rows of the table of promises: promise, means, tests."""
    table = page.split("## Promises")[1].split("\n## ")[0]
    rows = [line.strip("|").split(" | ") for line in table.splitlines() if line.startswith("| ")]
    return [[cell.strip() for cell in row] for row in rows if not set(row[0].strip()) <= {"-"}][1:]


def attackers(row):
    return [name.split("::") for name in re.findall(r"`(tests/[^`*]+?\.(?:c|py)(?:::\w+)?)`", row[-1])]


def missing(page):
    found = []
    for row in promises(page):
        if not attackers(row):
            found.append(f"no test attacks: {row[0]}")
        for path, *test in attackers(row):
            file = ROOT / path
            if not file.is_file() or any(f"def {name}(" not in file.read_text(encoding="utf-8") for name in test):
                found.append("::".join([path, *test]))
    return found


def test_promises_have_their_tests():
    assert len(promises(PAGE)) >= 9
    assert all(len(row) == 3 for row in promises(PAGE))
    assert not missing(PAGE)


@pytest.mark.parametrize("planted", ["| A | b | `tests/unit/test_nothing.c` |", "| A | b | c |",
                                     "| A | b | `tests/documents/test_reliability.py::test_nothing` |"])  # fmt: skip
def test_planted(planted):
    assert missing(PAGE.replace("\n\nThe first promise,", f"\n{planted}\n\nThe first promise,"))


def test_a_tier_names_what_takes_too_long(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "tests"))
    tier = importlib.import_module("tier")
    assert tier.too_long("test", {"a": 3.9, "b": 4.1, "c": 1}) == ["b took 4.1 s, of at most 4.0"]
    many = [tier.too_long("test", {str(k): 2.0 for k in range(count)}) for count in (150, 151)]
    assert many == [[], ["more time than the tier may take"]]
    assert tier.too_long("check", {"b": 60.0}) == [] and len(tier.too_long("check", {"b": 1501.0})) == 1


@pytest.fixture
def steps(monkeypatch, tmp_path):
    monkeypatch.syspath_prepend(str(LONG))
    for name in ("steps", "soak", "fuzz", "fuzz_hdf5", "sanitizers", "arm64", "windows", "bits", "calibration", "wheels", "systems", "mutants"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    spec = importlib.util.spec_from_file_location("steps", LONG / "steps.py")
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, "steps", module)
    spec.loader.exec_module(module)
    monkeypatch.setattr(module, "KEPT", tmp_path / "long")
    monkeypatch.setattr(module, "PAGE", tmp_path / "page.md")
    monkeypatch.setattr(module, "MEASURED", tmp_path / "page.json")
    monkeypatch.setattr(module, "sources", lambda: ("digest", "1234abc"))
    module.PAGE.write_text("<!-- figures of a part -->\nNot run yet.\n<!-- end -->\n<!-- figures of b -->\n<!-- end -->\n")
    return module


def test_parts_have_their_place(steps):
    for name in ("soak", "fuzz", "fuzz_hdf5", "sanitizers", "arm64", "windows", "want", "calibration", "wheels", "systems", "mutants"):
        part = importlib.import_module(name).PART
        page = part.page.read_text(encoding="utf-8") if part.page else PAGE
        assert re.search(rf"<!-- figures of {name} -->\n(?:(?!<!--).)*\n<!-- end -->", page, re.DOTALL)
        assert part.name == name
        assert sum(step.seconds for step in part.steps) < steps.LIMIT


def test_parts_took_no_longer_than_they_have(steps):
    minutes = [int(found) for found in re.findall(r"^\d+ of \d+ steps, (\d+) minutes", PAGE + "".join(OTHERS), re.MULTILINE)]
    ran = [part for part in json.loads((ROOT / "docs/notes/reliability.json").read_text(encoding="utf-8")).values() if part]
    assert len(minutes) == len(ran) >= 5 and 60 * max(minutes) < steps.LIMIT


def test_a_part_goes_on_where_it_was(steps, monkeypatch, capsys):
    """Finished steps are not repeated, a failed one is, and changed sources start anew."""
    ran, wrong = steps.PAGE.parent / "ran", steps.PAGE.parent / "wrong"
    part = steps.Part(
        "a part",
        [],
        [
            steps.Step("one", f"echo one >>{ran}; echo 7", 1, lambda text: {"tests": int(text)}),
            steps.Step("two", f"echo two >>{ran}; test ! -e {wrong}", 1),
            steps.Step("three", f"echo three >>{ran}; echo $HOOKE_LONG; false | cat", 1),
        ],
        lambda name, figures: [(name, str(figures))],
    )
    wrong.touch()
    assert steps.run_part(part) == 2  # `two`, and `three`, whose pipe failed
    assert ran.read_text().split() == ["one", "two", "three"]
    assert "Not run yet, or failed: two; three." in steps.PAGE.read_text()
    assert "FAILED" in capsys.readouterr().out
    wrong.unlink()
    part.steps[2].command = f"echo three >>{ran}"
    assert steps.run_part(part) == 0
    assert ran.read_text().split() == ["one", "two", "three", "two", "three"]
    page = steps.PAGE.read_text()
    assert "3 of 3 steps" in page and re.search(r"\| one \| {'tests': 7} \| [-0-9]+, 1234abc \|", page) and "failed" not in page
    assert "<!-- figures of b -->\n<!-- end -->" in page
    assert steps.run_part(part) == 0 and len(ran.read_text().split()) == 5
    monkeypatch.setattr(steps, "sources", lambda: (str(time.monotonic()), "1234abc"))
    assert steps.run_part(part) == 1  # the sources changed during the step: it does not count, and is the last
    ran.write_text("one two three two three\n")
    monkeypatch.setattr(steps, "sources", lambda: ("another", "5678def"))
    assert steps.run_part(part, "two") == 0 and len(ran.read_text().split()) == 6
    assert re.findall(r"\| (\w+) \|.*, (\w+) \|", steps.PAGE.read_text()) == [
        ("one", "1234abc"), ("two", "5678def"), ("three", "1234abc")]  # fmt: skip
    assert steps.run_part(part) == 0 and len(ran.read_text().split()) == 8
    assert steps.PAGE.read_text().count("5678def") == 3
    monkeypatch.setattr(steps, "sources", lambda: ("a third", "9abcdef"))
    wrong.touch()
    assert steps.run_part(part, "two") == 1
    assert "2 of 3 steps" in steps.PAGE.read_text() and "Not run yet, or failed: two." in steps.PAGE.read_text()


KILLED = """
import sys
sys.path.insert(0, {long!r})
from pathlib import Path
import steps
steps.KEPT, steps.PAGE, steps.sources = Path({here!r}), Path({here!r}) / "page.md", lambda: ("digest", "1234abc")
steps.MEASURED = Path({here!r}) / "page.json"
begun, gate = Path({here!r}) / "begun", Path({here!r}) / "gate"
wait = f"(echo $BASHPID >>{{begun}}; while ! test -e {{gate}}; do sleep 0.05; done) | cat"
steps.run_part(steps.Part("a part", [], [steps.Step("one", f"echo one >>{{begun}}", 1), steps.Step("two", wait, 1)], lambda name, figures: []))
"""


def gone(number):
    try:
        return Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def until(true, seconds=20):
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end
        time.sleep(0.02)


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="a process is told of its parent's end on Linux")
def test_a_killed_part_leaves_nothing_behind_and_goes_on(tmp_path):
    (tmp_path / "page.md").write_text("<!-- figures of a part -->\nNot run yet.\n<!-- end -->\n", encoding="utf-8")
    begun = tmp_path / "begun"
    words = [sys.executable, "-c", KILLED.format(long=str(LONG), here=str(tmp_path))]
    runner = subprocess.Popen(words, stdout=subprocess.DEVNULL)
    until(lambda: begun.exists() and len(begun.read_text(encoding="utf-8").split()) == 2)
    inner = begun.read_text(encoding="utf-8").split()[1]
    assert not gone(inner)
    second = subprocess.run(words, capture_output=True, text=True, check=True, timeout=60)
    assert second.stdout == "a part is running already\n"
    runner.kill()
    runner.wait()
    until(lambda: gone(inner))
    (tmp_path / "gate").touch()
    subprocess.run(words, stdout=subprocess.DEVNULL, check=True, timeout=60)
    assert [line == "one" for line in begun.read_text(encoding="utf-8").split()] == [True, False, False]
    assert "2 of 2 steps" in (tmp_path / "page.md").read_text(encoding="utf-8")
