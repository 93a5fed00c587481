"""Scenes built in Python: the same as from a file, every keyword of the tables, errors where they are made."""

import inspect
import json
import re
import typing

import numpy as np
import pytest
from conftest import ROOT, SIX_PARTICLES

import hooke
from hooke.parts import Springs

CLOTH = {"size": (12, 12), "edges": ((1, 0, 0), (0, 0, 1)), "mass": 1}
SQUARE = {"size": (3, 2), "edges": [[2, 0, 0], [0, 0, 1]], "mass": 6}


def six_particles():
    particles, springs = SIX_PARTICLES["particles"], SIX_PARTICLES["springs"]
    scene = hooke.Scene(SIX_PARTICLES["title"], gravity=SIX_PARTICLES["gravity"], run=SIX_PARTICLES["run"])
    return scene.particles(**particles).springs(**springs[0])


def same(a, b):
    """Two systems are equal to the bit."""
    state, other = a.state(), b.state()
    assert np.array_equal(state.q, other.q) and np.array_equal(state.v, other.v)
    assert np.array_equal(a.masses, b.masses) and np.array_equal(a.inverse_masses, b.inverse_masses)
    assert np.array_equal(a.spring_ends, b.spring_ends) and a.groups == b.groups and a.forces == b.forces
    for mine, theirs in zip(a.spring_material, b.spring_material):
        assert np.array_equal(mine, theirs)
    assert np.array_equal(a.bending_ends, b.bending_ends)
    v = np.ones_like(state.v)
    assert np.array_equal(a.force(state.q, v, 0.25), b.force(other.q, v, 0.25))
    return True


# keywords


@pytest.mark.parametrize("kind", hooke.part_kinds())
def test_every_kind_of_part_has_a_method_with_the_keywords_of_its_table(kind):
    method = getattr(hooke.Scene, kind)
    keywords = {name.rstrip("_") for name in inspect.signature(method).parameters} - {"self", "name"}
    table = [line.split()[0] for line in hooke.describe(kind).splitlines()]
    assert keywords == {name.split(".")[0] for name in table}
    for keyword in keywords:
        assert re.search(rf"`{keyword}(_|\b)", method.__doc__), f"{keyword} is not in the docstring of {kind}"


@pytest.mark.parametrize("kind", hooke.part_kinds())
def test_families_of_springs_have_the_keys_of_the_table(kind):
    rows = [line.split()[0].split(".") for line in hooke.describe(kind).splitlines()]
    families = {row[0] for row in rows if row[-1] == "stiffness" and len(row) == 2}
    hints = typing.get_type_hints(getattr(hooke.Scene, kind))
    for family in families:
        assert {row[1] for row in rows if row[0] == family and len(row) == 2} == set(Springs.__annotations__)
        assert hints[family] == typing.Optional[Springs]


def test_springs_have_the_keywords_of_their_table():
    keywords = set(inspect.signature(hooke.Scene.springs).parameters) - {"self", "name", "between"}
    rows = {line.split()[0] for line in hooke.describe("springs").splitlines()}
    assert keywords == {row for row in rows if "." not in row}
    assert {row.partition(".")[2] for row in rows if row.startswith("curve.")} == set(hooke.Curve.__annotations__)


def test_a_curve_is_a_dict(tmp_path):
    table = {"elongation": np.array([0, 0.5, 1]), "force": [0, 1, 8]}
    built = hooke.Scene().particles([[0, 0, 0], [1.5, 0, 0]], mass=1, pinned=[0])
    built.springs(between=[[0, 1]], curve=table, rest_length=1)
    with pytest.raises(hooke.BadValue, match=r"springs\[1\].curve.force\[2\]: 1 after 8"):
        built.springs(between=[[0, 1]], curve={**table, "force": [0, 8, 1]})
    built.save(tmp_path / "scene.json")
    for scene in (built, hooke.Scene.load(tmp_path / "scene.json"), hooke.Scene.parse(built.text)):
        assert scene.system.force(np.array([[0, 0, 0], [1.5, 0, 0]]), np.zeros((2, 3)))[0, 0] == 1.0


def test_anchors_have_the_keywords_of_their_table():
    keywords = set(inspect.signature(hooke.Scene.anchors).parameters) - {"self", "name", "particles"}
    assert keywords == {line.split()[0] for line in hooke.describe("anchors").splitlines()}


def test_loads_are_those_of_the_scene(tmp_path):
    built = hooke.Scene().particles([[0, 0, 0], [1, 0, 0]], mass=1, pinned=[0]).rope(
        "line", from_=[0, 1, 0], to=[1, 1, 0], segments=2, mass=1, pinned="start", stretch=dict(stiffness=5))
    built.loads([1, ("line", 2)], force=(0, -3, 0))
    built.loads(1, motion="harmonic", force=[1, 0, 0], frequency=2)
    built.loads(particles=[("line", 1)], motion="table", force=[[0, 0, 0], [0, 0, 1]], time=[0, 1])
    with pytest.raises(hooke.BadValue, match=r"loads\[3\].particles\[0\]: particle 0 is pinned"):
        built.loads([0], force=[1, 0, 0])
    built.save(tmp_path / "loads.json")
    for scene in (built, hooke.Scene.parse(built.text), hooke.Scene.load(tmp_path / "loads.json")):
        force = scene.system.force(scene.system.state().q, np.zeros((5, 3)), t=0.125)[[1, 3, 4]]
        expected = [[1, -3, 0], [0, 0, force[1, 2]], [0, -3, 0]]
        np.testing.assert_allclose(force, expected, atol=1e-12)
        assert 0.1 < force[1, 2] < 0.15
    system = hooke.System()
    system.add_particles([[0, 0, 0]], mass=2)
    system.add_loads(0, force=[4, 0, 0])
    system.commit()
    assert system.energy(*[np.ones((1, 3))] * 2) == 3 - 4


def test_gravity_factors_are_those_of_the_scene(tmp_path):
    built = hooke.Scene(gravity=[0, -10, 0]).particles([[0, 0, 0], [1, 0, 0]], mass=1, gravity_factor=[0.5, -2]).rope(
        "line", from_=[0, 1, 0], to=[1, 1, 0], segments=1, mass=1, gravity_factor=0.25)
    with pytest.raises(hooke.BadValue, match=r"particles.gravity_factor: 3 factors for 2 particles"):
        hooke.Scene().particles([[0, 0, 0], [1, 0, 0]], mass=1, gravity_factor=[1, 2, 3])
    built.save(tmp_path / "factors.json")
    system = hooke.System()
    system.add_particles(np.zeros((4, 3)), mass=1)
    system.set_gravity([0, -10, 0])
    system.set_gravity_factor([0.5, -2], count=2)
    system.set_gravity_factor(0.25, first=2)
    systems = [scene.system for scene in (built, hooke.Scene.parse(built.text), hooke.Scene.load(tmp_path / "factors.json"))]
    for one in (*systems, system):
        q = one.state().q
        assert one.acceleration(q, 0 * q)[:, 1].tolist() == [-5, 20, -2.5, -2.5]


def test_anchors_are_those_of_the_scene(tmp_path):
    built = hooke.Scene().particles([[0, 0, 0], [1, 0, 0]], mass=1)
    built.anchors("wall", particles=[1], points=[[1, 2, 0]], stiffness=6, damping=0.3, rest_length=0.5)
    built.anchors(particles=0, stiffness=2)
    with pytest.raises(hooke.BadValue, match=r"anchors\[2\].*particles"):
        built.anchors(particles=[2], stiffness=1)
    built.save(tmp_path / "scene.json")
    read = hooke.Scene.load(tmp_path / "scene.json")
    for one, other in zip(built.system.anchors, read.system.anchors):
        assert np.array_equal(one, other)


def test_bending_is_that_of_the_scene(tmp_path):
    """A scene with bending of its own, beside that of a part, is saved, read, run and verified."""
    built = hooke.Scene().particles([[0, 0, 0], [1, 0, 0], [2, 0.5, 0], [3, 0, 0]], mass=1)
    built.springs(between=[[0, 1], [1, 2], [2, 3]], stiffness=10)
    built.rope("line", from_=(0, 1, 0), to=(1, 1, 0), segments=4, mass=1, stretch={"stiffness": 10}, bending=0.1)
    built.bending("rib", triples=[[0, 1, 2], [1, 2, 3]], coefficient=[2, 3.5])
    built.bending(triples=np.array([[3, 2, 1]]), coefficient=1)
    built.bending("joint", triples=[[3, ("line", 0), ("line", 1)]], coefficient=7)
    with pytest.raises(hooke.BadValue, match=r"bending\[3\].*triples\[0\]"):
        built.bending(triples=[[0, 1, 1]], coefficient=1)
    parsed = hooke.Scene.parse(built.text)
    built.save(tmp_path / "scene.json")
    read = hooke.Scene.load(tmp_path / "scene.json")
    for other in (parsed.system, read.system):
        assert built.system.bending_count == other.bending_count == 7
        assert built.system.bending_groups == other.bending_groups
        assert np.array_equal(built.system.bending_ends, other.bending_ends)
        assert np.array_equal(built.system.bending_coefficient, other.bending_coefficient)
    hooke.run(built, method="rk4", step=1e-3, duration=0.1, output=tmp_path / "out.h5")
    assert hooke.verify(tmp_path / "out.h5", bits=True)


def test_obstacles_are_those_of_the_scene(tmp_path):
    """For all free particles, some, one of a part, and moved; built, parsed, saved and added to a system they are the same."""
    built = hooke.Scene(gravity=[0, -9.81, 0]).particles([[0, 0, 0], [1, 0, 0], [2, 0, 0]], mass=1, pinned=[0])
    built.rope("line", from_=(0, 0.1, 0), to=(1, 0.1, 0), segments=4, mass=1, stretch={"stiffness": 10})
    ground = {"shape": "plane", "point": [0, 0.2, 0], "normal": [0, 2, 0], "stiffness": 100, "damping": 3}
    ball = {"shape": "sphere", "center": np.array([0.2, 0, 0]), "radius": "50cm", "stiffness": 40, "friction": 0.3,
            "friction_speed": 0.01, "clearance": 0.01, "motion": "table", "time": [0, 1, 2], "position": np.eye(3)}
    roller = {"shape": "cylinder", "point": [0, 0, 0], "axis": [0, 0, 1], "radius": 0.5, "stiffness": 10,
              "motion": "harmonic", "amplitude": [0, 0.1, 0], "frequency": 2}
    built.obstacles(**ground).obstacles(particles=[2, ("line", 1)], **ball).obstacles(particles=("line", 4), **roller)
    with pytest.raises(hooke.BadValue, match=r"obstacles\[3\].*particles\[0\]"):
        built.obstacles(particles=[8], **ground)
    with pytest.raises(hooke.BadValue, match=r"obstacles\[3\].*radius: .*sphere"):
        built.obstacles(**ground, radius=1)
    written = json.loads(built.text)["obstacles"]
    assert [one.get("particles") for one in written] == [None, [2, 4], [7]] and written[1]["position"] == np.eye(3).tolist()
    parsed = hooke.Scene.parse(built.text)
    system = hooke.Scene.parse({key: value for key, value in json.loads(built.text).items() if key != "obstacles"}).system
    for particles, options in ((None, ground), ([2, 4], ball), (7, roller)):
        system.add_obstacle(particles, **options)
    built.save(tmp_path / "scene.json")
    read = hooke.Scene.load(tmp_path / "scene.json")
    assert json.loads(read.text)["obstacles"][1]["motion"] == "table"
    for other in (parsed.system, read.system, system):
        assert same(built.system, other)
    q, v = built.system.state().q, np.ones((8, 3))
    free = hooke.Scene.parse({key: value for key, value in json.loads(built.text).items() if key != "obstacles"}).system
    pushed = np.flatnonzero((built.system.force(q, v, 0.25) != free.force(q, v, 0.25)).any(axis=1))
    assert pushed.tolist() == [1, 2, 3, 4, 5, 6, 7] and "obstacles" in built.system.forces
    with pytest.raises(hooke.BadValue, match="particles"):
        hooke.Scene().particles([[0, 0, 0]], mass=1).anchors(particles=None, stiffness=1)


def test_keywords_are_those_of_the_schema():
    """Keywords that are not in the tables: the keys of a scene itself, of particles and of drives."""
    schema = json.loads((ROOT / "examples/scene.schema.json").read_text())

    def keywords(method):
        return set(inspect.signature(method).parameters) - {"self"}

    properties = schema["properties"]
    pieces = set(properties) - {"$schema", "hooke", "names", "particles", "springs", "bending", "anchors", "parts", "bodies",
                                "driven", "loads", "obstacles"}
    assert keywords(hooke.Scene.__init__) == pieces
    assert keywords(hooke.Scene.names) == {"names"}
    assert keywords(hooke.Scene.bodies) == set(_keys(schema, properties["bodies"]["items"]))
    assert keywords(hooke.Scene.particles) == set(_keys(schema, properties["particles"]))
    assert keywords(hooke.Scene.loads) == set(_keys(schema, properties["loads"]["items"]))
    assert keywords(hooke.Scene.driven) == set(_keys(schema, properties["driven"]["items"]))
    assert keywords(hooke.Scene.obstacles) == set(_keys(schema, properties["obstacles"]["items"]))


def _keys(schema, node):
    if "$ref" in node:
        node = schema["$defs"][node["$ref"].rsplit("/", 1)[1]]
    keys = set(node.get("properties", ()))
    for other in [*node.get("oneOf", ()), *node.get("anyOf", ())]:
        keys |= _keys(schema, other)
    return keys


# the same scene


def test_a_built_scene_is_the_parsed_one():
    built, parsed = six_particles(), hooke.Scene.parse(SIX_PARTICLES)
    assert type(built) is type(parsed) and built.title == parsed.title == "six particles"
    assert same(built.system, parsed.system)
    assert same(hooke.Scene.parse(built.text).system, parsed.system)
    results = [scene.run(frames=True) for scene in (built, parsed)]
    assert np.array_equal(results[0].frames.q, results[1].frames.q) and len(results[0].frames.t) == 11


def test_a_cloth_runs_as_it_is_typed(tmp_path):
    s = hooke.Scene(gravity=(0, -9.81, 0)).cloth(
        size=(12, 12),
        edges=((1, 0, 0), (0, 0, 1)),
        mass=1,
        structural=dict(stiffness=50, damping=0.01),
        pinned="top-corners",
    )
    result = hooke.run(
        s, method="symplectic-euler", step=1e-4, duration=0.3, every=0.01, output=tmp_path / "o.h5"
    )
    assert result.status == "finished" and result.system.particle_count == 144
    assert np.array_equal(s.system.state().q[0], [0, 0, 0])
    assert np.array_equal(result.state.q[11], [1, 0, 0]) and result.state.q[60, 1] < -0.1
    saved = json.loads(hooke.open(tmp_path / "o.h5").scene.text)
    assert saved["parts"][0]["structural"] == {"stiffness": 50, "damping": 0.01}


@pytest.mark.parametrize("way", ["text", "file"])
def test_everything_comes_back(way, tmp_path):
    rng = np.random.default_rng(7)
    scene = hooke.Scene("all of it", gravity=np.array([0, -9.81, 0]), drag=0.125, run={"step": 1e-3})
    scene.particles(rng.random((5, 3)), np.diag([1, 2, 0, 3, 0])[:, :3], mass=rng.random(5) + 1, pinned=np.array([4, 2]))
    scene.rope("line", from_=(2, 0, 0), to=(3, 0, 0), segments=4, density=0.5, stretch={"stiffness": 30}, bending=1e-3)
    scene.cloth(**CLOTH, origin=(0, 2, 0), shear={"stiffness": 5, "compression": False}, pinned=["corners", 7])
    scene.springs("some", between=[[0, 1], [1, 3]], stiffness=rng.random(2), rest_length=np.array([0.5, 0.25]))
    scene.springs(between=[[0, ("line", 4)], [("cloth1", 3), ("line", 0)]], law="length", stiffness=3, damping=[1, 2])
    scene.driven(1, amplitude=(0.1, 0, 0), frequency=2, phase=0.5)
    scene.driven(("line", 2), motion="table", time=[0, 1, 2], position=np.outer([0, 1, 0], [0, 1, 0]))
    scene.run_defaults(duration=0.01, method="verlet")
    if way == "text":
        again = hooke.Scene.parse(scene.text)
    else:
        scene.save(tmp_path / "s.json")
        again = hooke.Scene.load(tmp_path / "s.json")
    assert same(scene.system, again.system) and again.title == "all of it"
    assert {name: again.run_options[name] for name in again.run_options if again.run_options.is_set(name)} == {
        "step": 1e-3,
        "duration": 0.01,
        "method": "verlet",
    }
    results = [hooke.run(one) for one in (scene, again)]
    assert np.array_equal(results[0].state.q, results[1].state.q)


def test_a_parsed_scene_can_be_added_to(tmp_path):
    scene = hooke.Scene.parse(SIX_PARTICLES).cloth(**SQUARE).springs("tie", between=[[0, ("cloth0", 1)]], stiffness=2)
    scene.run_options["step"] = 5e-4
    again = hooke.Scene.parse(scene.text)
    assert same(again.system, scene.system) and scene.system.particle_count == 12
    assert again.run_options["step"] == 5e-4 and again.run_options["duration"] == 0.5
    untouched = json.dumps(SIX_PARTICLES, indent=3)
    assert hooke.Scene.parse(untouched).text == untouched


def test_a_mesh_keeps_the_vertices_of_its_file(tmp_path):
    path = tmp_path / "square.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
    shape = {"mass": 4, "transform": {"scale": 2, "translate": (0, 0, 1)}, "structural": {"stiffness": 3}}
    scene = hooke.Scene().mesh("m", file=path, **shape)
    vertices = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    again = hooke.Scene().mesh("m", vertices=vertices, triangles=np.array([[0, 1, 2], [0, 2, 3]]), **shape)
    path.unlink()
    assert same(scene.system, again.system) and same(hooke.Scene.parse(scene.text).system, scene.system)
    assert scene.system.state().q[2].tolist() == [2, 2, 1] and scene.system.spring_count == 5
    with pytest.raises(hooke.BadValue, match="mesh: .*cannot be opened"):
        hooke.Scene().mesh(file=path, **shape)
    path.write_text("v 0 0 0\n")
    with pytest.raises(hooke.BadValue, match="mesh.vertices: belongs to a mesh without a file"):
        hooke.Scene().mesh(file=path, vertices=vertices, **shape)


def test_a_lattice_begins_at_zero():
    scene = hooke.Scene().lattice(
        size=(2, 3, 2), edges=np.diag([1, 2, 1]), mass=12, structural={"stiffness": 3}, pinned="bottom"
    )
    assert scene.system.state().q[:3].tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert scene.system.free_count == 6 and same(hooke.Scene.parse(scene.text).system, scene.system)


def test_parts_that_were_read_have_their_names():
    text = hooke.Scene().particles([[9, 9, 9]], mass=1).cloth("a", **SQUARE).cloth(**SQUARE).text
    scene = hooke.Scene.parse(text).cloth("b", **SQUARE)
    scene.springs(between=[[("a", 5), 0], [("cloth1", 0), ("b", 2)]], stiffness=1)
    assert scene.system.spring_ends.tolist() == [[6, 0], [7, 15]]
    with pytest.raises(hooke.BadValue, match='no part called "c"; allowed: "a", "cloth1", "b"'):
        scene.springs(between=[[0, ("c", 1)]], stiffness=1)


def test_parts_of_files_that_were_read_have_their_names():
    scene = hooke.Scene.load(ROOT / "examples/scenes/mesh.json")
    name = json.loads(scene.text)["parts"][0].get("name", "mesh0")
    scene.springs("tie", between=[[(name, 0), (name, 2)]], stiffness=1)
    assert scene.system.groups[0] == ("tie", 1)


def test_the_scene_keeps_what_it_was_given():
    """The caller's arrays may change afterwards."""
    q, ends, stiffness = np.array([[0.0, 0, 0], [1, 0, 0]]), np.array([[0, 1]]), np.array([5.0])
    scene = hooke.Scene().particles(q, mass=1).springs(between=ends, stiffness=stiffness)
    text = scene.text
    q += 1
    ends[:] = 0
    stiffness[:] = 0
    assert scene.text == text


# errors

ERRORS = [
    (lambda s: s.cloth(**{**CLOTH, "size": (1, 12)}), "cloth.size[0]: 1 is not allowed"),
    (lambda s: s.cloth(**{**CLOTH, "mass": None}), "cloth: neither mass nor density is given"),
    (lambda s: s.cloth(**CLOTH, structural={"stiffness": -1}), "cloth.structural.stiffness: -1 is not allowed"),
    (lambda s: s.cloth(**CLOTH, structural={"damping": 1}), "cloth.structural.stiffness: is required but missing"),
    (lambda s: s.cloth(**CLOTH, shear={"stifness": 1}), 'unknown option "stifness"; did you mean "stiffness"?'),
    (lambda s: s.cloth(**CLOTH, bend=5), "cloth.bend: a number is not allowed"),
    (lambda s: s.cloth(**CLOTH, pinned=[144]), "cloth.pinned[0]: the part has no particle 144; allowed: 0 to 143"),
    (lambda s: s.cloth(**CLOTH, pinned="left"), 'cloth.pinned: "left" is not allowed'),
    (lambda s: s.cloth("line", **CLOTH), 'cloth.name: "line" is the name of another part'),
    (lambda s: s.springs(between=[[0, 8]], stiffness=1), "springs[1].between[0][1]: there is no particle 8"),
    (lambda s: s.springs(between=[[0, 1]], stiffness=-1), "springs[1].stiffness: -1 is not allowed"),
    (lambda s: s.springs(between=[[0, 1]], stiffness=[1, 2]), "springs[1].stiffness: 2 values for 1 springs"),
    (lambda s: s.springs(between=[[0.5, 1]], stiffness=1), "springs[1].between: whole numbers are needed"),
    (lambda s: s.springs(between=[[0, ("x", 1)]], stiffness=1), 'between[0][1]: there is no part called "x"; allowed: "line"'),
    (lambda s: s.springs(between=[[0, ("line", 3)]], stiffness=1), '"line" has no particle 3; allowed: 0 to 2'),
    (lambda s: s.driven(0, frequency=2), 'driven[0].amplitude: is required with motion "harmonic" but missing'),
    (lambda s: s.driven(0, motion="round"), 'driven[0].motion: "round" is not allowed'),
    (lambda s: s.driven(0, amplitude=(1, 0, 0), frequency=2, time=[0, 1]), 'driven[0].time: belongs to motion "table"; allowed with "harmonic": amplitude'),
    (lambda s: s.driven(0, amplitude=(1, 0), frequency=2), "driven[0].amplitude: 2 numbers given; allowed: 3 numbers [m]"),
    (
        lambda s: s.driven(0, motion="table", time=[0, 1], position=[[1, 0], [0, 1], [1, 0]]),
        "driven[0].position: its shape is (3, 2), allowed is (2, 3)",
    ),
    (lambda s: s.driven(99, amplitude=(1, 0, 0), frequency=2), "driven[0].particles[0]: there is no particle 99"),
    (lambda s: s.run_defaults(duration=1, step=-1), "run.step: -1 is not allowed"),
    (lambda s: s.run_defaults(stepp=1), 'run_defaults: unknown keyword "stepp"'),
]


@pytest.mark.parametrize("call, message", ERRORS, ids=[message for _, message in ERRORS])
def test_an_error_comes_at_once_names_its_keyword_and_changes_nothing(call, message):
    scene = hooke.Scene().particles([[0, 0, 0], [1, 0, 0]], mass=1).springs(between=[[0, 1]], stiffness=1)
    scene.rope("line", from_=(0, 0, 1), to=(1, 0, 1), segments=2, mass=1)
    text = scene.text
    with pytest.raises(hooke.BadValue) as caught:
        call(scene)
    assert message in str(caught.value) and caught.value.status == -2
    assert scene.text == text and scene.system.particle_count == 5 and scene.system.spring_count == 1
    scene.cloth(**SQUARE)  # and more can be added
    assert scene.system.particle_count == 11


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: hooke.Scene(gravity=(1, 2)), "gravity: 2 numbers given; allowed: 3 numbers [m/s^2]"),
        (lambda: hooke.Scene(drag=-1), "drag: -1 is not allowed"),
        (lambda: hooke.Scene(drag="much"), 'drag: "much" is not allowed; allowed: one or more numbers >= 0 [N s/m]'),
        (lambda: hooke.Scene(drag=[1, -1]), "drag[1]: -1 is not allowed"),
        (lambda: hooke.Scene(wind=[1, 2]), "wind: 2 numbers given; allowed: 3 numbers [m/s]"),
        (lambda: hooke.Scene(wind={"time": [0, 1], "velocity": [[1, 0, 0]] * 3}), "wind: 2 times and 3 velocities given"),
        (lambda: hooke.Scene().particles([[0, 0, 0]], mass=-1), "particles.mass: -1 is not allowed"),
        (lambda: hooke.Scene().particles([[0, 0]], mass=1), "particles.position: its shape is (1, 2)"),
        (lambda: hooke.Scene().particles([[0, 0, 0]], mass=1, pinned=[1]), "particles.pinned[0]: there is no particle 1"),
        (lambda: hooke.Scene().particles([[0, 0, 0]], [[1, 2, 3]], mass=1, pinned=0), "particles.velocity[0]: [1.0, 2.0, 3.0]"),
        (lambda: hooke.Scene().particles([[0, 0, 0]], [[1, 2]], mass=1), "particles.velocity: its shape is (1, 2)"),
    ],
)
def test_errors_of_the_first_pieces(call, message):
    with pytest.raises(hooke.BadValue) as caught:
        call()
    assert message in str(caught.value)


@pytest.mark.parametrize("wind", [(1, 2, 3), {"time": [0, 1, 3], "velocity": np.arange(9.0).reshape(3, 3)}])
def test_a_medium_is_that_of_the_scene(wind, tmp_path):
    fluid = {"density": 2, "diameter": 0.1, "normal": 1.2, "tangential": 0.02}
    built = hooke.Scene(drag=[1, 2, 3], quadratic_drag=0.5, wind=wind).rope(
        from_=(0, 0, 0), to=(1, 1, 0), segments=2, mass=1, stretch={"stiffness": 5}, fluid_drag=fluid)
    built.save(tmp_path / "scene.json")
    ends = [scene.run(method="verlet", step=1e-2, duration=0.5).state.q
            for scene in (built, hooke.Scene.parse(built.text), hooke.Scene.load(tmp_path / "scene.json"))]
    assert np.abs(ends[0]).max() > 0.1 and np.array_equal(ends[0], ends[1]) and np.array_equal(ends[0], ends[2])
    assert {"fluid_drag", "drag", "quadratic_drag"} <= set(built.system.forces)


def test_the_order_of_particles_is_that_of_the_format():
    scene = hooke.Scene().cloth(**SQUARE)
    with pytest.raises(hooke.BadCall, match="particles: they are numbered before those of parts"):
        scene.particles([[0, 0, 0]], mass=1)
    with pytest.raises(hooke.BadCall, match="particles: the scene has its particles already"):
        hooke.Scene.parse(SIX_PARTICLES).particles([[0, 0, 0]], mass=1)


def test_a_scene_in_use_is_finished(tmp_path):
    scene = hooke.Scene().cloth(**SQUARE)
    text = scene.text
    scene.system.state()
    with pytest.raises(hooke.BadCall, match="cloth: the system is committed"):
        scene.cloth(**SQUARE)
    assert scene.text == text


def test_an_unknown_keyword_is_a_type_error():
    with pytest.raises(TypeError, match="stifness"):
        hooke.Scene().springs(between=[[0, 1]], stifness=1)


def test_a_force_of_ones_own_joins_a_built_scene():
    scene = hooke.Scene().particles([[0, 0, 0]], mass=2)
    scene.system.set_force(lambda t, q, v, force: force.__iadd__([0, 4, 0]) is None)
    result = hooke.run(scene, method="symplectic-euler", step=0.5, duration=1)
    assert result.state.v[0, 1] == 2


def test_large_arrays_go_straight_to_the_library():
    """They are not converted to text: that would take a thousand times the memory."""
    import tracemalloc

    n = 200_000
    q = np.column_stack([np.arange(n), np.zeros(n), np.zeros(n)]).astype(float)
    ends = np.column_stack([np.arange(n - 1), np.arange(1, n)])
    tracemalloc.start()
    scene = hooke.Scene().particles(q, mass=1.0).springs(between=ends, stiffness=np.full(n - 1, 5.0))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    arrays = q.nbytes + ends.nbytes + 8 * n
    assert peak < 4 * arrays  # a list of as many numbers takes ten times its array
    assert scene.system.spring_count == n - 1


def test_methods_by_other_names():
    options = hooke.Options.for_run().set(method="velocity-verlet")
    assert options["method"] == "verlet"
    assert hooke.Options.for_study().set(methods="rk4, implicit-euler")["methods"] == "rk4,backward-euler"
    with pytest.raises(hooke.BadValue, match="'euler' is no method; choose one of forward-euler, symplectic-euler"):
        options.set(method="euler")


def test_all_faults_of_a_scene_are_told():
    text = '{"hooke": 1, "gravty": 1,\n"particles": {"position": [[0, 0, 0]], "mass": -1}}'
    with pytest.raises(hooke.BadValue) as told:
        hooke.Scene.parse(text)
    assert [line.split(": ")[1] for line in str(told.value).splitlines()] == ["gravty", "particles.mass"]


def test_names_take_the_place_of_numbers(tmp_path):
    built = hooke.Scene().particles([[0, 1, 0], [1, 1, 0]], mass=1, pinned=[0])
    built.rope("line", from_=(0, 0, 0), to=(1, 0, 0), segments=4, mass=1, stretch={"stiffness": 9})
    built.names({"tip": 1, "fairlead": ("line", 0)})
    built.springs(between=[("tip", "fairlead"), [("line", 4), "tip"]], stiffness=3, damping_ratio=0.2)
    built.anchors(particles=["fairlead"], stiffness=2)
    assert built.system.spring_ends[:2].tolist() == [[1, 2], [6, 1]]
    text = json.dumps({**json.loads(built.text), "anchors": [{"particles": ["fairlead"], "stiffness": 2}]})
    read = hooke.Scene.parse(text)
    same(built.system, read.system)
    read.save(tmp_path / "named.json")
    assert json.loads((tmp_path / "named.json").read_text())["names"] == {"tip": 1, "fairlead": 2}
    found = hooke.study(read, "rk4", steps=0.01, duration=0.1, every=0.05, watch="tip.y")
    assert list(found.watched) == ["tip.y"]
    with pytest.raises(hooke.BadValue, match=re.escape('particles[0]: there is no particle called "top"; allowed: tip')):
        hooke.Scene().particles([[0, 0, 0]], mass=1).names({"tip": 0}).anchors(particles=["top"], stiffness=1)
    for name in ("tip", "1", "1e3", "a.b", "a:b", "a b", ""):
        with pytest.raises(hooke.BadValue, match="^names"):
            hooke.Scene().particles([[0, 0, 0]], mass=1).names({"tip": 0}).names({name: 0})


def test_values_that_replace_those_of_a_text():
    text = '{"hooke": 1, "particles": {"position": [[0, 0, 0]], "mass": 1}, "drag": 1}'
    values = {"gravity": np.array([0, -1, 0]), "drag": np.float64(0.5), "title": 'a = "b"', "run.step": "1ms"}
    changed = json.loads(hooke.Scene.parse(text, set=values).text)
    assert changed["gravity"] == [0, -1, 0] and changed["drag"] == 0.5
    assert changed["title"] == 'a = "b"' and changed["run"] == {"step": "1ms"}
    with pytest.raises(hooke.BadValue, match='did you mean "drag"'):
        hooke.Scene.parse(text, set={"darg": 1})
