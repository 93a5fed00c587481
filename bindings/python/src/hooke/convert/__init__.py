"""Scenes from objects of other libraries: graphs of networkx, meshes of meshio, universes of MDAnalysis, systems of MoorPy.

What a scene has nothing for is left out, and each such thing is told of by a `LeftOut` warning. Particles are numbered as
there. The scene is open: more can be added to it.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from .. import BadValue, Scene
from .._types import FloatArray, Numbers

__all__ = ["LeftOut", "from_mdanalysis", "from_meshio", "from_moorpy", "from_networkx"]

_ANGSTROM, _DALTON, _PICOSECOND = 1e-10, 1.66053906660e-27, 1e-12
#: Edges of the cells of meshio, 10 a + b for the corners a and b; of those of higher order the corners alone count.
_EDGES = {
    "line": (1,), "triangle": (1, 12, 2), "quad": (1, 12, 23, 3), "tetra": (1, 12, 2, 3, 13, 23),
    "hexahedron": (1, 12, 23, 3, 45, 56, 67, 47, 4, 15, 26, 37), "wedge": (1, 12, 2, 34, 45, 35, 3, 14, 25),
    "pyramid": (1, 12, 23, 3, 4, 14, 24, 34),
}  # fmt: skip


class LeftOut(UserWarning):
    """Something that a scene has nothing for, and that was not carried over."""


def _leave_out(*things: str) -> None:
    for thing in filter(None, things):
        warnings.warn(f"left out: {thing}", LeftOut, stacklevel=3)


def _points(position: Iterable[Any], where: str) -> FloatArray:
    """Points in space, of those of a plane with z = 0."""
    points = np.array([*position], float)
    if points.ndim != 2 or points.shape[1] not in (2, 3):
        raise BadValue(f"{where}: two or three numbers are needed for each, all of one length")
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def _attributes(what: str, rows: list[dict[str, Any]], given: Mapping[str, Any]) -> dict[str, list[Any]]:
    """Columns of the attributes of nodes or edges, where they have none with the values `given`."""
    for name, value in given.items():
        missing = [k for k, row in enumerate(rows) if name not in row]
        if missing and value is None:
            raise BadValue(f"{name}: the {what} with number {missing[0]} has none; give it there, or as {name}=... for all")
    return {name: [row.get(name, value) for row in rows] for name, value in given.items()}


def from_networkx(
    graph: Any, pos: str | Mapping[Any, Numbers] = "pos", *, mass: float | None = None, stiffness: float | None = None,
    damping: float = 0.0,
) -> Scene:
    """The scene of a graph, with a particle for each node and a spring of the strain law for each edge.

    `pos` is the attribute with the position [m] of a node, or a mapping as layouts return it. Nodes may have `mass` [kg] and
    `pinned`, edges `stiffness` [N], `damping` [N s] and `rest_length` [m] (the distance, if none has one); for those that
    have none the arguments hold.
    """
    numbers = {node: k for k, node in enumerate(graph)}
    nodes = [{**data, "pos": data.get(pos) if isinstance(pos, str) else pos.get(node)} for node, data in graph.nodes(data=True)]
    edges = [(numbers[a], numbers[b], data) for a, b, data in graph.edges(data=True) if a != b]
    without = next((node for node, data in zip(numbers, nodes) if data["pos"] is None), None)
    if without is not None:
        raise BadValue(f"pos: node {without!r} has no position")
    ends, rows = [edge[:2] for edge in edges], [edge[2] for edge in edges]
    of_nodes = _attributes("node", nodes, {"mass": mass, "pinned": False})
    of_edges = _attributes("edge", rows, {"stiffness": stiffness, "damping": damping})
    lengths = _attributes("edge", rows, {"rest_length": None}) if any("rest_length" in row for row in rows) else {}
    others = {key for row in nodes for key in row} - {"pos", "mass", "pinned"} - ({pos} if isinstance(pos, str) else set())
    also = {key for row in rows for key in row} - {"stiffness", "damping", "rest_length"}
    loops = graph.number_of_edges() - len(edges)
    _leave_out(*(f"the attribute {key!r} of nodes" for key in sorted(map(str, others))),
               *(f"the attribute {key!r} of edges" for key in sorted(map(str, also))),
               f"{loops} edges from a node to itself" if loops else "",
               "directions of edges" if graph.is_directed() else "")  # fmt: skip
    scene = Scene("a graph").particles(
        _points((data["pos"] for data in nodes), "pos"), mass=of_nodes["mass"], pinned=np.flatnonzero(of_nodes["pinned"])
    )
    every: Any = {**of_edges, **lengths}
    return scene.springs("edges", between=np.array(ends, np.int64), **every) if ends else scene


def from_meshio(mesh: Any, *, mass: float, stiffness: float, damping: float = 0.0, pinned: Numbers = ()) -> Scene:
    """The scene of a mesh: a particle at each point, which share the total `mass` [kg] equally, and a spring of the strain law
    along each edge of a cell, with `stiffness` [N] and `damping` [N s]. `pinned` are numbers of points."""
    points, edges, unknown = _points(mesh.points, "points"), [np.empty((0, 2), np.int64)], set()
    for block in mesh.cells:
        kind = block.type.rstrip("0123456789")
        if kind not in _EDGES:
            unknown.add(block.type)
            continue
        if kind != block.type:
            unknown.add(f"nodes within the edges of {block.type}")
        edges += [np.asarray(block.data)[:, divmod(edge, 10)] for edge in _EDGES[kind]]
    ends = np.unique(np.sort(np.concatenate(edges), axis=1), axis=0)
    loose = len(points) - len(np.unique(ends))
    data = [*mesh.point_data, *mesh.cell_data, *mesh.field_data, *mesh.point_sets, *mesh.cell_sets]
    _leave_out(*(f"cells: {kind}" for kind in sorted(unknown)), *(f"data: {name}" for name in data),
               f"what held {loose} points that are in no edge: they are free particles" if loose else "")  # fmt: skip
    scene = Scene("a mesh").particles(points, mass=mass / max(1, len(points)), pinned=pinned)
    return scene.springs("edges", between=ends, stiffness=stiffness, damping=damping) if len(ends) else scene


def from_mdanalysis(universe: Any, *, stiffness: float | Mapping[Any, float], damping: float = 0.0) -> Scene:
    """The scene of a universe at its present frame, in SI: a particle for each atom, with its mass and its velocity, and a
    spring for each bond, by metres. `stiffness` [N/m] is one for all, or a mapping from the types of bonds, such as
    ``("C", "H")``, and `damping` [N s/m]; rest lengths are those of the frame."""
    atoms, bonds = universe.atoms, getattr(universe, "bonds", None)
    present = universe.trajectory.ts
    kinds = [kind for kind in ("angles", "dihedrals", "impropers", "cmaps") if hasattr(universe, kind)]
    lost = [f"{len(getattr(universe, kind))} {kind}" for kind in kinds]
    _leave_out(*lost, "charges" if hasattr(atoms, "charges") else "", "names of atoms and residues",
               "the periodic box" if present.dimensions is not None else "",
               "frames, but for the present one" if len(universe.trajectory) > 1 else "",
               "forces between atoms that are not bonded")  # fmt: skip
    speed = _ANGSTROM / _PICOSECOND
    scene = Scene("a universe").particles(
        atoms.positions.astype(float) * _ANGSTROM, atoms.velocities * speed if present.has_velocities else None,
        mass=atoms.masses * _DALTON,
    )
    if bonds is None or not len(bonds):
        return scene
    of = [_of_bond(stiffness, bond.type) if isinstance(stiffness, Mapping) else stiffness for bond in bonds]
    return scene.springs("bonds", between=bonds.indices.astype(np.int64), law="length", stiffness=of, damping=damping)


def _of_bond(stiffness: Mapping[Any, float], kind: Any) -> float:
    for known in (kind, tuple(reversed(kind)) if isinstance(kind, tuple) else kind):
        if known in stiffness:
            return stiffness[known]
    raise BadValue(f"stiffness: there is none for bonds of the type {kind!r}")


def from_moorpy(system: Any, *, damping_ratio: float = 0.1) -> Scene:
    """The scene of a MoorPy system where it is now, with z upwards: each line as its nodes, with the stiffness EA, the mass and
    the weight in water of its type; fixed and coupled points pinned; free points with their mass, weight and force; the sea
    bed as a plane, into which the heaviest particle sinks by a centimetre."""
    q = [np.array(point.r, float) for point in system.pointList]
    mass = [float(point.m) for point in system.pointList]
    weight = [float(point.m - point.v * system.rho) * float(system.g) for point in system.pointList]
    held, groups = {k for k, point in enumerate(system.pointList) if point.type != 0}, []
    for line in system.lineList:
        nodes = np.stack(line.getLineCoords(0.0)[:3], axis=1)
        first, piece = len(q), line.L / (len(nodes) - 1)
        ends = [next(point.number - 1 for point in system.pointList if line.number in point.attached
                     and point.attachedEndB[point.attached.index(line.number)] == end) for end in (0, 1)]  # fmt: skip
        numbers = [ends[0], *range(first, first + len(nodes) - 2), ends[1]]
        q += [*nodes[1:-1]]
        mass += [0.0] * (len(nodes) - 2)
        weight += [0.0] * (len(nodes) - 2)
        for share, number in zip([0.5, *[1.0] * (len(nodes) - 2), 0.5], numbers):
            mass[number] += share * piece * line.type["m"]
            weight[number] += share * piece * line.w
        groups.append((f"line{line.number}", np.stack([numbers[:-1], numbers[1:]], axis=1), line.type["EA"], piece))
    pulled = [(k, point.fExt) for k, point in enumerate(system.pointList) if k not in held and np.any(point.fExt)]
    bodies, coupled = len(system.bodyList), sum(point.type == -1 for point in system.pointList)
    _leave_out("drag and added mass of lines and points", "bending of lines",
               f"{bodies} bodies: the points on them are held still" if bodies else "",
               f"motion of {coupled} coupled points, which are held still" if coupled else "",
               "currents" if np.any(getattr(system, "current", 0)) else "", "friction on the sea bed")  # fmt: skip
    masses = np.where(np.array(mass) > 0, mass, 1.0)  # of points that hold nothing
    factor = np.array(weight) / (masses * system.g)
    scene = Scene("moorings", gravity=(0, 0, -system.g)).particles(q, mass=masses, pinned=sorted(held), gravity_factor=factor)
    for name, between, stiffness, piece in groups:
        made = {"stiffness": stiffness, "rest_length": piece, "damping_ratio": damping_ratio}
        scene.springs(name, between=between, compression=False, **made)
    for number, force in pulled:
        scene.loads([number], force=[force])
    sinks = 100 * float(np.max(weight, initial=0.0))
    if system.depth > 0 and sinks > 0:
        scene.obstacles(shape="plane", point=(0, 0, -system.depth), normal=(0, 0, 1), stiffness=sinks, damping=0.1 * sinks)
    return scene
