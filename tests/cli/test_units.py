"""Numbers with a unit in scenes and options: the same run as with plain numbers, and clear refusals."""

import copy
import math

import pytest
from conftest import SIX_PARTICLES

pytestmark = pytest.mark.everything

WITH_UNITS = {
    **copy.deepcopy(SIX_PARTICLES),
    "gravity": ["0 m/s^2", "-981cm/s^2", 0],
    "drag": "20 mN s/m",
    "particles": {
        **SIX_PARTICLES["particles"],
        "position": [["0m", 0, 0], ["100cm", 0, "10 cm"], [2, "200mm", 0], [2, 1.1, 0.3], ["0.7 m", 1.2, 0], [3, 2, 0.2]],
        "mass": ["1000g", 2, 3, "4 kg", 5, 6],
    },
    "springs": [{**SIX_PARTICLES["springs"][0], "stiffness": "0.1kN", "damping": ["500 mN s"] * 7}],
    "run": {"method": "symplectic-euler", "step": "1ms", "duration": "0.5 s", "every": "50ms"},
}


def test_units_in_a_scene_change_no_bit(hooke, write):
    plain = hooke("run", write({**SIX_PARTICLES, "drag": 0.02}), "--json", "--final")
    named = hooke("run", write(WITH_UNITS), "--json", "--final")
    assert plain.code == named.code == 0, named.err
    assert named.json["final"] == plain.json["final"]


def test_the_schema_takes_units(hooke):
    from test_schema import VALIDATOR

    VALIDATOR.validate(WITH_UNITS)
    assert not VALIDATOR.is_valid({**WITH_UNITS, "drag": "fast"})
    assert not VALIDATOR.is_valid({**WITH_UNITS, "drag": "3"})


def with_springs(**changes):
    return {**SIX_PARTICLES, "springs": [{**SIX_PARTICLES["springs"][0], **changes}]}


@pytest.mark.parametrize(
    "scene, message",
    [
        (with_springs(stiffness="2 px"), "springs[0].stiffness: there is no unit 'px' here; allowed: N, MN, kN"),
        (with_springs(stiffness="2"), 'springs[0].stiffness: "2" is not allowed; allowed:'),
        (with_springs(stiffness="2N, 3N"), 'springs[0].stiffness: "2N, 3N" is not allowed; allowed:'),
        (with_springs(stiffness="1kN/m"), "springs[0].stiffness: is given in units of N/m; the strain law needs one of N"),
        (with_springs(law="length", damping="1 N s"), "springs[0].damping: is given in units of N s; the length law"),
        (with_springs(stiffness=["1N"] * 6 + ["1N/m"]), "springs[0].stiffness[6]: 1N/m after a number in N"),
        (with_springs(rest_scale="1m"), 'springs[0].rest_scale: "1m" is not allowed; allowed: a number > 0'),
        ({**SIX_PARTICLES, "gravity": [0, "9.81 m", 0]}, "gravity[1]: there is no unit 'm' here; allowed: m/s^2"),
    ],
    ids=range(8),
)
def test_a_unit_that_does_not_fit_is_refused_at_its_place(hooke, write, scene, message):
    answer = hooke("check", write(scene))
    assert answer.code == 3 and message in answer.err, answer.err


def test_options_take_the_units_of_their_rows(hooke, tmp_path):
    make = ["make", "cloth", "--size", "4x4", "-o"]
    plain, named = tmp_path / "plain.json", tmp_path / "named.json"
    assert hooke(*make, plain, "--mass", 0.2, "--structural.stiffness", 2e3, "--edges", "1,0,0;0,-1,0").code == 0
    assert hooke(*make, named, "--mass", "200g", "--structural.stiffness", "2 kN", "--edges", "100cm,0,0;0,-1m,0").code == 0
    assert named.read_text() == plain.read_text()


# ---- options, as every verb takes them ----


@pytest.mark.parametrize(
    "text, value",
    [
        ("3e-3", 3e-3),
        ("3ms", 3e-3),
        ("3 ms", 3e-3),
        ("3000us", 3e-3),
        ("3e6ns", 3e-3),
        (".7ms", 0.7e-3),
        ("7.e-1 ms", 0.7e-3),
        ("0.1s", 0.1),
        ("0.001min", 0.001 * 60),
        ("1e-5h", 1e-5 * 3600),
    ],
)
def test_times_are_read_to_the_bit(hooke, write, text, value):
    scene = write(SIX_PARTICLES, every=None, step=None, duration=None)
    answer = hooke("run", scene, "--method", "cvode-adams", "--duration", text, "--json")
    assert answer.code == 0 and answer.json["time"] == value


@pytest.mark.parametrize("text", ["3 m s", "3ms2", "3m", "1 2ms", "ms", "3msms", "3,4ms", "1e400ms", "1e-400ms", "-3ms"])
def test_what_is_no_time_is_refused(hooke, write, text):
    answer = hooke("run", write(SIX_PARTICLES), f"--duration={text}")
    assert answer.code == 2 and "--duration" in answer.err, answer.err


def test_every_length_has_its_unit(hooke, write):
    for text, value in [("2um", 2e-6), ("3nm", 3e-9), ("0.5 cm", 0.5e-2), ("1e-7km", 1e-4), ("7e-3", 7e-3)]:
        answer = hooke("run", write(SIX_PARTICLES), "--method", "cvode-bdf", "--atol", text, "--json")
        assert answer.json["atol"] == value, text
    assert math.isclose(3 * 1e-9, 3e-9) and 3 * 1e-9 != 3e-9  # result of a plain product
