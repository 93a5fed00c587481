"""The tables of docs/notes/extremes.md equal the results of the suite of extremes."""

import importlib.util
import os
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
BUILD = Path(os.environ["HOOKE_BUILD_DIR"])

spec = importlib.util.spec_from_file_location("make_extremes", ROOT / "docs/make_extremes.py")
extremes = importlib.util.module_from_spec(spec)
spec.loader.exec_module(extremes)
PAGE = extremes.PAGE.read_text(encoding="utf-8")


def test_page_and_suite_agree():
    found = extremes.differences(extremes.read(PAGE), extremes.measure(BUILD))
    assert not found, "\n".join(found)


def test_page_is_as_it_is_made():
    assert extremes.fill(PAGE, extremes.read(PAGE)) == PAGE


@pytest.mark.parametrize(
    "a, b",
    [
        ("diverged", "solver failed"),
        ("diverged", "1e-03"),
        ("1e-03", "2e-05"),
        ("1e-03", "0e+00"),
        ("1e-03", ""),
        ("nan", "1e-03"),
        ("to the bit", "runs"),
    ],
)
def test_planted(a, b):
    assert not extremes.agree(a, b) and not extremes.agree(b, a)
    page = {"steps": {"0": {"rk4": a}}}
    assert extremes.differences(page, {"steps": {"0": {"rk4": b}}})
    assert extremes.differences(page, {}) or a == ""


@pytest.mark.parametrize("a, b", [("diverged", "diverged"), ("3e-07", "1e-06"), ("2e-14", "0e+00"), ("7e-16", "3e-16")])
def test_fine(a, b):
    assert extremes.agree(a, b) and extremes.agree(b, a)


def test_missing_rows_are_found():
    rows = extremes.read(PAGE)
    family = next(iter(rows))
    case = next(iter(rows[family]))
    fewer = {f: {c: dict(w) for c, w in cases.items() if (f, c) != (family, case)} for f, cases in rows.items()}
    assert extremes.differences(rows, fewer) and extremes.differences(fewer, rows)
