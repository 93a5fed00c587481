"""hooke run --watch: values at the end, and extremes over all steps or the part of them that is known."""

import math

import pytest
from conftest import STIFF_PAIR, Answer, interrupt

pytestmark = pytest.mark.everything

# A climber of 80 kg on 2.8 m of rope falls 4.8 m: the motion is free, then an oscillation, so that the largest
# tension is known: m g (1 + sqrt(1 + 2 k h/(m g))) with k = 20000 N / 2.8 m and a fall of h = 4.8 m.
CLIMBER = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "particles": {"position": [[0, 0, 0], [0, 2.0, 0]], "mass": 80, "pinned": [0]},
    "springs": [{"name": "rope", "between": [[0, 1]], "law": "strain", "stiffness": 20000, "rest_length": 2.8,
                 "compression": False}],
    "run": {"method": "rk4", "step": 1e-4, "duration": 1.4, "every": 0.002},
}  # fmt: skip
WEIGHT = 80 * 9.81
LARGEST = WEIGHT * (1 + math.sqrt(1 + 2 * 20000 / 2.8 * 4.8 / WEIGHT))
KEYS = ["quantity", "unit", "value", "minimum", "at_minimum", "maximum", "at_maximum", "from", "until"]
# A hanging rope of three masses with a load, which comes to rest.
HANGING = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "drag": 30,
    "particles": {"position": [[0, 0, 0], [1, 0, 0], [2, 0, 0]], "mass": [1, 2, 3], "pinned": [0, 2]},
    "springs": [{"name": "rope", "between": [[0, 1], [1, 2]], "stiffness": 200}],
    "loads": [{"particles": [1], "force": [3, 0, 1]}],
    "run": {"method": "rk4", "step": 0.01, "duration": 120},
}


def watched(answer):
    assert all(list(row) == KEYS for row in answer.json["watched"])
    return {row["quantity"]: row for row in answer.json["watched"]}


@pytest.mark.parametrize("how", [[], ["--method", "cvode-adams", "--rtol", "1e-9"], ["--method", "cvode-bdf", "--rtol", "1e-9"]])
def test_the_largest_tension_is_between_steps(hooke, write, how):
    """By both kinds of methods: 8162.521 N; frames alone give 8162.3 N, and a slack rope has a tension of 0."""
    assert abs(LARGEST - 8162.521) < 5e-4
    quantities = "rope:0.tension,rope:max.tension,0.reaction_y,period:1.y"
    answer = hooke("run", write(CLIMBER), *how, "--watch", quantities, "--json", "--no-estimate", "--quiet")
    found = watched(answer)
    for name in ("rope:0.tension", "rope:max.tension"):
        assert abs(found[name]["maximum"] - LARGEST) < 1e-3
        assert abs(found[name]["at_maximum"] - 1.166755) < 2e-6
        assert found[name]["minimum"] == found[name]["value"] == 0
    assert math.isclose(found["0.reaction_y"]["maximum"], found["rope:0.tension"]["maximum"] + WEIGHT, rel_tol=1e-12)
    assert found["period:1.y"]["value"] is found["period:1.y"]["maximum"] is None
    assert answer.json["claims"] == [] and "error" not in answer.json
    assert all(row["from"] == 0 and math.isclose(row["until"], 1.4) for row in found.values())


def test_coarse_steps_and_frames_change_little(hooke, write):
    found = [watched(hooke("run", write(STIFF_PAIR), "--duration", 3, "--every", 0.3, "--method", method, *how, "--watch",
                           "1.x,period:1.x", "--json", "--no-estimate", "--quiet"))
             for method, how in (("rk4", ["--step", "0.01"]), ("cvode-adams", ["--rtol", "1e-8"]))]  # fmt: skip
    for row in found:
        assert abs(row["1.x"]["maximum"] - 1.1) < 1e-4 and abs(row["1.x"]["minimum"] - 0.9) < 1e-4
        assert row["period:1.x"]["value"] is None, "ten frames are too few"


def test_supports_carry_weights_and_loads_at_rest(hooke, write):
    names = [f"{particle}.reaction_{axis}" for axis in "xyz" for particle in (0, 2)]
    answer = hooke("run", write(HANGING), "--watch", ",".join(names), "--json", "--no-estimate")
    value = [watched(answer)[name]["value"] for name in names]
    for (one, other), total in zip(zip(value[::2], value[1::2]), (-3, 6 * 9.81, -1)):
        assert abs(one + other - total) < 1e-10
        assert abs(one) > 0.1 and abs(other) > 0.1


def test_a_particle_is_driven_with_m_a_minus_f(hooke, write):
    scene = {**HANGING, "particles": {**HANGING["particles"], "pinned": [0]}}
    scene["driven"] = [{"particles": [2], "motion": "harmonic", "amplitude": [0, 0.1, 0], "frequency": 2}]
    answer = hooke("run", write(scene), "--duration", 1.3, "--every", 0.01, "--watch", "2.reaction_y,rope:1.tension", "--json",
                   "--final", "--no-estimate")  # fmt: skip
    found, (_, free, driven) = watched(answer), answer.json["final"]["position"]
    acceleration = -0.1 * (4 * math.pi) ** 2 * math.sin(4 * math.pi * 1.3)
    pull = found["rope:1.tension"]["value"] * (free[1] - driven[1]) / math.dist(free, driven)
    assert math.isclose(found["2.reaction_y"]["value"], 3 * (acceleration + 9.81) - pull, rel_tol=1e-10)


def claims(answer):
    return [(claim["of"], claim["text"]) for claim in answer.json["claims"] if claim["key"] == "watched"]


def test_extremes_of_a_part_are_not_those_of_the_whole(hooke, start, write):
    diverged = hooke("run", write(STIFF_PAIR), "--watch", "1.x", "--json", "--no-why", "--quiet")
    row = watched(diverged)["1.x"]
    assert diverged.code == 4 and row["value"] == 1.1 and row["maximum"] is row["minimum"] is None
    assert [of for of, _ in claims(diverged)] == ["unknown"]
    words = ["--watch", "1.x", "--json", "--no-estimate"]
    stopped = start("run", write(STIFF_PAIR, method="verlet", step=1e-3, duration=1e5, every=50), *words, "-o", "out.h5")
    further = None
    for _ in range(2):
        interrupt(stopped, 0.05)
        out, err = stopped.communicate()
        answer = Answer(stopped.returncode, out.decode(), err.decode())
        row, (claim,) = watched(answer)["1.x"], claims(answer)
        assert answer.json["status"] == "stopped" and 0 < row["until"] == answer.json["time"] < 1e5
        assert claim[0] == "part" and f"until t = {row['until']:.6g} s" in claim[1]
        assert abs(row["maximum"] - 1.1) < 1e-6
        if further is None:
            assert row["from"] == 0
            further, until = True, row["until"]
            stopped = start("run", "--resume", "out.h5", *words[:3])
    assert until <= row["from"] < until + 0.01


def test_words(hooke, write):
    answer = hooke("run", write(CLIMBER), "--duration", 1, "--watch", "rope:0.tension,1.y")
    assert answer.code == 0
    lines = answer.out[answer.out.index("\nwatched ") :].split("\n")
    assert lines[1].split() == "watched value minimum at t [s] maximum at t [s]".split()
    assert lines[2].split()[:3] == ["rope:0.tension", "[N]", "748.7117"] and lines[3].split()[:2] == ["1.y", "[m]"]
    for word, message in (("1.reaction", "allowed: a pinned or driven one, such as 0"), ("rope:top.length", "group:max")):
        refused = hooke("run", write(CLIMBER), "--watch", word)
        assert refused.code == 3 and f'watch: "{word}"' in refused.err and message in refused.err
