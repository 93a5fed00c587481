"""Queries of a system."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ._library import lib
from ._memory import Handle, address_of, double_pointer, index_pointer, rows, text, view
from ._types import FloatArray, IntArray
from .problems import Problem

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


class Count(property):
    """A property that is a count of the library; one that is known only of a committed system commits it."""

    def __init__(self, what: str, doc: str):
        late = what in ("free", "dropped_springs", "idle", "inside_bodies", "memory", "spring_memory")

        def count(system: Queries) -> int:
            return int(lib.hooke_system_count(system._committed() if late else system._handle, what.encode()))

        count.__doc__ = doc
        super().__init__(count)

    if TYPE_CHECKING:

        def __get__(self, system: Any, kind: type | None = None) -> int: ...  # type: ignore[override]


class Queries(Problem):
    """Counts, tables, forces and energies. Positions and velocities are (n, 3) arrays [m], [m/s]."""

    _handle: Handle
    _shape: tuple[int, int]  # of positions, once committed

    def _committed(self) -> Handle:
        raise NotImplementedError

    @property
    def is_committed(self) -> bool:
        """Whether the system is committed, and so constant."""
        return bool(lib.hooke_system_is_committed(self._handle))

    @property
    def particle_count(self) -> int:
        """Number of particles, including those of parts."""
        return int(lib.hooke_system_particle_count(self._handle))

    free_count = Count("free", "Number of particles that are neither pinned nor driven; commits.")

    spring_count = Count(
        "springs", "Number of springs: all that were added; once committed, those with stiffness or damping."
    )

    dropped_spring_count = Count(
        "dropped_springs", "Number of springs dropped because they have neither stiffness nor damping; commits."
    )

    idle_count = Count(
        "idle",
        "Number of pinned particles that no spring, no bending, no altitude spring and no force callback acts on; commits.",
    )

    @property
    def groups(self) -> list[tuple[str, int]]:
        """Name ("" if it has none) and number of springs of every group."""
        return self._groups(b"springs")

    def _groups(self, force: bytes) -> list[tuple[str, int]]:
        handle = self._handle
        return [
            (text(lib.hooke_system_group_name(handle, force, k)), lib.hooke_system_group_size(handle, force, k))
            for k in range(lib.hooke_system_group_count(handle, force))
        ]

    bending_count = Count("bending", "Number of triples of bending; commit drops those of coefficient 0.")

    @property
    def bending_groups(self) -> list[tuple[str, int]]:
        """Name ("" if it has none) and number of triples of every group."""
        return self._groups(b"bending")

    altitude_count = Count(
        "altitude", "Number of tetrahedra with altitude springs; commit drops those without stiffness and damping."
    )

    @property
    def altitude_groups(self) -> list[tuple[str, int]]:
        """Name ("" if it has none) and number of tetrahedra of every group."""
        return self._groups(b"altitude")

    anchor_count = Count("anchors", "Number of anchors; commit drops those without stiffness and damping.")

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

        def value(number: int, what: str) -> Any:
            if what == "value":
                return lib.hooke_system_derived_value(self._handle, number)
            word = lib.hooke_system_derived_text(self._handle, number, what.encode())
            return None if word is None else text(word)

        count = lib.hooke_system_count(self._handle, b"derived")
        return [Derived(*(value(number, what) for what in Derived._fields)) for number in range(count)]

    @property
    def masses(self) -> FloatArray:
        """Mass of every particle (n,) [kg], a read-only view."""
        return self._particle_numbers(lib.hooke_system_mass)

    @property
    def inverse_masses(self) -> FloatArray:
        """Inverse mass of every particle (n,) [1/kg], 0 where pinned or driven, a read-only view."""
        return self._particle_numbers(lib.hooke_system_inverse_mass)

    def _particle_numbers(self, function: Any) -> FloatArray:
        handle = self._committed()
        return view(address_of(function(handle)), (self.particle_count,), handle, writeable=False)

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

    @property
    def spring_ends(self) -> IntArray:
        """The particles at both ends of every spring (m, 2), in spring order."""
        return self._ends(b"springs")

    @property
    def spring_material(self) -> Material:
        """Stiffness, damping and rest length of every spring."""
        return self._material(b"springs")

    @property
    def bending_ends(self) -> IntArray:
        """The particles of every triple (m, 3), in their order."""
        return self._ends(b"bending")

    @property
    def bending_coefficient(self) -> FloatArray:
        """The coefficient of every triple (m,) [N/m]."""
        return self._material(b"bending").kappa

    @property
    def altitude_ends(self) -> np.ndarray:
        """The particles of every tetrahedron (m, 4), in their order."""
        return self._ends(b"altitude")

    @property
    def altitude_material(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Stiffness (m,) [N], damping (m,) [N s] and the seven rest lengths (m, 7) [m] of every tetrahedron,
        negative where its volume is."""
        stiffness, damping, rest_length = self._material(b"altitude", 7)
        return stiffness, damping, rest_length

    def altitude_lengths(self, q: Any) -> np.ndarray:
        """The altitude of every tetrahedron that acts at q (m,) [m]: negative where it is inverted, 0 where none
        acts."""
        count = lib.hooke_system_count(self._committed(), b"altitude")
        return self._filled(lib.hooke_system_altitude_lengths, count, q=q)

    body_count = Count("bodies", "Number of rigid bodies.")

    inside_body_count = Count(
        "inside_bodies",
        "Number of springs and other members of forces dropped because they are inside a rigid body; commits.",
    )

    @property
    def body_names(self) -> list[str]:
        """The names of the rigid bodies, "" for one without."""
        return [text(lib.hooke_system_body_name(self._handle, k)) for k in range(self.body_count)]

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

    @property
    def forces(self) -> list[str]:
        """The forces that the system computes ("springs", "bending", "altitude", "drag",
        "callback", "gravity")."""
        handle = self._committed()
        return [
            text(lib.hooke_system_force_name(handle, k)) for k in range(lib.hooke_system_count(handle, b"forces"))
        ]

    memory = Count("memory", "Memory that the system holds [bytes].")

    spring_memory = Count("spring_memory", "The part of it that grows with the number of springs [bytes].")

    # forces

    def force(self, q: Any, v: Any, t: float = 0.0) -> FloatArray:
        """Force on every particle (n, 3) [N]."""
        return self._filled(lib.hooke_system_force, None, t, q=q, v=v)

    def acceleration(self, q: Any, v: Any, t: float = 0.0) -> FloatArray:
        """Acceleration of every particle (n, 3) [m/s^2], zero where pinned or driven."""
        return self._filled(lib.hooke_system_acceleration, None, t, q=q, v=v)

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
        """Number of springs whose ends coincide although their rest length is not zero: they have no direction and no
        force."""
        return int(lib.hooke_system_coincident_springs(self._committed(), self._argument(q, "q")))

    # energies

    def kinetic_energy(self, v: Any) -> float:
        """Kinetic energy of the free particles [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"kinetic", None, self._argument(v, "v")))

    def spring_energy(self, q: Any) -> float:
        """Energy of the springs [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"springs", self._argument(q, "q"), None))

    def bending_energy(self, q: Any) -> float:
        """Energy of bending [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"bending", self._argument(q, "q"), None))

    def altitude_energy(self, q: Any) -> float:
        """Energy of the altitude springs [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"altitude", self._argument(q, "q"), None))

    def gravity_energy(self, q: Any) -> float:
        """The sum of -m g.q over the free particles [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"gravity", self._argument(q, "q"), None))

    def potential_energy(self, q: Any) -> float:
        """Energy of springs, bending, altitude springs and gravity [J]."""
        return float(lib.hooke_system_energy(self._committed(), b"potential", self._argument(q, "q"), None))

    def energy(self, q: Any, v: Any) -> float:
        """Total energy [J]. A force callback has no energy."""
        return float(lib.hooke_system_energy(self._committed(), b"total", self._argument(q, "q"), self._argument(v, "v")))

    def dissipated_power(self, q: Any, v: Any) -> float:
        """Power that damping and drag dissipate as heat [W]."""
        return float(lib.hooke_system_dissipated_power(self._committed(), self._argument(q, "q"), self._argument(v, "v")))

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
    "sundials", "cholmod", "lapack", "gsl", "arpack", "hdf5", "chartjs", "threejs", "instructions", "licence",
)
