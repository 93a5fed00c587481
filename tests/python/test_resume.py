"""Stopped runs continue: from files, from checkpoints, with callbacks, after exceptions."""

import copy
import json

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


STANDING = {*hooke.integrator.COUNTS} - {"memory_bytes", "zero_passages"}


def stop_after(calls, value=1):
    left = [calls]

    def observer(step, state):
        left[0] -= 1
        if left[0] == 0 and isinstance(value, BaseException):
            raise value
        return value if left[0] == 0 else None

    return observer


def check_equal(found, whole, *, from_frame=False):
    """Counts begin anew at a frame."""
    assert found.status == whole.status == "finished"
    assert np.array_equal(found.state.q, whole.state.q) and np.array_equal(found.state.v, whole.state.v)
    assert found.counts.get("zero_passages", 0) == 0
    counts = {key: value for key, value in whole.counts.items() if key in (("steps",) if from_frame else STANDING)}
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
    with pytest.raises(hooke.Unsuited, match="out.h5: the run had a force in a callback, which the file cannot hold"):
        hooke.resume(tmp_path / "out.h5", build_six_particles())
    check_equal(hooke.resume(tmp_path / "out.h5", built()), whole)


def same(t, q, v, dq, dv, out):
    out -= 0.1 * dv


def lead(t, q, v):
    q[:], v[:] = [[0.7, 1.2 + t, 0]], [[0, 1, 0]]


@pytest.mark.parametrize(
    "words, with_checkpoint",
    [("force", True), ("drive", False), ("force with derivative and drive", True)],
)
def test_a_file_says_which_callbacks_its_run_had(tmp_path, words, with_checkpoint):
    output = tmp_path / "out.h5"

    def scene(words):
        made = hooke.Scene.parse(SIX_PARTICLES) if not output.exists() else hooke.Scene.load(output)
        if "force" in words:
            made.system.set_force(push, same if "derivative" in words else None)
        if "drive" in words:
            made.system.drive_callback(4, lead)
        return made

    options = {"method": "backward-euler", "step": 2e-3, "duration": 0.05, "every": 0.01}
    whole = hooke.run(scene(words), output=tmp_path / "whole.h5", **options)
    hooke.run(scene(words), output=output, on_frame=stop_after(4), **options)
    if not with_checkpoint:
        (tmp_path / "out.h5.checkpoint").unlink()
    with hooke.open(output) as out:
        assert out.callbacks == words and out.scene is not None and len(out.state().q) == 6
    for others in {"none", "force", "force with derivative", "drive", "force with derivative and drive"} - {words}:
        with pytest.raises(hooke.Unsuited, match="callback"):
            hooke.resume(output, scene(others))
    for work in (hooke.resume, hooke.run, hooke.verify, hooke.needs, hooke.cost, hooke.limit):
        with pytest.raises(hooke.Unsuited, match=f"the run had a {words} in a callback, which the file cannot hold"):
            work(output, **({"want": 1e-3} if work is hooke.needs else {}))
    check_equal(hooke.resume(output, scene(words)), whole, from_frame=not with_checkpoint)


def test_a_run_without_callbacks_says_so_and_an_older_file_does_not(tmp_path):
    scene, output = hooke.Scene.parse(SIX_PARTICLES), tmp_path / "out.h5"
    whole = hooke.run(scene, output=tmp_path / "whole.h5")
    hooke.run(scene, output=output, on_frame=stop_after(4))
    with hooke.open(output) as out:
        assert out.callbacks == "none"
    (tmp_path / "out.h5.checkpoint").unlink()
    with pytest.raises(hooke.Unsuited, match="callbacks: the run had none, and this system has force"):
        hooke.resume(output, force=push)
    with h5py.File(output, "r+") as file:
        del file["hooke/file_check"]
        del file["hooke"].attrs["callbacks"]
    with hooke.open(output) as out:
        assert out.callbacks == ""
    assert hooke.verify(output)
    check_equal(hooke.resume(output), whole, from_frame=True)


def test_a_checkpoint_says_which_callbacks_its_run_had(tmp_path):
    path = tmp_path / "six.checkpoint"
    systems = {"force with derivative": build_six_particles(), "force": build_six_particles(), "none": build_six_particles()}
    systems["force with derivative"].set_force(push, same)
    systems["force"].set_force(push)
    options = {"method": "backward-euler", "step": 1e-3, "duration": 0.02}
    for had, system in systems.items():
        integrator, state = hooke.Integrator(system, **options), system.state()
        assert integrator.run(state, on_step=(1, stop_after(5))) == "stopped"
        integrator.write_checkpoint(path, state)
        for own, other in systems.items():
            integrator = hooke.Integrator(other, **options)
            if own == had:
                integrator.read_checkpoint(path, other.state())
                continue
            match = {"none": "another scene"}.get(had, "the run had a force|callbacks: the run had force, and this")
            with pytest.raises((hooke.Unsuited, hooke.BadValue), match=match):
                integrator.read_checkpoint(path, other.state())


def test_results_say_which_callbacks_took_part(tmp_path):
    study = hooke.study(build_six_particles(), ["rk4"], force=push, steps=[0.01], duration=0.1, every=0.1)
    study.write(tmp_path / "study.json")
    study.write(tmp_path / "study.h5")
    assert json.loads((tmp_path / "study.json").read_text())["callbacks"] == "force"
    with h5py.File(tmp_path / "study.h5") as file:
        assert file["hooke"].attrs["callbacks"] == "force"
    plain = hooke.study(build_six_particles(), ["rk4"], steps=[0.01], duration=0.1, every=0.1)
    plain.write(tmp_path / "plain.json")
    assert "callbacks" not in json.loads((tmp_path / "plain.json").read_text())


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
