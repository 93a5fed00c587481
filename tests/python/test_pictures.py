"""Pictures for a paper: what they draw, and that their words do not overlap."""

import itertools

import numpy as np
import pytest
from conftest import ROOT, build_oscillator

import hooke

plt = pytest.importorskip("matplotlib.pyplot")


@pytest.fixture(autouse=True)
def close():
    yield
    plt.close("all")


def overlapping(axes):
    """Pairs of words of 3-d axes that overlap, by half of their boxes, since slanted ones do not fill theirs."""
    axes.figure.canvas.draw()
    words = []
    for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
        low, high = axis.get_view_interval()
        labels = [tick.label1 for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
        words += [axis.label, *(label for label in labels if low <= float(label.get_text().replace("\u2212", "-")) <= high)]
    boxes = [(word.get_text(), word.get_window_extent().shrunk(0.5, 0.5)) for word in words if word.get_text()]
    return [(a, b) for (a, one), (b, other) in itertools.combinations(boxes, 2) if one.overlaps(other)]


@pytest.mark.parametrize("name", ["cloth-16", "mooring", "lattice", "six-particles"])
def test_words_of_a_scene_stand_apart(name):
    axes = hooke.plot.cloth(hooke.Scene.load(ROOT / f"examples/scenes/{name}.json"))
    assert not overlapping(axes)
    assert [axis.get_label_text() for axis in (axes.xaxis, axes.yaxis, axes.zaxis)] == ["z [m]", "x [m]", "y [m]"]


def test_a_cloth_is_a_surface_and_other_springs_have_depth():
    scene = hooke.Scene(gravity=(0, -1, 0)).cloth(size=(3, 4), edges=((1, 0, 0), (0, 0, 1)), mass=1, structural=dict(stiffness=1))
    scene.rope(from_=(0, 2, 0), to=(3, 2, 3), segments=5, mass=1, stretch=dict(stiffness=1))
    surface, lines = hooke.plot.cloth(scene, ax=None, color="#0072B2").collections
    assert len(surface.get_facecolor()) == 2 * 3 and len(lines._segments3d) == 5
    surface.figure.canvas.draw()
    assert all(len(path.vertices) == 5 for path in surface.get_paths()), "four corners, and the first again"
    shades = lines.get_colors()[:, :3].sum(axis=1)
    assert (np.diff(shades) < 0).all(), "the nearest last, and the darkest"
    assert len(hooke.plot.cloth(scene, surface=False).collections) == 1


def test_quantities_over_time(tmp_path):
    scene = hooke.Scene.parse(build_oscillator().text)
    result = hooke.run(scene, method="rk4", step=1e-3, duration=1, every=0.01, output=tmp_path / "out.h5")
    ax = plt.figure().add_subplot()
    assert hooke.plot.over_time(result, "1.x", ax) is ax and ax.get_ylabel() == "1.x [m]"
    t, x = ax.lines[0].get_data()
    np.testing.assert_allclose(x, 1 + 0.25 * np.cos(np.sqrt(40) * t), atol=1e-8)  # of the oscillator that conftest.py builds
    with hooke.open(tmp_path / "out.h5") as out:
        assert [line.get_label() for line in hooke.plot.over_time(out, ["energy", "kinetic"]).lines] == ["energy", "kinetic"]
        unit, tension = out.watched("spring:0.tension")["spring:0.tension"]
        np.testing.assert_allclose(tension, [out.tension(k)[0] for k in range(len(out))])
        with pytest.raises(hooke.BadValue, match="one unit at a time"):
            hooke.plot.over_time(out, "1.x,energy")
    assert unit == "N"
    with pytest.raises(hooke.BadValue, match="output"):
        hooke.plot.over_time(hooke.run(build_oscillator(), method="rk4", step=1e-3, duration=0.1), "1.x")


def test_work_and_precision():
    study = hooke.study(build_oscillator(), ["verlet", "rk4"], duration=1, want=1e-4)
    axes = hooke.plot.work_precision(study, cost="force_evaluations", want="0.1mm")
    lines = {line.get_label(): line for line in axes.lines}
    rows = study.rows[study.method == "rk4"]
    np.testing.assert_array_equal(lines["rk4"].get_xdata(), rows["force_evaluations"][rows["error_max"] > 0])
    assert lines["wanted: 0.0001 m"].get_ydata()[0] == 1e-4 and lines["rk4"].get_marker() != lines["verlet"].get_marker()
    assert axes.get_ylabel() == "error [m]"
