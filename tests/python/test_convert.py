"""Scenes from objects of other libraries: what is carried over, and that the rest is told of."""

import numpy as np
import pytest

import hooke
from hooke.convert import LeftOut, from_mdanalysis, from_meshio, from_moorpy, from_networkx


def left_out(call):
    with pytest.warns(LeftOut) as told:
        scene = call()
    return scene, [str(one.message).removeprefix("left out: ") for one in told]


def test_a_graph_with_positions():
    networkx = pytest.importorskip("networkx")
    graph = networkx.Graph()
    graph.add_node("hook", pos=(0, 0), pinned=True, colour="red")
    graph.add_node("knot", pos=(0, -1), mass=2)
    graph.add_node("tip", pos=(0, -3))
    graph.add_edge("hook", "knot", stiffness=30, rest_length=0.5)
    graph.add_edge("knot", "tip", rest_length=2, weight=3)
    graph.add_edge("tip", "tip")
    scene, told = left_out(lambda: from_networkx(graph, mass=1, stiffness=20))
    assert told == ["the attribute 'colour' of nodes", "the attribute 'weight' of edges", "1 edges from a node to itself"]
    system, state = scene.system, scene.system.state()
    assert system.masses.tolist() == [1, 2, 1] and system.spring_ends.tolist() == [[0, 1], [1, 2]]
    assert system.tension(state.q, state.v).tolist() == [30, 0]  # k (length / rest - 1)
    with pytest.raises(hooke.BadValue, match="mass: number 0 of 2 has none"):
        from_networkx(networkx.path_graph(2), networkx.spring_layout(networkx.path_graph(2)), stiffness=1)
    ring = from_networkx(networkx.cycle_graph(5), networkx.circular_layout(range(5)), mass=1, stiffness=1)
    assert ring.system.spring_count == 5


def test_a_mesh():
    meshio = pytest.importorskip("meshio")
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [5, 5, 5]], float)
    mesh = meshio.Mesh(corners, [("tetra", [[0, 1, 2, 3]]), ("triangle", [[0, 1, 2]]), ("vertex", [[4]])],
                       point_data={"heat": np.zeros(5)})  # fmt: skip
    scene, told = left_out(lambda: from_meshio(mesh, mass=10, stiffness=7, pinned=[0]))
    assert told == ["cells: vertex", "data: heat", "what held 1 points that are in no edge: they are free particles"]
    assert scene.system.spring_count == 6 and scene.system.masses.sum() == 10
    hexahedron = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float)
    system = from_meshio(meshio.Mesh(hexahedron, [("hexahedron", [range(8)])]), mass="1 kg", stiffness="1 N").system
    lengths = np.linalg.norm(np.diff(hexahedron[system.spring_ends], axis=1), axis=2)
    assert system.spring_count == 12 and (lengths == 1).all()


def test_a_universe_with_bonds():
    mda = pytest.importorskip("MDAnalysis")
    water = mda.Universe.empty(3, trajectory=True, velocities=True)
    water.add_TopologyAttr("masses", [15.999, 1.008, 1.008])
    water.add_TopologyAttr("types", ["O", "H", "H"])
    water.add_TopologyAttr("bonds", [(0, 1), (0, 2)])
    water.add_TopologyAttr("angles", [(1, 0, 2)])
    water.atoms.positions = [[0, 0, 0], [0.96, 0, 0], [-0.24, 0.93, 0]]
    water.atoms.velocities = [[0, 0, 0], [1, 0, 0], [0, 0, 0]]  # 1 angstrom a picosecond is 100 m/s
    scene, told = left_out(lambda: from_mdanalysis(water, stiffness={("H", "O"): 800}))
    assert told[0] == "1 angles" and "forces between atoms that are not bonded" in told
    system, state = scene.system, scene.system.state()
    np.testing.assert_allclose(state.q[1], [0.96e-10, 0, 0], rtol=1e-6)
    assert state.v[1, 0] == pytest.approx(100) and system.masses[1] == pytest.approx(1.008 * 1.66053906660e-27)
    reduced = system.masses[0] * system.masses[1] / (system.masses[0] + system.masses[1])
    stretch = hooke.modes(scene, count=2).rows["frequency"]  # [Hz]; of the two bonds, near that of one alone
    assert stretch.mean() == pytest.approx(np.sqrt(800 / reduced) / (2 * np.pi), rel=0.03)
    with pytest.raises(hooke.BadValue, match="stiffness: there is none for bonds of the type"):
        from_mdanalysis(water, stiffness={("C", "H"): 1})


@pytest.mark.filterwarnings("ignore::SyntaxWarning")
def test_a_mooring_hangs_as_its_own_library_says():
    moorpy = pytest.importorskip("moorpy")
    system = moorpy.System(depth=50)
    system.lineTypes["chain"] = {"name": "chain", "m": 100.0, "w": 850.0, "EA": 5e6, "d_vol": 0.12}
    system.addPoint(1, [0, 0, -30])
    system.addPoint(-1, [60, 0, 0])
    system.addLine(75, "chain", nSegs=40, pointA=1, pointB=2)
    system.initialize()
    system.solveEquilibrium()
    scene, told = left_out(lambda: from_moorpy(system))
    assert "motion of 1 coupled points, which are held still" in told and "drag and added mass of lines and points" in told
    rest = hooke.rest(scene)
    ends = scene.system.spring_ends.tolist()
    top = scene.system.tension(rest.position, 0 * rest.position)[next(k for k, pair in enumerate(ends) if 1 in pair)]
    line = system.lineList[0]
    assert top + 75 / 80 * line.w == pytest.approx(line.TB, rel=0.003)  # of the middle of the last piece, and half of its weight
    nodes = np.stack(line.getLineCoords(0.0)[:3], axis=1)
    assert abs(rest.position[[0, *range(2, 41), 1]] - nodes).max() < 0.1
