"""Meshes of other programs, as a user would use them: OBJ files in, results compared with NumPy, SciPy and h5py."""

import json

import h5py
import meshio
import numpy as np
import pytest
import trimesh
from conftest import ROOT
from scipy.spatial.distance import cdist

import hooke

GRAVITY = np.array([0, -9.81, 0])
STRUCTURAL, BEND = 40.0, 6.0  # N


def ball(folder, **export):
    """A sphere of trimesh as an OBJ file, and as trimesh reads it back."""
    mesh = trimesh.creation.icosphere(subdivisions=2, radius=0.2)
    if export.pop("uv", False):
        mesh.visual = trimesh.visual.TextureVisuals(uv=np.random.default_rng(1).random((len(mesh.vertices), 2)))
    path = folder / "ball.obj"
    path.write_text(trimesh.exchange.obj.export_obj(mesh, **export))
    return path, trimesh.load(path, process=False, maintain_order=True, force="mesh")


def scene_of(**part):
    return {
        "hooke": 1,
        "gravity": GRAVITY.tolist(),
        "parts": [{"kind": "mesh", "name": "m", "structural": {"stiffness": STRUCTURAL}, "bend": {"stiffness": BEND}, **part}],
        "run": {"method": "rk4", "step": 1e-3, "duration": 0.2, "every": 0.02},
    }


def energy(file, pairs, stiffness, mass, free):
    """For every frame, from positions and velocities alone."""
    q, v = (file[f"particles/all/{name}/value"][:] for name in ("position", "velocity"))
    rest = np.array([cdist(q[0][i : i + 1], q[0][j : j + 1])[0, 0] for i, j in pairs])
    spring = []
    for frame in q:
        length = np.linalg.norm(frame[pairs[:, 0]] - frame[pairs[:, 1]], axis=1)
        spring.append(np.sum(0.5 * stiffness * rest * (length / rest - 1) ** 2))
    kinetic = 0.5 * np.einsum("p,fpa,fpa->f", mass * free, v, v)
    weight = -np.einsum("p,fpa,a->f", mass * free, q, GRAVITY)
    return kinetic + spring + weight


@pytest.mark.parametrize("export", [{}, {"include_normals": True}, {"include_normals": True, "uv": True}])
def test_a_sphere_of_trimesh(tmp_path, export):
    path, mesh = ball(tmp_path, **export)
    text = path.read_text()
    assert ("\nvn " in text) == ("include_normals" in export) and ("\nvt " in text) == ("uv" in export)
    (tmp_path / "scene.json").write_text(json.dumps(scene_of(file="ball.obj", density=2, pinned=[7])))
    scene = hooke.Scene.load(tmp_path / "scene.json")
    system = scene.system

    # particles are the vertices of the file, in its order
    vertices = np.array([line.split()[1:4] for line in text.splitlines() if line.startswith("v ")], dtype=float)
    np.testing.assert_array_equal(system.state().q, vertices)
    assert np.flatnonzero(system.inverse_masses == 0).tolist() == [7]

    # springs are trimesh's edges and the vertices opposite to each other across them
    edges = np.unique(np.sort(mesh.edges_unique, axis=1), axis=0)
    count = len(edges)
    assert system.groups == [("m.structural", count), ("m.bend", count)]
    np.testing.assert_array_equal(system.spring_ends[:count], edges)
    across = dict(zip(map(tuple, np.sort(mesh.face_adjacency_edges, axis=1)), mesh.face_adjacency_unshared))
    expected = np.sort([across[tuple(edge)] for edge in edges.tolist()], axis=1)
    np.testing.assert_array_equal(system.spring_ends[count:], expected)
    assert len(vertices) - count + len(mesh.faces) == 2 == mesh.euler_number

    # rest lengths by SciPy, masses by trimesh's areas
    ends = system.spring_ends
    distance = cdist(vertices, vertices)[ends[:, 0], ends[:, 1]]
    np.testing.assert_allclose(system.spring_material.rest_length, distance, rtol=1e-14)
    mass = np.zeros(len(vertices))
    np.add.at(mass, mesh.faces.ravel(), np.repeat(2 * mesh.area_faces / 3, 3))
    np.testing.assert_allclose(system.masses, mass, rtol=1e-12)
    assert system.masses.sum() == pytest.approx(2 * mesh.area, rel=1e-13)

    # it falls and swings; the energy that hooke reports is that of its frames
    result = scene.run(output=tmp_path / "out.h5")
    with h5py.File(tmp_path / "out.h5") as file:
        np.testing.assert_array_equal(file["connectivity/springs"][:], ends)
        stiffness = np.repeat([STRUCTURAL, BEND], count)
        found = energy(file, ends, stiffness, mass, system.inverse_masses > 0)
        reported = file["observables/total_energy/value"][:]
        moved = np.linalg.norm(file["particles/all/position/value"][-1] - vertices, axis=1)
    np.testing.assert_allclose(reported, found, rtol=1e-11, atol=1e-11)
    assert np.ptp(found) < 1e-6  # rk4, and nothing damps
    assert moved[7] == 0 and 0.005 < np.delete(moved, 7).min()
    np.testing.assert_array_equal(result.state.q[7], vertices[7])


def test_quads_of_meshio(tmp_path):
    """A cylinder of quads, closed where its first and last columns coincide."""
    columns, rows = 13, 5
    angle = np.linspace(0, 2 * np.pi, columns)
    angle[-1] = 0
    points = np.array([[np.cos(a), 0.3 * r, np.sin(a)] for r in range(rows) for a in angle])
    quads = np.array([[r * columns + c, r * columns + c + 1, (r + 1) * columns + c + 1, (r + 1) * columns + c]
                      for r in range(rows - 1) for c in range(columns - 1)])  # fmt: skip
    meshio.write_points_cells(tmp_path / "tube.obj", points, [("quad", quads)])
    part = dict(mass=3, structural={"stiffness": STRUCTURAL}, bend={"stiffness": BEND})

    system = hooke.System()
    assert system.add_part("mesh", "m", file=tmp_path / "tube.obj", transform={"scale": 0.5}, **part) == range(60)
    kept = np.flatnonzero(np.arange(rows * columns) % columns < columns - 1)
    np.testing.assert_array_equal(system.state().q, 0.5 * points[kept])

    # each quad is two triangles, cut from its first corner
    number = np.empty(rows * columns, dtype=int)
    number[kept] = range(60)
    number[columns - 1 :: columns] = number[::columns]
    triangles = number[np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)]
    edges = np.unique(np.sort(np.concatenate([triangles[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))]), axis=1), axis=0)
    border = 2 * (columns - 1)
    assert system.groups == [("m.structural", len(edges)), ("m.bend", len(edges) - border)]
    np.testing.assert_array_equal(system.spring_ends[: len(edges)], edges)
    assert 60 - len(edges) + 2 * len(quads) == 0
    assert system.masses.sum() == pytest.approx(3, rel=1e-14)
    assert [(row.name, row.value) for row in system.derived] == [("vertices welded to others", rows)]

    # the same from arrays
    other = hooke.System()
    other.add_part("mesh", "m", vertices=0.5 * points[kept], triangles=triangles, **part)
    np.testing.assert_array_equal(other.spring_ends, system.spring_ends)
    for a, b in zip(other.spring_material, system.spring_material):
        np.testing.assert_array_equal(a, b)
    np.testing.assert_array_equal(other.masses, system.masses)


def test_a_saved_scene_needs_no_file(tmp_path):
    path, _ = ball(tmp_path)
    system = hooke.System()
    system.set_gravity(GRAVITY)
    system.add_part("mesh", "m", file=path, mass=1, pinned=[3], structural={"stiffness": 50, "damping_ratio": 0.1})
    system.save(tmp_path / "saved.json", "a ball", step=1e-3, duration=0.1)
    path.unlink()
    saved = hooke.Scene.load(tmp_path / "saved.json")
    run = dict(method="symplectic-euler", step=1e-3, duration=0.1)
    np.testing.assert_array_equal(saved.run(**run).state.q, system.run(**run).state.q)
    np.testing.assert_array_equal(saved.system.masses, system.masses)


def test_driven_particles_of_parts(tmp_path):
    """A ball that is shaken by one of its vertices, on a lattice whose lower layer follows a table: by a scene, by
    calls, and by the scene saved from the calls, its motion is the same to the bit."""
    families = {"structural": {"stiffness": 50, "damping": 0.01}, "bend": {"stiffness": 5}}
    block = {"origin": [0, 0, 0], "edges": [[0.3, 0, 0], [0, 0, 0.3], [0, 0.2, 0]], "size": [4, 3, 3], "mass": 1,
             "shear": {"stiffness": 20}, **families}  # fmt: skip
    (tmp_path / "ball.obj").write_text((ROOT / "examples/scenes/ball.obj").read_text())
    mesh = {"file": "ball.obj", "transform": {"scale": 0.1, "translate": [0, 1, 0]}, "mass": 0.1, **families}
    amplitude, time = [0.05, 0, 0], [0, 0.1, 0.3]
    position = [[0, 0, 0], [0, 0.02, 0], [0.01, 0, 0]]
    scene = {
        "hooke": 1,
        "parts": [{"kind": "lattice", "name": "block", **block}, {"kind": "mesh", "name": "ball", **mesh}],
        "driven": [
            {"particles": [["ball", 16]], "motion": "harmonic", "amplitude": amplitude, "frequency": 3},
            {"particles": list(range(12)), "motion": "table", "time": time, "position": position},
        ],
    }
    run = dict(method="symplectic-euler", step=1e-3, duration=0.2)
    by_scene = hooke.Scene.parse(scene, folder=tmp_path).run(**run).state

    system = hooke.System()
    assert system.add_part("lattice", "block", **block) == range(36)
    particles = system.add_part("mesh", "ball", **{**mesh, "file": str(tmp_path / "ball.obj")})
    assert particles == range(36, 78)
    system.drive_harmonic(particles[16], amplitude, 3)
    system.drive_table(range(12), time, position)
    assert system.free_count == 78 - 13
    start = system.state().q.copy()
    by_calls = system.run(**run).state
    system.save(tmp_path / "saved.json")
    by_file = hooke.Scene.load(tmp_path / "saved.json").run(**run).state
    for state in (by_calls, by_file):
        np.testing.assert_array_equal(state.q, by_scene.q)
        np.testing.assert_array_equal(state.v, by_scene.v)

    moved = by_scene.q - start
    np.testing.assert_allclose(moved[52], [0.05 * np.sin(2 * np.pi * 3 * 0.2), 0, 0], atol=1e-14)
    np.testing.assert_array_equal(moved[:12].round(12), np.repeat(moved[:1].round(12), 12, axis=0))
    assert 1e-3 < np.linalg.norm(moved[24:36], axis=1).min()  # the upper layer followed
    assert 1e-3 < np.linalg.norm(moved[36:52], axis=1).min()


def test_a_file_belongs_to_a_mesh(tmp_path):
    with pytest.raises(hooke.BadValue, match=r'make them with hooke_options_create\("mesh", ...\)'):
        hooke.System().add_part("rope", file=tmp_path / "a.obj")
    with pytest.raises(hooke.BadValue, match="a file, or vertices and triangles"):
        hooke.System().add_part("mesh", mass=1)
    with pytest.raises(hooke.BadValue, match="no folder"):
        hooke.Scene.parse(scene_of(file="ball.obj", mass=1))
