"""Rigid bodies in Python: the same system from a scene, from that scene saved, and from calls."""

import json
from pathlib import Path

import numpy as np
import pytest

import hooke

BOARD = json.loads((Path(__file__).resolve().parents[1] / "data/board.json").read_text())


def test_python_builds_the_same_system(tmp_path):
    loaded = hooke.Scene.parse(json.dumps(BOARD))
    assert loaded.system.body_names == ["box", "board", ""]
    loaded.save(tmp_path / "again.json")
    again = hooke.Scene.load(tmp_path / "again.json")
    built = hooke.Scene(gravity=BOARD["gravity"])
    given = BOARD["particles"]
    built.particles(given["position"], velocity=given["velocity"], mass=given["mass"], pinned=given["pinned"])
    ropes = BOARD["springs"][0]
    built.springs("ropes", between=ropes["between"], stiffness=200, damping=0.5)
    box, bar = BOARD["parts"]
    built.lattice("box", **{key: box[key] for key in ("origin", "size", "edges", "mass", "structural")}, rigid=True)
    built.rope("bar", from_=bar["from"], to=bar["to"], segments=4, mass=1, pinned="start", stretch=bar["stretch"])
    built.bodies("board", particles=[0, 1, 2, 3]).bodies(part="bar")
    ends = [hooke.run(one, method="rk4", step=0.001, duration=0.1).state.q for one in (loaded, again, built)]
    assert np.array_equal(ends[0], ends[1]) and np.array_equal(ends[0], ends[2])
    mass, inertia = built.system.body_inertia(1)
    assert mass == 1 and inertia == pytest.approx([0.01, 0.04, 0.05])
    state = built.system.state()
    motion = built.system.body_motion(1, state.q, state.v)
    assert motion.point == pytest.approx([0.2, 0, 0.1]) and motion.velocity == pytest.approx([0, 0, 0.5])
    assert list(built.system.body_particles(1)) == [0, 1, 2, 3]
