"""The tables of docs/notes/validation.md equal the results of the library."""

import importlib.util
import os
from pathlib import Path

import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])

spec = importlib.util.spec_from_file_location("make_validation", ROOT / "docs/make_validation.py")
validation = importlib.util.module_from_spec(spec)
spec.loader.exec_module(validation)


def test_page_and_library_agree():
    found = validation.differences(validation.PAGE.read_text(encoding="utf-8"), validation.made())
    assert not found, "\n".join(found)


def test_orders_over_contacts_are_what_the_pages_state():
    """At most 2 where the force of contact has a kink, 1 where damping makes it jump."""
    table = validation.PAGE.read_text(encoding="utf-8").split("<!-- table: contacts -->")[1].split("<!-- end -->")[0]
    rows = [[float(number) for number in row.split("|")[2:5]] for row in table.strip().splitlines()[2:]]
    assert len(rows) == 8 and {own for own, _, _ in rows} == {1, 2, 4}
    for own, kink, jump in rows:
        assert abs(kink - min(own, 2)) < 0.2 and abs(jump - 1) < 0.2


@pytest.mark.parametrize("a, b", [("| 1.5e-06 |", "| 1.6e-06 |"), ("| verlet | 1 |", "| rk4 | 1 |"), ("| 1e-9 |", "| 0 |")])
def test_planted(a, b):
    assert validation.differences(a, b) and validation.differences(a, a + "\n" + a)


@pytest.mark.parametrize("a, b", [("| 1.500e-06 |", "| 1.501e-06 |"), ("| 1e-16 |", "| 3e-15 |")])
def test_fine(a, b):
    assert not validation.differences(a, b)
