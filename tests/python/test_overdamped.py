"""Overdamped scenes: the format, the package, and a sheet of cells."""

import os
from pathlib import Path

import numpy as np
import pytest

import hooke

EXAMPLES = Path(os.environ["HOOKE_SOURCE_DIR"]) / "examples/scenes"
PAIR = {
    "hooke": 1,
    "dynamics": "overdamped",
    "drag": 2,
    "particles": {"position": [[0, 0, 0], [1.5, 0, 0]]},
    "springs": [{"name": "pair", "stiffness": 30, "rest_length": 1, "between": [[0, 1]]}],
    "run": {"method": "rk4", "step": 1e-3, "duration": 0.1},
}


def pair(**changes):
    return hooke.Scene.parse({**PAIR, **changes})


def test_frames_have_force_over_drag():
    result = pair().run(frames=True)
    length = result.frames.q[:, 1, 0] - result.frames.q[:, 0, 0]
    np.testing.assert_allclose(length, 1 + 0.5 * np.exp(-30 * result.frames.t), atol=1e-9)
    np.testing.assert_allclose(result.frames.v[:, 1, 0], -15 * (length - 1), atol=1e-12)


def test_a_scene_is_built_saved_and_read_again(tmp_path):
    scene = hooke.Scene(dynamics="overdamped", drag=2).particles([[0, 0, 0], [1.5, 0, 0]])
    scene.springs("pair", between=[[0, 1]], stiffness=30, rest_length=1)
    scene.save(tmp_path / "a.json")
    scene.system.save(tmp_path / "b.json")
    want = pair().run().state.q
    for name in "ab":
        again = hooke.Scene.load(tmp_path / f"{name}.json")
        assert again.system.dynamics == "overdamped"
        np.testing.assert_array_equal(again.run(method="rk4", step=1e-3, duration=0.1).state.q, want)


def test_an_output_verifies_and_resumes_to_the_bit(tmp_path):
    scene = pair(run={"method": "tr-bdf2", "step": 1e-3, "duration": 0.1})
    scene.run(output=tmp_path / "out.h5")
    assert hooke.verify(tmp_path / "out.h5").verdict == "agrees"
    state, integrator = scene.system.state(), hooke.Integrator(scene.system, scene.run_options)
    for _ in range(100):
        integrator.step(state)
    np.testing.assert_array_equal(state.q, hooke.open(tmp_path / "out.h5")[-1].q)
    q, v = integrator.get(1)
    integrator.put(1, q + [0.1, 0, 0], v)
    integrator.sync(state)
    np.testing.assert_allclose(state.v[1, 0], v[0] - 15 * 0.1, rtol=1e-12)


@pytest.mark.parametrize(
    "changes, place",
    [
        ({"drag": 0}, "drag: 0 is not allowed"),
        ({"particles": {**PAIR["particles"], "velocity": [[0, 0, 0], [1, 0, 0]]}}, r"particles\.velocity"),
        ({"springs": [{**PAIR["springs"][0], "damping": 1}]}, "damping"),
        ({"gravity": [0, 0, -9.81]}, r"particles\.mass"),
        ({"dynamics": "inertial"}, r"particles\.mass"),
        ({"dynamics": "none"}, "dynamics"),
    ],
)
def test_bad_scenes_are_refused_by_name(changes, place):
    with pytest.raises(hooke.BadValue, match=place):
        pair(**changes).system.state()


def test_methods_with_inertia_are_refused():
    for method in ("symplectic-euler", "verlet", "shardlow"):
        with pytest.raises(hooke.Unsuited, match=method):
            pair().run(method=method)


def test_measurements_know_it():
    limits = {row["method"]: row for row in hooke.limit(pair()).rows}
    assert set(limits) == {"forward-euler", "heun", "rk4", "backward-euler", "tr-bdf2", "implicit-midpoint"}
    for method, reach in (("forward-euler", 2), ("heun", 2), ("rk4", 2.7852935634)):
        assert limits[method]["predicted"] == pytest.approx(reach / 30, rel=1e-6)
        assert limits[method]["measured"] == pytest.approx(reach / 30, rel=1e-3)
    study = hooke.study(pair(), ["forward-euler", "heun"], want=1e-4)
    assert study.recommendation is not None
    assert study.orders["forward-euler"].order == pytest.approx(1, abs=0.1)
    assert study.orders["heun"].order == pytest.approx(2, abs=0.1)
    assert pair().run(want=1e-4, method="heun").error.met


def test_buckling_is_named():
    positions = [[0, 0, 0], [1.5, 0, 0], [0.7, 0.1, 0]]
    ends = [[0, 1], [1, 2], [0, 2]]
    scene = pair(particles={"position": positions}, springs=[{**PAIR["springs"][0], "between": ends}])
    notes = {row["method"]: row["note"] for row in hooke.limit(scene, predict=True).rows}
    assert "buckling" in notes["forward-euler"]
    q = scene.system.state().q
    step, size = 1e-6, q.size
    columns = []
    for k in range(size):
        push = np.zeros(size)
        push[k] = step
        ahead, behind = (scene.system.force(q + sign * push.reshape(q.shape), 0 * q) for sign in (1, -1))
        columns.append((ahead - behind).ravel() / (2 * step) / 2)
    fastest = np.linalg.eigvals(np.array(columns)).real.max()
    told = float(notes["forward-euler"].split("exp(")[1].split()[0])
    assert told == pytest.approx(fastest, rel=0.05)


def test_a_sheet_of_cells_is_cheaper_by_a_stiff_method():
    """1 % of the motion, at least five times cheaper than forward Euler just below its limit."""
    scene = hooke.Scene.load(EXAMPLES / "tissue.json")
    start = scene.system.state().q.copy()
    exact = scene.run(rtol=1e-8, atol=1e-12).state.q
    motion = np.sqrt(((exact - start) ** 2).sum(axis=1).mean())
    results = {
        "cvode-bdf": [scene.run() for _ in range(3)],
        "forward-euler": [scene.run(method="forward-euler")],
    }
    seconds = {}
    for name, runs in results.items():
        error = np.sqrt(((runs[0].state.q - exact) ** 2).sum(axis=1).mean())
        assert runs[0].status == "finished" and error < 0.01 * motion, name
        seconds[name] = min(result.wall_seconds for result in runs)
    assert seconds["forward-euler"] > 5 * seconds["cvode-bdf"], seconds


def test_velocities_follow_forces_and_have_no_heat_in_excess():
    """At h lambda = 1.8 velocities change their signs in each step, which in a scene with inertia would be warned of."""
    error = pair().run(method="forward-euler", step=0.06, duration=1.2, estimate=True).error
    assert error.estimate > 0 and np.isnan(error.heat_excess)
