"""A start at other positions than the undeformed ones: rest lengths, frames and clamps stay, the motion begins there."""

import json

import numpy as np
import pytest

import hooke

ROPE = dict(kind="rope", name="line", to=(1, 0, 0), segments=4, mass=1, pinned="start", stretch=dict(stiffness=100))


def scene(**start):
    """A rope tied to a crate."""
    return hooke.Scene.parse({
        "hooke": 1, "gravity": (0, -9.81, 0), "run": dict(method="verlet", step=1e-3, duration=0.1),
        "particles": dict(position=[(3, 0, 0), (4, 0, 0), (3, 1, 0)], mass=[1, 2, 3]),
        "parts": [{"from": (0, 0, 0), **ROPE}], "springs": [dict(between=[(2, 7)], stiffness=20)],
        "bodies": [dict(name="crate", particles=[0, 1, 2])], **({"start": start} if start else {}),
    })


def moved(angle=0.3):
    """Its positions turned about the pinned end, and velocities of a rotation about it."""
    q = scene().system.state().q.copy()
    turn = np.array([[np.cos(angle), -np.sin(angle), 0], [np.sin(angle), np.cos(angle), 0], [0, 0, 1]])
    v = np.cross((0, 0, 2), q @ turn.T)
    v[3] = 0
    return q @ turn.T, v


def test_forces_are_those_of_the_undeformed_scene():
    q, v = moved()
    plain, started = scene(), scene(position=q, velocity=v)
    assert np.array_equal(started.system.state().q, q) and np.array_equal(started.system.state().v, v)
    assert np.array_equal(started.system.acceleration(q, v), plain.system.acceleration(q, v))
    state = plain.system.state()
    state.q[:], state.v[:] = q, v
    one, other = hooke.run(plain, state=state), hooke.run(started)
    assert np.array_equal(one.state.q, other.state.q) and not np.array_equal(other.state.q, q)


def test_written_and_copied(tmp_path):
    q, v = moved()
    first = scene(position=q, velocity=v)
    first.system.save(tmp_path / "again.json", method="verlet", step=1e-3, duration=0.1)
    again = hooke.Scene.load(tmp_path / "again.json")
    written = json.loads(again.text)
    assert written["start"]["position"] == q.tolist() and "velocity" not in written["particles"]
    assert np.array_equal(hooke.run(first).state.q, hooke.run(again).state.q)
    lean = hooke.needs(first, want=1e-3)  # whose first copy, with nothing left out, is held against the scene
    assert lean.full.step_limit > 0


def test_what_is_refused():
    q, _ = moved()
    with pytest.raises(hooke.BadValue, match=r"start.position: 7 places for 8 particles"):
        scene(position=q[:7]).system.state()
    q[3, 1] = 1e-9
    with pytest.raises(hooke.BadValue, match=r"start.position\[3\]\[1\]: particle 3 is pinned at 0 m, not at"):
        scene(position=q).system.state()
    q[3, 1] = 0
    q[1, 2] += 0.1
    with pytest.raises(hooke.BadValue, match="rigid"):
        hooke.run(scene(position=q))
