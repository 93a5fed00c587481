"""Displayed numbers have at most 6 digits; those of a command to type, and of every particle, read back to the same
bits."""

import re

import pytest
from conftest import SIX_PARTICLES

pytestmark = pytest.mark.everything

ODD = {"step": 1e-3 / 3, "every": 0.1 / 3, "duration": 0.1}
VERBS = [
    ("run", "-o", "out.h5"),
    ("run", "--final"),
    ("run", "--method", "cvode-bdf", "--rtol", str(1e-4 / 3)),
    ("run", "--want", "1mm"),
    ("run", "--step", "0.3", "--every", "0.3", "--duration", "30"),
    ("run", "--step", "0.0007"),
    ("compare", "--methods", "verlet,rk4"),
    ("study", "--methods", "verlet", "--want", "1mm"),
    ("limit", "--predict"),
    ("why", "--step", "0.3", "--every", "0.3", "--duration", "30"),
    ("needs", "--want", "1cm", "--method", "rk4"),
    ("check", "--cost", "--budget", "0.1s"),
]


def too_long(text):
    """The numbers of more than 6 significant digits that have a fraction or an exponent."""
    numbers = re.findall(r"(?<![\w.])-?\d+\.?\d*(?:e[-+]?\d+)?(?![\w.]*\.h5)", text)
    return [n for n in numbers if re.search(r"[.e]", n) and len(re.sub(r"e.*|\D", "", n).strip("0")) > 6]


@pytest.mark.parametrize("words", VERBS, ids=" ".join)
def test_words_have_six_digits(hooke, write, words):
    scene = write(SIX_PARTICLES, **ODD)
    answer = hooke(words[0], scene, *words[1:])
    assert answer.code in (0, 4), answer.err
    table = r"(?<=vz \[m/s\]\n)(?:\d.*\n)+"  # of --final: it reads back
    told = [line for line in (re.sub(table, "", answer.out) + answer.err).splitlines() if " hooke run " not in line]
    assert len(told) > 5
    assert not too_long("\n".join(told))


def test_verify_and_view_have_six_digits(hooke, write):
    assert hooke("run", write(SIX_PARTICLES, **ODD), "-o", "out.h5").code == 0
    for words in [("verify", "out.h5"), ("view", "out.h5", "-o", "out.html")]:
        answer = hooke(*words)
        assert answer.code == 0 and not too_long(answer.out + answer.err)


def test_a_step_to_type_has_every_digit(hooke, write):
    answer = hooke("run", write(SIX_PARTICLES, step=0.0007), "--strict")
    assert answer.code == 3
    steps = [float(word) for word in re.findall(r"0\.000\d+", answer.err.split("fit are")[1])]
    assert len(steps) == 2
    for step in steps:
        assert hooke("run", write(SIX_PARTICLES), "--strict", "--step", repr(step)).code == 0
