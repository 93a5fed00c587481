"""Strands by the command line: their description by check, and what needs asks of them."""

import copy
import json
import pathlib

import pytest

pytestmark = pytest.mark.everything

CURL = json.loads((pathlib.Path(__file__).resolve().parents[2] / "examples" / "scenes" / "curl.json").read_text())
STRAIGHT = {
    "hooke": 1,
    "parts": [
        {
            "kind": "strand", "name": "hair", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 4, "density": 0.2,
            "pinned": ["start", 1, 2], "stretch": {"stiffness": 8}, "bend": {"stiffness": 2, "damping_ratio": 0.5},
            "twist": {"stiffness": 1}, "altitude": {"stiffness": 3, "damping_ratio": 0.25, "rest_scale": 1.5},
        }
    ],
    "run": {"method": "verlet", "step": 1e-4, "duration": 0.01},
}  # fmt: skip


def test_check_tells_of_tetrahedra(hooke, write):
    scene = write(STRAIGHT)
    answer = hooke("check", scene, "--json")
    assert (answer.code, answer.json["warnings"]) == (0, [])
    value = answer.json
    assert (value["particles"], value["springs"]) == (9, 8 + 7 + 6)
    assert value["groups"] == [{"name": f"hair.{n}", "springs": k} for n, k in (("stretch", 8), ("bend", 7), ("twist", 6))]
    assert (value["tetrahedra"], value["altitude_groups"]) == (6, [{"name": "hair.altitude", "tetrahedra": 6}])
    assert value["forces"] == ["springs", "altitude"]
    derived = {(row["family"], row["name"]): row["value"] for row in value["derived"]}
    mass = derived[None, "mass of an inner particle"]
    assert mass == pytest.approx(0.2 * 0.125, rel=1e-14)
    on_axis, extra = 2 / 0.25, 2 / (0.25 * 1.25**0.5)
    assert derived["bend", "kappa on the axis"] == pytest.approx(on_axis, rel=1e-14)
    assert derived["bend", "kappa of extra particles"] == pytest.approx(extra, rel=1e-14)
    assert derived["bend", "gamma of extra particles"] == pytest.approx((extra * mass / 2) ** 0.5, rel=1e-14)
    # of P X P X with offset a = 1/2 that of the edges 03 and 12: 6 V = a^2 sin 60 over (3/4 a^4 + 13/4 a^2)^1/2
    length = 1.5 * 0.25 * 0.25 * 0.75**0.5 / (0.75 / 16 + 3.25 / 4) ** 0.5
    assert derived["altitude", "kd"] == pytest.approx(0.5 * (3 / length * mass / 2) ** 0.5 * length, rel=1e-13)
    words = hooke("check", scene).out
    assert "tetrahedra   6\n           6 hair.altitude\n" in words


def test_needs_asks_for_altitude_springs(hooke, write):
    scene = copy.deepcopy(CURL)
    scene["run"]["duration"] = 0.04
    answer = hooke("needs", write(scene), "--want", "1e-3", "--json")
    assert answer.code == 0, answer.err
    rows = {row["without"]: row["needed"] for row in answer.json["rows"]}
    assert rows["hair.altitude"] in (True, False) and "half the resolution of hair" in rows
