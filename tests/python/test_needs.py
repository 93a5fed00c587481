"""hooke.needs: rows, the lean system, resolutions, pictures; and scenes that are saved."""

import json

import h5py
import numpy as np
import pytest
from conftest import SIX_PARTICLES, build_oscillator, build_six_particles

import hooke

ROPES = {
    "hooke": 1,
    "title": "a rope and its twin far away",
    "gravity": [0, -9.81, 0],
    "drag": 1e-9,
    "parts": [
        {"kind": "rope", "name": "rope", "from": [0, 0, 0], "to": [0.5, 0, 0], "segments": 6, "mass": 0.1,
         "pinned": "start", "stretch": {"stiffness": 100, "damping": 0.05}},
        {"kind": "rope", "name": "twin", "from": [9, 0, 0], "to": [9.5, 0, 0], "segments": 6, "mass": 0.1,
         "pinned": "start", "stretch": {"stiffness": 100, "damping": 0.05}},
    ],
    "run": {"method": "symplectic-euler", "step": 1e-4, "duration": 0.2, "every": 0.02},
}


@pytest.fixture(scope="module")
def ropes():
    return hooke.needs(hooke.Scene.parse(ROPES), 2e-3, "rope")


def test_rows(ropes):
    assert ropes.outcome == "finished" and ropes.want == 2e-3 and ropes.method == "symplectic-euler"
    assert ropes.duration == 0.2 and ropes.judged_until == pytest.approx(0.2) and ropes.runs > 2 * len(ropes.rows)
    assert ropes["gravity"]["needed"] and ropes["rope.stretch"]["needed"] and ropes["gravity"]["error"] > 0.01
    assert not ropes["drag"]["needed"] and ropes["drag"]["error"] < 1e-6
    assert ropes["twin"]["error"] == 0 and ropes["twin"]["kind"] == "part" and ropes["twin"]["particles"] == 7
    assert (ropes.rows["needed"] == (ropes.rows["error"] > ropes.want)).all() and ropes.parts.size == 0
    full = ropes.full
    assert (full.particles, full.springs) == (14, 12) and full.steps * full.step == pytest.approx(0.2)
    assert full.step_error <= 0.1 * ropes.want and full.wall_seconds > 0 and np.isnan(full.rtol)
    assert full.step < full.step_limit
    with pytest.raises(KeyError, match="gravity"):
        ropes["graviti"]
    with pytest.raises(ValueError):
        ropes.rows["error"][0] = 1


def test_the_lean_system(ropes, tmp_path):
    assert set(ropes.left_out) <= set(ropes.rows["without"][~ropes.rows["needed"]])
    assert "twin" in ropes.left_out and ropes.lean.particle_count == ropes.lean_cost.particles == 7
    assert 0 < ropes.lean_error <= ropes.want and ropes.lean_cost.springs < ropes.full.springs
    result = hooke.run(ropes.lean, frames=True, **ropes.lean_options)
    assert result.counts["steps"] == ropes.lean_cost.steps
    lean = np.array([ropes.lean_position(q)[:7] for q in result.frames.q])
    full = hooke.run(hooke.Scene.parse(ROPES), frames=True, step=ropes.full.step / 16).frames.q[:, :7]
    error = np.sqrt(((lean - full) ** 2).sum(axis=2)).max()
    assert error <= ropes.lean_error <= error + 2 * ropes.own_error
    assert ropes.own_error <= ropes.full.step_error and ropes.note == ropes.lean_note == "" and ropes.moved > 0.01
    assert ropes.cheapest.step >= ropes.full.step and ropes.cheapest.particles == 14
    assert ropes.times_less == ropes.cheapest.wall_seconds / ropes.lean_cost.wall_seconds
    assert np.isnan(ropes.lean_position(ropes.lean.state().q)[7:]).all()
    ropes.save_lean(tmp_path / "lean.json")
    scene = hooke.Scene.load(tmp_path / "lean.json")
    assert scene.title == ROPES["title"]
    np.testing.assert_array_equal(hooke.run(scene).state.q, result.state.q)
    with pytest.raises(hooke.BadValue):
        ropes.lean_position(np.zeros((3, 3)))


def test_a_lean_cloth_that_is_saved_is_the_lean_system(tmp_path):
    cloth = {"kind": "cloth", "name": "cloth", "origin": [0, 0, 0], "edges": [[0.8, 0, 0], [0, -0.6, 0.5]], "size": [8, 7],
             "mass": 0.1, "pinned": "top", "structural": {"stiffness": 40, "damping": 0.02},
             "shear": {"stiffness": 10}, "bend": {"stiffness": 1e-3}}
    scene = {"hooke": 1, "gravity": [0, -9.81, 0], "drag": 1e-6, "parts": [cloth],
             "run": {"method": "symplectic-euler", "step": 1e-3, "duration": 0.3, "every": 0.02}}
    found = hooke.needs(hooke.Scene.parse(scene), 2e-3)
    assert {"cloth.bend", "drag"} & set(found.left_out) == {"cloth.bend", "drag"}
    found.save_lean(tmp_path / "lean.json")
    text = json.loads((tmp_path / "lean.json").read_text())
    assert "springs" not in text and "particles" not in text and "drag" not in text
    (part,) = text["parts"]
    assert part["kind"] == "cloth" and "bend" not in part and part["pinned"] == "top"
    loaded = hooke.Scene.load(tmp_path / "lean.json")
    np.testing.assert_array_equal(loaded.system.spring_ends, found.lean.spring_ends)
    for saved, measured in zip(loaded.system.spring_material, found.lean.spring_material):
        np.testing.assert_array_equal(saved, measured)
    result = hooke.run(found.lean, **found.lean_options)
    np.testing.assert_array_equal(hooke.run(loaded).state.q, result.state.q)
    np.testing.assert_array_equal(hooke.run(loaded).state.v, result.state.v)


def test_resolutions(ropes):
    found = hooke.needs(hooke.Scene.parse(ROPES), 2e-3, "rope", refine=True)
    assert list(found.parts["part"]) == ["rope", "twin"] and found.rows.size == 0
    rope, twin = found.parts
    assert (rope["cells"], twin["cells"]) == (6, 6) and np.isnan(rope["cells_second"])
    assert rope["change"] > rope["change_fine"] > 0 and 0.25 < rope["order"] < 4.5
    assert rope["order"] == pytest.approx(np.log2(rope["change"] / rope["change_fine"]))
    assert rope["wanted"] == np.ceil(6 * rope["factor"]) and twin["change"] < 1e-4 and twin["note"]
    assert found.lean is None and found.lean_cost is None and found.lean_options == {} and np.isnan(found.lean_error)
    assert "rope has 6 cells" in str(found) and "2 parts" in repr(found)
    with pytest.raises(hooke.BadCall, match="no lean system"):
        found.save_lean("lean.json")
    with pytest.raises(hooke.BadCall):
        found.lean_position(np.zeros((0, 3)))


def test_a_system_what_is_watched_and_stopping():
    system = build_oscillator()
    system.set_gravity([1e-9, 0, 0])
    found = hooke.needs(system, 1e-3, [1], method="verlet", duration=1.0)
    assert found.method == "verlet" and not found["gravity"]["needed"] and found["spring"]["needed"]
    same = hooke.needs(system, 1e-3, "1", method="verlet", duration=1.0)
    np.testing.assert_array_equal(same.rows["error"], found.rows["error"])
    told = []
    stopped = hooke.needs(system, 1e-3, method="verlet", duration=1.0,
                          progress=lambda done, what: told.append((done, what)) or done > 0.3)
    assert stopped.outcome == "stopped" and stopped.lean is None and len(stopped.rows) < len(found.rows)
    assert "the full scene" in {what for _, what in told} and not np.isnan(stopped.full.wall_seconds)
    with pytest.raises(ZeroDivisionError):
        hooke.needs(system, 1e-3, duration=1.0, method="verlet", progress=lambda done, what: 1 / 0)
    with pytest.raises(hooke.BadValue, match="watch"):
        hooke.needs(system, 1e-3, "nobody", duration=1.0)
    with pytest.raises(hooke.BadValue, match="want"):
        hooke.needs(system, 0, duration=1.0)
    with pytest.raises(hooke.BadValue, match="first-order"):
        hooke.needs(hooke.FirstOrder(lambda t, x, out: None, [1.0]), 1e-3)


def test_a_force_of_its_own_lives_in_the_lean_system():
    system = build_six_particles()
    system.set_force(lambda t, q, v, force: force.__iadd__([0, 0, 1e-3]) is None)
    found = hooke.needs(system, 0.5, duration=0.05, every=0.01, method="verlet")
    assert "force callback" in " ".join(found.rows["without"]) or "callback" in found.rows["kind"]
    assert hooke.run(found.lean, **found.lean_options).status == "finished"


def test_scenes_that_are_saved(tmp_path):
    scene = hooke.Scene.parse(SIX_PARTICLES)
    scene.run_options["duration"] = 0.25
    scene.save(tmp_path / "scene.json")
    again = hooke.Scene.load(tmp_path / "scene.json")
    assert again.title == "six particles" and again.run_options["duration"] == 0.25
    assert again.system.groups == scene.system.groups
    np.testing.assert_array_equal(again.run().state.q, scene.run().state.q)
    system = build_six_particles()
    system.save(tmp_path / "system.json", "built", duration=0.1, step=1e-3)
    text = json.loads((tmp_path / "system.json").read_text())
    assert text["title"] == "built" and text["run"] == {"duration": 0.1, "step": 1e-3}
    np.testing.assert_array_equal(hooke.run(tmp_path / "system.json").state.q,
                                  hooke.run(system, duration=0.1, step=1e-3).state.q)
    with pytest.raises(hooke.IOFailed):
        system.save(tmp_path / "nowhere" / "system.json")
    called = build_six_particles()
    called.set_force(lambda t, q, v, force: None)
    with pytest.raises(hooke.Unsuited):
        called.save(tmp_path / "called.json")


def test_files(ropes, tmp_path):
    for ending in ("json", "csv", "h5", "html"):
        ropes.write(tmp_path / f"needs.{ending}")
    found = json.loads((tmp_path / "needs.json").read_text())
    names = ropes.rows["without"].tolist()
    assert [row["without"] for row in found["rows"]] == names and found["watched"] == 7
    assert found["full"]["springs"] == 12 and found["lean"]["error"] == ropes.lean_error and found["parts"] == []
    assert found["lean"]["full"]["wall_seconds"] == ropes.cheapest.wall_seconds
    lines = (tmp_path / "needs.csv").read_text().splitlines()
    assert lines[0].startswith("without,kind,error,needed,left_out,") and len(lines) == 1 + len(names)
    with h5py.File(tmp_path / "needs.h5") as file:
        assert file["needs/without"].asstr()[:].tolist() == names and file["needs"].attrs["want"] == 2e-3
        assert file["needs/lean"].attrs["error"] == ropes.lean_error
    assert ROPES["title"] in (tmp_path / "needs.html").read_text()


def test_picture(ropes):
    import matplotlib.pyplot as plt

    ax = ropes.plot()
    names = [label.get_text() for label in ax.get_yticklabels()]
    assert sorted(names) == sorted(ropes.rows["without"]) and ax.get_xscale() == "log"
    for bars in ax.containers:
        for bar in bars:
            row = ropes[names[round(bar.get_y() + bar.get_height() / 2)]]
            wide = bar.get_width()
            assert (wide > ropes.want) == row["needed"] and (wide == row["error"] or row["error"] < ax.get_xlim()[0])
            assert (bars.get_label() == "needed") == row["needed"]
    assert ax.lines[0].get_xdata()[0] == ropes.want
    assert hooke.plot.needs(ropes, ax) is ax
    ax.figure.canvas.draw()
    plt.close("all")


def test_a_part_may_be_coarser_than_half_until_it_breaks_the_want():
    """A rope of 24 segments, hanging from its end and let go unstretched; runs of ropes made apart say what fewer do."""

    def rope(segments, **run):
        return hooke.Scene.parse({"hooke": 1, "gravity": [0, -9.81, 0], "run": {"duration": 0.5, "every": 0.01, **run}, "parts": [
            {"kind": "rope", "name": "rope", "from": [0, 0, 0], "to": [0, -1, 0], "segments": segments, "mass": 0.2,
             "pinned": ["start"], "stretch": {"stiffness": 500, "damping": 0.5}}]})  # fmt: skip

    def heights(segments):
        height = hooke.run(rope(segments), method="cvode-adams", rtol=1e-9, frames=True).frames.q[:, :, 1]
        return np.array([np.interp(np.arange(25) / 24, np.arange(segments + 1) / segments, one) for one in height])

    found = hooke.needs(rope(24), "0.1mm", method="verlet")
    (row,) = [row for row in found.rows if row["kind"] == "resolution"]
    eight, five = (abs(heights(segments) - heights(24)).max() for segments in (8, 5))
    assert row["without"] == "all but 8 of 24 cells of rope" and row["left_out"]
    assert row["error"] == pytest.approx(eight, rel=0.03) and eight < 1e-4 < five
