"""hooke.cost: rows, numbers, and omissions."""

import math

import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator, build_six_particles

import hooke


def test_rows_of_a_scene():
    found = hooke.cost(hooke.Scene.parse(SIX_PARTICLES), budget=0.5)
    assert found.outcome == "finished" and found.method == "symplectic-euler" and found.step == 1e-3
    assert found.rows["name"].tolist() == ["edges", "damping", "gravity"]
    assert found.rows["kind"].tolist() == ["springs", "damping", "gravity"]
    assert found["edges"]["springs"] == 7 and np.isnan(found["gravity"]["springs"])
    assert found.nanoseconds > 0 and found.resolution >= 0 and (found.rows["nanoseconds"] >= 0).all()
    assert math.isinf(found["edges"]["step_limit_without"]) and found["edges"]["memory_bytes"] > 0
    limits = [hooke.limit(build_six_particles(), predict=True)["symplectic-euler"]["predicted"], found.step_limit]
    assert limits[1] == pytest.approx(limits[0], rel=2e-3) and found["damping"]["step_limit_without"] > limits[1]
    assert "edges" in str(found) and "3 ingredients" in repr(found)
    with pytest.raises(KeyError, match="there are edges"):
        found["drag"]


def test_without_the_timing(tmp_path):
    system = build_oscillator()
    found = hooke.cost(system, predict=True, method="verlet")
    assert found.method == "verlet" and np.isnan(found.nanoseconds) and np.isnan(found.rows["nanoseconds"]).all()
    assert found.step_limit == pytest.approx(2 / math.sqrt(40), rel=1e-3) and found.step == found.step_limit
    assert hooke.cost(system, predict=True, method="cvode-bdf").method == "symplectic-euler"
    found.write(tmp_path / "cost.csv")
    lines = (tmp_path / "cost.csv").read_text().splitlines()
    assert lines[0].startswith("ingredient,kind,") and len(lines) == 1 + len(found.rows)
    with pytest.raises(hooke.BadValue, match="no page for a cost"):
        found.write(tmp_path / "cost.html")


def test_a_callback_is_an_ingredient():
    system, calls = build_oscillator(), []
    system.set_force(lambda t, q, v, force: calls.append(t))
    found = hooke.cost(system, budget=0.5)
    assert found.rows["kind"].tolist() == ["springs", "callback"] and calls
    assert found["callback"]["memory_bytes"] > 0

    def fail(t, q, v, force):
        raise RuntimeError("no such force")

    system = build_oscillator()
    system.set_force(fail)
    with pytest.raises(RuntimeError, match="no such force"):
        hooke.cost(system, budget=0.5)


def test_options_and_wrong_problems():
    assert "budget" in hooke.describe("cost") and "predict" in hooke.describe("cost")
    with pytest.raises(hooke.BadValue, match="budget"):
        hooke.cost(build_oscillator(), budget=0)
    with pytest.raises(hooke.BadValue, match="does not fit"):
        hooke.cost(build_oscillator(), build_six_particles().state())


def test_a_check_tells_without_a_run():
    system = build_oscillator()
    found = hooke.check(system, method="verlet", step=10, duration=20)
    assert (found.particles, found.springs) == (system.particle_count, system.spring_count) and found.memory_bytes > 0
    assert found["verlet"]["seconds"] == system.step_bound("verlet", system.state().q) and len(found.rows) == len(hooke.methods())
    first = found.claims[0]
    assert (first.key, first.of) == ("above-limit", "whole") and str(found).startswith("the step of the run, 10 s, is above ")
