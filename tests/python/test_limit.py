"""hooke.limit: rows, modes, limiting springs, remedy, the state, and the picture."""

import json
import math

import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator, build_six_particles

import hooke

FIXED_STEP = ["forward-euler", "symplectic-euler", "verlet", "shardlow", "heun", "rk4", "backward-euler", "tr-bdf2",
              "implicit-midpoint"]
OMEGA = math.sqrt(40)  # of the oscillator


def build_damped(damping):
    """One spring along x that is damped along its length, its first end pinned."""
    system = hooke.System()
    system.add_particles([[0, 0, 0], [1, 0, 0]], mass=[1, 0.5])
    system.pin(0)
    system.add_springs("spring", [[0, 1]], stiffness=20, damping=damping, rest_length=1)
    return system


def eigenvalues(system, q):
    """Matrices of the free particles, from the derivative blocks at rest."""
    blocks, n = system.derivative_blocks(q, np.zeros_like(q)), system.particle_count
    weight = np.repeat(system.inverse_masses, 3)
    whole = np.zeros((2, 3 * n, 3 * n))
    for matrix, values in zip(whole, (blocks.dfdq, blocks.dfdv)):
        for row in range(n):
            for k in range(blocks.row_start[row], blocks.row_start[row + 1]):
                column = blocks.column[k]
                matrix[3 * row : 3 * row + 3, 3 * column : 3 * column + 3] = values[k]
    free = np.flatnonzero(weight)
    k, c = (weight[free, None] * matrix[np.ix_(free, free)] for matrix in whole)
    companion = np.block([[np.zeros_like(k), np.eye(len(k))], [k, c]])
    return np.linalg.eigvals(companion)


def test_rows():
    found = hooke.limit(build_oscillator())
    assert found.methods == FIXED_STEP and found.outcome == "finished" and found.time == 0
    assert found.frequency_max == pytest.approx(OMEGA, rel=1e-12) and found.rate_max == 0 and found.clamped == 0
    factors = {"symplectic-euler": 2, "verlet": 2, "shardlow": 2, "rk4": 2 * math.sqrt(2)}
    for method, factor in factors.items():
        row = found[method]
        assert row["predicted"] == pytest.approx(factor / OMEGA, rel=1e-9)
        assert 0 < row["bound"] <= row["predicted"] and row["exact"] and not row["never_stable"]
        assert 0.98 < row["ratio"] < 1.02 and row["ratio"] == row["measured"] / row["predicted"]
        assert row["steps_run"] > 100 and np.isnan(row["smallest"])
    assert found["forward-euler"]["never_stable"] and found["forward-euler"]["predicted"] == 0
    assert np.isinf(found["backward-euler"]["predicted"]) and "accuracy" in found["backward-euler"]["note"]
    assert found.rows["by_eigenvalue"].tolist() == [True, False, False, False, True, True, False, False, False]
    with pytest.raises(KeyError, match="cvode-bdf"):
        found["cvode-bdf"]
    with pytest.raises(ValueError):
        found.rows["predicted"][0] = 1


@pytest.mark.parametrize("build", [build_six_particles, lambda: build_damped(0.8), lambda: build_damped(60)])
def test_modes_are_the_eigenvalues(build):
    system = build()
    found = hooke.limit(system, predict=True)
    exact = eigenvalues(system, system.state().q)
    exact = exact[(exact.imag >= 0) & (abs(exact) > 1e-6 * abs(exact).max())]
    assert found.modes.shape == found.frequency.shape == found.decay.shape == (len(exact),)
    order = np.lexsort((exact.imag, -abs(exact).round(9)))
    np.testing.assert_allclose(abs(found.modes), abs(exact[order]), rtol=1e-6)
    for value in exact:
        assert abs(found.modes - value).min() < 1e-6 * abs(exact).max()
    z, w, d = found.modes, found.frequency, found.decay
    np.testing.assert_allclose(z**2 + 2 * d * z + w**2, 0, atol=1e-9 * abs(z).max() ** 2)
    assert (d >= 0).all() and found.frequency_max == pytest.approx(w.max(), rel=1e-6)


def test_what_it_hangs_on():
    found = hooke.limit("examples/scenes/stiff-spring.json", predict=True)
    first = found.blame[0]
    assert (first.spring, first.ends, first.group) == (6, (3, 4), "stiff") and 0.99 < first.share <= 1
    shares = [one.share for one in found.blame]
    assert shares == sorted(shares, reverse=True)
    assert {one.particle for one in found.participation[:2]} == {3, 4}
    assert sum(one.share for one in found.participation) == pytest.approx(1, abs=1e-6)
    assert found.changes.kind == "soften" and found.changes.springs == 1 and np.isnan(found.changes.particles)
    assert 50 < found.changes.gain < 72 < found.changes.cost * 1.01 and found.changes.factor > 1000
    # by Gragg-Bulirsch-Stoer extrapolation in long double the softer spring puts the run 0.2284998 m off
    assert found.changes.error == pytest.approx(0.2284998, rel=2e-3) and np.isnan(found.changes.want)
    assert found.changes.sentence.endswith("softened so, the run is 0.23 m off (tried)")
    assert "softening it, and its damping, by 5100 allows" in found.changes.sentence
    assert found.shape.shape == (8, 3)
    sizes = np.linalg.norm(found.shape, axis=1)
    assert sizes.max() == pytest.approx(1) and set(np.argsort(sizes)[-2:]) == {3, 4}
    free = hooke.System()
    free.add_particles([[0, 0, 0]], mass=1)
    nothing = hooke.limit(free, predict=True)
    unstable = hooke.limit("examples/scenes/stiff-spring.json", predict=True, methods="heun")
    assert unstable.changes is None and not any(claim.key == "changes" for claim in unstable.claims)
    assert nothing.shape is None and nothing.blame == [] and nothing.changes is None and nothing.modes.size == 0


def test_where(tmp_path):
    scene = hooke.Scene.parse(SIX_PARTICLES)
    result = hooke.run(scene, output=tmp_path / "out.h5", frames=True)
    start = hooke.limit(scene, predict=True)
    end = hooke.limit(scene, tmp_path / "out.h5", predict=True)
    assert end.time == 0.5 and (end.rows["predicted"][1:4] != start.rows["predicted"][1:4]).all()
    assert start.step == 1e-3
    for at in ((tmp_path / "out.h5", -1), result.state, result.state.q, result.frames.q[-1]):
        np.testing.assert_array_equal(hooke.limit(scene, at, predict=True).rows["predicted"], end.rows["predicted"])
    first = hooke.limit(scene, (tmp_path / "out.h5", 0), predict=True)
    assert first.time == 0 and (first.rows["predicted"] == start.rows["predicted"]).all()
    with pytest.raises(hooke.BadValue, match="99"):
        hooke.limit(scene, (tmp_path / "out.h5", 99), predict=True)
    with pytest.raises(hooke.BadValue, match="does not fit"):
        hooke.limit(build_oscillator(), result.state, predict=True)


def test_the_step_of_one_mode():
    step = hooke.Limit.step_of_mode
    assert step("symplectic-euler", 4.0, 0.0) == pytest.approx(0.5) and step("forward-euler", 4.0, 0.0) == 0
    many = step("rk4", [1.0, 2.0, 0.0], 0.0)
    assert many.tolist() == pytest.approx([8**0.5, 8**0.5 / 2, np.inf]) and np.isinf(step("cvode-bdf", 1.0, 0.0)) and np.isnan(step("other", 1.0, 0.0))


def test_along_a_run():
    scene = hooke.Scene.parse(SIX_PARTICLES)
    found = hooke.limit(scene, along=True)
    start = hooke.limit(scene, predict=True)
    for method in ("symplectic-euler", "verlet", "rk4"):
        row = found[method]
        assert row["smallest"] <= min(row["predicted"], start[method]["predicted"])
        assert 0 <= row["smallest_time"] <= 0.5 and np.isnan(row["measured"])
    assert found.time == 0.5 and "at the frames up to t = 0.5 s the smallest limit of " in str(found)
    assert scene.system.state().t == 0


def test_options_and_stopping():
    found = hooke.limit(build_oscillator(), None, ["rk4", "verlet"], accuracy=1e-2, budget=5)
    assert found.methods == ["rk4", "verlet"]
    assert hooke.limit(build_oscillator(), methods="verlet", predict=True).methods == ["verlet"]
    told = []
    stopped = hooke.limit(build_oscillator(), progress=lambda done, what: told.append((done, what)) or done > 0.04)
    assert stopped.outcome == "stopped" and stopped["rk4"]["predicted"] > 0 and np.isnan(stopped["rk4"]["measured"])
    assert told[0][0] == 0 and all(what for _, what in told)
    with pytest.raises(ZeroDivisionError):
        hooke.limit(build_oscillator(), progress=lambda done, what: 1 / 0)
    with pytest.raises(hooke.BadValue, match="verlot"):
        hooke.limit(build_oscillator(), methods="verlot")
    with pytest.raises(hooke.BadValue, match="accuracy"):
        hooke.limit(build_oscillator(), accuracy=2)
    with pytest.raises(hooke.BadValue, match="first-order"):
        hooke.limit(hooke.FirstOrder(lambda t, x, out: None, [1.0]))
    assert "accuracy" in hooke.describe("limit")


def test_picture():
    import matplotlib.pyplot as plt

    found = hooke.limit(build_damped(0.8), predict=True)
    plane, reach = found.plot()
    lines = {line.get_label(): line.get_xydata() for line in plane.lines}
    assert set(lines) == {"forward-euler", "heun", "rk4", "modes"}
    z = {name: xy @ [1, 1j] for name, xy in lines.items()}
    np.testing.assert_allclose(abs(1 + z["forward-euler"]), 1, atol=1e-12)
    np.testing.assert_allclose(abs(1 + z["heun"] + z["heun"] ** 2 / 2), 1, atol=1e-12)
    r = z["rk4"]
    np.testing.assert_allclose(abs(1 + r + r**2 / 2 + r**3 / 6 + r**4 / 24), 1, atol=1e-11)
    assert abs(r.real.min() + 2.785293563) < 1e-8 and abs(r.imag).max() > 2.8
    # no step is named: the smallest limit is used, that of forward Euler, on whose circle its eigenvalues are
    step = found["forward-euler"]["predicted"]
    np.testing.assert_allclose(abs(1 + z["modes"]).max(), 1, atol=1e-9)
    np.testing.assert_allclose(np.sort_complex(z["modes"]), np.sort_complex(np.r_[found.modes, found.modes.conj()] * step))
    lines = {line.get_label(): line.get_xydata().T for line in reach.lines}
    assert set(lines) == {"forward-euler", "symplectic-euler", "verlet", "shardlow", "heun", "rk4", "modes",
                          "critical damping"}
    x, y = lines["symplectic-euler"]
    np.testing.assert_allclose(x**2 + 4 * y, 4, atol=1e-12)
    np.testing.assert_allclose(lines["verlet"][0][:150], 2, atol=1e-12)
    again = found.plot((plane, reach), step=0.1)
    np.testing.assert_array_equal(again[0].lines[-1].get_xydata()[:, 0], 0.1 * np.r_[found.modes, found.modes].real)
    again[0].figure.canvas.draw()
    same = found.plot(step="100 ms")[0].lines[-1].get_xydata()
    np.testing.assert_array_equal(same, again[0].lines[-1].get_xydata())
    found = hooke.limit(build_damped(0.8), methods="backward-euler")
    plane, reach = found.plot()  # neither a step nor a limit
    assert "backward-euler: everywhere" in [line.get_label() for line in reach.lines]
    assert np.hypot(*plane.lines[-1].get_xydata().T).max() == pytest.approx(2)
    plt.close("all")


def test_files(tmp_path):
    found = hooke.limit("examples/scenes/stiff-spring.json", predict=True)
    found.write(tmp_path / "limit.json")
    value = json.loads((tmp_path / "limit.json").read_text())
    assert value["frequency_max"] == found.frequency_max and value["blamed"] == "symplectic-euler"
    assert [row["predicted"] for row in value["rows"]][1:4] == found.rows["predicted"][1:4].tolist()
    assert value["blame"][0]["number"] == found.blame[0].spring and value["changes"]["sentence"] == found.changes.sentence
    assert [mode["decay"] for mode in value["modes"]] == found.decay.tolist()
    found.write(tmp_path / "limit.csv")
    assert (tmp_path / "limit.csv").read_text().splitlines()[0] == ",".join(found.rows.dtype.names)
    for name, fact in (("limit.html", "chartjs"), ("limit.h5", "hdf5")):
        if not hooke.build_facts()[fact]:
            with pytest.raises(hooke.NotBuilt):
                found.write(tmp_path / name)
            continue
        found.write(tmp_path / name, title="a chain")
        assert (tmp_path / name).stat().st_size > 10_000
    if hooke.build_facts()["chartjs"]:
        assert '"a chain"' in (tmp_path / "limit.html").read_text()
    with pytest.raises(hooke.BadValue, match="end in"):
        found.write(tmp_path / "limit.pdf")


def test_few_steps_measure_a_limit():
    """Each start is one of motion that turns round at its ends, as that at the limit does."""
    system = hooke.System()
    system.add_particles([[0, 0, 0], [1, 0, 0], [2, 0, 0]], mass=1.0)
    system.pin([0])
    system.add_springs("rods", [[0, 1], [1, 2]], stiffness=100.0, damping=1.0)
    rows = hooke.limit(system, methods=["verlet", "shardlow"]).rows
    np.testing.assert_allclose(rows["measured"], rows["predicted"], rtol=1e-3)
    assert (rows["steps_run"] < 3000).all(), rows["steps_run"]


def swinging(light, damping=0.0):
    """Six masses on springs of their own, the first one light."""
    mass = [light] + [1.0] * 5
    groups = [{"name": "all", "between": [[2 * k, 2 * k + 1] for k in range(6)], "stiffness": 100, "damping": damping}]
    positions = [[k, -y, 0] for k in range(6) for y in (0, 1)]
    return {"hooke": 1, "gravity": [0, -9.81, 0], "springs": groups,
            "run": {"method": "verlet", "duration": 1, "every": 0.02},
            "particles": {"position": positions, "mass": [one for each in mass for one in (1.0, each)],
                          "pinned": list(range(0, 12, 2))}}  # fmt: skip


def fall(mass, t, stiffness=100.0):
    return 9.81 * mass / stiffness * (1 - np.cos(np.sqrt(stiffness / mass) * t))


def test_a_heavier_particle_has_its_price():
    found = hooke.limit(hooke.Scene.parse(swinging(0.01)), predict=True).changes
    t = np.linspace(0, 1, 51)
    assert found.kind == "heavier"
    assert found.error == pytest.approx(abs(fall(0.01 * found.factor, t) - fall(0.01, t)).max(), rel=0.05)


def test_leaving_out_damping_has_its_price():
    """The light one is damped so much that it sinks slowly."""
    found = hooke.limit(hooke.Scene.parse(swinging(1.0, damping=60.0)), predict=True, methods="symplectic-euler",
                        method="symplectic-euler").changes  # fmt: skip
    t = np.linspace(0, 1, 51)
    fast, slow = 30 + np.sqrt(800), 30 - np.sqrt(800)
    sinks = 0.0981 * (1 - (fast * np.exp(-slow * t) - slow * np.exp(-fast * t)) / (fast - slow))
    assert "without damping the run is" in found.sentence
    assert found.error == pytest.approx(abs(fall(1.0, t) - sinks).max(), rel=0.05)


def test_a_price_that_is_not_known_says_how_to_ask_for_it():
    made = swinging(0.01)
    made["run"]["duration"] = 1e5
    found = hooke.limit(hooke.Scene.parse(made), predict=True).changes
    assert np.isnan(found.error) and found.want == pytest.approx(0.05) and "error of the run is not known" in found.sentence
    del made["run"]["duration"]
    found = hooke.limit(hooke.Scene.parse(made), predict=True).changes
    assert np.isnan(found.error) and np.isnan(found.want)
