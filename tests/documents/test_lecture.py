"""docs/lecture.md: its figures, its commands, its Python and its C have the same numbers, and those are right."""

import math
import os
import re
import subprocess
import sys

import numpy as np
import pytest
from pages import ROOT, script

import hooke

BUILT = ROOT / "build/playground"
PAGE = (ROOT / "docs/lecture.md").read_text(encoding="utf-8")
SECTIONS = {re.search(r"images/lecture-(\w+)\.svg", part)[1]: part for part in PAGE.split("\n## ")[1:]}
FUNCTION = {name: re.search(r"In C: \[(\w+)\(\)\]", part)[1] for name, part in SECTIONS.items()}
ENGINE = pytest.mark.skipif(not (BUILT / "hooke.wasm").exists(), reason="the playground is not built (`make playground`)")


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    to, library = tmp_path_factory.mktemp("lecture") / "lecture", os.environ["HOOKE_LIBRARY"]
    subprocess.run([os.environ["HOOKE_CC"], "-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", f"-I{ROOT}/include", ROOT / "examples/c/lecture.c",
                    library, f"-Wl,-rpath,{os.path.dirname(library)}", "-lm", "-o", to], check=True)
    return to


def numbers(command):
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    return [float(word) for word in done.stdout.split()]


@pytest.fixture(scope="module")
def in_python():
    """What the blocks of each section print, in one process."""
    code = "".join(f"print({name!r})\n" + "".join(re.findall(r"```python\n(.*?)```", part, re.DOTALL)) for name, part in SECTIONS.items())
    code = code.replace('axes.figure.savefig("river.png")', "")
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    return {line[0]: [float(word) for word in line[1:]] for line in map(str.split, re.split(r"\n(?=[a-z])", done.stdout))}


def test_every_figure_has_its_section():
    figures = re.findall(r'^  (?:\{ name: |timed\()"(\w+)",', (ROOT / "docs/lecture/figures.js").read_text(encoding="utf-8"), re.MULTILINE)
    assert figures == list(SECTIONS) and len(SECTIONS) == 17


@pytest.mark.parametrize("name", SECTIONS)
def test_c_and_python_agree(program, in_python, name):
    own, other = in_python[name], numbers([program, {"leaf": "river"}.get(FUNCTION[name], FUNCTION[name])])
    assert own and other[:len(own)] == pytest.approx(own, rel=1e-9, abs=1e-12)


@ENGINE
def test_figures_agree(in_python):
    drawn = script("make_lecture").ask(BUILT, script("make_lecture").DRAWN)
    assert list(drawn) == list(SECTIONS)
    for name, figure in drawn.items():
        assert figure["numbers"] and in_python[name][:len(figure["numbers"])] == pytest.approx(figure["numbers"], rel=1e-9, abs=1e-12), name
        shown = re.findall(r"```console\n(.*?)```", SECTIONS[name], re.DOTALL)
        printed = [float(word) for word in re.findall(r"(?<![\w.])-?\d+\.\d+(?:e-?\d+)?\b", " ".join(shown))]
        if shown and name != "errors":  # whose command is of another problem
            assert any(figure["numbers"][0] == pytest.approx(word, rel=1e-4) for word in printed), name
        picture = (ROOT / f"docs/images/lecture-{name}.svg").read_text(encoding="utf-8")
        assert "NaN" not in picture and picture.count("<svg") == figure["file"].count("<svg"), name


@ENGINE
def test_regions_are_those_of_theory():
    """Radii along angles from the positive axis, for eigenvalues z and their conjugates."""
    half, damped = math.sqrt(0.5), 2 * (math.sqrt(1.5) - math.sqrt(0.5))
    known = [("forward-euler", 1, 2), ("forward-euler", 0.75, 2 * half), ("heun", 1, 2), ("rk4", 1, 2.785293563405282),
             ("rk4", 0.5, 2 * math.sqrt(2)), ("symplectic-euler", 0.5, 2), ("symplectic-euler", 0.75, damped), ("verlet", 0.5, 2),
             ("backward-euler", 0.75, None), ("tr-bdf2", 0.75, None), ("implicit-midpoint", 0.75, None)]
    rows = ", ".join(f'edgeOf(library, "{method}", {angle} * Math.PI)' for method, angle, _ in known)
    for (method, angle, radius), found in zip(known, script("make_lecture").ask(BUILT, f"[{rows}]"), strict=True):
        assert found == (None if radius is None else pytest.approx(radius, abs=1e-3)), (method, angle)
    inside, beyond = script("make_lecture").ask(BUILT, """[0.9, 1.1].map((r) => {
      const factor = new Factor(library, "backward-euler"); return factor.at(1 + r * Math.cos(2), r * Math.sin(2)); })""")
    assert inside == pytest.approx(1 / 0.9, abs=1e-6) and beyond == pytest.approx(1 / 1.1, abs=1e-6)  # of 1/(1 - z)


@ENGINE
def test_orders():
    """Of flows with an exact solution, at the end and of one step; of a chain whose particles move in turn, of its momentum, too."""
    lists = """{ flows: ["river", "linear"].flatMap((name) => FIRST_ORDER.map((method, k) => [[1, 2, 4][k],
      ...[errorAtEnd, errorOfStep].map((of) => slopeOf([0.02, 0.01].map((h) => [h, of(library, name, method, h)])))])),
      chains: [false, true].map((way) => slopeOf(chainErrors(library, way).slice(-2))),
      drift: slopeOf([0.01, 0.005].map((h) => [h, chain(library, h, true).rows.at(-1)[1]])),
      kept: chain(library, 0.01, false).rows.at(-1)[1] }"""
    found = script("make_lecture").ask(BUILT, lists)
    for order, end, step in found["flows"]:
        assert end == pytest.approx(order, abs=0.1) and step == pytest.approx(order + 1, abs=0.1)
    assert found["chains"] == pytest.approx([1, 1], abs=0.15) and found["drift"] == pytest.approx(1, abs=0.1) and found["kept"] < 1e-12


def test_flows_by_name(program):
    """Of the example in C, against Python."""
    a = -0.2 + 2j
    flows = [(lambda t, x, rate: rate.__setitem__(slice(None), [1, np.cos(x[0]) - (x[1] - np.sin(x[0])) / 2]), [0, 1]),
             (lambda t, x, rate: rate.__setitem__(slice(None), [(a * complex(*x)).real, (a * complex(*x)).imag]), [1, 0]),
             (lambda t, x, rate: rate.__setitem__(slice(None), [x[1], (1 - x[0] ** 2) * x[1] - x[0]]), [0.5, 0])]
    ends = [hooke.FirstOrder(phi, x).run(method="forward-euler", step=0.5, duration=6).state.x for phi, x in flows]
    assert numbers([program, "river"]) == pytest.approx(np.ravel(ends), rel=1e-9)
