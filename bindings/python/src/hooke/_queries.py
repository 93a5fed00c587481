"""What can be asked of a system."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ._library import lib
from ._memory import Handle, address_of, double_pointer, index_pointer, rows, text, view


class Material(NamedTuple):
    """Per spring, each (m,): kappa [N/m], gamma [N s/m], rest length [m]."""

    kappa: np.ndarray
    gamma: np.ndarray
    rest_length: np.ndarray


class Derived(NamedTuple):
    """A number that a part derived from its density, damping ratio or bending stiffness."""

    part: str
    family: str | None
    name: str
    value: float
    unit: str


class Blocks(NamedTuple):
    """A sparse matrix of 3x3 blocks in compressed rows: row_start (n + 1,), column (count,), blocks
    (count, 3, 3)."""

    row_start: np.ndarray
    column: np.ndarray
    dfdq: np.ndarray
    dfdv: np.ndarray


class Queries:
    """Counts, tables, forces and energies. Positions and velocities are (n, 3) arrays [m], [m/s]."""

    _handle: Handle

    def _committed(self) -> Handle:
        raise NotImplementedError

    @property
    def is_committed(self) -> bool:
        """Whether the system is finished and constant."""
        return bool(lib.hooke_system_is_committed(self._handle))

    @property
    def particle_count(self) -> int:
        return lib.hooke_system_particle_count(self._handle)

    @property
    def free_count(self) -> int:
        """Particles that are neither pinned nor driven; commits."""
        return lib.hooke_system_free_count(self._committed())

    @property
    def spring_count(self) -> int:
        """Springs: all that were added, once committed those that have stiffness or damping."""
        return lib.hooke_system_spring_count(self._handle)

    @property
    def dropped_spring_count(self) -> int:
        """Springs left out since they have neither stiffness nor damping; commits."""
        return lib.hooke_system_dropped_spring_count(self._committed())

    @property
    def idle_count(self) -> int:
        """Pinned particles that no spring, no bending and no force callback touches; commits."""
        return lib.hooke_system_idle_count(self._committed())

    @property
    def groups(self) -> list[tuple[str, int]]:
        """Name ("" if it has none) and number of springs of every group."""
        return [
            (
                text(lib.hooke_system_group_name(self._handle, group)),
                lib.hooke_system_group_size(self._handle, group),
            )
            for group in range(lib.hooke_system_group_count(self._handle))
        ]

    @property
    def bending_count(self) -> int:
        """Triples of bending; commit drops those of coefficient 0."""
        return lib.hooke_system_bending_count(self._handle)

    @property
    def bending_groups(self) -> list[tuple[str, int]]:
        """Name ("" if it has none) and number of triples of every group."""
        return [
            (
                text(lib.hooke_system_bending_group_name(self._handle, group)),
                lib.hooke_system_bending_group_size(self._handle, group),
            )
            for group in range(lib.hooke_system_bending_group_count(self._handle))
        ]

    @property
    def derived(self) -> list[Derived]:
        """What parts derived from their density, damping ratios and bending stiffness."""

        def word(number: int, what: bytes) -> str | None:
            found = lib.hooke_system_derived_text(self._handle, number, what)
            return None if found is None else text(found)

        return [
            Derived(
                word(k, b"part") or "",
                word(k, b"family"),
                word(k, b"name") or "",
                lib.hooke_system_derived_value(self._handle, k),
                word(k, b"unit") or "",
            )
            for k in range(lib.hooke_system_derived_count(self._handle))
        ]

    @property
    def masses(self) -> np.ndarray:
        """Mass of every particle (n,) [kg], a read-only view."""
        return self._particle_numbers(lib.hooke_system_mass)

    @property
    def inverse_masses(self) -> np.ndarray:
        """Inverse mass of every particle (n,) [1/kg], 0 where pinned or driven, a read-only view."""
        return self._particle_numbers(lib.hooke_system_inverse_mass)

    def _particle_numbers(self, function: Any) -> np.ndarray:
        handle = self._committed()
        return view(address_of(function(handle)), (self.particle_count,), handle, writeable=False)

    @property
    def spring_ends(self) -> np.ndarray:
        """The particles at both ends of every spring (m, 2), in spring order."""
        handle = self._committed()
        ends = np.empty((self.spring_count, 2), np.int64)
        lib.hooke_system_spring_ends(handle, index_pointer(ends))
        return ends

    @property
    def spring_material(self) -> Material:
        """What every spring is made of."""
        handle = self._committed()
        material = Material(*(np.empty(self.spring_count) for _ in range(3)))
        lib.hooke_system_spring_material(handle, *(double_pointer(column) for column in material))
        return material

    @property
    def bending_ends(self) -> np.ndarray:
        """The particles of every triple (m, 3), in their order."""
        handle = self._committed()
        triples = np.empty((self.bending_count, 3), np.int64)
        lib.hooke_system_bending_ends(handle, index_pointer(triples))
        return triples

    @property
    def bending_coefficient(self) -> np.ndarray:
        """The coefficient of every triple (m,) [N/m]."""
        handle = self._committed()
        coefficient = np.empty(self.bending_count)
        lib.hooke_system_bending_coefficient(handle, double_pointer(coefficient))
        return coefficient

    @property
    def forces(self) -> list[str]:
        """The forces that the system computes ("springs", "bending", "drag", "callback",
        "gravity")."""
        handle = self._committed()
        return [
            text(lib.hooke_system_force_name(handle, k)) for k in range(lib.hooke_system_force_count(handle))
        ]

    @property
    def memory(self) -> int:
        """Memory that the system holds [bytes]."""
        return lib.hooke_system_memory(self._committed())

    @property
    def spring_memory(self) -> int:
        """The part of it that goes with the number of springs [bytes]."""
        return lib.hooke_system_spring_memory(self._committed())

    # forces

    def force(self, q: Any, v: Any, t: float = 0.0) -> np.ndarray:
        """Force on every particle (n, 3) [N]."""
        return self._vectors(lib.hooke_system_force, t, q=q, v=v)

    def acceleration(self, q: Any, v: Any, t: float = 0.0) -> np.ndarray:
        """Acceleration of every particle (n, 3) [m/s^2], zero where pinned or driven."""
        return self._vectors(lib.hooke_system_acceleration, t, q=q, v=v)

    def derivative_product(self, q: Any, v: Any, dq: Any, dv: Any, t: float = 0.0) -> np.ndarray:
        """(df/dq) dq + (df/dv) dv of the force, (n, 3)."""
        return self._vectors(lib.hooke_system_derivative_product, t, q=q, v=v, dq=dq, dv=dv)

    def derivative_blocks(self, q: Any, v: Any) -> Blocks:
        """df/dq [N/m] and df/dv [N s/m] as sparse 3x3 blocks, callbacks left out."""
        handle = self._committed()
        q, v = self._rows(q=q, v=v)
        count = lib.hooke_system_block_count(handle)
        blocks = Blocks(
            np.empty(self.particle_count + 1, np.int64),
            np.empty(count, np.int64),
            np.empty((count, 3, 3)),
            np.empty((count, 3, 3)),
        )
        lib.hooke_system_derivative_pattern(
            handle, index_pointer(blocks.row_start), index_pointer(blocks.column)
        )
        lib.hooke_system_derivative_blocks(
            handle,
            double_pointer(q),
            double_pointer(v),
            double_pointer(blocks.dfdq),
            double_pointer(blocks.dfdv),
        )
        return blocks

    def coincident_springs(self, q: Any) -> int:
        """Springs whose ends coincide although their rest length is not zero: they have no direction and
        no force."""
        return self._number(lib.hooke_system_coincident_springs, q=q)

    # energies

    def kinetic_energy(self, v: Any) -> float:
        """Kinetic energy of the free particles [J]."""
        return self._number(lib.hooke_system_kinetic_energy, v=v)

    def spring_energy(self, q: Any) -> float:
        """Energy of the springs [J]."""
        return self._number(lib.hooke_system_spring_energy, q=q)

    def bending_energy(self, q: Any) -> float:
        """Energy of bending [J]."""
        return self._number(lib.hooke_system_bending_energy, q=q)

    def gravity_energy(self, q: Any) -> float:
        """The sum of -m g.q over the free particles [J]."""
        return self._number(lib.hooke_system_gravity_energy, q=q)

    def potential_energy(self, q: Any) -> float:
        """Energy of springs, bending and gravity [J]."""
        return self._number(lib.hooke_system_potential_energy, q=q)

    def energy(self, q: Any, v: Any) -> float:
        """Total energy [J]. A force callback has none."""
        return self._number(lib.hooke_system_energy, q=q, v=v)

    def dissipated_power(self, q: Any, v: Any) -> float:
        """Power that damping and drag turn into heat [W]."""
        return self._number(lib.hooke_system_dissipated_power, q=q, v=v)

    def momentum(self, v: Any) -> np.ndarray:
        """Momentum of the free particles (3,) [kg m/s]."""
        return self._sum(lib.hooke_system_momentum, v=v)

    def angular_momentum(self, q: Any, v: Any) -> np.ndarray:
        """Angular momentum of the free particles about the origin (3,) [kg m^2/s]."""
        return self._sum(lib.hooke_system_angular_momentum, q=q, v=v)

    def step_bound(self, method: str, q: Any) -> float:
        """A step [s] below which `method` is certain to be stable for the system linearised at q: 0 if it
        never is, infinity if nothing limits it, NaN if no bound is known."""
        handle = self._committed()
        bound = np.empty(1)
        (q,) = self._rows(q=q)
        lib.hooke_step_bound(handle, method.encode(), double_pointer(q), double_pointer(bound))
        return float(bound[0])

    def _rows(self, **arrays: Any) -> list[np.ndarray]:
        return [rows(values, name, self.particle_count) for name, values in arrays.items()]

    def _vectors(self, function: Any, t: float, **arrays: Any) -> np.ndarray:
        handle = self._committed()
        out = np.empty((self.particle_count, 3))
        inputs = self._rows(**arrays)
        function(handle, t, *(double_pointer(array) for array in inputs), double_pointer(out))
        return out

    def _number(self, function: Any, **arrays: Any) -> Any:
        handle = self._committed()
        inputs = self._rows(**arrays)
        return function(handle, *(double_pointer(array) for array in inputs))

    def _sum(self, function: Any, **arrays: Any) -> np.ndarray:
        handle = self._committed()
        out = np.empty(3)
        inputs = self._rows(**arrays)
        function(handle, *(double_pointer(array) for array in inputs), double_pointer(out))
        return out


def build_facts() -> dict[str, str]:
    """The library's version and what it was built with; "" for a library that this build is without."""
    facts = {what: text(lib.hooke_build_fact(what.encode())) for what in _FACTS}
    return {"version": text(lib.hooke_version()), "path": str(lib.path), **facts}


_FACTS = ("sundials", "cholmod", "gsl", "arpack", "hdf5", "jansson", "chartjs", "threejs", "instructions", "licence")
