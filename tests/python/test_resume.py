"""Stopped runs continue: from files, from checkpoints, with callbacks, after exceptions."""

import copy

import h5py
import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_six_particles

import hooke

METHODS = {
    "verlet": {"method": "verlet"},
    "cvode-bdf": {"method": "cvode-bdf", "checkpoint": 0.07},
    "cvode-adams from the beginning": {"method": "cvode-adams"},
}


def stop_after(calls, value=1):
    left = [calls]

    def observer(step, state):
        left[0] -= 1
        if left[0] == 0 and isinstance(value, BaseException):
            raise value
        return value if left[0] == 0 else None

    return observer


def check_equal(found, whole):
    assert found.status == whole.status == "finished"
    assert np.array_equal(found.state.q, whole.state.q) and np.array_equal(found.state.v, whole.state.v)
    counts = {key: value for key, value in whole.counts.items() if key not in ("memory_bytes", "zero_passages")}
    assert found.counts.get("zero_passages", 0) == 0
    assert {key: found.counts[key] for key in counts} == counts
    with hooke.open(found.output) as a, hooke.open(whole.output) as b:
        assert np.array_equal(a.t, b.t) and np.array_equal(a.steps, b.steps)
        assert np.array_equal(a.q, b.q) and np.array_equal(a.v, b.v)
        assert a.status == b.status


@pytest.mark.parametrize("name", METHODS)
@pytest.mark.parametrize("value", [3, ValueError("tired")])
def test_a_file_is_gone_on_with(tmp_path, name, value):
    scene, options = hooke.Scene.parse(SIX_PARTICLES), METHODS[name]
    whole = hooke.run(scene, output=tmp_path / "whole.h5", **options)
    if value == 3:
        stopped = hooke.run(scene, output=tmp_path / "out.h5", on_step=(1, stop_after(53, value)), **options)
        assert stopped.status == "stopped" and stopped.stop_value == 3
    else:
        with pytest.raises(ValueError, match="tired"):
            hooke.run(scene, output=tmp_path / "out.h5", on_step=(1, stop_after(53, value)), **options)
    seen = []
    found = hooke.resume(tmp_path / "out.h5", threads=2, progress=lambda done, state: seen.append(done))
    check_equal(found, whole)
    assert seen == sorted(seen) and seen[-1] == pytest.approx(1)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["out.h5", "out.xdmf", "whole.h5", "whole.xdmf"]
    again = hooke.resume(tmp_path / "out.h5")
    assert again.status == "finished" and "had finished" in again.message
    assert np.array_equal(again.state.q, whole.state.q) and again.state.t == whole.state.t
    assert again.counts == {"steps": whole.counts["steps"]} and np.isnan(again.wall_seconds)


@pytest.mark.parametrize("checkpoint", [True, False])
@pytest.mark.parametrize("stop", [("on_step", 47), ("on_step", 48), ("on_step", 49), ("on_step", 50), ("on_frame", 10)])
@pytest.mark.parametrize("method", ["symplectic-euler", "verlet", "rk4"])
def test_the_last_interval_may_be_short(tmp_path, method, stop, checkpoint):
    """Stopped before, at and after the last whole multiple of every, at the end, and when its frame is in the file."""
    options = {"method": method, "step": 0.01, "every": 0.06, "duration": 0.5}
    scene, (where, calls) = hooke.Scene.parse(SIX_PARTICLES), stop
    whole = hooke.run(scene, output=tmp_path / "whole.h5", **options)
    observer = stop_after(calls) if where == "on_frame" else (1, stop_after(calls))
    stopped = hooke.run(scene, output=tmp_path / "out.h5", **{where: observer}, **options)
    assert stopped.status == "stopped" and stopped.counts["steps"] == (50 if where == "on_frame" else calls)
    if not checkpoint:
        (tmp_path / "out.h5.checkpoint").unlink()
    found = hooke.resume(tmp_path / "out.h5")
    if checkpoint:
        check_equal(found, whole)
    assert found.status == "finished" and found.state.t == 0.5 and np.array_equal(found.state.q, whole.state.q)
    with h5py.File(tmp_path / "out.h5") as a, h5py.File(tmp_path / "whole.h5") as b:
        time = a["particles/all/position/time"][:]
        assert len(time) == 10 and time[-1] == 0.5
        names = []
        b.visit(names.append)
        for name in names:
            if isinstance(b[name], h5py.Dataset):
                assert np.asarray(a[name][()]).tobytes() == np.asarray(b[name][()]).tobytes(), name


def push(t, q, v, f):
    f += 3 * np.sin(t) - 0.1 * v


def test_callbacks_come_with_the_system(tmp_path):
    options = {**SIX_PARTICLES["run"], "method": "rk4"}

    def built():
        made = build_six_particles()
        made.set_force(push)
        return made

    whole = hooke.run(built(), output=tmp_path / "whole.h5", **options)
    hooke.run(built(), output=tmp_path / "out.h5", on_frame=stop_after(4), **options)
    with pytest.raises(hooke.BadValue, match="scene"):
        hooke.resume(tmp_path / "out.h5")
    with pytest.raises(hooke.BadValue, match="another scene"):
        hooke.resume(tmp_path / "out.h5", build_six_particles())
    check_equal(hooke.resume(tmp_path / "out.h5", built()), whole)


def test_an_integrator_writes_and_reads_checkpoints(tmp_path):
    path = tmp_path / "six.checkpoint"
    problem = hooke.Scene.parse(SIX_PARTICLES).system
    options = {"method": "cvode-adams", "duration": 0.5, "checkpoint": 0.11}
    whole, first = hooke.Integrator(problem, **options), hooke.Integrator(problem, **options)
    expected, state = problem.state(), problem.state()
    points = []
    assert whole.run(expected, on_checkpoint=lambda step, state: points.append(state.t)) == "finished"
    assert points == [k * 0.11 for k in range(1, 5)]

    def keep(step, state):
        first.write_checkpoint(path, state, "six")
        return state.t > 0.3

    assert first.run(state, on_checkpoint=keep) == "stopped"
    second, state = hooke.Integrator(problem, threads=2, **options), problem.state()
    with pytest.raises(hooke.BadCall):
        second.resume(state)
    with pytest.raises(hooke.BadValue, match="another run"):
        second.read_checkpoint(path, state, "seven")
    second.read_checkpoint(path, state, "six")
    assert state.t == 3 * 0.11
    assert second.resume(state) == "finished"
    assert np.array_equal(state.q, expected.q) and second.counts["steps"] == whole.counts["steps"]
    other = hooke.Integrator(problem, **{**options, "rtol": 1e-7})
    with pytest.raises(hooke.BadValue, match="other options"):
        other.read_checkpoint(path, state)


def test_a_scene_that_names_files_is_kept_with_their_numbers_where_a_scene_can_hold_it(tmp_path):
    with h5py.File(tmp_path / "arrays.h5", "w") as file:
        file["position"] = SIX_PARTICLES["particles"]["position"]
    scene = copy.deepcopy(SIX_PARTICLES)
    scene["particles"]["position"] = {"file": "arrays.h5", "dataset": "position"}
    kept = []
    for force in (None, push):
        loaded = hooke.Scene.parse(scene, folder=tmp_path)
        hooke.run(loaded, output=tmp_path / "out.h5", force=force, duration=0.1, every=0.1)
        with h5py.File(tmp_path / "out.h5") as file:
            kept.append(file["hooke/scene"].asstr()[()])
    assert kept[1] == loaded.text and "arrays.h5" in kept[1]
    (tmp_path / "arrays.h5").unlink()
    assert hooke.Scene.parse(kept[0]).system.particle_count == 6
