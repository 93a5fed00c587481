"""Pages and headers say of methods what the table of methods says."""

import os
import re
from fnmatch import fnmatch
from pathlib import Path

import pytest

import hooke

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
DESIGN = (ROOT / "docs/design.md").read_text(encoding="utf-8")
TAKES = {method.name: method.bodies for method in hooke.methods()}


def named(row):
    """The methods of a row of the table, of whose words some are patterns, and some options follow a name."""
    patterns = re.findall(r"`([\w*-]+)`(?! with)", row.split("|")[1])
    return {name for name in TAKES if any(fnmatch(name, pattern) for pattern in patterns)}


def complaints(page):
    *taken, refused = page.split("| method | with bodies |\n| --- | --- |\n")[1].split("\n\n")[0].split("\n")
    found = set().union(*map(named, taken))
    return {name for name, takes in TAKES.items() if takes != (name in found) or (not takes and name not in named(refused))}


def listed(header):
    """Comments that name so many methods that they can only be a list."""
    comments = re.findall(r"/\*.*?\*/", header, re.DOTALL)
    return [text for text in comments if sum(bool(re.search(rf"(?<![\w-]){name}(?![\w-])", text)) for name in TAKES) > 2]


def test_the_table_of_bodies_has_every_method():
    assert len(TAKES) > 10 and complaints(DESIGN) == set()


@pytest.mark.parametrize("old, new, name", [("`heun`, ", "", "heun"), ("| `shardlow`; ", "| ", "shardlow"),
                                            ("| `verlet` |", "| `verlet`, `shardlow` |", "shardlow")])
def test_planted(old, new, name):
    assert old in DESIGN and complaints(DESIGN.replace(old, new)) == {name}


def test_headers_list_no_methods():
    headers = [path.read_text(encoding="utf-8") for path in (ROOT / "include").rglob("*.h")]
    assert headers and not [text for header in headers for text in listed(header)]
    assert listed("/* Methods: heun, rk4 and verlet. */") and not listed("/* heun and rk4, not verlet_damping. */")
