"""Every key of a JSON result is in the documentation."""

import re
from pathlib import Path

import pytest
from conftest import METHODS, SIX_PARTICLES
from test_study_watched import DOUBLE

pytestmark = pytest.mark.everything

DOCS = Path(__file__).parents[2] / "docs"
VERBS = {
    "run": ["--want", "1cm", "--final", "-o", "out.h5"],
    "compare": ["--methods", "verlet"],
    "study": ["--methods", "rk4", "--steps", "2ms", "--want", "1cm", "--budget", "3s"],
    "limit": ["--methods", "symplectic-euler,rk4"],
    "rest": ["--final", "--watch", "2.y"],
    "modes": [],
    "needs": ["--want", "1cm", "--method", "rk4"],
    "why": ["--step", "0.3", "--every", "0.3", "--duration", "30"],
    "check": ["--cost", "--budget", "0.1s"],
}


def keys_of(value):
    if isinstance(value, list):
        return set().union(*map(keys_of, value))
    if not isinstance(value, dict):
        return set()
    return set(value).union(*map(keys_of, value.values()))


def documented(verb):
    """The words of a verb's section in the page of the command line, and those of the section on JSON."""
    text = (DOCS / "command-line.md").read_text().split("## JSON", 1)[1]
    title = "`study` and `compare`" if verb in ("study", "compare") else f"`{verb}`"
    part = re.split(rf"\n{title}(?:, with [^\n]*)?:\n", text)[1]
    return set(re.findall(r"\w+", re.split(r"\n`\w+`(?:, with [^\n]*)?:\n", part)[0]))


@pytest.mark.parametrize("verb", VERBS)
def test_keys_are_documented(hooke, write, verb):
    value = hooke(verb, write(SIX_PARTICLES), *VERBS[verb], "--json").json
    names = {*METHODS, "edges"}
    assert keys_of(value) - documented(verb) - names == set()


def test_keys_of_statistics_are_documented(hooke, write):
    words = ["--duration", 40, "--every", 0.1, "--methods", "rk4", "--steps", "2ms", "--watch", "2.y", "--ensemble", 2]
    value = hooke("study", write(DOUBLE), *words, "--json").json
    assert value["statistics"] is not None
    assert keys_of(value) - documented("study") - set(METHODS) == set()
