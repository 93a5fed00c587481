"""hooke.rest: positions of rest against statics that know nothing of hooke."""

import json
import pathlib

import numpy as np
import pytest

import hooke

LINES = json.loads((pathlib.Path(__file__).parents[1] / "data" / "catenary.json").read_text())["rows"]
GRAVITY = 9.81


def build_line(row, springs):
    """A rope whose ends, held, carry half a spring's weight, as in the data."""
    weight = row["weight_per_length"] * row["unstretched_length"]
    scene = hooke.Scene(gravity=(0, -GRAVITY, 0))
    length = row["unstretched_length"] / springs
    place = np.linspace((0, 0, 0), (row["span"], row["rise"], 0), springs + 1)
    scene.particles(place, mass=weight / springs / GRAVITY, pinned=[0, springs])
    between = [(k, k + 1) for k in range(springs)]
    return scene.springs("line", between=between, stiffness=row["EA"], rest_length=length)


def pull_at(scene, found, row, springs):
    """Horizontal and vertical force of the line on its lower end, by Hooke's law at the position of rest."""
    length = row["unstretched_length"] / springs
    d = found.position[1] - found.position[0]
    stretched = np.linalg.norm(d)
    return row["EA"] * (stretched / length - 1) * d / stretched


@pytest.mark.parametrize("springs", (50, 200))
@pytest.mark.parametrize("row", LINES, ids=lambda row: f"{row['span']:g}")
def test_an_elastic_line_hangs_as_statics_say(row, springs):
    scene = build_line(row, springs)
    found = scene.rest(watch=f"line:0.tension,line:{springs - 1}.tension")
    assert found.status == "at rest"
    known, continuous = row[f"springs_{springs}"], row["continuous"]
    lower, upper = found.watched.values()
    assert lower == pytest.approx(known["tension_lower"], rel=1e-8)
    assert upper == pytest.approx(known["tension_upper"], rel=1e-8)
    pull, half = pull_at(scene, found, row, springs), row["weight_per_length"] * row["unstretched_length"] / springs / 2
    assert pull[0] == pytest.approx(known["H"], rel=1e-8)
    assert pull[1] - half == pytest.approx(known["V_lower"], rel=1e-8)
    if springs == 200:
        assert pull[0] == pytest.approx(continuous["H"], rel=1e-3)
        assert pull[1] - half == pytest.approx(continuous["V_lower"], rel=1e-3)


def test_a_cable_net_hangs_as_force_densities_say():
    """Equal force densities and loads give the net by one linear system; rest lengths follow from Hooke's law."""
    n, density, load, stiffness = 7, 30.0, 2.0, 900.0
    number = np.arange(n * n).reshape(n, n)
    between = np.vstack([np.stack([a.ravel(), b.ravel()], 1)
                         for a, b in ((number[:, :-1], number[:, 1:]), (number[:-1], number[1:]))])
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    place = np.stack([x, 0.3 * (x - 3.0) * (y - 3.0), y], -1).reshape(-1, 3).astype(float)
    held = np.unique(np.concatenate([number[0], number[-1], number[:, 0], number[:, -1]]))
    free = np.setdiff1d(number, held)
    matrix = np.zeros((n * n, n * n))
    for i, j in between:
        matrix[[i, j], [i, j]] += density
        matrix[[i, j], [j, i]] -= density
    right = np.tile((0.0, -load, 0.0), (len(free), 1)) - matrix[np.ix_(free, held)] @ place[held]
    net = place.copy()
    net[free] = np.linalg.solve(matrix[np.ix_(free, free)], right)
    lengths = np.linalg.norm(net[between[:, 0]] - net[between[:, 1]], axis=1)
    scene = hooke.Scene(gravity=(0, -GRAVITY, 0)).particles(place, mass=load / GRAVITY, pinned=held)
    scene.springs("net", between=between, stiffness=stiffness, rest_length=lengths / (1 + density * lengths / stiffness))
    found = scene.rest()
    assert found.status == "at rest" and found.minimum is True and found.zero_modes == 0
    assert np.abs(found.position - net).max() < 1e-9
    assert found.largest_force == pytest.approx(density * lengths.max(), rel=1e-9)


def test_slack_cables_leave_free_motions():
    """A taut line of three springs; a slack branch of two particles hangs nowhere, and any place is as good."""
    scene = hooke.Scene().particles(
        [(0, 0, 0), (1, 0.2, 0), (2, 0, 0), (3, 0, 0), (1, 0.3, 0), (1, 0.4, 0)], mass=1, pinned=[0, 3]
    )
    scene.springs("cables", between=[(0, 1), (1, 2), (2, 3), (1, 4), (4, 5)], stiffness=100, compression=False,
                  rest_length=[0.9, 0.9, 0.9, 0.5, 0.5])
    found = scene.rest(watch="cables:0.tension,cables:3.tension")
    assert found.status == "at rest" and found.minimum is True and found.zero_modes == 6
    assert list(found.watched.values()) == pytest.approx([100 * (1 / 0.9 - 1), 0], abs=1e-9)


def test_a_tip_load_bends_a_beam():
    """P L^3/(3 EI), to second order in the segments from either side of it."""
    length, bending, load = 1.0, 2.0, 1e-3
    errors = []
    for segments in (10, 20, 40):
        scene = hooke.Scene().rope(segments=segments, from_=(0, 0, 0), to=(length, 0, 0), mass=0.1, clamped="start",
                                   stretch=dict(stiffness=1e5), bending=bending)
        scene.loads(particles=[segments], force=(0, -load, 0))
        found = scene.rest(watch=f"{segments}.y")
        assert found.status == "at rest"
        errors.append(next(iter(found.watched.values())) / (-load * length**3 / (3 * bending)) - 1)
    assert abs(errors[-1]) < 1e-3
    assert 1.8 < np.log2(errors[0] / errors[1]) < 2.2 and 1.8 < np.log2(errors[1] / errors[2]) < 2.2


def test_a_mass_on_top_of_a_spring_rests_but_does_not_stay():
    scene = hooke.Scene(gravity=(0, -GRAVITY, 0)).particles([(0, 0, 0), (0, 1, 0)], mass=2, pinned=[0])
    found = scene.springs(between=[(0, 1)], stiffness=500, rest_length=1).rest()
    shorter = 2 * GRAVITY / 500
    assert found.status == "at rest" and found.minimum is False
    assert found.position[1] == pytest.approx((0, 1 - shorter, 0), abs=1e-12)
    assert f"grows at {np.sqrt(GRAVITY / (1 - shorter)):.6g} 1/s" in str(found)


def test_what_nothing_holds_falls():
    scene = hooke.Scene(gravity=(0, 0, -GRAVITY)).particles([(0, 0, 0), (1, 0, 0)], mass=3)
    found = scene.springs(between=[(0, 1)], stiffness=10, rest_length=0.5).rest()
    assert found.status == "none" and found.minimum is None and found.zero_modes is None or np.isnan(found.zero_modes)
    assert found.residual == pytest.approx(3 * GRAVITY) and "falls along 0 0 -1" in str(found)


def test_what_floats_rests_where_it_is():
    """Three translations and two rotations of a pair without weight; its centre stays."""
    scene = hooke.Scene().particles([(0, 0, 0), (1, 0, 0)], mass=3)
    found = scene.springs(between=[(0, 1)], stiffness=10, rest_length=0.5).rest()
    assert found.status == "at rest" and found.minimum is True and found.zero_modes == 5
    assert found.position.ravel() == pytest.approx([0.25, 0, 0, 0.75, 0, 0], abs=1e-12)


def hang(**options):
    scene = hooke.Scene(**options).particles([(0, 0, 0), (1, 0, 0)], mass=2, pinned=[0])
    return scene.springs(between=[(0, 1)], stiffness=300, damping=5 if "dynamics" not in options else 0, rest_length=1)


def test_drag_does_not_matter_and_wind_does():
    still = hang(gravity=(0, -GRAVITY, 0), drag=3.0).rest()
    slow = hang(gravity=(0, -GRAVITY, 0), drag=3.0, dynamics="overdamped").rest()
    windy = hang(gravity=(0, -GRAVITY, 0), drag=3.0, wind=(4, 0, 0)).rest()
    assert still.position[1] == pytest.approx((0, -1 - 2 * GRAVITY / 300, 0), abs=1e-10)
    assert slow.position == pytest.approx(still.position, abs=1e-10)
    pull = np.array((3.0 * 4, -2 * GRAVITY, 0))
    size = np.linalg.norm(pull)
    assert windy.position[1] == pytest.approx((1 + size / 300) * pull / size, abs=1e-9)
    assert windy.minimum is None and still.minimum is True


def test_what_moves_is_held_where_it_is_at_the_start():
    """A driven hook, 0.5 m off at the start and fast; a floor that rises, with friction."""
    scene = hooke.Scene(gravity=(0, -GRAVITY, 0)).particles([(0, 0, 0), (0.3, -1, 0), (3, 0.1, 0)], mass=2)
    scene.springs("cord", between=[(0, 1)], stiffness=300, damping=5, rest_length=1)
    scene.driven(particles=[0], motion="harmonic", amplitude=(1, 0, 0), frequency=7, phase=np.pi / 6)
    scene.obstacles(shape="plane", point=(0, -3, 0), normal=(0, 1, 0), stiffness=1e4, damping=10, friction=0.5,
                    friction_speed=0.01, particles=[2], motion="harmonic", amplitude=(0, 2, 0), frequency=1, phase=np.pi / 2)
    found = scene.rest(watch="cord:0.tension,period:1.x")
    assert found.status == "at rest"
    assert found.position[1] == pytest.approx((0.5, -1 - 2 * GRAVITY / 300, 0), abs=1e-9)
    assert found.position[2] == pytest.approx((3, -1 - 2 * GRAVITY / 1e4, 0), abs=1e-9)
    assert found.watched["cord:0.tension"] == pytest.approx(2 * GRAVITY, rel=1e-9) and np.isnan(found.watched["period:1.x"])
    assert "friction is left out" in str(found) and "at its value at the start" in str(found)


def test_bodies_rest_where_their_weight_hangs_below_the_pin():
    """A rigid triangle, pinned at a corner: its centre of mass comes below that, and nothing moves it."""
    scene = hooke.Scene(gravity=(0, -GRAVITY, 0)).particles([(0, 0, 0), (1, 0, 0), (1, 1, 0)], mass=[1, 1, 1], pinned=[0])
    scene.system.add_body("triangle", [0, 1, 2])
    found = scene.rest()
    middle = found.position[1:].mean(0)
    assert found.status == "at rest" and middle == pytest.approx((0, -np.hypot(1, 0.5), 0), abs=1e-8)


def test_the_search_can_be_stopped_and_has_a_budget():
    scene = hooke.Scene.load("examples/scenes/cloth-64.json")
    assert hooke.rest(scene, progress=lambda done, what: 1).outcome == "stopped"
    found = hooke.rest(scene, budget=1e-3)
    assert found.status == "none" and "there may be" in str(found)
