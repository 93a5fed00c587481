"""Progress bars, and objects that close."""

import os
import subprocess
import sys

import pytest
from conftest import PACKAGES, SIX_PARTICLES, build_oscillator

import hooke

SHORT = {"duration": 0.05, "every": 0.01}
WORK = {
    "run": lambda **options: hooke.Scene.parse(SIX_PARTICLES).run(**SHORT, **options),
    "compare": lambda **options: hooke.compare(hooke.Scene.parse(SIX_PARTICLES), ["verlet"], **SHORT, **options),
    "study": lambda **options: hooke.study(hooke.Scene.parse(SIX_PARTICLES), ["verlet"], points=6, **SHORT, **options),
    "limit": lambda **options: hooke.limit(hooke.Scene.parse(SIX_PARTICLES), methods="verlet", **options),
    "cost": lambda **options: hooke.cost(build_oscillator(), budget=0.5, method="verlet", step=1e-3, **options),
    "needs": lambda **options: hooke.needs(hooke.Scene.parse(SIX_PARTICLES), 0.1, duration=0.5, **options),
}


@pytest.mark.parametrize("what", WORK)
def test_a_bar_that_fills(what, capsys):
    WORK[what](progress=True)
    shown = capsys.readouterr().err
    assert "100%" in shown and shown.lstrip("\r").startswith("  0%")


def test_a_bar_stays_where_a_run_ended(capsys):
    WORK["run"](progress=True, on_step=(1, lambda step, state: step == 25))
    shown = capsys.readouterr().err
    assert " 40%" in shown and "100%" not in shown


@pytest.mark.parametrize("progress", [False, None])
def test_no_bar(progress, capsys):
    WORK["run"](progress=progress)
    WORK["limit"](progress=progress)
    assert capsys.readouterr().err == ""


def test_a_bar_needs_tqdm_and_says_so():
    code = """
import sys
sys.modules["tqdm.auto"] = None
import hooke
calls = []
hooke.FirstOrder(lambda t, x, rate: calls.append(t), [1.0]).run(
    method="rk4", step=0.1, duration=1, progress=lambda fraction, state: None)
print(len(calls))
hooke.FirstOrder(lambda t, x, rate: calls.append(t), [1.0]).run(method="rk4", step=0.1, duration=1, progress=True)
"""
    environment = {**os.environ, "PYTHONPATH": str(PACKAGES)}
    run = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)
    assert run.stdout == "40\n" and run.returncode
    assert 'ImportError: progress=True shows a bar of tqdm, which is not installed: pip install "libhooke[progress]"' in run.stderr


def test_an_integrator_closes():
    system = build_oscillator()
    state = system.state()
    with hooke.Integrator(system, method="verlet", step=1e-3) as integrator:
        assert integrator.step(state, 10) == "finished"
        options = integrator.options
    for use in (integrator.step, integrator.run):
        with pytest.raises(hooke.BadCall, match="this Integrator is closed"):
            use(state)
    with pytest.raises(hooke.BadCall):
        integrator.counts
    integrator.close()
    assert options["method"] == "verlet"  # arrays obtained before stay
    assert state.t == pytest.approx(0.01, rel=1e-12)
    with pytest.raises(AttributeError, match="'Integrator' object has no attribute 'nothing'"):
        integrator.nothing


def test_a_study_closes():
    with WORK["study"]() as study:
        assert len(study.rows) == 6
    assert study.error[0] > 0
    with pytest.raises(hooke.BadCall, match="this Study is closed"):
        study.series(0)
