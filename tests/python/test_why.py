"""hooke.why: runs that blew up, as objects; and the warning before."""

import math
import warnings

import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator

import hooke

# sqrt(k/m) = 10: symplectic Euler is stable up to 0.2 s
TOO_LARGE = dict(method="symplectic-euler", step=0.21, duration=21, every=0.21)


@pytest.fixture
def oscillator():
    return build_oscillator(k=50, m=0.5)


@pytest.fixture
def quiet():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", hooke.StepWarning)
        yield


def test_a_result_that_diverged(oscillator, quiet):
    result = hooke.run(oscillator, **TOO_LARGE)
    assert result.status == "diverged"
    why = hooke.why(result)
    assert why.cause == "step-above-limit" and why.method == "symplectic-euler"
    assert why.sentence == result.diagnosis
    assert why.limit == pytest.approx(0.2, rel=1e-6) and why.step == 0.21
    assert why.time == result.state.t and why.noticed == result.diverged_at
    assert why.blame == [(0, (0, 1), "spring", pytest.approx(1), "")]
    assert why.particle == 1
    assert "step" in why.advice[0].options
    again = hooke.run(oscillator, **{**TOO_LARGE, **why.advice[0].options})
    assert again.status == "finished"
    assert str(why).replace("\n", "; ") == why.sentence and [claim.key for claim in why.claims] == ["cause", "course"]


def test_frames_after_divergence(oscillator, quiet, tmp_path):
    usual = hooke.run(oscillator, **TOO_LARGE, output=tmp_path / "usual.h5")
    result = hooke.run(oscillator, **TOO_LARGE, output=tmp_path / "out.h5", past_divergence=True)
    assert result.status == "diverged" and result.diverged_at == usual.diverged_at
    assert np.array_equal(result.state.q, usual.state.q)
    with hooke.open(tmp_path / "out.h5") as out, hooke.open(tmp_path / "usual.h5") as short:
        assert out.beyond == slice(len(short), len(out)) and len(out) > len(short) == short.beyond.start
        assert np.array_equal(out.q[: len(short)], short.q) and np.isfinite(out.q[out.beyond]).all()
        assert out.t[out.beyond][0] == result.diverged_at
    few = hooke.run(oscillator, **TOO_LARGE, frames=True, frames_after=3)
    assert (few.frames.t >= few.diverged_at).sum() == 3


def test_the_page(oscillator, quiet, tmp_path):
    why = hooke.why(hooke.run(oscillator, **TOO_LARGE))
    page = tmp_path / "why.html"
    try:
        why.write(page, title="two particles")
    except hooke.NotBuilt:
        pytest.skip("this build writes no pages")
    text = page.read_text(encoding="utf-8")
    assert "two particles" in text and '"frames":[{"time":0,' in text.replace(" ", "")
    assert why.report(tmp_path / "report.html").exists() and "srcdoc=" in why._repr_html_()
    why.write(tmp_path / "why.json")
    assert why.sentence in (tmp_path / "why.json").read_text(encoding="utf-8")


def test_a_result_that_finished(oscillator):
    result = hooke.run(oscillator, step=0.01, duration=1)
    assert result.diagnosis == "" and result.integrator is None
    assert hooke.why(result) is None


def test_a_scene_is_run(quiet):
    scene = hooke.Scene.parse(SIX_PARTICLES)
    assert hooke.why(scene) is None
    why = hooke.why(scene, step=0.5, every=0.5, duration=50)
    assert why.cause == "step-above-limit" and why.blame[0].group == "edges"


def test_a_solver_that_failed():
    system = hooke.System()
    system.set_gravity([0, -9.81, 0])
    system.add_particles([[0, 0, 0], [0, -0.9, 0]], mass=1)
    system.pin(0)
    system.add_springs(
        "cable", [[0, 1]], law="length", stiffness=1000, damping=1e6, rest_length=1, compression=False
    )
    options = dict(method="backward-euler", step=0.01, duration=4)
    with pytest.raises(hooke.SolverFailed) as caught:
        hooke.run(system, **options)
    why = hooke.why(caught.value)
    assert why.cause == "solver-failed" and str(caught.value).partition("; ")[0] in why.sentence
    assert caught.value.diagnosis == why.sentence
    assert hooke.why(system, **options).sentence == why.sentence
    assert math.isinf(why.limit)
    assert hooke.run(system, **{**options, **why.advice[0].options}).status == "finished"


def test_a_force_that_is_not_finite():
    def force(t, q, v, out):
        if t > 0.5:
            out[1, 0] = np.nan

    system = build_oscillator()
    system.set_force(force)
    result = hooke.run(system, method="verlet", step=0.01, duration=1)
    why = hooke.why(result)
    assert why.cause == "force-not-finite" and why.particle == 1
    assert 0.47 < why.time <= 0.51
    assert why.advice[0].options["duration"] < 0.51
    assert why.advice[1].options == {} and "callback" in why.advice[1].change


def test_an_exception_of_a_callback_comes_out():
    def force(t, q, v, out):
        if broken:
            raise LookupError("not now")
        out[1, 0] = np.inf if t > 0.5 else 0

    system, broken = build_oscillator(), False
    system.set_force(force)
    result = hooke.run(system, method="verlet", step=0.01, duration=1)
    broken = True
    with pytest.raises(LookupError, match="not now"):
        hooke.why(result)


def test_a_first_order_problem_has_only_its_message():
    def rate(t, x, out):
        out[:] = x * x

    result = hooke.FirstOrder(rate, [1.0]).run(method="forward-euler", step=0.1, duration=10)
    assert result.status == "diverged" and result.diagnosis == result.message
    with pytest.raises(hooke.Unsuited):
        hooke.why(result)


# ---- warnings ----


@pytest.mark.parametrize("step, words", [(0.192, "within 5 %"), (0.21, "is above"), (0.18, None)])
def test_a_step_near_the_limit_warns(oscillator, step, words):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        hooke.run(oscillator, step=step, duration=10 * step)
    texts = [str(one.message) for one in caught if issubclass(one.category, hooke.StepWarning)]
    assert len(texts) == (words is not None)
    if words:
        assert words in texts[0] and "spring 0 (particles 0 and 1, group spring)" in texts[0]


def test_a_warning_may_be_an_error(oscillator):
    with warnings.catch_warnings():
        warnings.simplefilter("error", hooke.StepWarning)
        with pytest.raises(hooke.StepWarning, match="is above"):
            hooke.run(oscillator, **TOO_LARGE)
    assert hooke.run(oscillator, step=0.01, duration=1).status == "finished"
