"""Queries of a system."""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from ._library import lib
from ._memory import Asked, Handle, address_of, double_pointer, index_pointer, rows, text, view
from ._types import FloatArray, IntArray
from .problems import Problem

__all__ = ["Blocks", "BodyMotion", "Derived", "Material", "build_facts"]

_DOUBLE = np.dtype(np.float64)


class Material(NamedTuple):
    """Per spring, each (m,): kappa [N/m], gamma [N s/m], rest length [m]."""

    kappa: FloatArray
    gamma: FloatArray
    rest_length: FloatArray


class Derived(NamedTuple):
    """A number that a part derived from its density, damping ratio or bending stiffness."""

    part: str
    family: str | None
    name: str
    value: float
    unit: str


class BodyMotion(NamedTuple):
    """The motion of a rigid body: position (3,) [m] and velocity (3,) [m/s] of its point, which is the centre of mass or
    the first pinned particle; the quaternion (4,) from its axes to those of space, real part first; the angular momentum
    about the point (3,) [kg m^2/s]."""

    point: FloatArray
    quaternion: FloatArray
    velocity: FloatArray
    angular_momentum: FloatArray


class Blocks(NamedTuple):
    """A sparse matrix of 3x3 blocks in compressed rows: row_start (n + 1,), column (count,), blocks
    (count, 3, 3)."""

    row_start: IntArray
    column: IntArray
    dfdq: FloatArray
    dfdv: FloatArray


#: Counts that are known only of a committed system.
_LATE = ("free", "dropped_springs", "idle", "inside_bodies", "memory", "spring_memory", "forces")


class Queries(Problem):
    """Counts, tables, forces and energies. Positions and velocities are (n, 3) arrays [m], [m/s]."""

    _handle: Handle
    _shape: tuple[int, int]  # of positions, once committed

    def _committed(self) -> Handle:
        raise NotImplementedError

    def _count(self, what: str) -> int:
        return int(lib.hooke_system_count(self._committed() if what in _LATE else self._handle, what.encode()))

    def _groups(self, force: bytes) -> list[tuple[str, int]]:
        handle = self._handle
        return [
            (text(lib.hooke_system_group_name(handle, force, k)), lib.hooke_system_group_size(handle, force, k))
            for k in range(lib.hooke_system_group_count(handle, force))
        ]

    def _ends(self, force: bytes) -> IntArray:
        handle = self._committed()
        ends = np.empty((lib.hooke_system_count(handle, force), lib.hooke_member_particles(force)), np.int64)
        lib.hooke_system_members(handle, force, index_pointer(ends), None, None, None)
        return ends

    def _material(self, force: bytes, *rest_lengths: int) -> Material:
        handle = self._committed()
        count = lib.hooke_system_count(handle, force)
        material = Material(np.empty(count), np.empty(count), np.empty((count, *rest_lengths)))
        lib.hooke_system_members(handle, force, None, *(double_pointer(column) for column in material))
        return material

    def _particle_numbers(self, function: Any) -> FloatArray:
        handle = self._committed()
        return view(address_of(function(handle)), (self.particle_count,), handle, writeable=False)

    def _names(self, function: Any, what: str) -> list[str]:
        return [text(function(self._handle, k)) for k in range(self._count(what))]

    is_committed = Asked(
        lambda system: bool(lib.hooke_system_is_committed(system._handle)), "Whether the system is committed, and so constant."
    )
    particle_count = Asked(
        lambda system: int(lib.hooke_system_particle_count(system._handle)), "Number of particles, including those of parts."
    )
    free_count = Asked(_count, "Number of particles that are neither pinned nor driven; commits.", "free")
    spring_count = Asked(
        _count, "Number of springs: all that were added; once committed, those with stiffness or damping.", "springs"
    )
    dropped_spring_count = Asked(
        _count, "Number of springs dropped because they have neither stiffness nor damping; commits.", "dropped_springs"
    )
    idle_count = Asked(
        _count,
        "Number of pinned particles that no spring, no bending, no altitude spring and no force callback acts on; commits.",
        "idle",
    )
    bending_count = Asked(_count, "Number of triples of bending; commit drops those of coefficient 0.", "bending")
    altitude_count = Asked(
        _count, "Number of tetrahedra with altitude springs; commit drops those without stiffness and damping.", "altitude"
    )
    anchor_count = Asked(_count, "Number of anchors; commit drops those without stiffness and damping.", "anchors")
    body_count = Asked(_count, "Number of rigid bodies.", "bodies")
    inside_body_count = Asked(
        _count,
        "Number of springs and other members of forces dropped because they are inside a rigid body; commits.",
        "inside_bodies",
    )
    memory = Asked(_count, "Memory that the system holds [bytes].", "memory")
    spring_memory = Asked(_count, "The part of it that grows with the number of springs [bytes].", "spring_memory")
    groups = Asked(_groups, 'Name ("" if it has none) and number of springs of every group.', b"springs")
    bending_groups = Asked(_groups, 'Name ("" if it has none) and number of triples of every group.', b"bending")
    altitude_groups = Asked(_groups, 'Name ("" if it has none) and number of tetrahedra of every group.', b"altitude")
    masses = Asked(_particle_numbers, "Mass of every particle (n,) [kg], a read-only view.", lib.hooke_system_mass)
    inverse_masses = Asked(
        _particle_numbers,
        "Inverse mass of every particle (n,) [1/kg], 0 where pinned or driven, a read-only view.",
        lib.hooke_system_inverse_mass,
    )
    spring_ends = Asked(_ends, "The particles at both ends of every spring (m, 2), in spring order.", b"springs")
    spring_material = Asked(_material, "Stiffness, damping and rest length of every spring.", b"springs")
    bending_ends = Asked(_ends, "The particles of every triple (m, 3), in their order.", b"bending")
    bending_coefficient = Asked[FloatArray](
        lambda system: system._material(b"bending").kappa, "The coefficient of every triple (m,) [N/m]."
    )
    altitude_ends = Asked(_ends, "The particles of every tetrahedron (m, 4), in their order.", b"altitude")
    altitude_material = Asked(
        _material,
        "Stiffness (m,) [N], damping (m,) [N s] and the seven rest lengths (m, 7) [m] of every tetrahedron, negative "
        "where its volume is.",
        b"altitude",
        7,
    )
    body_names = Asked(_names, 'The names of the rigid bodies, "" for one without.', lib.hooke_system_body_name, "bodies")
    forces = Asked(
        _names,
        'The forces that the system computes ("springs", "bending", "altitude", "drag", "wind", "callback", "gravity").',
        lib.hooke_system_force_name,
        "forces",
    )

    @property
    def anchors(self) -> tuple[IntArray, FloatArray, FloatArray, FloatArray, FloatArray]:
        """Particle (m,), point (m, 3) [m], stiffness [N/m], damping [N s/m] and rest length [m] (m,) of every anchor."""
        particles = self._ends(b"anchors")[:, 0]
        points = np.empty((len(particles), 3))
        lib.hooke_system_anchor_points(self._handle, double_pointer(points))
        return (particles, points, *self._material(b"anchors"))

    @property
    def derived(self) -> list[Derived]:
        """Numbers that parts derived from their density, damping ratios and bending stiffness."""

        def words(number: int, what: bytes) -> str:
            return text(lib.hooke_system_derived_text(self._handle, number, what))

        return [
            Derived(words(k, b"part"), words(k, b"family") or None, words(k, b"name"), value, words(k, b"unit"))
            for k in range(self._count("derived"))
            for value in [lib.hooke_system_derived_value(self._handle, k)]
        ]

    def altitude_lengths(self, q: Any) -> np.ndarray:
        """The altitude of every tetrahedron that acts at q (m,) [m]: negative where it is inverted, 0 where none
        acts."""
        count = lib.hooke_system_count(self._committed(), b"altitude")
        return self._filled(lib.hooke_system_altitude_lengths, count, q=q)

    def body_particles(self, body: int) -> IntArray:
        """The particles of a rigid body (m,), ascending once committed."""
        particles = np.empty(lib.hooke_system_body_particles(self._handle, body, None), np.int64)
        lib.hooke_system_body_particles(self._handle, body, index_pointer(particles))
        return particles

    def body_inertia(self, body: int) -> tuple[float, FloatArray]:
        """Mass [kg] of a rigid body and its moments of inertia (3,) [kg m^2] about the axes through its point, ascending;
        with two pinned points one, before two zeros."""
        inertia = self._filled(lib.hooke_system_body_inertia, 4, body)
        return float(inertia[0]), inertia[1:]

    def body_motion(self, body: int, q: Any, v: Any) -> BodyMotion:
        """The motion of a rigid body at q and v."""
        motion = self._filled(lib.hooke_system_body_motion, 13, body, q=q, v=v)
        return BodyMotion(motion[:3], motion[3:7], motion[7:10], motion[10:])

    # forces

    def force(self, q: Any, v: Any, t: float = 0.0) -> FloatArray:
        """Force on every particle (n, 3) [N]."""
        return self._filled(lib.hooke_system_force, None, t, q=q, v=v)

    def acceleration(self, q: Any, v: Any, t: float = 0.0) -> FloatArray:
        """Acceleration of every particle (n, 3) [m/s^2], zero where pinned or driven."""
        return self._filled(lib.hooke_system_acceleration, None, t, q=q, v=v)

    def tension(self, q: Any, v: Any, t: float = 0.0) -> FloatArray:
        """Tension of every spring (m,) [N], with damping: positive where it pulls its ends together, 0 where a spring that
        only pulls is slack."""
        return self._filled(lib.hooke_system_tension, self.spring_count, t, q=q, v=v)

    def reaction(self, q: Any, v: Any, t: float = 0.0) -> FloatArray:
        """Force of the support of every particle (n, 3) [N]: m a - f where it is pinned or driven, with its own weight in f,
        and 0 where it is free. NaN in a rigid body, and of a drive by a callback."""
        return self._filled(lib.hooke_system_reaction, None, t, q=q, v=v)

    def derivative_product(self, q: Any, v: Any, dq: Any, dv: Any, t: float = 0.0) -> FloatArray:
        """(df/dq) dq + (df/dv) dv of the force, (n, 3)."""
        return self._filled(lib.hooke_system_derivative_product, None, t, q=q, v=v, dq=dq, dv=dv)

    def derivative_blocks(self, q: Any, v: Any) -> Blocks:
        """df/dq [N/m] and df/dv [N s/m] as sparse 3x3 blocks, callbacks left out."""
        handle = self._committed()
        count = lib.hooke_system_count(handle, b"blocks")
        blocks = Blocks(
            np.empty(self.particle_count + 1, np.int64),
            np.empty(count, np.int64),
            np.empty((count, 3, 3)),
            np.empty((count, 3, 3)),
        )
        lib.hooke_system_derivative_pattern(handle, index_pointer(blocks.row_start), index_pointer(blocks.column))
        at, found = (self._argument(q, "q"), self._argument(v, "v")), map(double_pointer, blocks[2:])
        lib.hooke_system_derivative_blocks(handle, *at, *found)
        return blocks

    def coincident_springs(self, q: Any) -> int:
        """Number of springs whose ends coincide although their rest length is not zero, and of particles at the centre or on
        the axis of an obstacle, as it is at time 0: they have no direction and no force."""
        return int(lib.hooke_system_coincident_springs(self._committed(), self._argument(q, "q")))

    # energies

    def kinetic_energy(self, v: Any) -> float:
        """Kinetic energy of the free particles [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"kinetic", None, self._argument(v, "v")))

    def spring_energy(self, q: Any, t: float = 0.0) -> float:
        """Energy of the springs at time t [J]."""
        return float(lib.hooke_system_energy_at(self._committed(), b"springs", t, self._argument(q, "q"), None))

    def bending_energy(self, q: Any) -> float:
        """Energy of bending [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"bending", self._argument(q, "q"), None))

    def altitude_energy(self, q: Any) -> float:
        """Energy of the altitude springs [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"altitude", self._argument(q, "q"), None))

    def gravity_energy(self, q: Any) -> float:
        """The sum of -m g.q over the free particles [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"gravity", self._argument(q, "q"), None))

    def potential_energy(self, q: Any, t: float = 0.0) -> float:
        """Energy of all forces that have one, at time t [J]."""
        return float(lib.hooke_system_energy_at(self._committed(), b"potential", t, self._argument(q, "q"), None))

    def energy(self, q: Any, v: Any, t: float = 0.0) -> float:
        """Total energy at time t [J]. A force callback has no energy."""
        at = (self._argument(q, "q"), self._argument(v, "v"))
        return float(lib.hooke_system_energy_at(self._committed(), b"total", t, *at))

    def dissipated_power(self, q: Any, v: Any, t: float = 0.0) -> float:
        """Power that damping and drag dissipate as heat at time t [W]."""
        at = (self._argument(q, "q"), self._argument(v, "v"))
        return float(lib.hooke_system_dissipated_power_at(self._committed(), t, *at))

    def momentum(self, v: Any) -> FloatArray:
        """Momentum of the free particles (3,) [kg m/s]."""
        return self._filled(lib.hooke_system_momentum, 3, v=v)

    def angular_momentum(self, q: Any, v: Any) -> FloatArray:
        """Angular momentum of the free particles about the origin (3,) [kg m^2/s]."""
        return self._filled(lib.hooke_system_angular_momentum, 3, q=q, v=v)

    def step_bound(self, method: str, q: Any) -> float:
        """A step [s] below which `method` is certain to be stable for the system linearised at q: 0 if no step is
        stable, infinity if nothing limits it, NaN if no bound is known."""
        return float(self._filled(lib.hooke_step_bound, 1, method.encode(), q=q)[0])

    def _argument(self, values: Any, name: str) -> Any:
        """Positions or velocities as an argument; those of a state are passed unchanged."""
        if type(values) is np.ndarray and values.shape == self._shape and values.dtype is _DOUBLE:
            try:
                buffer: Any = values
                return ctypes.c_double.from_buffer(buffer)
            except TypeError:  # read-only or not contiguous
                pass
        return double_pointer(rows(values, name, self.particle_count))

    def _filled(self, function: Any, shape: Any, *before: Any, **arrays: Any) -> FloatArray:
        """What a function writes at positions and velocities; of every particle without a `shape`."""
        handle = self._committed()
        out = np.empty(self._shape if shape is None else shape)
        function(handle, *before, *(self._argument(values, name) for name, values in arrays.items()), double_pointer(out))
        return out


def build_facts() -> dict[str, str]:
    """The library's version and its build; "" for a library that this build lacks."""
    facts = {what: text(lib.hooke_build_fact(what.encode())) for what in _FACTS}
    return {"version": text(lib.hooke_version()), "path": str(lib.path), **facts}


_FACTS = (
    "sundials", "cholmod", "blas", "lapack", "gsl", "hdf5", "chartjs", "threejs", "instructions", "licence",
)
