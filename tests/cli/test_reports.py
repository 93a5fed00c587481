"""The option --report of every verb that has it: places that cannot be written, and builds without Chart.js."""

import pytest
from conftest import STIFF_PAIR
from pages import DRAWS, needs_page

VERBS = [["study"], ["why"], *(pytest.param(words, marks=pytest.mark.everything) for words in (
    ["limit", "--predict"], ["needs", "--want", "0.5", "--duration", "0.1", "--every", "0.1"]))]  # fmt: skip


@needs_page
@pytest.mark.parametrize("words", VERBS)
def test_places_that_cannot_be_written(hooke, write, words):
    scene = write(STIFF_PAIR)
    assert hooke(*words, scene, "--report", "nowhere/page.html").code == 5
    assert hooke(*words, scene, "--report", "/dev/null").code == 5
    hooke(*words, scene, "--report", scene, code=2, err="its name has to end in .html; 'hooke make -o' writes a scene")


@pytest.mark.skipif(DRAWS, reason="this build writes reports")
@pytest.mark.parametrize("words", VERBS)
def test_not_in_this_build(hooke, write, words):
    hooke(*words, write(STIFF_PAIR), "--report", "page.html", code=6, err="libjs-chart.js")
