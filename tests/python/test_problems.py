"""Studies, estimates and wanted errors of first- and second-order problems."""

import re

import matplotlib
import numpy as np
import pytest

import hooke

RUN = {"duration": 2.0, "every": 0.1}


def turn(t, x, rate):
    rate[:] = 1j * x - 0.5 * x


def swing(t, q, v, force):
    force -= np.sin(q)


matplotlib.use("Agg")
TURN, SWING = hooke.FirstOrder(turn, [1 + 0j]), hooke.SecondOrder(swing, [1.0, 0.5])


def off(result):
    """How far frames are off at most, by real or imaginary parts, as errors count them."""
    apart = result.frames.q[:, 0] - np.exp((1j - 0.5) * result.frames.t)
    return max(abs(apart.real).max(), abs(apart.imag).max())


def sentences(found):
    text = "\n".join(claim.text for claim in found.claims)
    assert text and not re.search(r"\d m\b|particle", text)
    return text


@pytest.mark.parametrize("method", ["forward-euler", "heun", "rk4"])
def test_an_estimate_changes_no_bit_and_brackets_the_error(method):
    run = {"method": method, "step": 0.02, "frames": True, **RUN}
    plain, result = TURN.run(**run), TURN.run(estimate=True, **run)
    np.testing.assert_array_equal(plain.frames.q, result.frames.q)
    assert result.problem is TURN and result.state.x.dtype == complex and result.frames.v is None
    assert off(result) <= result.error.estimate <= 4 * off(result)
    assert "of any number" in sentences(result)
    hooke.Integrator(TURN, method=method, step=0.02, duration=1).run(result.state)  # a state of the problem


def test_a_callback_follows_its_arrays():
    """A block that begins where another one began may have its arrays elsewhere."""
    block, called = np.zeros(8), hooke.FirstOrder(lambda t, x, rate: rate.fill(1), [1.0, 2.0])._rate
    for place in (2, 4, 6, 2):
        block[:] = 0
        assert called(2, 0.0, block.ctypes.data, block[place:].ctypes.data, None) == 0
        assert list(np.flatnonzero(block)) == [place, place + 1]


def test_a_want_is_met_or_said_not_to_be():
    result = TURN.run(want=1e-5, frames=True, **RUN)
    assert result.error.met and off(result) <= result.error.estimate <= 1e-5
    assert "within the wanted 1e-05" in sentences(result)
    result = SWING.run(want=1e-17, method="cvode-adams", **RUN)
    assert not result.error.met
    assert re.search("are not met|nobody knows", sentences(result))


def test_a_study_recommends(tmp_path):
    study = hooke.study(SWING, "rk4", want=1e-5, steps=[0.1, 0.05], **RUN)
    assert study.unit == "" and np.isnan(study.energy_drift).all()
    best = study.recommendation
    assert best.met and "energy" not in sentences(study)
    truth = SWING.run(method="cvode-adams", rtol=1e-12, atol=1e-13, frames=True, **RUN).frames.q
    again = SWING.run(frames=True, **best.options, **RUN).frames.q
    assert abs(again - truth).max() == pytest.approx(best.error, abs=1e-9)
    assert study.plot()[0].get_ylabel() == "error"
    study.write(tmp_path / "study.json")
    for name in ("study.h5", "study.html"):
        with pytest.raises(hooke.Unsuited, match="needs particles, and this is a second-order problem"):
            study.write(tmp_path / name)


@pytest.mark.parametrize("options", [{"watch": "0.x"}, {"ensemble": 3}])
def test_what_is_of_particles_is_refused(options):
    with pytest.raises(hooke.Unsuited, match=f"{next(iter(options))}: needs particles"):
        hooke.study(SWING, "verlet", **options, **RUN)


@pytest.mark.parametrize("kind", [hooke.FirstOrder, hooke.SecondOrder])
@pytest.mark.parametrize("work", [hooke.study, lambda problem, **run: problem.run(want=1e-3, **run)])
def test_exceptions_of_callbacks_are_raised_again(kind, work):
    def fails(*_):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        work(kind(fails, [1.0]), **RUN)


def test_progress_stops_a_study():
    study = hooke.study(SWING, "verlet", progress=lambda done, what: what == "verlet", **RUN)
    assert study.outcome == "stopped" and list(study.rows["status"]) == ["stopped"]
