"""Trajectory files opened by the package, compared with h5py and with the run, and after accidents."""

import gc
import os

import h5py
import matplotlib.pyplot as plt
import numpy as np
import pytest
from conftest import SIX_PARTICLES

import hooke

OBSERVABLES = {
    "kinetic": "kinetic_energy",
    "potential": "potential_energy",
    "total": "total_energy",
    "dissipated_power": "dissipated_power",
}


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "out.h5"
    hooke.run(hooke.Scene.parse(SIX_PARTICLES), output=path)
    return path


def test_arrays_are_those_of_the_file(path):
    with h5py.File(path) as file, hooke.open(path) as out:
        particles = file["particles/all"]
        assert np.array_equal(out.t, particles["position/time"][:])
        assert np.array_equal(out.steps, particles["position/step"][:])
        assert np.array_equal(out.q, particles["position/value"][:]) and out.q.shape == (11, 6, 3)
        assert np.array_equal(out.v, particles["velocity/value"][:])
        assert np.array_equal(out.mass, particles["mass"][:])
        assert np.array_equal(out.springs, file["connectivity/springs"][:])
        for field, name in OBSERVABLES.items():
            assert np.array_equal(getattr(out.energy, field), file[f"observables/{name}/value"][:])
        for name in ("momentum", "angular_momentum"):
            assert np.array_equal(getattr(out, name), file[f"observables/{name}/value"][:])
        assert out.steps.dtype == out.springs.dtype == np.int64
    assert out.path == os.fspath(path)


def test_arrays_are_those_of_the_run(path):
    result = hooke.run(hooke.Scene.parse(SIX_PARTICLES), frames=True)
    out = hooke.open(path)
    assert np.array_equal(out.q, result.frames.q) and np.array_equal(out.t, result.frames.t)
    assert out.energy.total[-1] == result.system.energy(result.state.q, result.state.v)
    assert out.status == "finished" and out.options["method"] == "symplectic-euler"
    assert out.scene.title == "six particles" and out.scene.run_options["step"] == 1e-3
    assert out.pinned.tolist() == [5] and out.driven.tolist() == []
    state = out.state()
    assert state.t == result.state.t and np.array_equal(state.q, result.state.q)
    state = out.state(3)
    assert state.t == out.t[3] and np.array_equal(state.v, out.v[3])


def test_a_run_goes_on_from_a_frame(path):
    out = hooke.open(path)
    end = hooke.run(out.scene, state=out.state(4), duration=0.3).state
    assert np.array_equal(end.q, out.q[-1]) and np.array_equal(end.v, out.v[-1])


def test_strain(path):
    out = hooke.open(path)
    for frame in (0, -1):
        lengths = [np.linalg.norm(out.q[frame, i] - out.q[frame, j]) for i, j in out.springs]
        rest = [np.linalg.norm(out.q[0, i] - out.q[0, j]) * 0.9 for i, j in out.springs]
        assert np.allclose(out.strain(frame), np.array(lengths) / rest - 1, rtol=0, atol=1e-15)
    assert np.allclose(out.strain(0), 1 / 0.9 - 1, rtol=0, atol=1e-15) and abs(out.strain()).max() > 0.05


def test_frames_as_a_sequence(path):
    out = hooke.open(path)
    assert len(out) == 11 and len(list(out)) == 11
    first, last = out[0], out[-1]
    assert (first.step, first.t) == (0, 0.0) and (last.step, last.t) == (500, 0.5)
    assert np.array_equal(last.q, out.q[10]) and np.array_equal(last.v, out.v[10])
    some = out[2:8:3]
    assert some.t.tolist() == out.t[[2, 5]].tolist() and np.array_equal(some.q, out.q[[2, 5]])
    for frame in (11, -12):
        with pytest.raises(IndexError, match="has 11 frames"):
            out[frame]
        with pytest.raises(hooke.BadValue, match="there is no frame"):
            out.state(frame)
        with pytest.raises(IndexError):
            out.strain(frame)


def test_positions_are_mapped_and_stay_when_the_file_is_closed(path):
    with hooke.open(path) as out:
        q, springs = out.q, out.springs
        base = q
        while base is not None and not isinstance(base, np.memmap):
            base = base.base
        assert base is not None, "the frames were copied"
    with pytest.raises(hooke.BadCall, match="this Trajectory is closed"):
        out.q
    out.close()
    end = q[-1].copy()
    path.unlink()
    del out
    gc.collect()
    assert np.array_equal(q[-1], end) and len(springs) == 7
    with pytest.raises(ValueError, match="read-only"):
        q[0, 0, 0] = 1


@pytest.mark.parametrize("stored", [{"compression": "gzip"}, {"dtype": ">f8"}])
def test_a_file_that_another_program_has_stored_anew(path, stored):
    with hooke.open(path) as out:
        q, v = out.q.copy(), out.v.copy()
    with h5py.File(path, "r+") as file:
        for name in ("position", "velocity"):
            value = file[f"particles/all/{name}/value"][:]
            del file[f"particles/all/{name}/value"]
            file.create_dataset(f"particles/all/{name}/value", data=value, **stored)
    again = hooke.open(path)
    assert np.array_equal(again.q, q) and np.array_equal(again.v, v)
    assert not again.q.flags.writeable


def test_frames_that_were_not_written_are_left_out(path):
    with h5py.File(path, "r+") as file:  # state of a killed run
        file["particles/all/position/time"][7:] = np.nan
        file["particles/all/position/step"][7:] = -1
        del file["hooke/status"]
        file["hooke/status"] = np.bytes_("running")
    out = hooke.open(path)
    assert len(out) == 7 and out.q.shape == (7, 6, 3) and out.t[-1] == 0.3 and out.status == "running"
    assert len(out.energy.total) == len(out.momentum) == len(out.steps) == 7
    assert out[-1].t == 0.3 and out.state().t == 0.3


def test_no_frame_yet(path):
    with h5py.File(path, "r+") as file:
        file["particles/all/position/time"][:] = np.nan
        del file["hooke/status"]
        file["hooke/status"] = np.bytes_("running")
    out = hooke.open(path)
    assert len(out) == 0 and out.q.shape == (0, 6, 3) and out.energy.total.shape == (0,)
    with pytest.raises(hooke.BadValue, match="has no frames to show"):
        out.animate()


def test_a_run_of_a_system_has_no_scene(tmp_path, system):
    hooke.run(system, method="verlet", step=1e-3, duration=0.01, output=tmp_path / "o.h5")
    out = hooke.open(tmp_path / "o.h5")
    assert out.scene is None and out.q.shape == (11, 6, 3)
    with pytest.raises(hooke.BadValue, match="holds no scene"):
        out.strain()


def test_a_fork_that_ends_leaves_the_file_to_the_run(tmp_path):
    ends, owner = [], os.getpid()

    def fork(step, state):
        if step == 100:
            child = os.fork()
            if child == 0:
                raise SystemExit(7)
            ends.append(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))

    try:
        hooke.run(hooke.Scene.parse(SIX_PARTICLES), output=tmp_path / "out.h5", on_frame=fork)
    except BaseException as exception:
        if os.getpid() != owner:  # the fork has to end here
            os._exit(getattr(exception, "code", 1))
        raise
    assert ends == [7] and sorted(os.listdir(tmp_path)) == ["out.h5", "out.xdmf"]
    with hooke.open(tmp_path / "out.h5") as out:
        assert out.status == "finished" and len(out.t) == 11


def test_a_run_that_diverged(tmp_path):
    scene = hooke.Scene().particles([[0, 0, 0], [2, 0, 0]], mass=1, pinned=0)
    scene.springs(between=[[0, 1]], stiffness=100, rest_length=1)
    with pytest.warns(hooke.StepWarning):
        hooke.run(scene, method="symplectic-euler", step=0.5, duration=500, every=0.5, output=tmp_path / "o.h5")
    out = hooke.open(tmp_path / "o.h5")
    assert out.status == "diverged" and 0 < len(out) < 1000 and np.isfinite(out.q).all()


def test_files_that_are_none(tmp_path):
    with pytest.raises(hooke.IOFailed, match="nowhere.h5"):
        hooke.open(tmp_path / "nowhere.h5")
    (tmp_path / "a.h5").write_text("not HDF5")
    with pytest.raises(hooke.IOFailed):
        hooke.open(tmp_path / "a.h5")
    with h5py.File(tmp_path / "b.h5", "w") as file:
        file["x"] = 1.0
    with pytest.raises(hooke.Error):
        hooke.open(tmp_path / "b.h5")


def test_a_place_outside_the_file_is_not_mapped(path, tmp_path):
    """A link may lead to another file, whose bytes these are not."""
    value = hooke.open(path).q.copy()
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["value"] = value + 1
    with h5py.File(path, "r+") as file:
        del file["particles/all/position/value"]
        file["particles/all/position/value"] = h5py.ExternalLink(str(tmp_path / "other.h5"), "/value")
    with pytest.raises(hooke.Error):
        hooke.open(path).q


# pictures


def test_an_animation_draws_the_frames(path, tmp_path):
    out = hooke.open(path)
    film = out.animate(seconds=0.2, fps=25)
    ax = film._fig.axes[0]
    lines = ax.collections[0]

    def ends(number):
        film._func(number)
        return np.array(lines._segments3d)[:, :, [1, 2, 0]]  # from z, x, y with y upwards

    shown = list(film.new_frame_seq())
    assert len(shown) == 5
    assert np.array_equal(ends(0), out.q[0][out.springs])
    assert np.array_equal(ends(4), out.q[-1][out.springs]) and ax.get_title() == "t = 0.5 s"
    film.save(tmp_path / "film.gif")
    assert (tmp_path / "film.gif").read_bytes()[:6] == b"GIF89a"
    plt.close("all")


def test_an_animation_shows_itself_in_a_notebook(path):
    film = hooke.open(path).animate(seconds=0.1, color="strain")
    page = film._repr_html_()
    assert page.count("data:image/png;base64") == 2 and "<script" in page
    plt.close("all")


def test_a_plot_of_a_frame(path):
    ax = hooke.open(path).plot(frame=0)
    assert ax.get_title() == "t = 0 s" and len(ax.collections[0]._segments3d) == 7
    with pytest.raises(hooke.BadValue, match='up: "w" is not allowed'):
        hooke.open(path).plot(up="w")
    plt.close("all")


# tensions and reactions

SPRINGS = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "particles": {"position": [[0, 0, 0], [1, 0, 0], [2, 0.1, 0], [3, 0, 0.2], [4, 0, 0]], "mass": [1, 2, 3, 4, 5],
                  "velocity": [[0, 0, 0], [0.5, 0, 0.1], [-0.3, 0.2, 0], [0.1, 0, 0], [0, 0, 0]], "pinned": [0]},
    "springs": [
        {"name": "linear", "between": [[0, 1], [1, 2]], "stiffness": 300, "damping": 2, "rest_scale": 0.9},
        {"name": "curved", "between": [[2, 3]], "curve": {"elongation": [-0.5, 0, 0.5], "force": [-100, 0, 300]}, "damping": 1},
        {"name": "cables", "between": [[3, 4], [0, 2]], "law": "length", "stiffness": 50, "rest_length": 1.2, "damping": 3,
         "compression": False},
    ],
    "driven": [{"particles": [4], "motion": "harmonic", "amplitude": [0.1, 0.2, 0], "frequency": 0.7}],
    "loads": [{"particles": [2], "force": [1, 2, 3]}],
    "run": {"method": "rk4", "step": 1e-3, "duration": 0.5, "every": 0.1},
}


@pytest.fixture
def springs(tmp_path):
    hooke.run(hooke.Scene.parse(SPRINGS), output=tmp_path / "out.h5")
    return hooke.open(tmp_path / "out.h5")


def test_tensions_are_those_of_their_laws(springs):
    """k (l - l0) + c dl/dt by hand, for a curve the slope of its energy, and 0 where a cable is slack."""
    system, slack, taut = springs.system, 0, 0
    material = system.spring_material
    for frame in range(len(springs)):
        _, t, q, v = springs[frame]
        x, u = (np.diff(each[springs.springs], axis=1)[:, 0] for each in (q, v))
        length = np.linalg.norm(x, axis=1)
        damping = material.gamma * (x * u).sum(axis=1) / length
        elastic = material.kappa * (length - material.rest_length)
        moved, h = np.array([q, q]), 1e-6
        moved[:, 3] += h * np.outer([1, -1], x[2] / length[2])
        cable = np.maximum(np.linalg.norm(moved[:, 4] - moved[:, 3], axis=1) - 1.2, 0)
        energy = [system.spring_energy(each, t) for each in moved] - 0.5 * material.kappa[3] * cable**2
        elastic[2] = (energy[0] - energy[1]) / (2 * h)
        free = elastic + damping
        cables = slice(3, 5)
        is_slack = (length[cables] <= 1.2) | (free[cables] < 0)
        free[cables][is_slack] = 0
        slack, taut = slack + is_slack.sum(), taut + (~is_slack).sum()
        assert springs.tension(frame) == pytest.approx(free, rel=1e-6, abs=1e-6)
    assert slack > 0 and taut > 0


def test_reactions_are_what_the_others_do_not_bear(springs):
    """All forces inside cancel: the sum of m a over all particles is that of weights, loads and reactions."""
    mass, gravity = springs.mass, np.array([0, -9.81, 0])
    for frame in range(len(springs)):
        _, t, q, v = springs[frame]
        acceleration = springs.system.acceleration(q, v, t)
        acceleration[4] = -((2 * np.pi * 0.7) ** 2) * np.array([0.1, 0.2, 0]) * np.sin(2 * np.pi * 0.7 * t)
        reaction = springs.reaction(frame)
        assert (reaction[1:4] == 0).all() and (np.abs(reaction[[0, 4]]).max(axis=1) > 1).all()
        outside = mass.sum() * gravity + [1, 2, 3] + reaction.sum(axis=0)
        assert outside == pytest.approx(mass @ acceleration, abs=1e-10)


def test_a_callback_leaves_reactions_unknown(tmp_path):
    def push(t, q, v, force):
        force += 1.0

    path = tmp_path / "out.h5"
    hooke.run(hooke.Scene.parse(SIX_PARTICLES), force=push, output=path)
    with pytest.raises(hooke.BadValue, match="callback"):
        hooke.open(path).reaction()
