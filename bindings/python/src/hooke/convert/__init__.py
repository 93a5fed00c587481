"""Scenes from objects of other libraries: graphs of networkx, meshes of meshio, universes of MDAnalysis, systems of MoorPy.

What a scene has nothing for is left out, and each such thing is told of by a `LeftOut` warning. Particles are numbered as
there. The scene is open: more can be added to it.
"""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

import numpy as np

from .. import BadValue, Scene, options_of
from .._signature import takes
from .._types import FloatArray, Numbers
from ..parts import Quantity

_ANGSTROM, _DALTON, _PICOSECOND = 1e-10, 1.66053906660e-27, 1e-12
#: Edges of the cells of meshio, 10 a + b for the corners a and b; of those of higher order the corners alone count.
_EDGES = {
    "line": (1,), "triangle": (1, 12, 2), "quad": (1, 12, 23, 3), "tetra": (1, 12, 2, 3, 13, 23),
    "hexahedron": (1, 12, 23, 3, 45, 56, 67, 47, 4, 15, 26, 37), "wedge": (1, 12, 2, 34, 45, 35, 3, 14, 25),
    "pyramid": (1, 12, 23, 3, 4, 14, 24, 34),
}  # fmt: skip


class LeftOut(UserWarning):
    """Something that a scene has nothing for, and that was not carried over."""


def _leave_out(*things: str | None) -> None:
    for thing in filter(None, things):
        warnings.warn(f"left out: {thing}", LeftOut, stacklevel=3)


def _points(position: Any) -> FloatArray:
    """Points in space, of those of a plane with z = 0."""
    points = np.array(position, float)
    return np.pad(points, ((0, 0), (0, 3 - points.shape[1])))


def _column(rows: list[dict[str, Any]], name: str, given: Any = None) -> list[Any]:
    """An attribute of nodes or edges; `given` where they have none."""
    values = [row.get(name, given) for row in rows]
    for number, value in enumerate(values):
        if value is None:
            raise BadValue(f"{name}: number {number} of {len(rows)} has none; give it there, or for all")
    return values


@takes()
def from_networkx(
    graph: Any, pos: str | Mapping[Any, Numbers] = "pos", *, mass: Quantity | None = None,
    stiffness: Quantity | None = None, damping: Quantity = 0.0,
) -> Scene:
    """The scene of a graph, with a particle for each node and a spring of the strain law for each edge.

    `pos` is the attribute with the position [m] of a node, or a mapping as layouts return it. Nodes may have `mass` [kg] and
    `pinned`, edges `stiffness` [N], `damping` [N s] and `rest_length` [m] (the distance, if none has one); for those that
    have none the arguments hold.
    """
    numbers = {node: k for k, node in enumerate(graph)}
    nodes = [dict(data) if isinstance(pos, str) else {**data, "pos": pos.get(node)} for node, data in graph.nodes(data=True)]
    edges = [(numbers[a], numbers[b], data) for a, b, data in graph.edges(data=True) if a != b]
    rows, where, loops = [edge[2] for edge in edges], pos if isinstance(pos, str) else "pos", graph.number_of_edges() - len(edges)
    known = {"nodes": (nodes, {where, "mass", "pinned"}), "edges": (rows, {"stiffness", "damping", "rest_length"})}
    lost = sorted({f"the attribute {key!r} of {what}" for what, (each, taken) in known.items() for row in each for key in row
                   if key not in taken}, key=lambda words: (words.endswith("edges"), words))  # fmt: skip
    itself = f"{loops} edges from a node to itself" if loops else None
    _leave_out(*lost, itself, "directions of edges" if graph.is_directed() else None)
    pinned, masses = np.flatnonzero(_column(nodes, "pinned", False)), _column(nodes, "mass", mass)
    scene = Scene("a graph").particles(_points(_column(nodes, where)), mass=masses, pinned=pinned)
    if not edges:
        return scene
    lengths = _column(rows, "rest_length") if any("rest_length" in row for row in rows) else None
    ends, strong, damped = [edge[:2] for edge in edges], _column(rows, "stiffness", stiffness), _column(rows, "damping", damping)
    return scene.springs("edges", between=np.array(ends), stiffness=strong, damping=damped, rest_length=lengths)


@takes()
def from_meshio(
    mesh: Any, *, mass: Quantity, stiffness: Quantity, damping: Quantity = 0.0, pinned: Numbers = ()
) -> Scene:
    """The scene of a mesh: a particle at each point, which share the total `mass` [kg] equally, and a spring of the strain law
    along each edge of a cell, with `stiffness` [N] and `damping` [N s]. `pinned` are numbers of points."""
    edges, lost = [np.empty((0, 2), np.int64)], set()
    for block in mesh.cells:
        kind = block.type.rstrip("0123456789")
        edges += [np.asarray(block.data)[:, divmod(edge, 10)] for edge in _EDGES.get(kind, ())]
        if kind != block.type or kind not in _EDGES:
            lost.add(f"nodes within the edges of {block.type}" if kind in _EDGES else f"cells: {block.type}")
    ends = np.unique(np.sort(np.concatenate(edges), axis=1), axis=0)
    loose = len(mesh.points) - len(np.unique(ends))
    data = [*mesh.point_data, *mesh.cell_data, *mesh.field_data, *mesh.point_sets, *mesh.cell_sets]
    held = f"what held {loose} points that are in no edge: they are free particles" if loose else None
    _leave_out(*sorted(lost), *(f"data: {name}" for name in data), held)
    total: Any = options_of("particles").set(mass=mass)["mass"]
    share = total / max(1, len(mesh.points))
    scene = Scene("a mesh").particles(_points(mesh.points), mass=share, pinned=pinned)
    return scene.springs("edges", between=ends, stiffness=stiffness, damping=damping) if len(ends) else scene


@takes()
def from_mdanalysis(universe: Any, *, stiffness: Quantity | Mapping[Any, Quantity], damping: Quantity = 0.0) -> Scene:
    """The scene of a universe at its present frame, in SI: a particle for each atom, with its mass and its velocity, and a
    spring for each bond, by metres. `stiffness` [N/m] is one for all, or a mapping from the types of bonds, such as
    ``("C", "H")``, and `damping` [N s/m]; rest lengths are those of the frame."""
    atoms, bonds, present = universe.atoms, getattr(universe, "bonds", ()), universe.trajectory.ts
    kinds = [kind for kind in ("angles", "dihedrals", "impropers", "cmaps") if hasattr(universe, kind)]
    _leave_out(
        *(f"{len(getattr(universe, kind))} {kind}" for kind in kinds),
        "charges" if hasattr(atoms, "charges") else None,
        "names of atoms and residues",
        "the periodic box" if present.dimensions is not None else None,
        "frames, but for the present one" if len(universe.trajectory) > 1 else None,
        "forces between atoms that are not bonded",
    )
    velocity = atoms.velocities * (_ANGSTROM / _PICOSECOND) if present.has_velocities else None
    scene = Scene("a universe").particles(atoms.positions.astype(float) * _ANGSTROM, velocity, mass=atoms.masses * _DALTON)
    if not len(bonds):
        return scene
    ends = np.array([bond.indices for bond in bonds], np.int64)
    each: Any = stiffness
    if isinstance(stiffness, Mapping):
        known = {**{kind[::-1]: value for kind, value in stiffness.items()}, **stiffness}
        missing = {tuple(bond.type) for bond in bonds} - set(known)
        if missing:
            raise BadValue(f"stiffness: there is none for bonds of the type {min(missing)!r}")
        each = [known[tuple(bond.type)] for bond in bonds]
    return scene.springs("bonds", between=ends, law="length", stiffness=each, damping=damping)


@takes()
def from_moorpy(system: Any, *, damping_ratio: float = 0.1) -> Scene:
    """The scene of a MoorPy system where it is now, with z upwards: each line as its nodes, with the stiffness EA, the mass and
    the weight in water of its type; fixed and coupled points pinned; free points with their mass, weight and force; the sea
    bed as a plane, into which the heaviest particle sinks by a centimetre."""
    points, q = system.pointList, [np.array(point.r, float) for point in system.pointList]
    mass, groups = [float(point.m) for point in points], []
    weight = [float(point.m - point.v * system.rho) * float(system.g) for point in points]
    for line in system.lineList:
        nodes = np.stack(line.getLineCoords(0.0)[:3], axis=1)
        inner, piece = len(nodes) - 2, line.L / (len(nodes) - 1)
        tied = [(k, *tie) for k, point in enumerate(points) for tie in zip(point.attached, point.attachedEndB)]
        held = {end: k for k, of, end in tied if of == line.number}
        numbers = [held[0], *range(len(q), len(q) + inner), held[1]]
        q, mass, weight = [*q, *nodes[1:-1]], mass + [0.0] * inner, weight + [0.0] * inner
        for share, number in zip([0.5, *[1.0] * inner, 0.5], numbers):
            mass[number] += share * piece * line.type["m"]
            weight[number] += share * piece * line.w
        groups.append((f"line{line.number}", np.stack([numbers[:-1], numbers[1:]], axis=1), line.type["EA"], piece))
    bodies, coupled = len(system.bodyList), sum(point.type == -1 for point in points)
    _leave_out(
        "drag and added mass of lines and points",
        "bending of lines",
        f"{bodies} bodies: the points on them are held still" if bodies else None,
        f"motion of {coupled} coupled points, which are held still" if coupled else None,
        "currents" if np.any(getattr(system, "current", 0)) else None,
        "friction on the sea bed",
    )
    masses = np.where(np.array(mass) > 0, mass, 1.0)  # of points that hold nothing
    pinned, factor = [k for k, point in enumerate(points) if point.type != 0], np.array(weight) / (masses * system.g)
    scene = Scene("moorings", gravity=(0, 0, -system.g)).particles(q, mass=masses, pinned=pinned, gravity_factor=factor)
    for name, between, stiffness, piece in groups:
        made = {"stiffness": stiffness, "rest_length": piece, "damping_ratio": damping_ratio}
        scene.springs(name, between=between, compression=False, **made)
    for number, point in enumerate(points):
        if point.type == 0 and np.any(point.fExt):
            scene.loads([number], force=[point.fExt])
    sinks = 100 * float(np.max(weight, initial=0.0))
    if system.depth > 0 and sinks > 0:
        scene.obstacles(shape="plane", point=(0, 0, -system.depth), normal=(0, 0, 1), stiffness=sinks, damping=0.1 * sinks)
    return scene
